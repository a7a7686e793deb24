// @ts-check
/**
 * Marks on a path, where the control changes and where the circle is joined, with labels that cover as little as
 * possible.
 *
 * @typedef {import("../shared/types.js").Maneuver} Maneuver
 * @typedef {import("../shared/types.js").Scene} Scene
 * @typedef {import("../shared/geometry.js").Point} Point
 * @typedef {import("../shared/geometry.js").View} View
 */
import { svg } from "../shared/dom.js";
import { pointAt, positionToScreen, toScreen, unitVector } from "../shared/geometry.js";
import { stateAt } from "../shared/maneuver.js";
import { decimalsFor, fixed } from "../shared/units.js";

// Pixels: a label at the start of the last segment is left out if its point is nearer than this to another.
const LEAST_DISTANCE = { join: 26, aircraft: 30 };

const CHARACTER_PX = 6.6; // mean width

/**
 * @param {View} view
 * @param {Maneuver} maneuver
 * @param {Scene} scene
 */
export function drawMarks(view, maneuver, scene) {
  const { segments, join, duration_s } = maneuver;
  if (segments.length === 0) return [];
  const decimals = decimalsFor(scene.orbit.radius_m, "metric");
  const joined = positionToScreen(view, join);
  const switches = segments.slice(1).map(({ start }) => positionToScreen(view, start));
  const covered = coveredPoints(view, maneuver, scene);
  const labels = [label(view, joined, covered, `join ${fixed(duration_s, decimals)} s`)];
  const last = switches.at(-1);
  if (last && !isCrowded(last, joined, positionToScreen(view, scene.pose)))
    labels.push(label(view, last, covered, `peel off ${fixed(segments[segments.length - 1].start_s, decimals)} s`));
  return [...switches.map((point) => dot(point, 4.5, "switch")), dot(joined, 6, "join"), ...labels];
}

/** @param {Point} point @param {number} r @param {string} kind */
const dot = ([cx, cy], r, kind) => svg("circle", { cx, cy, r, class: kind });

/** @param {Point} point @param {Point} joined @param {Point} aircraft */
function isCrowded([x, y], joined, aircraft) {
  const distance = (/** @type {Point} */ other) => Math.hypot(x - other[0], y - other[1]);
  return distance(joined) < LEAST_DISTANCE.join || distance(aircraft) < LEAST_DISTANCE.aircraft;
}

/**
 * Points that labels should not cover: on the path, the circle, and the aircraft with the handle of its heading.
 *
 * @param {View} view
 * @param {Maneuver} maneuver
 * @param {Scene} scene
 * @returns {Point[]}
 */
function coveredPoints(view, { track, duration_s, join, join_over_ground }, { pose }) {
  const centre = toScreen(view, join_over_ground.centre_east_m, join_over_ground.centre_north_m);
  const joined = positionToScreen(view, join);
  const r = Math.hypot(joined[0] - centre[0], joined[1] - centre[1]);
  const aircraft = positionToScreen(view, pose);
  return [
    ...Array.from({ length: 81 }, (_, i) => positionToScreen(view, stateAt(track, (i / 80) * duration_s))),
    ...Array.from({ length: 72 }, (_, k) => pointAt(centre, 5 * k, r)),
    ...Array.from({ length: 16 }, (_, k) => pointAt(aircraft, pose.heading_deg, 5 * k - 12)),
  ];
}

/**
 * A text beside a point, on the side where it covers the fewest points.
 *
 * @param {View} view
 * @param {Point} point
 * @param {Point[]} covered
 * @param {string} text
 */
function label(view, point, covered, text) {
  const width = CHARACTER_PX * text.length;
  const places = [0, 45, 90, 135, 180, 225, 270, 315].map((bearing) => {
    const place = placeAt(point, bearing, width);
    const isCut = place.left < 4 || place.left + width > view.width - 4;
    return { ...place, cost: countCovered(place, width, covered) + (isCut ? 1000 : 0) };
  });
  const best = places.reduce((least, place) => (place.cost < least.cost ? place : least));
  return svg("text", { x: best.left, y: best.middle + 4, class: "halo" }, [text]);
}

/**
 * Where a label is if it lies at a bearing from a point.
 *
 * @param {Point} point
 * @param {number} bearing
 * @param {number} width
 */
function placeAt([x, y], bearing, width) {
  const [east, north] = unitVector(bearing);
  const isCentred = Math.abs(east) < 0.1;
  return { left: x + 13 * east + (width / 2) * (isCentred ? -1 : Math.sign(east) - 1), middle: y - 17 * north };
}

/** @param {{left: number, middle: number}} place @param {number} width @param {Point[]} points */
const countCovered = ({ left, middle }, width, points) =>
  points.filter(([x, y]) => x > left - 4 && x < left + width + 4 && Math.abs(y - middle) < 10).length;
