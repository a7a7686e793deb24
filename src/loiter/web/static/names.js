// @ts-check
/**
 * What the service calls the numbers of a request, and what the page calls them.
 *
 * @typedef {import("./api.js").Problem} Problem
 */

/**
 * The field of each place in a request.
 *
 * @type {Record<string, string>}
 */
const FIELDS = {
  "pose/east_m": "east",
  "pose/north_m": "north",
  "pose/heading_deg": "course",
  "orbit/east_m": "centre-east",
  "orbit/north_m": "centre-north",
  "orbit/radius_m": "circle-radius",
  "orbit/velocity_east_m_s": "velocity-east",
  "orbit/velocity_north_m_s": "velocity-north",
  "aircraft/airspeed_m_s": "airspeed",
  "aircraft/max_bank_deg": "limit",
  "aircraft/min_turn_radius_m": "limit",
  "aircraft/max_turn_rate_deg_s": "limit",
  aircraft: "limit",
  "wind/speed_m_s": "wind-speed",
  "wind/from_deg": "wind-from",
  "origin/latitude_deg": "latitude",
  "origin/longitude_deg": "longitude",
  origin: "latitude",
  altitude_m: "altitude",
  altitude_reference: "altitude-reference",
  home_altitude_m: "home-altitude",
};

/**
 * What has no field of its own, or is more than one.
 *
 * @type {Record<string, string>}
 */
const WORDS = {
  "orbit/turn": "Direction of the hold",
  tolerance_m: "Tolerance",
  chord_error_m: "Chord error",
  origin: "The place of (0, 0) on Earth",
};

/**
 * The field that a refusal is about, whether the service names it or not.
 *
 * @type {Record<string, string>}
 */
const BLAMED = { "radius-too-small": "circle-radius", "wind-too-strong": "wind-speed" };

/**
 * The service's sentence in the names of the page: "Airspeed is 0: ..." for "aircraft.airspeed_m_s is 0: ...".
 *
 * @param {string} sentence
 * @param {(field: string) => string} nameOf  what the page calls a field
 */
export function inWords(sentence, nameOf) {
  const name = /^[\w.]*/.exec(sentence)?.[0] ?? "";
  const place = name.replaceAll(".", "/");
  const words = WORDS[place] ?? (FIELDS[place] && nameOf(FIELDS[place])) ?? name;
  const whole = words + sentence.slice(name.length);
  return whole.charAt(0).toUpperCase() + whole.slice(1);
}

/**
 * The fields that a refusal is about.
 *
 * @param {Problem} problem
 * @returns {string[]}
 */
export function blamed({ kind, places }) {
  const fields = [...places.map((place) => FIELDS[place]), BLAMED[kind]];
  return [...new Set(fields.filter((field) => field !== undefined))];
}
