// @ts-check
/**
 * The plan view: grid, circle, aircraft, the optimal paths and those that lose, and the handles that change the scene.
 *
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./types.js").Answer} Answer
 * @typedef {import("./types.js").Maneuver} Maneuver
 * @typedef {import("./types.js").Alternative} Alternative
 * @typedef {import("./types.js").Units} Units
 * @typedef {import("./view.js").View} View
 * @typedef {import("./view.js").Point} Point
 * @typedef {import("./track.js").Instant} Instant
 *
 * @typedef {object} Shown  what a drawing needs
 * @property {Scene} scene
 * @property {Units} units
 * @property {Answer | null} answer
 *
 * @typedef {(scene: Scene, event: Event) => void} Change
 */
import { heading, vector } from "./compass.js";
import { makeHandle, place, pointOf } from "./handle.js";
import { byId, polyline, set, show, svg } from "./svg.js";
import { at, pieces } from "./track.js";
import { decimalsFor, difference, fixed, length, nice, tidy, unit, wrapped } from "./units.js";
import { contains, fitted, panned, toScreen, toWorld, zoomed } from "./view.js";

// Pixels between what must be seen and the edge, for buttons, dial, labels and key; less on a small screen.
const MARGINS = { left: 84, right: 64, top: 40, bottom: 64 };
const LEVER = 62; // pixels from the aircraft to the handle that turns it
const TINY = 30; // pixels: no handle of the radius is nearer to the centre
const DIALS = { small: 28, large: 42 }; // pixels: the wind dial's radius, half the airspeed
const GRID = 84; // pixels: lines of the grid are no closer

/** An aeroplane from above, nose up, some 30 pixels long. */
const AEROPLANE =
  "M0-15C1.3-15 2-13 2-10.5V-5L15 2.2V5L2 2V9.2L6 12.2V14L0 12.6-6 14V12.2L-2 9.2V2L-15 5V2.2L-2-5V-10.5C-2-13-1.3-15 0-15Z";
const ARROWHEAD = "M-6-5.5 6 0-6 5.5-3.5 0Z";

/**
 * The optimal maneuvers of an answer, and the others.
 *
 * @param {Answer} answer
 * @returns {{best: Maneuver[], others: Alternative[]}}
 */
export function sorted(answer) {
  const { alternatives, optimal } = answer;
  return { best: [answer, ...alternatives.slice(0, optimal - 1)], others: alternatives.slice(optimal - 1) };
}

/**
 * @param {() => Shown} shown
 * @param {Change} change
 * @param {(index: number | null) => void} hover  one of the others is pointed at
 * @param {() => void} moved  the user has moved the view
 */
