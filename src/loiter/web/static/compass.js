// @ts-check
/**
 * Compass headings as vectors, the reduced state as a place: the few formulas that dragging needs.
 *
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./types.js").Pose} Pose
 * @typedef {import("./types.js").Limit} Limit
 */

const DEGREE = Math.PI / 180;
const STANDARD_GRAVITY_M_S2 = 9.80665;

/**
 * East and north component of the unit vector along a heading.
 *
 * @param {number} heading_deg
 * @returns {[number, number]}
 */
export function vector(heading_deg) {
  return [Math.sin(heading_deg * DEGREE), Math.cos(heading_deg * DEGREE)];
}

/**
 * The heading along a vector, degrees in [0, 360).
 *
 * @param {number} east
 * @param {number} north
 */
export function heading(east, north) {
  return (Math.atan2(east, north) / DEGREE + 360) % 360;
}

/**
 * Where an aircraft with a heading is whose reduced state is (x, y), in turn radii: the inverse of the paper's (2), a
 * rotation. x counts along the course past the centre, y to the left of it.
 *
 * @param {number} x
 * @param {number} y
 * @param {Scene} scene
 * @param {number} turnRadius_m
 * @returns {{east_m: number, north_m: number}}
 */
export function placeOf(x, y, { pose, orbit }, turnRadius_m) {
  const [east, north] = vector(pose.heading_deg);
  return {
    east_m: orbit.east_m + turnRadius_m * (x * east - y * north),
    north_m: orbit.north_m + turnRadius_m * (x * north + y * east),
  };
}

/**
 * The turn radius of an aircraft's limit, metres.
 *
 * @param {Scene["aircraft"]} aircraft
 */
export function turnRadiusOf({ airspeed_m_s, max_bank_deg, min_turn_radius_m, max_turn_rate_deg_s }) {
  if (min_turn_radius_m !== undefined) return min_turn_radius_m;
  if (max_turn_rate_deg_s !== undefined) return airspeed_m_s / (max_turn_rate_deg_s * DEGREE);
  return airspeed_m_s ** 2 / (STANDARD_GRAVITY_M_S2 * Math.tan((max_bank_deg ?? 0) * DEGREE));
}

/**
 * The limit of another kind that gives the same turn radius: tan(bank) = V^2 / (g r), rate = V / r.
 *
 * @param {Limit} kind
 * @param {number} airspeed_m_s
 * @param {number} turnRadius_m
 */
export function limitFor(kind, airspeed_m_s, turnRadius_m) {
  if (kind === "min_turn_radius_m") return turnRadius_m;
  if (kind === "max_turn_rate_deg_s") return airspeed_m_s / turnRadius_m / DEGREE;
  return Math.atan(airspeed_m_s ** 2 / (STANDARD_GRAVITY_M_S2 * turnRadius_m)) / DEGREE;
}
