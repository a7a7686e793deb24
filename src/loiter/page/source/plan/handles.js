// @ts-check
/**
 * The handles of the plan view: aircraft, heading, centre and radius of the circle. Each gives its position on the
 * screen, and the scene after a drag or a key.
 *
 * @import {Scene, Units} from "../shared/types.js"
 * @import {Point, View} from "../shared/geometry.js"
 *
 * @typedef {object} Stage
 * @property {View} view
 * @property {Scene} scene
 * @property {Units} units
 * @property {number} radiusBearing_deg  where on the circle the handle of the radius is
 *
 * @typedef {object} Handle
 * @property {string} id
 * @property {string} label
 * @property {SVGElement[]} parts
 * @property {(stage: Stage) => Point} position  pixels
 * @property {(stage: Stage, point: Point) => Scene} dragTo  the scene after a drag to a point
 * @property {(stage: Stage, right: number, up: number) => Scene} moveBy  the scene after steps of the arrow keys
 * @property {(stage: Stage, point: Point) => number} [bearing]  of the handle of the radius after a drag
 * @property {(stage: Stage) => void} [dragBegins]
 * @property {(scene: Scene) => boolean} [isShown]  whether the scene has what the handle moves; by default it has
 * @property {(stage: Stage) => Scene} [remove]  the scene without what the handle moves
 * @property {(scene: Scene) => number} value  for assistive software
 * @property {(scene: Scene, units: Units) => string} text  for assistive software
 */
import { withOrbit, withPose } from "../scene/scene.js";
import { zoneHandles } from "../scene/fence.js";
import { svg } from "../shared/dom.js";
import { headingOf, pointAt, positionToScreen, toScreen, toWorld, wrapped } from "../shared/geometry.js";
import { decimalsFor, fixed, quantityText, tidy } from "../shared/units.js";
import { gridOf } from "./background.js";

/** An aeroplane from above, nose up, some 30 pixels long. */
export const AEROPLANE =
  "M0-15C1.3-15 2-13 2-10.5V-5L15 2.2V5L2 2V9.2L6 12.2V14L0 12.6-6 14V12.2L-2 9.2V2L-15 5V2.2L-2-5V-10.5C-2-13-1.3-15 0-15Z";

/** Pixels from the aircraft to the handle of its heading. */
export const HEADING_HANDLE_PX = 62;

const LEAST_RADIUS_PX = 30; // from the centre to the handle of the radius

/** The step of an arrow key, metres: a twentieth of the spacing of the grid. @param {Stage} stage */
export function stepOf({ view, units }) {
  const { step, size } = gridOf(view, units);
  return (step * size) / 20;
}

/** The resolution of a drag, metres: a tenth of a pixel. @param {View} view */
export const resolutionOf = (view) => 0.1 / view.scale;

/** A position after a drag or a key. @param {Stage} stage @param {Point} point east and north */
export function tidyPosition({ view }, [east, north]) {
  return { east_m: tidy(east, resolutionOf(view)), north_m: tidy(north, resolutionOf(view)) };
}

/** @param {Stage} stage @param {{east_m: number, north_m: number}} from @param {number} right @param {number} up */
export function stepped(stage, { east_m, north_m }, right, up) {
  return tidyPosition(stage, [east_m + right * stepOf(stage), north_m + up * stepOf(stage)]);
}

/** @param {Stage} stage @returns {Point} */
const aircraftPoint = ({ view, scene }) => positionToScreen(view, scene.pose);

/** @param {Stage} stage @returns {Point} */
const centrePoint = ({ view, scene }) => positionToScreen(view, scene.orbit);

/** The bearing on the screen from one point to another. @param {Point} from @param {Point} to */
const bearingBetween = (from, to) => headingOf(to[0] - from[0], from[1] - to[1]);

/** @param {{east_m: number, north_m: number}} position @param {Scene} scene @param {Units} units */
export function positionText({ east_m, north_m }, { orbit }, units) {
  const length = (/** @type {number} */ metres) =>
    quantityText(metres, "length", units, decimalsFor(orbit.radius_m, units));
  return `${length(east_m)} east, ${length(north_m)} north`;
}

/**
 * The elements of a handle: an area for the finger, a ring that shows the focus, and its shape.
 *
 * @param {number} touch_px
 * @param {number} focus_px
 * @param {SVGElement} shape
 */
export const handleParts = (touch_px, focus_px, shape) => [
  svg("circle", { r: touch_px, class: "touch" }),
  svg("circle", { r: focus_px, class: "focus" }),
  shape,
];

const knob = () => svg("circle", { r: 6.5, class: "knob" });

