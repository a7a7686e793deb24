// @ts-check
/**
 * What the plan view draws: grid, circle, paths, marks. Each function makes elements for a view and keeps nothing.
 *
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./types.js").Answer} Answer
 * @typedef {import("./types.js").Maneuver} Maneuver
 * @typedef {import("./types.js").Alternative} Alternative
 * @typedef {import("./types.js").Units} Units
 * @typedef {import("./view.js").View} View
 * @typedef {import("./view.js").Point} Point
 */
import { vector } from "./compass.js";
import { gridOf } from "./handles.js";
import { polyline, set, svg } from "./svg.js";
import { at, pieces, sorted } from "./track.js";
import { decimalsFor, difference, fixed } from "./units.js";
import { toScreen, toWorld } from "./view.js";

const ARROWHEAD = "M-6-5.5 6 0-6 5.5-3.5 0Z";

/**
 * @param {SVGGElement} layer
 * @param {View} view
 * @param {Units} units
 */
export function drawGrid(layer, view, units) {
  const { name, size, step } = gridOf(view, units);
  const decimals = Math.max(0, -Math.floor(Math.log10(step)));
  const [west, north] = toWorld(view, [0, 0]);
  const [east, south] = toWorld(view, [view.width, view.height]);
  const lines = [];
  const texts = [];
  for (const k of within(west / size, east / size, step)) {
    const x = Math.round(toScreen(view, k * step * size, 0)[0]) + 0.5;
    lines.push(svg("path", { d: `M${x} 0V${view.height}`, class: k === 0 ? "axis" : "" }));
    if (x > 56 && x < view.width - 30)
      texts.push(svg("text", { x, y: view.height - 8, "text-anchor": "middle" }, [fixed(k * step, decimals)]));
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
export function drawCircle(layer, view, { orbit }, answer) {
  const [cx, cy] = toScreen(view, orbit.east_m, orbit.north_m);
  const r = Math.abs(orbit.radius_m) * view.scale;
  const moves = orbit.velocity_east_m_s !== 0 || orbit.velocity_north_m_s !== 0;
  const parts = [svg("circle", { cx, cy, r, class: moves ? "start" : "" })];
  const best = answer ? sorted(answer).best : [];
  if (moves && answer) {
    const { centre_east_m, centre_north_m } = answer.join_over_ground;
    const [x, y] = toScreen(view, centre_east_m, centre_north_m);
    parts.push(svg("circle", { cx: x, cy: y, r }));
    layer.replaceChildren(
      ...parts,
      svg("path", { d: `M${cx} ${cy}L${x} ${y}`, class: "drift" }),
      ...holds([x, y], r, best),
    );
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
      return svg("path", {
        d: ARROWHEAD,
        class: "hold",
        transform: `translate(${cx + r * east} ${cy - r * north}) rotate(${along})`,
      });
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
export function drawBest(view, maneuver) {
  const found = pieces(maneuver);
  return [
    svg("path", { d: pathOf(view, maneuver), class: "casing" }),
    ...found.map(({ letter, indices }) =>
      svg("path", { d: pathOf(view, maneuver, indices), class: `piece ${letter}`, "data-letter": letter }),
    ),
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
  const j = Math.max(
    1,
    reached.findIndex((sum) => sum >= whole / 2),
  );
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
export function drawOther(view, other, index, { orbit }, hover) {
  const d = pathOf(view, other);
  const asked = orbit.turn === "either" || orbit.turn === other.turn;
  const group = svg("g", { class: asked ? "other" : "other unasked" }, [
    svg("path", { d, class: "line", "stroke-opacity": Math.max(0.25, 0.8 - 0.12 * index) }),
    svg("path", { d, class: "reach" }),
  ]);
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
export function callout(label, view, other) {
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
export function drawMarks(view, maneuver, scene) {
  const { segments, join, duration_s } = maneuver;
  if (segments.length === 0) return [];
  const decimals = decimalsFor(scene.orbit.radius_m, "metric");
  const { centre_east_m, centre_north_m } = maneuver.join_over_ground;
  const centre = toScreen(view, centre_east_m, centre_north_m);
  const ends = segments
    .slice(1)
    .map(({ start, start_s }, i) => ({ pose: start, time: start_s, last: i === segments.length - 2 }));
  const marks = ends.map(({ pose }) => {
    const [cx, cy] = toScreen(view, pose.east_m, pose.north_m);
    return svg("circle", { cx, cy, r: 4.5, class: "switch" });
  });
  const [cx, cy] = toScreen(view, join.east_m, join.north_m);
  const joined = svg("circle", { cx, cy, r: 6, class: "join" });
  const taken = Array.from({ length: 81 }, (_, i) => at(maneuver.track, (i / 80) * duration_s)).map(
    ({ east_m, north_m }) => toScreen(view, east_m, north_m),
  );
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
