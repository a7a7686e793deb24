// @ts-check
/**
 * Lines on the map: curves between regions, optimal paths, and the points of the circle.
 *
 * @typedef {import("../shared/types.js").Curve} Curve
 * @typedef {import("../shared/types.js").Maneuver} Maneuver
 * @typedef {import("../shared/types.js").Synthesis} Synthesis
 * @typedef {import("../shared/view.js").View} View
 */
import { polyline, svg } from "../shared/dom.js";
import { piecesOf } from "../shared/track.js";
import { toScreen } from "../shared/view.js";

/**
 * @param {View} view
 * @param {Curve} curve
 */
export function drawCurve(view, { kind, x, y }) {
  const points = x.map((value, i) => {
    const other = y[i];
    return value === null || other === null ? null : toScreen(view, value, other);
  });
  return svg("path", { d: polyline(points), class: `curve ${kind}` });
}

/**
 * An optimal path, in the colours of its controls.
 *
 * @param {View} view
 * @param {Maneuver} maneuver
 */
export function drawReducedPath(view, maneuver) {
  const { x, y } = maneuver.track;
  const lines = piecesOf(maneuver).map(({ letter, indices }) => ({
    letter,
    d: polyline(indices.map((i) => toScreen(view, x[i], y[i]))),
  }));
  return [
    ...lines.map(({ d }) => svg("path", { d, class: "casing" })),
    ...lines.map(({ d, letter }) => svg("path", { d, class: `piece ${letter}` })),
  ];
}

/**
 * The states on the circle that the turn allows: (0, R) clockwise, (0, -R) counter-clockwise.
 *
 * @param {View} view
 * @param {Synthesis} synthesis
 */
export function drawTargets(view, { radius, turn }) {
  const targets = [
    { direction: "cw", y: radius },
    { direction: "ccw", y: -radius },
  ];
  return targets
    .filter(({ direction }) => turn === "either" || turn === direction)
    .map(({ y }) => {
      const [cx, cy] = toScreen(view, 0, y);
      return svg("circle", { cx, cy, r: 4.5 });
    });
}
