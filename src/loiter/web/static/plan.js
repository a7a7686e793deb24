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
 * @typedef {import("./handles.js").Stage} Stage
 *
 * @typedef {object} Shown  what a drawing needs
 * @property {Scene} scene
 * @property {Units} units
 * @property {Answer | null} answer
 * @property {import("./types.js").Altitude} altitude
 * @property {boolean} current  whether the answer is that to the scene
 *
 * @typedef {(scene: Scene, event: Event) => void} Change
 */
import { vector } from "./compass.js";
import { callout, drawBest, drawCircle, drawGrid, drawMarks, drawOther } from "./draw.js";
import { AEROPLANE, AIRCRAFT, CENTRE, HEADING, LEVER, WIND, dialOf, pivotOf, radiusHandle } from "./handles.js";
import { gestures } from "./gestures.js";
import { makeHandle, place } from "./draggable.js";
import { byId, polyline, set, show, svg } from "./svg.js";
import { sorted } from "./track.js";
import { tidy } from "./units.js";
import { contains, fitted, toScreen, zoomed } from "./view.js";

// Pixels between what must be seen and the edge, for buttons, dial, labels and key; less on a small screen.
const MARGINS = { left: 84, right: 64, top: 40, bottom: 64 };

/**
 * @param {() => Shown} shown
 * @param {Change} change
 * @param {(index: number | null) => void} hover  one of the others is pointed at
 * @param {() => void} moved  the user has moved the view
 */
export function planView(shown, change, hover, moved) {
  const root = byId("plan", SVGSVGElement);
  const layer = Object.fromEntries(
    ["grid", "circle", "others", "best", "marks", "wind", "handles"].map((name) => [
      name,
      svg("g", { class: `layer ${name}` }),
    ]),
  );
  const ghost = svg("g", { class: "ghost" }, [svg("path", { d: AEROPLANE })]);
  const label = svg("text", { class: "halo callout" });
  root.append(layer.grid, layer.circle, layer.others, layer.best, layer.marks, layer.wind, ghost, label, layer.handles);
  /** @type {View} */
  let view = { scale: 1, east: 0, north: 0, width: 800, height: 600 };
  let own = false; // whether the user has moved the view
  const handles = makeHandles(
    root,
    layer.handles,
    () => ({ view, scene: shown().scene, units: shown().units }),
    change,
  );

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
    const { scene, answer } = shown();
    set(root, {
      "data-scale": view.scale,
      "data-east": view.east,
      "data-north": view.north,
      "data-scene": JSON.stringify(scene),
    });
    drawCircle(layer.circle, view, scene, answer);
    handles.draw();
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
    ghost.setAttribute(
      "transform",
      `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${instant.heading_deg.toFixed(2)})`,
    );
  }

  function fit() {
    const { scene, answer } = shown();
    const points = extent(scene, answer);
    handles.turn(freest(scene, points));
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

  function bookmark() {
    const [was, mine] = [view, own];
    return () => {
      [view, own] = [was, mine];
      draw();
      moved();
    };
  }

  gestures(root, () => view, look, fit, bookmark);
  /** @param {number} width @param {number} height */
  function resize(width, height) {
    const first = view.width === 800 && view.height === 600;
    view = { ...view, width, height };
    set(root, { width, height, viewBox: `0 0 ${width} ${height}` });
    if (first) fit();
    else if (own) draw();
    else keep();
  }

  /** What the link tells of a view that the user has moved: its middle and how many metres it is wide. */
  function span() {
    return own
      ? [view.east, view.north, view.width / view.scale].map((metres) => tidy(metres, 0.1 / view.scale))
      : null;
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
 * The handles of the scene, with the lever of the heading and the dial of the wind.
 *
 * @param {SVGSVGElement} root
 * @param {SVGGElement} layer
 * @param {() => Stage} stage
 * @param {Change} change
 */
function makeHandles(root, layer, stage, change) {
  const { handle: radius, turn } = radiusHandle();
  const lever = svg("path", { class: "lever" });
  const dial = windDial();
  // Later ones lie on top: the aircraft is always within reach.
  const groups = [CENTRE, radius, WIND, HEADING, AIRCRAFT].map((handle) => ({
    handle,
    group: svg("g", { id: handle.id }, handle.parts),
  }));
  layer.append(dial.group, lever, ...groups.map(({ group }) => group));
  for (const { handle, group } of groups) listen(group, root, handle, stage, change);

  function draw() {
    const now = stage();
    for (const { handle, group } of groups)
      place(group, handle.at(now), handle.value(now.scene), handle.text(now.scene, now.units));
    turnTo("#aircraft .aeroplane", now.scene.pose.heading_deg);
    turnTo("#wind .tip", now.scene.wind ? now.scene.wind.from_deg + 180 : 0);
    lever.setAttribute("d", leverOf(now));
    dial.draw(now);
  }
  /** @param {string} selector @param {number} deg */
  const turnTo = (selector, deg) => layer.querySelector(selector)?.setAttribute("transform", `rotate(${deg})`);
  return { draw, turn };
}

/**
 * @param {SVGGElement} group
 * @param {SVGSVGElement} root
 * @param {import("./handles.js").Handle} handle
 * @param {() => Stage} stage
 * @param {Change} change
 */
function listen(group, root, handle, stage, change) {
  makeHandle(group, root, handle.label, {
    where: () => {
      handle.taken?.(stage());
      return handle.at(stage());
    },
    to: (point, event) => change(handle.to(stage(), point), event),
    by: (right, up, event) => change(handle.by(stage(), right, up), event),
  });
}

/** @param {Stage} stage */
function leverOf({ view, scene }) {
  const [x, y] = toScreen(view, scene.pose.east_m, scene.pose.north_m);
  const [east, north] = vector(scene.pose.heading_deg);
  return polyline([19, LEVER - 7].map((far) => [x + far * east, y - far * north]));
}

/** The dial of the wind: its outer ring is half the airspeed. */
function windDial() {
  const rings = [svg("circle"), svg("circle", { class: "half" })];
  const dial = svg("g", { class: "dial" }, rings);
  const shaft = svg("path", { class: "shaft" });
  const text = svg("text", { class: "dialtext halo", "text-anchor": "middle" });
  const group = svg("g", { class: "air" }, [dial, text, shaft]);
  /** @param {Stage} stage */
  function draw(stage) {
    const [x, y] = pivotOf(stage.view);
    const r = dialOf(stage.view);
    rings.forEach((ring, i) => ring.setAttribute("r", String(r / (i + 1))));
    dial.setAttribute("transform", `translate(${x} ${y})`);
    shaft.setAttribute("d", polyline([[x, y], WIND.at(stage)]));
    set(text, { x, y: y + r + 18 });
    text.textContent = stage.scene.wind ? WIND.text(stage.scene, stage.units) : "wind: calm";
  }
  return { group, draw };
}