/** @type {Handle} */
export const AIRCRAFT = {
  id: "aircraft",
  label: "Aircraft",
  parts: handleParts(24, 23, svg("path", { d: AEROPLANE, class: "aeroplane" })),
  position: aircraftPoint,
  dragTo: (stage, point) => withPose(stage.scene, tidyPosition(stage, toWorld(stage.view, point))),
  moveBy: (stage, right, up) => withPose(stage.scene, stepped(stage, stage.scene.pose, right, up)),
  value: ({ pose }) => pose.east_m,
  text: (scene, units) => positionText(scene.pose, scene, units),
};

/** @type {Handle} */
export const HEADING = {
  id: "heading",
  label: "Heading of the aircraft",
  parts: handleParts(20, 12, knob()),
  position: (stage) => pointAt(aircraftPoint(stage), stage.scene.pose.heading_deg, HEADING_HANDLE_PX),
  dragTo: (stage, point) =>
    withPose(stage.scene, { heading_deg: tidy(bearingBetween(aircraftPoint(stage), point), 1) % 360 }),
  moveBy: ({ scene }, right, up) =>
    withPose(scene, { heading_deg: tidy(wrapped(scene.pose.heading_deg + right - up), 1e-6) }),
  value: ({ pose }) => pose.heading_deg,
  text: ({ pose }) => `${fixed(pose.heading_deg, 0)} degrees`,
};

/** @type {Handle} */
export const CENTRE = {
  id: "centre",
  label: "Centre of the circle",
  parts: handleParts(20, 14, svg("path", { d: "M-8 0H8M0-8V8", class: "cross" })),
  position: centrePoint,
  dragTo: (stage, point) => withOrbit(stage.scene, tidyPosition(stage, toWorld(stage.view, point))),
  moveBy: (stage, right, up) => withOrbit(stage.scene, stepped(stage, stage.scene.orbit, right, up)),
  value: ({ orbit }) => orbit.east_m,
  text: (scene, units) => positionText(scene.orbit, scene, units),
};

/** Where a handle on the circle is; of a tiny circle outside. @param {Stage} stage @param {number} bearing_deg */
export function pointOnCircle(stage, bearing_deg) {
  const radius_px = Math.abs(stage.scene.orbit.radius_m) * stage.view.scale;
  return pointAt(centrePoint(stage), bearing_deg, Math.max(LEAST_RADIUS_PX, radius_px));
}

/** The bearing of a point from the centre. @param {Stage} stage @param {Point} point */
export const bearingFromCentre = (stage, point) => bearingBetween(centrePoint(stage), point);

/** Where the handle of the radius is. @param {Stage} stage */
const radiusPoint = (stage) => pointOnCircle(stage, stage.radiusBearing_deg);

/** Where the handles of aircraft, circle, fence and leg are. @param {Stage} stage */
export const handlePoints = (stage) => [
  ...[...zoneHandles(stage.scene), ...(stage.scene.leg ? [stage.scene.leg.exit_to] : [])].map(([east, north]) => toScreen(stage.view, east, north)),
  aircraftPoint(stage),
  HEADING.position(stage),
  centrePoint(stage),
  radiusPoint(stage),
  ...(stage.scene.slot ? [pointOnCircle(stage, stage.scene.slot.phase_deg)] : []),
];

/**
 * The handle of the radius. It may be anywhere on the circle, but never too near to the centre: on a tiny circle it
 * lies outside, by a distance in pixels that a drag must not add to the radius.
 *
 * @returns {Handle}
 */
export function radiusHandle() {
  let outside_px = 0; // when the drag began
  const radius_px = (/** @type {Stage} */ { view, scene }) => Math.abs(scene.orbit.radius_m) * view.scale;
  return {
    id: "radius",
    label: "Radius of the circle",
    parts: handleParts(20, 12, knob()),
    position: radiusPoint,
    dragBegins: (stage) => (outside_px = Math.max(0, LEAST_RADIUS_PX - radius_px(stage))),
    bearing: bearingFromCentre,
    dragTo: (stage, point) => {
      const [x, y] = centrePoint(stage);
      const pixels = Math.max(1, Math.hypot(point[0] - x, point[1] - y) - outside_px);
      return withOrbit(stage.scene, { radius_m: tidy(pixels / stage.view.scale, resolutionOf(stage.view)) });
    },
    moveBy: (stage, right, up) => {
      const radius_m = tidy(stage.scene.orbit.radius_m + (right + up) * stepOf(stage), resolutionOf(stage.view));
      return radius_m > 0 ? withOrbit(stage.scene, { radius_m }) : stage.scene;
    },
    value: ({ orbit }) => orbit.radius_m,
    text: ({ orbit }, units) => quantityText(orbit.radius_m, "length", units, decimalsFor(orbit.radius_m, units)),
  };
}
