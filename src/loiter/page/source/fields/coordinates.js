// @ts-check
/**
 * Coordinates as the user types or pastes them: degrees with decimals, degrees and minutes, or degrees, minutes and
 * seconds, with or without the letter of a hemisphere; a latitude, a longitude, or both.
 *
 * @import {Origin} from "../shared/types.js"
 * @typedef {"latitude_deg" | "longitude_deg"} Axis
 */
import { tidy } from "../shared/units.js";

const NUMBER = "\\d+(?:[.,]\\d*)?";
// 47.1, -47.1, 47°06', 47 06 00, 47:06:00, 47°6'0.5"
const ANGLE = new RegExp(
  `^([+-]?)\\s*(${NUMBER})\\s*[°:]?(?:\\s*(${NUMBER})\\s*[':]?(?:\\s*(${NUMBER})\\s*"?)?)?$`,
);

/** @type {Record<string, {axis: Axis, sign: number}>} */
const HEMISPHERES = {
  N: { axis: "latitude_deg", sign: 1 },
  S: { axis: "latitude_deg", sign: -1 },
  E: { axis: "longitude_deg", sign: 1 },
  W: { axis: "longitude_deg", sign: -1 },
};

/** @type {Record<Axis, {name: string, most: number}>} */
const LIMITS = {
  latitude_deg: { name: "latitude", most: 90 },
  longitude_deg: { name: "longitude", most: 360 },
};

const RESOLUTION_DEG = 1e-9; // 0.1 mm

/** A text with the same sign for each of the many minus signs, primes and degree signs. @param {string} text */
const plain = (text) =>
  text
    .trim()
    .toUpperCase()
    .replace(/[−–]/g, "-")
    .replace(/''|[″”“]/g, '"')
    .replace(/[′’‘´]/g, "'")
    .replace(/º|DEG(REES)?/g, "°");

/**
 * One angle, or null if the text is none. The axis is that of its hemisphere, if it names one.
 *
 * @param {string} text
 * @returns {{value: number, axis: Axis | null} | null}
 */
function angleOf(text) {
  const [letter, another] = text.match(/[NSEW]/g) ?? [];
  const match = ANGLE.exec(text.replace(/^[NSEW]|[NSEW]$/, "").trim());
  if (!match || another) return null;
  const [, sign, ...parts] = match;
  const [degrees, minutes = 0, seconds = 0] = parts.map((part) => part && Number(part.replace(",", ".")));
  const hemisphere = letter ? HEMISPHERES[letter] : null;
  const isWrong = Number(minutes) >= 60 || Number(seconds) >= 60 || (hemisphere && sign === "-");
  // Only the last part may have decimals.
  const given = parts.filter((part) => part !== undefined);
  if (isWrong || given.slice(0, -1).some((part) => /[.,]/.test(part))) return null;
  const size = Number(degrees) + Number(minutes) / 60 + Number(seconds) / 3600;
  const value = tidy(size * (sign === "-" ? -1 : 1) * (hemisphere?.sign ?? 1), RESOLUTION_DEG);
  return { value, axis: hemisphere?.axis ?? null };
}

/**
 * A latitude or a longitude; the problem completes a sentence that begins with the name of the field.
 *
 * @param {string} text
 * @param {Axis} axis
 * @returns {{value: number} | {problem: string}}
 */
export function parseAngle(text, axis) {
  const typed = text.trim();
  if (typed === "") return { problem: "needs a number." };
  const angle = angleOf(plain(text));
  const { name, most } = LIMITS[axis];
  if (!angle) return { problem: `is "${typed}": write 47.1, 47.1 N or 47°06' N.` };
  if (angle.axis && angle.axis !== axis) return { problem: `is "${typed}": that is no ${name}.` };
  if (Math.abs(angle.value) <= most) return { value: angle.value };
  const hint = axis === "latitude_deg" ? " Are latitude and longitude swapped?" : "";
  return { problem: `is "${typed}": a ${name} is at most ${most}°.${hint}` };
}

/**
 * The ways to cut a text into two angles: at a semicolon or slash, between hemispheres, at a comma, at a space.
 *
 * @param {string} text
 * @returns {string[][]}
 */
function cuts(text) {
  const at = (/** @type {RegExp} */ separator) => text.split(separator);
  const lettersFirst = /^[NSEW]/.test(text);
  return [
    at(/[;/]/),
    lettersFirst ? at(/[,\s]*(?=[NSEW][^NSEW]*$)/) : at(/(?<=^[^NSEW]*[NSEW])[,\s]*/),
    at(/,\s+/),
    at(/,/),
    at(/\s+/),
  ];
}

/**
 * Latitude and longitude, in this order unless hemispheres say otherwise; null if the text is not a pair.
 *
 * @param {string} text
 * @returns {Origin | null}
 */
export function parsePair(text) {
  const normal = plain(text).replace(/^[([{]\s*|\s*[)\]}]$/g, "");
  for (const parts of cuts(normal)) {
    if (parts.length !== 2) continue;
    const [first, second] = parts.map((part) => angleOf(part.trim()));
    if (!first || !second || (first.axis && first.axis === second.axis)) continue;
    const isSwapped = first.axis === "longitude_deg" || second.axis === "latitude_deg";
    const [latitude_deg, longitude_deg] = isSwapped ? [second.value, first.value] : [first.value, second.value];
    return { latitude_deg, longitude_deg };
  }
  return null;
}

/** The error in a pair: a latitude beyond a pole. @param {Origin} pair @returns {string} nothing if it is fine */
export function pairProblem({ latitude_deg, longitude_deg }) {
  if (Math.abs(latitude_deg) > 90)
    return Math.abs(longitude_deg) <= 90
      ? "a latitude is at most 90°. Are latitude and longitude swapped?"
      : "a latitude is at most 90°.";
  return Math.abs(longitude_deg) > 360 ? "a longitude is at most 360°." : "";
}
