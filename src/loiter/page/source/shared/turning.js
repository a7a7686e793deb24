// @ts-check
/**
 * The turn radius that a limit gives, and back: the page's only formulas of flight, which are needed before there is an
 * answer. A test compares them with `loiter.Aircraft`.
 *
 * @import {Aircraft, Limit} from "./types.js"
 */
import { DEGREE } from "./geometry.js";

const STANDARD_GRAVITY_M_S2 = 9.80665;

/** The turn radius of an aircraft, metres. @param {Aircraft} aircraft */
export function turnRadiusOf({ airspeed_m_s, max_bank_deg, min_turn_radius_m, max_turn_rate_deg_s }) {
  if (min_turn_radius_m !== undefined) return min_turn_radius_m;
  if (max_turn_rate_deg_s !== undefined) return airspeed_m_s / (max_turn_rate_deg_s * DEGREE);
  return airspeed_m_s ** 2 / (STANDARD_GRAVITY_M_S2 * Math.tan((max_bank_deg ?? 0) * DEGREE));
}

/**
 * The value of a limit that gives this turn radius: tan(bank) = V^2 / (g r), rate = V / r.
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
