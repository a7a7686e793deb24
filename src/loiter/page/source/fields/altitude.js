// @ts-check
/**
 * The altitude of missions. The page never assumes one.
 *
 * @import {Altitude, Reference, Units} from "../shared/types.js"
 * @import {FieldErrors} from "../state/page_state.js"
 */
import { fixed, unitOf } from "../shared/units.js";

/** @type {Record<Reference, string>} */
const ABOVE = { msl: "above mean sea level", home: "above home", ground: "above the ground" };

/** Whether the altitude of home must be given. @param {Altitude} altitude */
export const needsHome = ({ altitude_reference }) => altitude_reference === "home" || altitude_reference === "ground";

/**
 * Sentences for the fields that a mission needs and that are empty.
 *
 * @param {Altitude} altitude
 * @returns {FieldErrors}
 */
export function missingForMission(altitude) {
  const { altitude_m, altitude_reference, home_altitude_m } = altitude;
  /** @type {FieldErrors} */
  const sentences = {};
  if (!altitude_reference) sentences["altitude-reference"] = "Choose what the altitude is measured from.";
  if (altitude_m === undefined) sentences.altitude = "A mission needs an altitude.";
  if (needsHome(altitude) && home_altitude_m === undefined)
    sentences["home-altitude"] = "This mission also needs the altitude of home above mean sea level.";
  return sentences;
}

/**
 * The altitude for a mission: without the altitude of home where its field is hidden.
 *
 * @param {Altitude} altitude
 * @returns {Altitude}
 */
export function missionAltitude({ home_altitude_m, ...altitude }) {
  return needsHome(altitude) ? { ...altitude, home_altitude_m } : altitude;
}

/**
 * The altitude for maps and tables, which measure from mean sea level; nothing if it is not known from there.
 *
 * @param {Altitude} altitude
 * @returns {Altitude}
 */
export function mapAltitude(altitude) {
  const { altitude_m, altitude_reference, home_altitude_m } = altitude;
  const isKnown = altitude_reference === "msl" || (altitude_reference === "home" && home_altitude_m !== undefined);
  return isKnown && altitude_m !== undefined ? missionAltitude(altitude) : {};
}

/**
 * The altitude of a mission as text: "120 m above home, home at 450 m".
 *
 * @param {Altitude} altitude
 * @param {Units} units
 */
export function altitudeText(altitude, units) {
  const { altitude_m = 0, altitude_reference = "msl", home_altitude_m = 0 } = altitude;
  const { name, size } = unitOf("length", units);
  const length = (/** @type {number} */ metres) => `${fixed(metres / size, 1).replace(/\.0$/, "")} ${name}`;
  const home = needsHome(altitude) ? `, home at ${length(home_altitude_m)}` : "";
  return `${length(altitude_m)} ${ABOVE[altitude_reference]}${home}`;
}
