// @ts-check
/**
 * The paths in the plan view.
 *
 * @import {Alternative, Letter, Maneuver, Scene, Track} from "../shared/types.js"
 * @import {Point, View} from "../shared/geometry.js"
 */
import { part, polyline, setAttributes } from "../shared/dom.js";
import { DEGREE, toScreen } from "../shared/geometry.js";
import { isAllowed, piecesOf } from "../shared/maneuver.js";
import { timeDifference } from "../shared/units.js";
import { ARROWHEAD } from "./background.js";

const LEAST_LENGTH_PX = 46; // of a segment with an arrow

/**
 * The pixels of samples of a track.
 *
 * @param {View} view
 * @param {Track} track
 * @param {number[]} [indices] all by default
 */
function pointsOf(view, { east_m, north_m }, indices = [...east_m.keys()]) {
  return indices.map((i) => toScreen(view, east_m[i], north_m[i]));
}

/**
 * An optimal path, or a leg: each segment in the colour of its control, with an arrow.
 *
 * @param {View} view
 * @param {Maneuver} maneuver
 */
export function drawBest(view, maneuver) {
  const pieces = piecesOf(maneuver).map(({ letter, indices }) => ({
    letter,
    points: pointsOf(view, maneuver.track, indices),
  }));
  const isLeg = maneuver.join_s !== undefined;
  const casing = isLeg ? pieces.map(({ points }) => polyline(points)).join("") : polyline(pointsOf(view, maneuver.track));
  return [
    part("path", { d: casing, class: "casing" }),
    ...pieces.map(({ letter, points }) =>
      part("path", { d: polyline(points), class: `piece ${letter}`, "data-letter": letter }),
    ),
    ...pieces.flatMap(({ letter, points }) => drawArrow(letter, points)),
  ];
}

/** An arrow half way along a segment that is long enough. @param {Letter} letter @param {Point[]} points */
function drawArrow(letter, points) {
  const sums = cumulativeLengths(points);
  const half = (sums.at(-1) ?? 0) / 2;
  if (2 * half < LEAST_LENGTH_PX) return [];
  const j = Math.max(
    1,
    sums.findIndex((sum) => sum >= half),
  );
  const [from, to] = [points[j - 1], points[j]];
  const share = (half - sums[j - 1]) / (sums[j] - sums[j - 1] || 1);
  const [x, y] = [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
  const angle = Math.atan2(to[1] - from[1], to[0] - from[0]) / DEGREE;
  return [part("path", { d: ARROWHEAD, class: `arrow ${letter}`, transform: `translate(${x} ${y}) rotate(${angle})` })];
}

/** The length of a polyline up to each point. @param {Point[]} points */
function cumulativeLengths(points) {
  let sum = 0;
  return points.map(([x, y], i) => {
    const last = points[Math.max(0, i - 1)];
    return (sum += Math.hypot(x - last[0], y - last[1]));
  });
}

/** The fastest path where it is not clear of the fence, beside a clear one. @param {View} view @param {Maneuver} maneuver */
export const drawBlocked = (view, { track }) => part("path", { d: polyline(pointsOf(view, track)) });

/**
 * A slower path, or one in a direction that is not allowed.
 *
 * @param {View} view
 * @param {Alternative} other
 * @param {Scene} scene
 */
export function drawOther(view, other, scene) {
  const d = polyline(pointsOf(view, other.track));
  const parts = [part("path", { d, class: "line" }), part("path", { d, class: "reach" })];
  return part("g", { class: isAllowed(scene, other) ? "other" : "other disallowed" }, parts);
}

/**
 * Write the word of another path, and how much later it joins, beside its middle.
 *
 * @param {SVGTextElement} label
 * @param {View} view
 * @param {Alternative} other
 * @param {Scene} scene
 */
export function placeCallout(label, view, { track, word, turn, later_s }, scene) {
  const [[x, y]] = pointsOf(view, track, [track.time_s.length >> 1]);
  const inside = { x: Math.min(view.width - 90, Math.max(90, x)), y: Math.min(view.height - 30, Math.max(24, y - 12)) };
  setAttributes(label, { ...inside, "text-anchor": "middle" });
  label.textContent = `${word} ${turn}: ${timeDifference(later_s, scene)} ${later_s < 0 ? "sooner" : "later"}`;
}
