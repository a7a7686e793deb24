// @ts-check
/**
 * The leg of a scene: what is flown after the entry, and scenes with a part of it changed.
 *
 * @import {Leg, Scene} from "../shared/types.js"
 */
import { powerBelow, tidy } from "../shared/units.js";

/** @type {Omit<Leg, "exit_to">} */
const NOTHING_MORE = { hold_s: 0, turns: 0, start_altitude_m: null, altitude_m: null, climb_rate_m_s: null, descent_rate_m_s: null };

const FIRST_DISTANCE = 3; // from the centre to a new exit point, radii of the circle

/** A scene with a leg changed; without one it begins, and has no slot. @param {Scene} scene @param {Partial<Leg>} changes @returns {Scene} */
export const withLeg = (scene, changes) => ({ ...scene, slot: null, leg: { ...NOTHING_MORE, exit_to: firstExit(scene), ...scene.leg, ...changes } });

/** @param {Scene} scene @returns {Scene} */
export const withoutLeg = (scene) => ({ ...scene, leg: null });

/** @param {Scene} scene @param {{east_m?: number, north_m?: number}} position @returns {Scene} */
export function withExit(scene, position) {
  const { east_m, north_m } = { ...exitOf(scene), ...position };
  return withLeg(scene, { exit_to: [east_m, north_m] });
}

/** The point that a leg flies to. @param {Scene} scene */
export function exitOf({ leg }) {
  const [east_m, north_m] = leg?.exit_to ?? [NaN, NaN];
  return { east_m, north_m };
}

/** A new exit point: on the far side of the circle, seen from the aircraft. @param {Scene} scene @returns {[number, number]} */
function firstExit({ pose, orbit }) {
  const [east, north] = [orbit.east_m - pose.east_m, orbit.north_m - pose.north_m];
  const away = Math.hypot(east, north);
  const [x, y] = away > 0 ? [east / away, north / away] : [1, 0];
  const [distance, resolution] = [FIRST_DISTANCE * orbit.radius_m, powerBelow(orbit.radius_m, 0.1)];
  return [tidy(orbit.east_m + distance * x, resolution), tidy(orbit.north_m + distance * y, resolution)];
}
