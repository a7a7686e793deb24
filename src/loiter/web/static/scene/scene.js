// @ts-check
/**
 * Properties of a scene, and scenes with one part changed.
 *
 * @typedef {import("../shared/types.js").Scene} Scene
 * @typedef {import("../shared/types.js").Wind} Wind
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
 * Whether the air or the circle moves. Then a plan takes a search, and the state does not reduce to a plane.
 *
 * @param {Scene} scene
 */
export const drifts = (scene) => scene.wind !== null || orbitMoves(scene);

// The ratio of a circle of the turn radius is off 1 by rounding only.
const ROUNDING = 1e-9;

/**
 * Whether the paper proves the optimum of a scene: still air, and a circle of the turn radius at rest.
 *
 * @param {Scene} scene
 * @param {number} radius  of the circle, turn radii
 */
export function isProved(scene, radius) {
  return !drifts(scene) && scene.tolerance_m === 0 && Math.abs(radius - 1) < ROUNDING;
}
