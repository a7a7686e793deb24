// @ts-check
/**
 * Properties of a scene and its aircraft, and scenes with one part changed.
 *
 * @import {Aircraft, Limit, Scene, Wind} from "../shared/types.js"
 */

/** @param {Scene} scene @param {Partial<Scene["pose"]>} pose @returns {Scene} */
export const withPose = (scene, pose) => ({ ...scene, pose: { ...scene.pose, ...pose } });

/** @param {Scene} scene @param {Partial<Scene["orbit"]>} orbit @returns {Scene} */
export const withOrbit = (scene, orbit) => ({ ...scene, orbit: { ...scene.orbit, ...orbit } });

/** A scene with another wind; zero speed means still air. @param {Scene} scene @param {Wind} wind @returns {Scene} */
export const withWind = (scene, wind) => ({ ...scene, wind: wind.speed_m_s === 0 ? null : wind });

/** Whether the circle moves. @param {Scene} scene */
export const orbitMoves = ({ orbit }) => orbit.velocity_east_m_s !== 0 || orbit.velocity_north_m_s !== 0;

/**
 * Whether the air or the circle moves. Then a plan needs a search, and the state does not reduce to a plane.
 *
 * @param {Scene} scene
 */
export const drifts = (scene) => scene.wind !== null || orbitMoves(scene);

/** @type {Limit[]} */
export const LIMITS = ["max_bank_deg", "min_turn_radius_m", "max_turn_rate_deg_s"];

/** The limit that an aircraft gives. @param {Aircraft} aircraft @returns {Limit} */
export function limitOf(aircraft) {
  return LIMITS.find((name) => aircraft[name] !== undefined) ?? "max_bank_deg";
}
