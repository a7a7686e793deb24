// @ts-check
/**
 * The axes of the map, turn radii.
 *
 * @typedef {import("../shared/view.js").View} View
 */
import { svg } from "../shared/dom.js";
import { decimalsOfStep, fixed, roundStep } from "../shared/units.js";
import { toScreen } from "../shared/view.js";

const LEAST_SPACING_PX = 60;
const EDGE_PX = 18; // nearer to the edge a number would be cut

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
    svg("path", { d: `M${cx} 0V${height}M0 ${cy}H${width}` }),
    ...numbers.flatMap((number) => drawNumber(view, number, fixed(number, decimalsOfStep(step)))),
    svg("text", { x: width - 6, y: cy - 6, "text-anchor": "end", class: "axisname" }, ["x"]),
    svg("text", { x: cx + 7, y: 13, class: "axisname" }, ["y"]),
  ];
}

/**
 * A number at both axes.
 *
 * @param {View} view
 * @param {number} number
 * @param {string} text
 */
function drawNumber(view, number, text) {
  const [x, y] = toScreen(view, number, number);
  if (number === 0 || x < EDGE_PX || x > view.width - EDGE_PX) return [];
  return [
    svg("text", { x, y: view.height - 6, "text-anchor": "middle" }, [text]),
    svg("text", { x: 5, y: y + 4 }, [text]),
  ];
}
