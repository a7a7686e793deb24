// @ts-check
/**
 * The circle in the plan view.
 *
 * @typedef {import("../shared/types.js").Answer} Answer
 * @typedef {import("../shared/types.js").Direction} Direction
 * @typedef {import("../shared/types.js").Scene} Scene
 * @typedef {import("../shared/view.js").Point} Point
 * @typedef {import("../shared/view.js").View} View
 */
import { orbitMoves } from "../scene/scene.js";
import { unitVector } from "../shared/compass.js";
import { polyline, svg } from "../shared/dom.js";
import { splitAnswer } from "../shared/track.js";
import { positionToScreen, toScreen } from "../shared/view.js";

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
  const way = svg("path", { d: polyline([start, end]), class: "drift" });
  return [ring(start, r, "start"), ring(end, r, ""), way, ...holdArrows(end, r, turns)];
}

/** @param {Point} centre @param {number} r @param {string} kind */
const ring = ([cx, cy], r, kind) => svg("circle", { cx, cy, r, class: kind });

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
      return svg("path", { d: ARROWHEAD, class: "hold", transform });
    }),
  );
}
