// @ts-check
/** Compass headings and vectors. */

/** Radians per degree. */
export const DEGREE = Math.PI / 180;

/**
 * The east and north components of the unit vector along a heading.
 *
 * @param {number} heading_deg
 * @returns {[number, number]}
 */
export function unitVector(heading_deg) {
  return [Math.sin(heading_deg * DEGREE), Math.cos(heading_deg * DEGREE)];
}

/**
 * The heading along a vector, degrees in [0, 360).
 *
 * @param {number} east
 * @param {number} north
 */
export function headingOf(east, north) {
  return (Math.atan2(east, north) / DEGREE + 360) % 360;
}

/**
 * A heading as the same direction in [0, 360).
 *
 * @param {number} degrees
 */
export function wrapped(degrees) {
  return (((degrees % 360) + 360) % 360) + 0;
}
