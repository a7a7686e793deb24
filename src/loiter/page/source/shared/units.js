// @ts-check
/**
 * Units and formats of the numbers that are shown and typed. All other code uses metres, seconds and degrees.
 *
 * @import {Scene, Units} from "./types.js"
 * @typedef {"length" | "speed" | "degrees" | "direction" | "rate" | "climb" | "time" | "count"} Quantity
 */

// The international foot and the knot, exact by definition.
const FOOT_M = 0.3048;
const NAUTICAL_MILE_M = 1852;
const KNOT_M_S = NAUTICAL_MILE_M / 3600;
const MILE_PER_HOUR_M_S = 1609.344 / 3600;

const METRIC = {
  length: { name: "m", size: 1 },
  speed: { name: "m/s", size: 1 },
  degrees: { name: "°", size: 1 },
  direction: { name: "°", size: 1 },
  rate: { name: "°/s", size: 1 },
  climb: { name: "m/s", size: 1 },
  time: { name: "s", size: 1 },
  count: { name: "", size: 1 },
};

/** @type {Record<Units, Record<Quantity, {name: string, size: number}>>} */
const SCALES = {
  metric: METRIC,
  aviation: {
    ...METRIC,
    length: { name: "ft", size: FOOT_M },
    speed: { name: "kt", size: KNOT_M_S },
    climb: { name: "ft/min", size: FOOT_M / 60 },
  },
};

/**
 * The unit in which a quantity is shown: its name, and its size in metres, metres per second or degrees.
 *
 * @param {Quantity} quantity
 * @param {Units} units
 */
export const unitOf = (quantity, units) => SCALES[units][quantity];

/** @param {string | null} text @returns {Units} */
export const asUnits = (text) => (text === "aviation" ? text : "metric");

/** The units of long distances, and the distance in metres from which they are used. */
const FAR = {
  metric: { name: "km", size: 1000, from: 10_000 },
  aviation: { name: "NM", size: NAUTICAL_MILE_M, from: NAUTICAL_MILE_M },
};

/** The unit in which a length of this size is read. @param {Units} units @param {number} metres */
export const lengthUnit = (units, metres) =>
  Math.abs(metres) >= FAR[units].from ? FAR[units] : unitOf("length", units);

const DEGREES = { "°": 1, deg: 1 };

/** The units that may be typed after a number, in lower case, with their sizes. @type {Record<Quantity, Record<string, number>>} */
const ACCEPTED = {
  length: { m: 1, km: 1000, ft: FOOT_M, nm: NAUTICAL_MILE_M, nmi: NAUTICAL_MILE_M },
  speed: { "m/s": 1, "km/h": 1 / 3.6, kn: KNOT_M_S, kt: KNOT_M_S, kts: KNOT_M_S, mph: MILE_PER_HOUR_M_S },
  degrees: DEGREES,
  direction: { ...DEGREES, t: 1 },
  rate: { "°/s": 1, "deg/s": 1 },
  climb: { "m/s": 1, "ft/min": FOOT_M / 60, fpm: FOOT_M / 60 },
  time: { s: 1, min: 60 },
  count: { turn: 1, turns: 1 },
};

/** The units that may be typed for a quantity, with their sizes. @param {Quantity} quantity */
export const acceptedUnits = (quantity) => new Map(Object.entries(ACCEPTED[quantity]));

/** What stands between thousands: a narrow space that breaks no line. Commas mean decimals in some countries. */
const THOUSANDS = "\u202f";

/**
 * A number with a minus sign (not a hyphen), a fixed number of decimals, and its thousands apart.
 *
 * @param {number} value
 * @param {number} decimals
 */
export function fixed(value, decimals) {
  const [whole, part] = Math.abs(value).toFixed(decimals).split(".");
  const text = whole.replace(/\B(?=(\d{3})+$)/g, THOUSANDS) + (part ? `.${part}` : "");
  return value < 0 && /[1-9]/.test(text) ? `−${text}` : text;
}

/**
 * The number of decimals for a scene with a circle of this radius: as on the command line, but none for feet.
 *
 * @param {number} radius_m
 * @param {Units} units
 */
export function decimalsFor(radius_m, units) {
  if (radius_m < 10) return 3;
  return units === "metric" ? 1 : 0;
}

/** The number of decimals that multiples of a step need. @param {number} step */
export const decimalsOfStep = (step) => Math.max(0, -Math.floor(Math.log10(step)));

/**
 * A quantity as text, in the unit in which it is shown: "12.5 m/s".
 *
 * @param {number} value
 * @param {Quantity} quantity
 * @param {Units} units
 * @param {number} decimals
 */
export function quantityText(value, quantity, units, decimals) {
  const { name, size } = quantity === "length" ? lengthUnit(units, value) : unitOf(quantity, units);
  return `${fixed(value / size, size === FAR[units].size ? 2 : decimals)} ${name}`;
}

