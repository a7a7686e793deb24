// @ts-check
/**
 * The file formats of the page, and what each file needs.
 *
 * @import {Altitude} from "../shared/types.js"
 * @import {FieldErrors, PageState} from "../state/page_state.js"
 * @import {Fields} from "../fields/fields.js"
 *
 * @typedef {"map" | "table" | "mission" | "picture"} Kind
 * @typedef {{format: string, name: string, use: string, kind: Kind, about?: string}} Format
 */
import { quantityText } from "../shared/units.js";
import { altitudeText, mapAltitude, missingForMission, missionAltitude } from "../fields/altitude.js";

/** @type {Format[]} */
export const FORMATS = [
  { format: "geojson", name: "GeoJSON", use: "for maps", kind: "map" },
  { format: "kml", name: "KML", use: "for Google Earth", kind: "map" },
  { format: "gpx", name: "GPX", use: "for GPS receivers", kind: "map" },
  { format: "csv", name: "CSV", use: "samples along the track, in metres", kind: "table" },
  { format: "plan", name: "Plan", use: "mission for QGroundControl", kind: "mission" },
  { format: "waypoints", name: "WPL", use: "waypoints for Mission Planner", kind: "mission", about: "a text file that MAVProxy and QGroundControl read too" },
  { format: "png", name: "PNG", use: "picture", kind: "picture" },
  { format: "svg", name: "SVG", use: "picture", kind: "picture" },
];

/** The formats of legs. */
export const LEG_FORMATS = ["kml", "plan", "waypoints"];

/**
 * Sentences for the fields that must be filled in or corrected before a file can be written.
 *
 * @param {Kind} kind
 * @param {PageState} state
 * @param {Fields} fields
 * @returns {FieldErrors}
 */
export function missingFor(kind, { scene, place, altitude }, fields) {
  const needsOrigin = kind === "map" || kind === "mission";
  return {
    ...(needsOrigin && !scene.origin ? missingPlace(place) : {}),
    ...(kind === "mission" ? missingForAltitude(scene, altitude) : {}),
    ...(kind === "picture" ? {} : typos(fields)),
  };
}

/** @param {PageState["scene"]} scene @param {Altitude} altitude @returns {FieldErrors} */
function missingForAltitude({ leg }, altitude) {
  if (!leg) return missingForMission(altitude);
  return legAltitude(leg) === null ? { "leg-start-altitude": "A mission of a leg needs an altitude." } : {};
}

/** The altitude of a leg's mission. @param {import("../shared/types.js").Leg} leg */
const legAltitude = ({ altitude_m, start_altitude_m }) => altitude_m ?? start_altitude_m;

/** @param {PageState["place"]} place @returns {FieldErrors} */
function missingPlace({ latitude_deg, longitude_deg }) {
  const sentence = "This file needs the position of (0, 0) on Earth.";
  return {
    ...(latitude_deg === undefined ? { latitude: sentence } : {}),
    ...(longitude_deg === undefined ? { longitude: sentence } : {}),
  };
}

/** The errors in the texts of place and altitude. @param {Fields} fields @returns {FieldErrors} */
const typos = (fields) =>
  Object.fromEntries(
    ["latitude", "longitude", "altitude", "home-altitude"]
      .map((id) => [id, fields[id].typo()])
      .filter(([, sentence]) => sentence !== ""),
  );

/** The altitude that is written into a file. @param {Kind} kind @param {Altitude} altitude @returns {Altitude} */
export function altitudeFor(kind, altitude) {
  if (kind === "picture") return {};
  return kind === "mission" ? missionAltitude(altitude) : mapAltitude(altitude);
}

/** The message after a file was saved. @param {string} name @param {Kind} kind @param {PageState} state */
export function savedText(name, kind, { scene, altitude, units }) {
  const { leg } = scene;
  if (leg) return `${name} saved${kind === "mission" ? `: ${altitudeText({ altitude_m: legAltitude(leg) ?? 0, altitude_reference: "msl" }, units)}` : ""}.`;
  if (kind === "mission")
    return `${name} saved: ${altitudeText(missionAltitude(altitude), units)}.${radiusRemark(scene.orbit.radius_m, units)}`;
  const isLost = altitude.altitude_m !== undefined && altitudeFor(kind, altitude).altitude_m === undefined;
  if (kind === "picture" || !isLost) return `${name} saved.`;
  return `${name} saved without the altitude: it is not known above mean sea level.`;
}

/**
 * A sentence on the radius that ArduPlane stores, where it is not that of the mission; otherwise nothing.
 *
 * @param {number} radius_m
 * @param {PageState["units"]} units
 */
function radiusRemark(radius_m, units) {
  const stored_m = Math.floor(radius_m);
  const shown = units === "metric" ? "" : ` (${quantityText(stored_m, "length", units, 1)})`;
  return stored_m === radius_m ? "" : ` ArduPlane stores the radius in whole metres: ${stored_m} m${shown}.`;
}
