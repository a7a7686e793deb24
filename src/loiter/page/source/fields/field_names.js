// @ts-check
/**
 * Errors of the library, in the names that the page gives to the fields.
 *
 * @import {Units} from "../shared/types.js"
 * @import {FieldErrors} from "../state/page_state.js"
 */
import { Problem } from "../requests/answers.js";
import { byId } from "../shared/dom.js";
import { sentenceIn } from "../shared/units.js";

/** The id of the field for each part of a scene. @type {Record<string, string>} */
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
  margin_m: "margin",
  "slot/phase_deg": "slot-bearing",
  "slot/at_s": "slot-at",
  exit_to: "exit-east",
  "exit_to/east_m": "exit-east",
  "exit_to/north_m": "exit-north",
  hold_s: "leg-hold",
  turns: "leg-turns",
  start_altitude_m: "leg-start-altitude",
  "pose/altitude_m": "leg-start-altitude",
  climb_rate_m_s: "climb-rate",
  descent_rate_m_s: "descent-rate",
  altitude_m: "altitude",
  altitude_reference: "altitude-reference",
  home_altitude_m: "home-altitude",
};

/** Names of parts that have no field of their own, or several. @type {Record<string, string>} */
const NAMES = {
  "orbit/turn": "Direction of the hold",
  pose: "The aircraft",
  fence: "The fence",
  exit_to: "The exit point",
  tolerance_m: "Tolerance",
  chord_error_m: "Chord error",
  origin: "The place of (0, 0) on Earth",
};

/** The field for each kind of problem that names no part of the scene. @type {Record<string, string>} */
const FIELD_OF_PROBLEM = { "radius-too-small": "circle-radius", "wind-too-strong": "wind-speed" };

/** The name of a field: "Radius of the circle". @param {HTMLElement} input */
export function nameOf(input) {
  const label = input.closest("label")?.querySelector("span")?.textContent;
  return input.getAttribute("aria-label") ?? label ?? "The field";
}

/**
 * The sentence of an error in the names and units of the page, and the same sentence for each field that it concerns.
 *
 * @param {Error} error
 * @param {Units} units
 * @returns {{sentence: string, fields: FieldErrors}}
 */
export function refusalOf(error, units) {
  const sentence = translate(error.message, units);
  const ids = error instanceof Problem ? fieldsOf(error) : [];
  return { sentence, fields: Object.fromEntries(ids.map((id) => [id, sentence])) };
}

/**
 * A sentence of the library with the name of the field: "Airspeed is 0: ..." for "aircraft.airspeed_m_s is 0: ...".
 *
 * @param {string} sentence
 * @param {Units} units
 */
function translate(sentence, units) {
  const path = /^[\w.]*/.exec(sentence)?.[0] ?? "";
  const quantity = path.endsWith("_m_s") ? "speed" : path.endsWith("_m") ? "length" : undefined;
  const translated = nameOfPart(path.replaceAll(".", "/")) + sentenceIn(sentence.slice(path.length), units, quantity);
  return translated.charAt(0).toUpperCase() + translated.slice(1);

  /** @param {string} part */
  function nameOfPart(part) {
    return NAMES[part] ?? (FIELDS[part] ? nameOf(byId(FIELDS[part], HTMLElement)) : path);
  }
}

/** The fields that a refusal concerns. @param {Problem} problem @returns {string[]} */
function fieldsOf({ kind, places }) {
  const fields = [...places.map((place) => FIELDS[place]), FIELD_OF_PROBLEM[kind]];
  return [...new Set(fields.filter((field) => field !== undefined))];
}