/** How sentences of the library call its units, and what they measure. @type {Record<string, Quantity>} */
const MEASURES = { m: "length", "m/s": "speed", metres: "length", "metres per second": "speed" };
const NAMES = { length: "feet", speed: "knots" };

/**
 * A sentence of the library, which measures in metres and metres per second, in the units of the page.
 *
 * @param {string} sentence
 * @param {Units} units
 * @param {Quantity} [quantity]  of its first number, if that has no unit
 */
export function sentenceIn(sentence, units, quantity) {
  if (units === "metric") return sentence;
  const text = (/** @type {string} */ number, /** @type {Quantity} */ kind) =>
    String(Number((Number(number) / unitOf(kind, units).size).toPrecision(5)));
  const [name] = /metres per second|metres/.exec(sentence) ?? [];
  const kind = name ? /** @type {"length" | "speed"} */ (MEASURES[name]) : null;
  // "is -18.0: it must be a positive, finite number of metres per second"
  if (name && kind) return sentence.replace(/-?\d[\d.]*/g, (number) => text(number, kind)).replace(name, NAMES[kind]);
  const bare = quantity ? sentence.replace(/(?<= is )-?\d[\d.]*(?=:)/, (number) => text(number, quantity)) : sentence;
  return bare.replace(
    /(-?\d[\d.]*) (m\/s|m)\b/g,
    (_, number, unit) => `${text(number, MEASURES[unit])} ${unitOf(MEASURES[unit], units).name}`,
  );
}

/** A number for a field, with at most six digits. @param {number} value */
export const sixDigits = (value) => Number(value.toPrecision(6));

/**
 * The number of decimals of all times of a scene, so that a time reads the same wherever it is shown.
 *
 * @param {{orbit: {radius_m: number}}} scene
 */
const timeDecimals = ({ orbit }) => (orbit.radius_m < 10 ? 3 : 2);

/** A time of a scene: "9.14 s", or "1:23.40 min" from a minute on. @param {number} seconds @param {Scene} scene */
export const timeText = (seconds, scene) => clockText(seconds, timeDecimals(scene));

/** A time with its unit: seconds, or minutes and seconds. @param {number} seconds @param {number} decimals */
export function clockText(seconds, decimals) {
  const whole = Number(seconds.toFixed(decimals));
  return whole < 60 ? `${fixed(whole, decimals)} s` : `${clock(whole, decimals)} min`;
}

/** A time as minutes and seconds: "1:23.40". @param {number} seconds @param {number} decimals */
export function clock(seconds, decimals) {
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${(seconds - 60 * minutes).toFixed(decimals).padStart(decimals ? decimals + 3 : 2, "0")}`;
}

/**
 * A difference of times without its sign: "4.91 s", or "< 0.01 s" where it would read as none.
 *
 * @param {number} seconds
 * @param {Scene} scene
 */
export function timeDifference(seconds, scene) {
  const least = 10 ** -timeDecimals(scene);
  const size = Math.abs(seconds);
  return size < least / 2 ? `< ${least} s` : timeText(size, scene);
}

/** A difference of times with its sign: "+4.91 s"; one that would read as none has no sign. @param {number} seconds @param {Scene} scene */
export function signedTimeDifference(seconds, scene) {
  const size = timeDifference(seconds, scene);
  return size.startsWith("<") ? size : `${seconds < 0 ? "−" : "+"}${size}`;
}

/**
 * The value with the fewest decimals that is at most `resolution` away. Drags use it to keep links and commands short.
 *
 * @param {number} value
 * @param {number} resolution
 */
export function tidy(value, resolution) {
  const decimals = Math.min(12, Math.max(-12, -Math.floor(Math.log10(resolution))));
  const unitSize = 10 ** -decimals;
  // Division by a whole power of ten rounds once; multiplication by its inverse would leave 0.30000000000000004.
  const whole =
    decimals >= 0 ? Math.round(value * 10 ** decimals) / 10 ** decimals : Math.round(value / unitSize) * unitSize;
  return whole + 0;
}

/** Like `tidy`, but never below the value. @param {number} value @param {number} resolution */
export function tidyAbove(value, resolution) {
  const nearest = tidy(value, resolution);
  return nearest >= value ? nearest : tidy(nearest + resolution, resolution);
}

/** The power of ten that is at most this share of a size. @param {number} size @param {number} share */
export const powerBelow = (size, share) => 10 ** Math.floor(Math.log10(Math.max(Math.abs(size) * share, 1e-12)));

/** The smallest number of the form 1, 2 or 5 times a power of ten that is not below `least`. @param {number} least */
export function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return /** @type {number} */ ([1, 2, 5, 10].find((step) => step * power >= least * (1 - 1e-12))) * power;
}
