// @ts-check
/**
 * Lines on the map: axes, curves between regions, optimal paths, and the points of the circle.
 *
 * @import {View} from "../shared/geometry.js"
 * @import {Curve, Maneuver, Synthesis} from "../shared/types.js"
 */
import { part, polyline } from "../shared/dom.js";
import { toScreen } from "../shared/geometry.js";
import { piecesOf } from "../shared/maneuver.js";
import { decimalsOfStep, fixed, roundStep } from "../shared/units.js";

/**
 * The view of the map: it reaches half a cell beyond the outer points of the grid, which are middles of cells.
 *
 * @param {{synthesis: Synthesis | null, mapSide: number}} state
 * @returns {View}
 */
export function mapViewOf({ synthesis, mapSide }) {
  const x = synthesis?.x ?? [-1, 1];
  const reach = (x[x.length - 1] * x.length) / (x.length - 1);
  return { scale: mapSide / (2 * reach), east: 0, north: 0, width: mapSide, height: mapSide };
}

const LEAST_SPACING_PX = 60;
const EDGE_PX = 18; // a number nearer to the edge would be cut

/** The spacing of the numbers. @param {View} view */
export const stepOf = (view) => roundStep(LEAST_SPACING_PX / view.scale);

/** @param {View} view */
export function drawAxes(view) {
  const { width, height, scale } = view;
  const [cx, cy] = toScreen(view, 0, 0);
  const step = stepOf(view);
  const count = Math.floor(width / 2 / scale / step);
  const numbers = Array.from({ length: 2 * count + 1 }, (_, i) => (i - count) * step);
  return [
    part("path", { d: `M${cx} 0V${height}M0 ${cy}H${width}` }),
    ...numbers.flatMap((number) => drawNumber(view, number, fixed(number, decimalsOfStep(step)))),
    part("text", { x: width - 6, y: cy - 6, "text-anchor": "end", class: "axisname" }, ["x"]),
    part("text", { x: cx + 7, y: 13, class: "axisname" }, ["y"]),
  ];
}

/** A number at both axes. @param {View} view @param {number} number @param {string} text */
function drawNumber(view, number, text) {
  const [x, y] = toScreen(view, number, number);
  if (number === 0 || x < EDGE_PX || x > view.width - EDGE_PX) return [];
  return [
    part("text", { x, y: view.height - 6, "text-anchor": "middle" }, [text]),
    part("text", { x: 5, y: y + 4 }, [text]),
  ];
}

/** @param {View} view @param {Curve} curve */
export function drawCurve(view, { kind, x, y }) {
  const points = x.map((value, i) => {
    const other = y[i];
    return value === null || other === null ? null : toScreen(view, value, other);
  });
  return part("path", { d: polyline(points), class: `curve ${kind}` });
}

/** An optimal path, in the colours of its controls. @param {View} view @param {Maneuver} maneuver */
export function drawReducedPath(view, maneuver) {
  const { x, y } = maneuver.track;
  const lines = piecesOf(maneuver).map(({ letter, indices }) => ({
    letter,
    d: polyline(indices.map((i) => toScreen(view, x[i], y[i]))),
  }));
  return [
    ...lines.map(({ d }) => part("path", { d, class: "casing" })),
    ...lines.map(({ d, letter }) => part("path", { d, class: `piece ${letter}` })),
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
      return part("circle", { cx, cy, r: 4.5 });
    });
}
