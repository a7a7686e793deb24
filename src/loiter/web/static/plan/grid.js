// @ts-check
/**
 * The grid of the plan view.
 *
 * @typedef {import("../shared/types.js").Units} Units
 * @typedef {import("../shared/view.js").View} View
 */
import { svg } from "../shared/dom.js";
import { decimalsOfStep, fixed, roundStep, unitOf } from "../shared/units.js";
import { toScreen, toWorld } from "../shared/view.js";

const LEAST_SPACING_PX = 84;

// Labels keep clear of the buttons, the corner with the unit, and the edges; pixels.
const LABELS = { left: 56, right: 30, top: 130, bottom: 30 };

/**
 * The spacing of the grid in the unit shown, and that unit's name and size in metres.
 *
 * @param {View} view
 * @param {Units} units
 */
export function gridOf(view, units) {
  const { name, size } = unitOf("length", units);
  return { name, size, step: roundStep(LEAST_SPACING_PX / (view.scale * size)) };
}

/**
 * Lines and labels of the grid.
 *
 * @param {View} view
 * @param {Units} units
 */
export function drawGrid(view, units) {
  const { name, size, step } = gridOf(view, units);
  const label = (/** @type {number} */ k) => fixed(k * step, decimalsOfStep(step));
  const [west, north] = toWorld(view, [0, 0]);
  const [east, south] = toWorld(view, [view.width, view.height]);
  const columns = multiples(west / size, east / size, step).flatMap((k) => {
    const x = Math.round(toScreen(view, k * step * size, 0)[0]) + 0.5;
    const hasLabel = x > LABELS.left && x < view.width - LABELS.right;
    const text = svg("text", { x, y: view.height - 8, "text-anchor": "middle" }, [label(k)]);
    return [line(`M${x} 0V${view.height}`, k), ...(hasLabel ? [text] : [])];
  });
  const rows = multiples(south / size, north / size, step).flatMap((k) => {
    const y = Math.round(toScreen(view, 0, k * step * size)[1]) + 0.5;
    const hasLabel = y > LABELS.top && y < view.height - LABELS.bottom;
    return [line(`M0 ${y}H${view.width}`, k), ...(hasLabel ? [svg("text", { x: 8, y: y + 4 }, [label(k)])] : [])];
  });
  return [...columns, ...rows, svg("text", { x: 8, y: view.height - 8, class: "unit" }, [name])];
}

/** @param {string} d @param {number} k number of the line; 0 is an axis */
const line = (d, k) => svg("path", { d, class: k === 0 ? "axis" : "" });

/**
 * The whole numbers k with k * step between two values: none where neighbours cannot be distinguished in floating point.
 *
 * @param {number} from
 * @param {number} to
 * @param {number} step
 */
function multiples(from, to, step) {
  const first = Math.ceil(from / step);
  const count = Math.floor(to / step) - first + 1;
  return Array.from({ length: Math.min(200, Math.max(0, count)) }, (_, i) => first + i);
}