export function planView(shown, change, hover, moved) {
  const root = byId("plan", SVGSVGElement);
  const layer = Object.fromEntries(
    ["grid", "circle", "others", "best", "marks", "wind", "handles"].map((name) => [name, svg("g", { class: `layer ${name}` })]),
  );
  const ghost = svg("g", { class: "ghost" }, [svg("path", { d: AEROPLANE })]);
  const label = svg("text", { class: "halo callout" });
  root.append(layer.grid, layer.circle, layer.others, layer.best, layer.marks, layer.wind, ghost, label, layer.handles);
  /** @type {View} */
  let view = { scale: 1, east: 0, north: 0, width: 800, height: 600 };
  let own = false; // whether the user has moved the view
  let bearing_deg = 150; // where on the circle the handle of its radius sits

  const handles = makeHandles(root, layer.handles, shown, change, () => view, (deg) => (bearing_deg = deg), () => bearing_deg);

  /** @param {View} next */
  function look(next) {
    view = next;
    own = true;
    draw();
    moved();
  }

  function draw() {
    drawGrid(layer.grid, view, shown().units);
    drawScene();
    drawAnswer();
    fly(flown);
    highlight(lit);
  }

  /** What follows the pointer at once; paths wait for their answer. */
  function drawScene() {
    const { scene, units, answer } = shown();
    set(root, { "data-scale": view.scale, "data-east": view.east, "data-north": view.north, "data-scene": JSON.stringify(scene) });
    drawCircle(layer.circle, view, scene, answer);
    handles.draw(scene, units);
  }

  function drawAnswer() {
    const { scene, answer } = shown();
    if (!answer) return;
    const { best, others } = sorted(answer);
    drawCircle(layer.circle, view, scene, answer);
    layer.best.replaceChildren(...best.flatMap((maneuver) => drawBest(view, maneuver)));
    layer.others.replaceChildren(...others.map((other, i) => drawOther(view, other, i, scene, hover)));
    layer.marks.replaceChildren(...best.flatMap((maneuver) => drawMarks(view, maneuver, scene)));
  }

  /** @type {number | null} */
  let lit = null;
  /** @param {number | null} index */
  function highlight(index) {
    lit = index;
    const { answer } = shown();
    const other = answer && index !== null ? sorted(answer).others[index] : undefined;
    Array.from(layer.others.children).forEach((child, i) => child.classList.toggle("lit", i === index));
    root.classList.toggle("comparing", other !== undefined);
    show(label, other !== undefined);
    if (other) callout(label, view, other);
  }

  /** @type {Instant | null} */
  let flown = null;
  /** @param {Instant | null} instant */
  function fly(instant) {
    flown = instant;
    show(ghost, instant !== null);
    if (!instant) return;
    const [x, y] = toScreen(view, instant.east_m, instant.north_m);
    ghost.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${instant.heading_deg.toFixed(2)})`);
  }

  function fit() {
    const { scene, answer } = shown();
    const points = extent(scene, answer);
    bearing_deg = freest(scene, points);
    const near = fitted(view, points, margin());
    // The handle of the heading is as long at any scale; one step brings it into the view.
    const [east, north] = vector(scene.pose.heading_deg);
    const reach = LEVER / near.scale;
    view = fitted(view, [...points, [scene.pose.east_m + reach * east, scene.pose.north_m + reach * north]], margin());
    own = false;
    draw();
    moved();
  }

  function keep() {
    const { scene, answer } = shown();
    if (!contains(view, extent(scene, answer), 16)) fit();
    else draw();
  }

  const margin = () => {
    const share = Math.min(1, view.width / 640, view.height / 420);
    const { left, right, top, bottom } = MARGINS;
    return { left: left * share, right: right * share, top: top * share, bottom: bottom * share };
  };

  moves(root, () => view, look, fit);
  /** @param {number} width @param {number} height */
  function resize(width, height) {
    const first = view.width === 800 && view.height === 600;
    view = { ...view, width, height };
    set(root, { width, height, viewBox: `0 0 ${width} ${height}` });
    if (first) fit();
    else keep();
  }

  /** What the link tells of a view that the user has moved: its middle and how many metres it is wide. */
  function span() {
    return own ? [view.east, view.north, view.width / view.scale].map((metres) => tidy(metres, 0.1 / view.scale)) : null;
  }

  /** @param {number[]} span */
  function showSpan([east, north, wide]) {
    look({ ...view, east, north, scale: view.width / wide });
  }

  const zoom = (/** @type {number} */ factor) => look(zoomed(view, [view.width / 2, view.height / 2], factor));
  return { draw, drawScene, drawAnswer, highlight, fly, fit, keep, resize, zoom, span, showSpan };
}

/**
 * What a view has to show: aircraft, circle, optimal paths.
 *
 * @param {Scene} scene
 * @param {Answer | null} answer
 * @returns {Point[]}
 */
function extent({ pose, orbit }, answer) {
  /** @type {Point[]} */
  const points = [[pose.east_m, pose.north_m]];
  const centres = [[orbit.east_m, orbit.north_m]];
  for (const maneuver of answer ? sorted(answer).best : []) {
    maneuver.track.east_m.forEach((east, i) => points.push([east, maneuver.track.north_m[i]]));
    centres.push([maneuver.join_over_ground.centre_east_m, maneuver.join_over_ground.centre_north_m]);
  }
  const r = Math.abs(orbit.radius_m);
  for (const [east, north] of centres) points.push([east - r, north - r], [east + r, north + r]);
  return points;
}

/**
 * The bearing at which the circle is farthest from what else is drawn: for the handle of its radius.
 *
 * @param {Scene} scene
 * @param {Point[]} points
 */
function freest({ orbit }, points) {
  const bearings = Array.from({ length: 24 }, (_, k) => 15 * k + 7);
  const room = bearings.map((bearing) => {
    const [east, north] = vector(bearing).map((part) => part * orbit.radius_m);
    return Math.min(...points.map(([x, y]) => Math.hypot(x - orbit.east_m - east, y - orbit.north_m - north)));
  });
  return bearings[room.indexOf(Math.max(...room))];
}

/**
 * @param {SVGGElement} layer
 * @param {View} view
 * @param {Units} units
 */
function drawGrid(layer, view, units) {
  const { name, size } = unit("length", units);
  const step = nice(GRID / (view.scale * size));
  const decimals = Math.max(0, -Math.floor(Math.log10(step)));
  const [west, north] = toWorld(view, [0, 0]);
  const [east, south] = toWorld(view, [view.width, view.height]);
  const lines = [];
  const texts = [];
  for (const k of within(west / size, east / size, step)) {
    const x = Math.round(toScreen(view, k * step * size, 0)[0]) + 0.5;
    lines.push(svg("path", { d: `M${x} 0V${view.height}`, class: k === 0 ? "axis" : "" }));
    if (x > 56 && x < view.width - 30) texts.push(svg("text", { x, y: view.height - 8, "text-anchor": "middle" }, [fixed(k * step, decimals)]));
  }
  for (const k of within(south / size, north / size, step)) {
    const y = Math.round(toScreen(view, 0, k * step * size)[1]) + 0.5;
    lines.push(svg("path", { d: `M0 ${y}H${view.width}`, class: k === 0 ? "axis" : "" }));
    if (y > 130 && y < view.height - 30) texts.push(svg("text", { x: 8, y: y + 4 }, [fixed(k * step, decimals)]));
  }
  texts.push(svg("text", { x: 8, y: view.height - 8, class: "unit" }, [name]));
  layer.replaceChildren(...lines, ...texts);
}

/**
 * The whole multiples of a step between two values; none where a view is so far off that they cannot be told apart.
 *
 * @param {number} from
 * @param {number} to
 * @param {number} step
 */
function within(from, to, step) {
  const first = Math.ceil(from / step);
  const count = Math.floor(to / step) - first + 1;
  return Array.from({ length: Math.min(200, Math.max(0, count)) }, (_, i) => first + i);
}

/**
 * @param {SVGGElement} layer
 * @param {View} view
 * @param {Scene} scene
 * @param {Answer | null} answer
 */
function drawCircle(layer, view, { orbit }, answer) {
  const [cx, cy] = toScreen(view, orbit.east_m, orbit.north_m);
  const r = Math.abs(orbit.radius_m) * view.scale;
  const moves = orbit.velocity_east_m_s !== 0 || orbit.velocity_north_m_s !== 0;
  const parts = [svg("circle", { cx, cy, r, class: moves ? "start" : "" })];
  const best = answer ? sorted(answer).best : [];
  if (moves && answer) {
    const { centre_east_m, centre_north_m } = answer.join_over_ground;
    const [x, y] = toScreen(view, centre_east_m, centre_north_m);
    parts.push(svg("circle", { cx: x, cy: y, r }));
    layer.replaceChildren(...parts, svg("path", { d: `M${cx} ${cy}L${x} ${y}`, class: "drift" }), ...holds([x, y], r, best));
    return;
  }
  layer.replaceChildren(...parts, ...holds([cx, cy], r, best));
}

/**
 * Arrows round the circle, the way it is held.
 *
 * @param {Point} centre
 * @param {number} r pixels
 * @param {Maneuver[]} best
 */
function holds([cx, cy], r, best) {
  const count = r < 24 ? 0 : 4;
  return [...new Set(best.map((maneuver) => maneuver.turn))].flatMap((turn, i) =>
    Array.from({ length: count }, (_, k) => {
      const bearing = (k + (i + 1) / 3) * (360 / count);
      const [east, north] = vector(bearing);
      const along = turn === "cw" ? bearing : bearing + 180;
      return svg("path", { d: ARROWHEAD, class: "hold", transform: `translate(${cx + r * east} ${cy - r * north}) rotate(${along})` });
    }),
  );
}

/**
 * @param {View} view
 * @param {Maneuver} maneuver
 * @param {number[]} [indices]
 */
function pathOf(view, { track }, indices) {
  const all = indices ?? track.time_s.map((_, i) => i);
  return polyline(all.map((i) => toScreen(view, track.east_m[i], track.north_m[i])));
}

/**
 * @param {View} view
 * @param {Maneuver} maneuver
 */
function drawBest(view, maneuver) {
  const found = pieces(maneuver);
  return [
    svg("path", { d: pathOf(view, maneuver), class: "casing" }),
    ...found.map(({ letter, indices }) => svg("path", { d: pathOf(view, maneuver, indices), class: `piece ${letter}`, "data-letter": letter })),
    ...found.flatMap(({ letter, indices }) => arrowOn(view, maneuver, letter, indices)),
  ];
}

/**
 * An arrow half way along a piece, where that is long enough to carry one.
 *
 * @param {View} view
 * @param {Maneuver} maneuver
 * @param {string} letter
 * @param {number[]} indices
 */
function arrowOn(view, { track }, letter, indices) {
  const points = indices.map((i) => toScreen(view, track.east_m[i], track.north_m[i]));
  const reached = points.reduce((sums, [x, y], i) => {
    const last = points[Math.max(0, i - 1)];
    return [...sums, (sums.at(-1) ?? 0) + Math.hypot(x - last[0], y - last[1])];
  }, /** @type {number[]} */ ([]));
  const whole = reached.at(-1) ?? 0;
  if (whole < 46) return [];
  const j = Math.max(1, reached.findIndex((sum) => sum >= whole / 2));
  const [from, to] = [points[j - 1], points[j]];
  const share = (whole / 2 - reached[j - 1]) / (reached[j] - reached[j - 1] || 1);
  const [x, y] = [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
  const angle = (Math.atan2(to[1] - from[1], to[0] - from[0]) * 180) / Math.PI;
  return [svg("path", { d: ARROWHEAD, class: `arrow ${letter}`, transform: `translate(${x} ${y}) rotate(${angle})` })];
}

/**
 * @param {View} view
 * @param {Alternative} other
 * @param {number} index
 * @param {Scene} scene
 * @param {(index: number | null) => void} hover
 */
function drawOther(view, other, index, { orbit }, hover) {
  const d = pathOf(view, other);
  const asked = orbit.turn === "either" || orbit.turn === other.turn;
  const group = svg("g", { class: asked ? "other" : "other unasked" }, [svg("path", { d, class: "line", "stroke-opacity": Math.max(0.25, 0.8 - 0.12 * index) }), svg("path", { d, class: "reach" })]);
  group.addEventListener("pointerenter", () => hover(index));
  group.addEventListener("pointerleave", () => hover(null));
  return group;
}

/**
 * The word of a path that loses, and by how much, beside its middle.
 *
 * @param {SVGTextElement} label
 * @param {View} view
 * @param {Alternative} other
 */
function callout(label, view, other) {
  const { track, word, turn, later_s } = other;
  const middle = track.time_s.length >> 1;
  const [x, y] = toScreen(view, track.east_m[middle], track.north_m[middle]);
  const inside = [Math.min(view.width - 90, Math.max(90, x)), Math.min(view.height - 30, Math.max(24, y - 12))];
  set(label, { x: inside[0], y: inside[1], "text-anchor": "middle" });
  label.textContent = `${word} ${turn}: ${difference(later_s)} ${later_s < 0 ? "sooner" : "later"}`;
}

/**
 * Where controls change, and where the circle is joined.
 *
 * @param {View} view
 * @param {Maneuver} maneuver
 * @param {Scene} scene
 */
function drawMarks(view, maneuver, scene) {
  const { segments, join, duration_s } = maneuver;
  if (segments.length === 0) return [];
  const decimals = decimalsFor(scene.orbit.radius_m, "metric");
  const { centre_east_m, centre_north_m } = maneuver.join_over_ground;
  const centre = toScreen(view, centre_east_m, centre_north_m);
  const ends = segments.slice(1).map(({ start, start_s }, i) => ({ pose: start, time: start_s, last: i === segments.length - 2 }));
  const marks = ends.map(({ pose }) => {
    const [cx, cy] = toScreen(view, pose.east_m, pose.north_m);
    return svg("circle", { cx, cy, r: 4.5, class: "switch" });
  });
  const [cx, cy] = toScreen(view, join.east_m, join.north_m);
  const joined = svg("circle", { cx, cy, r: 6, class: "join" });
  const taken = Array.from({ length: 81 }, (_, i) => at(maneuver.track, (i / 80) * duration_s)).map(({ east_m, north_m }) => toScreen(view, east_m, north_m));
  taken.push(...rim(centre, Math.hypot(cx - centre[0], cy - centre[1])));
  taken.push(...handled(view, scene));
  const texts = [beside(view, [cx, cy], taken, `join ${fixed(duration_s, decimals)} s`)];
  for (const { pose, time, last } of ends) {
    const point = toScreen(view, pose.east_m, pose.north_m);
    const crowded = Math.hypot(point[0] - cx, point[1] - cy) < 26 || nearStart(view, scene, point);
    if (last && !crowded) texts.push(beside(view, point, taken, `peel off ${fixed(time, decimals)} s`));
  }
  return [...marks, joined, ...texts];
}

/**
 * Points round a circle.
 *
 * @param {Point} centre
 * @param {number} r
 * @returns {Point[]}
 */
function rim([x, y], r) {
  return Array.from({ length: 72 }, (_, k) => vector(5 * k)).map(([east, north]) => [x + r * east, y - r * north]);
}

/**
 * @param {View} view
 * @param {Scene} scene
 * @param {Point} point
 */
function nearStart(view, { pose }, [x, y]) {
  const [left, top] = toScreen(view, pose.east_m, pose.north_m);
  return Math.hypot(x - left, y - top) < 30;
}

/**
 * Points that the aircraft and the handle of its heading cover.
 *
 * @param {View} view
 * @param {Scene} scene
 * @returns {Point[]}
 */
function handled(view, { pose }) {
  const [x, y] = toScreen(view, pose.east_m, pose.north_m);
  const [east, north] = vector(pose.heading_deg);
  return Array.from({ length: 16 }, (_, k) => [x + (5 * k - 12) * east, y - (5 * k - 12) * north]);
}

/**
 * A text beside a point, on the side where it covers the fewest of the points that are taken.
 *
 * @param {View} view
 * @param {Point} point
 * @param {Point[]} taken
 * @param {string} text
 */
function beside(view, [x, y], taken, text) {
  const width = 6.6 * text.length;
  const sides = [0, 45, 90, 135, 180, 225, 270, 315].map((bearing) => {
    const [ux, up] = vector(bearing);
    const left = x + 13 * ux + (width / 2) * (Math.abs(ux) < 0.1 ? -1 : Math.sign(ux) - 1);
    const middle = y - 17 * up;
    const covered = taken.filter(([px, py]) => px > left - 4 && px < left + width + 4 && Math.abs(py - middle) < 10);
    const cut = left < 4 || left + width > view.width - 4;
    return { left, middle, covered: covered.length + (cut ? 1000 : 0) };
  });
  const best = sides.reduce((least, side) => (side.covered < least.covered ? side : least));
  return svg("text", { x: best.left, y: best.middle + 4, class: "halo" }, [text]);
}

/**
 * The handles of the scene: aircraft, heading, centre, radius, wind.
 *
 * @param {SVGSVGElement} root
 * @param {SVGGElement} layer
 * @param {() => Shown} shown
 * @param {Change} change
 * @param {() => View} viewed
 * @param {(bearing_deg: number) => void} turned
 * @param {() => number} bearing
 */
function makeHandles(root, layer, shown, change, viewed, turned, bearing) {
  const lever = svg("path", { class: "lever" });
  const rings = [svg("circle"), svg("circle", { class: "half" })];
  const dial = svg("g", { class: "dial" }, rings);
  const face = () => (viewed().width < 500 ? DIALS.small : DIALS.large);
  const shaft = svg("path", { class: "shaft" });
  const calm = svg("text", { class: "dialtext halo", "text-anchor": "middle" });
  const disc = (/** @type {number} */ r) => svg("circle", { r, class: "touch" });
  const ring = (/** @type {number} */ r) => svg("circle", { r, class: "focus" });
  const aircraft = svg("g", { id: "aircraft" }, [disc(24), ring(23), svg("path", { d: AEROPLANE, class: "aeroplane" })]);
  const nose = svg("g", { id: "heading" }, [disc(20), ring(12), svg("circle", { r: 6.5, class: "grip" })]);
  const centre = svg("g", { id: "centre" }, [disc(20), ring(14), svg("path", { d: "M-8 0H8M0-8V8", class: "cross" })]);
  const radius = svg("g", { id: "radius" }, [disc(20), ring(12), svg("circle", { r: 6.5, class: "grip" })]);
  const wind = svg("g", { id: "wind" }, [disc(18), ring(12), svg("path", { d: "M0-9 6.5 5H-6.5Z", class: "tip" })]);
  layer.append(dial, calm, shaft, lever, centre, radius, wind, nose, aircraft);

  const at = () => toScreen(viewed(), shown().scene.pose.east_m, shown().scene.pose.north_m);
  const hub = () => toScreen(viewed(), shown().scene.orbit.east_m, shown().scene.orbit.north_m);
  /** @returns {Point} */
  const pivot = () => [viewed().width - Math.max(56, face() + 22), face() + (face() === DIALS.large ? 30 : 14)];
  // A tenth of a pixel: what a drag is rounded to; and a tenth of a line of the grid: what a key moves by.
  const fine = () => 0.1 / viewed().scale;
  const step = () => {
    const { size } = unit("length", shown().units);
    return (nice(GRID / (viewed().scale * size)) * size) / 20;
  };
  let slack = 0;

  /** @param {Partial<Scene["pose"]>} pose @param {Event} event */
  const setPose = (pose, event) => change({ ...shown().scene, pose: { ...shown().scene.pose, ...pose } }, event);
  /** @param {Partial<Scene["orbit"]>} orbit @param {Event} event */
  const setOrbit = (orbit, event) => change({ ...shown().scene, orbit: { ...shown().scene.orbit, ...orbit } }, event);
  /** @param {number} east @param {number} north speeds, m/s @param {Event} event */
  function setWind(east, north, event) {
    const finest = shown().scene.aircraft.airspeed_m_s / 180;
    const speed_m_s = tidy(Math.hypot(east, north), finest);
    const wind = speed_m_s > 0 ? { speed_m_s, from_deg: tidy(heading(-east, -north), 1) % 360 } : null;
    change({ ...shown().scene, wind }, event);
  }
  const blowing = () => {
    const { wind: air } = shown().scene;
    const [east, north] = air ? vector(air.from_deg) : [0, 0];
    return air ? [-air.speed_m_s * east, -air.speed_m_s * north] : [0, 0];
  };
  const perSpeed = () => (2 * face()) / shown().scene.aircraft.airspeed_m_s;
  /** @returns {Point} */
  const tipAt = () => {
    const [east, north] = blowing();
    const [x, y] = pivot();
    const speed = Math.hypot(east, north);
    const far = speed > 0 ? Math.min(speed * perSpeed(), 2 * face()) / speed : 0;
    return [x + far * east, y - far * north];
  };
  /** @returns {Point} */
  const noseAt = () => {
    const [east, north] = vector(shown().scene.pose.heading_deg);
    const [x, y] = at();
    return [x + LEVER * east, y - LEVER * north];
  };
  /** @returns {Point} */
  const rimAt = () => {
    const [x, y] = hub();
    const real = Math.abs(shown().scene.orbit.radius_m) * viewed().scale;
    const [east, north] = vector(bearing());
    const far = Math.max(TINY, real);
    return [x + far * east, y - far * north];
  };

  makeHandle(aircraft, root, "Aircraft", {
    where: at,
    to: (point, event) => {
      const [east, north] = toWorld(viewed(), point);
      setPose({ east_m: tidy(east, fine()), north_m: tidy(north, fine()) }, event);
    },
    by: (right, up, event) => {
      const { east_m, north_m } = shown().scene.pose;
      setPose({ east_m: tidy(east_m + right * step(), fine()), north_m: tidy(north_m + up * step(), fine()) }, event);
    },
  });
  makeHandle(nose, root, "Heading of the aircraft", {
    where: noseAt,
    to: ([x, y], event) => {
      const [left, top] = at();
      setPose({ heading_deg: tidy(heading(x - left, top - y), 1) % 360 }, event);
    },
    by: (right, up, event) => setPose({ heading_deg: tidy(wrapped(shown().scene.pose.heading_deg + right - up), 1e-6) }, event),
  });
  makeHandle(centre, root, "Centre of the circle", {
    where: hub,
    to: (point, event) => {
      const [east, north] = toWorld(viewed(), point);
      setOrbit({ east_m: tidy(east, fine()), north_m: tidy(north, fine()) }, event);
    },
    by: (right, up, event) => {
      const { east_m, north_m } = shown().scene.orbit;
      setOrbit({ east_m: tidy(east_m + right * step(), fine()), north_m: tidy(north_m + up * step(), fine()) }, event);
    },
  });
  makeHandle(radius, root, "Radius of the circle", {
    where: () => {
      slack = Math.max(0, TINY - shown().scene.orbit.radius_m * viewed().scale);
      return rimAt();
    },
    to: ([x, y], event) => {
      const [left, top] = hub();
      turned(heading(x - left, top - y));
      const pixels = Math.max(1, Math.hypot(x - left, y - top) - slack);
      setOrbit({ radius_m: tidy(pixels / viewed().scale, fine()) }, event);
    },
    by: (right, up, event) => {
      const radius_m = tidy(shown().scene.orbit.radius_m + (right + up) * step(), fine());
      if (radius_m > 0) setOrbit({ radius_m }, event);
    },
  });
  makeHandle(wind, root, "Wind", {
    where: tipAt,
    to: ([x, y], event) => {
      const [left, top] = pivot();
      const far = Math.hypot(x - left, y - top);
      const share = (far < 3 ? 0 : Math.min(1, (1.9 * face()) / far)) / perSpeed();
      setWind((x - left) * share, (top - y) * share, event);
    },
    by: (right, up, event) => {
      const [east, north] = blowing();
      const size = shown().scene.aircraft.airspeed_m_s / 100;
      setWind(east + right * size, north + up * size, event);
    },
  });

  /** @param {Scene} scene @param {Units} units */
  function draw(scene, units) {
    const { pose, orbit, wind: air } = scene;
    const decimals = decimalsFor(orbit.radius_m, units);
    const there = (/** @type {{east_m: number, north_m: number}} */ { east_m, north_m }) =>
      `${length(east_m, units, decimals)} east, ${length(north_m, units, decimals)} north`;
    const [x, y] = at();
    const [left, top] = noseAt();
    place(aircraft, [x, y], pose.east_m, there(pose));
    aircraft.querySelector(".aeroplane")?.setAttribute("transform", `rotate(${pose.heading_deg})`);
    place(nose, [left, top], pose.heading_deg, `${fixed(pose.heading_deg, 0)} degrees`);
    set(nose, { "aria-valuemin": 0, "aria-valuemax": 360 });
    const [east, north] = vector(pose.heading_deg);
    lever.setAttribute("d", polyline([[x + 19 * east, y - 19 * north], [left - 7 * east, top + 7 * north]]));
    place(centre, hub(), orbit.east_m, there(orbit));
    place(radius, rimAt(), orbit.radius_m, length(orbit.radius_m, units, decimals));
    drawWind(air, units);
  }
  /** @param {Scene["wind"]} air @param {Units} units */
  function drawWind(air, units) {
    const [x, y] = pivot();
    const tip = tipAt();
    const { name, size } = unit("speed", units);
    const text = air ? `${fixed(air.speed_m_s / size, 1)} ${name} from ${fixed(air.from_deg, 0)}°` : "calm";
    place(wind, tip, air?.speed_m_s ?? 0, air ? text : "calm");
    wind.querySelector(".tip")?.setAttribute("transform", `rotate(${air ? air.from_deg + 180 : 0})`);
    rings.forEach((ring, i) => ring.setAttribute("r", String(face() / (i + 1))));
    dial.setAttribute("transform", `translate(${x} ${y})`);
    shaft.setAttribute("d", polyline([[x, y], tip]));
    set(calm, { x, y: y + face() + 18 });
    calm.textContent = air ? text : "wind: calm";
  }
  return { draw };
}

/**
 * Pan with the pointer or the arrow keys, zoom with the wheel, two fingers or plus and minus; 0 fits.
 *
 * @param {SVGSVGElement} root
 * @param {() => View} viewed
 * @param {(view: View) => void} look
 * @param {() => void} fit
 */
function moves(root, viewed, look, fit) {
  /** @type {Map<number, Point>} */
  const fingers = new Map();
  root.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    fingers.set(event.pointerId, pointOf(root, event));
    root.setPointerCapture(event.pointerId);
  });
  root.addEventListener("pointermove", (event) => {
    const from = fingers.get(event.pointerId);
    if (!from) return;
    const to = pointOf(root, event);
    fingers.set(event.pointerId, to);
    const still = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (!still) return look(panned(viewed(), to[0] - from[0], to[1] - from[1]));
    const wide = (/** @type {Point} */ [x, y]) => Math.max(1, Math.hypot(x - still[0], y - still[1]));
    look(zoomed(viewed(), still, wide(to) / wide(from)));
  });
  for (const end of /** @type {const} */ (["pointerup", "pointercancel", "lostpointercapture"]))
    root.addEventListener(end, (event) => fingers.delete(event.pointerId));
  root.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1);
      look(zoomed(viewed(), pointOf(root, event), Math.exp(-pixels / 500)));
    },
    { passive: false },
  );
  root.addEventListener("keydown", (event) => {
    const view = viewed();
    /** @type {Record<string, () => void>} */
    const keys = {
      ArrowLeft: () => look(panned(view, 60, 0)),
      ArrowRight: () => look(panned(view, -60, 0)),
      ArrowUp: () => look(panned(view, 0, 60)),
      ArrowDown: () => look(panned(view, 0, -60)),
      "+": () => look(zoomed(view, [view.width / 2, view.height / 2], 1.25)),
      "-": () => look(zoomed(view, [view.width / 2, view.height / 2], 0.8)),
      0: fit,
    };
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    keys[event.key]();
    event.preventDefault();
  });
}
