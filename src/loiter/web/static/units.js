// @ts-check
/**
 * Numbers as they are shown and typed. Everything else is in metres, seconds and degrees.
 *
 * @typedef {import("./types.js").Units} Units
 * @typedef {"length" | "speed" | "degrees" | "rate"} Quantity
 */

// The international foot and the knot, exact by definition.
const FOOT_M = 0.3048;
const KNOT_M_S = 1852 / 3600;

/** @type {Record<Units, Record<Quantity, {name: string, size: number}>>} */
const SCALES = {
  metric: {
    length: { name: "m", size: 1 },
    speed: { name: "m/s", size: 1 },
    degrees: { name: "°", size: 1 },
    rate: { name: "°/s", size: 1 },
  },
  aviation: {
    length: { name: "ft", size: FOOT_M },
    speed: { name: "kt", size: KNOT_M_S },
    degrees: { name: "°", size: 1 },
    rate: { name: "°/s", size: 1 },
  },
};

/**
 * The unit that a quantity is shown in: its name, and its size in metres, metres per second or degrees.
 *
 * @param {Quantity} quantity
 * @param {Units} units
 */
export function unit(quantity, units) {
  return SCALES[units][quantity];
}

/**
 * The units that may be typed after a number, and the size of each; in lower case.
 *
 * @type {Record<Quantity, Map<string, number>>}
 */
const TYPED = {
  length: new Map([
    ["m", 1],
    ["km", 1000],
    ["ft", FOOT_M],
  ]),
  speed: new Map([
    ["m/s", 1],
    ["km/h", 1 / 3.6],
    ["kn", KNOT_M_S],
    ["kt", KNOT_M_S],
  ]),
  degrees: new Map([
    ["°", 1],
    ["deg", 1],
  ]),
  rate: new Map([
    ["°/s", 1],
    ["deg/s", 1],
  ]),
};

/** @param {Quantity} quantity */
export const understood = (quantity) => TYPED[quantity];

/**
 * A number with a true minus sign and no more decimals than asked for.
 *
 * @param {number} value
 * @param {number} decimals
 */
export function fixed(value, decimals) {
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/**
 * How many decimals a scene of this size asks for; the command line's rule, and none for feet.
 *
 * @param {number} radius_m
 * @param {Units} units
 */
export function decimalsFor(radius_m, units) {
  if (radius_m < 10) return 3;
  return units === "metric" ? 1 : 0;
}

/**
 * @param {number} metres
 * @param {Units} units
 * @param {number} decimals
 */
export function length(metres, units, decimals) {
  const { name, size } = unit("length", units);
  return `${fixed(metres / size, decimals)} ${name}`;
}

/**
 * A number for a field: six digits, as it is not for reading more and has no room.
 *
 * @param {number} value
 */
export const shortened = (value) => Number(value.toPrecision(6));

/**
 * A difference of times: three digits, as the command line tells it.
 *
 * @param {number} seconds
 */
export function difference(seconds) {
  const size = Math.abs(seconds);
  if (size < 1e-3) return "< 1 ms";
  return `${size >= 100 ? size.toFixed(0) : String(Number(size.toPrecision(3)))} s`;
}

/**
 * The value at most `resolution` away with the fewest digits: what a drag sets, so that links and commands stay short.
 *
 * @param {number} value
 * @param {number} resolution
 */
export function tidy(value, resolution) {
  const decimals = Math.min(12, Math.max(-12, -Math.floor(Math.log10(resolution))));
  const unitSize = 10 ** -decimals;
  // Dividing by a whole power of ten rounds once; multiplying by its inverse would leave 0.30000000000000004.
  const whole =
    decimals >= 0 ? Math.round(value * 10 ** decimals) / 10 ** decimals : Math.round(value / unitSize) * unitSize;
  return whole + 0;
}

/**
 * A length of 1, 2 or 5 times a power of ten, the least that is not below `least`.
 *
 * @param {number} least
 */
export function nice(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return /** @type {number} */ ([1, 2, 5, 10].find((step) => step * power >= least * (1 - 1e-12))) * power;
}

/**
 * The heading in [0, 360).
 *
 * @param {number} degrees
 */
export function wrapped(degrees) {
  return (((degrees % 360) + 360) % 360) + 0;
}
