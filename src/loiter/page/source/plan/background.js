// @ts-check
/**
 * The grid and the circle of the plan view.
 *
 * @import {Answer, Direction, Scene, Units} from "../shared/types.js"
 * @import {Point, View} from "../shared/geometry.js"
 */
import { orbitMoves } from "../scene/scene.js";
import { part, polyline } from "../shared/dom.js";
import { positionToScreen, toScreen, toWorld, unitVector } from "../shared/geometry.js";
import { splitAnswer } from "../shared/maneuver.js";
import { decimalsOfStep, fixed, lengthUnit, roundStep } from "../shared/units.js";

const LEAST_SPACING_PX = 84;

// Labels keep clear of the buttons, the corner with the unit, and the edges; pixels.
const LABELS = { left: 56, right: 30, top: 240, bottom: 30 };

/**
 * The spacing of the grid in the unit shown, and that unit's name and size in metres.
 *
 * @param {View} view
 * @param {Units} units
 */
export function gridOf(view, units) {
  const { name, size } = lengthUnit(units, view.width / view.scale / 4);
  return { name, size, step: roundStep(LEAST_SPACING_PX / (view.scale * size)) };
}

/** Lines and labels of the grid. @param {View} view @param {Units} units */
export function drawGrid(view, units) {
  const { name, size, step } = gridOf(view, units);
  const label = (/** @type {number} */ k) => fixed(k * step, decimalsOfStep(step));
  const [west, north] = toWorld(view, [0, 0]);
  const [east, south] = toWorld(view, [view.width, view.height]);
  const columns = multiples(west / size, east / size, step).flatMap((k) => {
    const x = Math.round(toScreen(view, k * step * size, 0)[0]) + 0.5;
    const hasLabel = x > LABELS.left && x < view.width - LABELS.right;
    const text = part("text", { x, y: view.height - 8, "text-anchor": "middle" }, [label(k)]);
    return [line(`M${x} 0V${view.height}`, k), ...(hasLabel ? [text] : [])];
  });
  const rows = multiples(south / size, north / size, step).flatMap((k) => {
    const y = Math.round(toScreen(view, 0, k * step * size)[1]) + 0.5;
    const hasLabel = y > LABELS.top && y < view.height - LABELS.bottom;
    return [line(`M0 ${y}H${view.width}`, k), ...(hasLabel ? [part("text", { x: 8, y: y + 4 }, [label(k)])] : [])];
  });
  return [...columns, ...rows, part("text", { x: 8, y: view.height - 8, class: "unit" }, [name])];
}

/** @param {string} d @param {number} k number of the line; 0 is an axis */
const line = (d, k) => part("path", { d, class: k === 0 ? "axis" : "" });

/**
 * The whole numbers k with k * step between two values: none where neighbours cannot be distinguished in floating
 * point.
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

/** An arrowhead that points east. */
export const ARROWHEAD = "M-6-5.5 6 0-6 5.5-3.5 0Z";

const ARROWS = 4;
const LEAST_RADIUS_PX = 24; // of a circle with arrows

/**
 * The circle with arrows in the direction of the hold. If it moves, also the circle at the time of joining.
 *
 * @param {View} view
 * @param {Scene} scene
 * @param {Answer | null} answer
 */
export function drawCircle(view, scene, answer) {
  const start = positionToScreen(view, scene.orbit);
  const r = Math.abs(scene.orbit.radius_m) * view.scale;
  const turns = answer ? [...new Set(splitAnswer(answer).best.map(({ turn }) => turn))] : [];
  if (!orbitMoves(scene)) return [ring(start, r, ""), ...holdArrows(start, r, turns)];
  if (!answer) return [ring(start, r, "start")];
  const { centre_east_m, centre_north_m } = answer.join_over_ground;
  const end = toScreen(view, centre_east_m, centre_north_m);
  const way = part("path", { d: polyline([start, end]), class: "drift" });
  return [ring(start, r, "start"), ring(end, r, ""), way, ...holdArrows(end, r, turns)];
}

/** @param {Point} centre @param {number} r @param {string} kind */
const ring = ([cx, cy], r, kind) => part("circle", { cx, cy, r, class: kind });

/**
 * Arrows round the circle for each direction of the hold.
 *
 * @param {Point} centre
 * @param {number} r pixels
 * @param {Direction[]} turns
 */
function holdArrows([cx, cy], r, turns) {
  const count = r < LEAST_RADIUS_PX ? 0 : ARROWS;
  return turns.flatMap((turn, i) =>
    Array.from({ length: count }, (_, k) => {
      const bearing = (k + (i + 1) / 3) * (360 / count);
      const [east, north] = unitVector(bearing);
      const angle = turn === "cw" ? bearing : bearing + 180;
      const transform = `translate(${cx + r * east} ${cy - r * north}) rotate(${angle})`;
      return part("path", { d: ARROWHEAD, class: "hold", transform });
    }),
  );
}
