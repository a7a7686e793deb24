// @ts-check
/**
 * Numbers as the user types them: with a decimal point or comma, with or without a unit.
 *
 * @import {Units} from "../shared/types.js"
 * @import {Quantity} from "../shared/units.js"
 * @typedef {{value: number} | {problem: string}} Entry  in metres, metres per second or degrees; or why there is none
 */
import { acceptedUnits, unitOf } from "../shared/units.js";

const NUMBER = /^([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+))(e[+-]?\d+)?\s*(.*)$/i;

// 1,200 means 1.2 in some countries and 1200 in others; 0,200 and 12,50 can only be decimals.
const AMBIGUOUS = /^[+-]?[1-9]\d{0,2},\d{3}$/;

/**
 * The number in a text. Without a unit it has the unit that the field shows. The problem completes a sentence that
 * begins with the name of the field.
 *
 * @param {string} text
 * @param {Quantity} quantity
 * @param {Units} units
 * @returns {Entry}
 */
export function parseNumber(text, quantity, units) {
  const typed = text.trim();
  if (typed === "") return { problem: "needs a number." };
  // As the page writes them, for numbers that are copied from it.
  const match = NUMBER.exec(typed.replaceAll("−", "-").replace(/(?<=\d)\u202f(?=\d{3})/g, ""));
  if (!match) return { problem: `is "${typed}": it must be a number.` };
  const [, digits, power = "", suffix] = match;
  const problem = digitsProblem(digits, suffix);
  if (problem) return { problem: `is "${typed}": ${problem}` };
  const size = suffix === "" ? unitOf(quantity, units).size : acceptedUnits(quantity).get(suffix.toLowerCase());
  if (size === undefined) return { problem: `is "${typed}": the accepted units are ${unitList(quantity)}.` };
  const value = thirteenDigits(withPoint(digits + power) * size);
  return Number.isFinite(value) ? { value } : { problem: `is "${typed}": that is too large.` };
}

/** What is unclear in the digits of a number, or nothing. @param {string} digits @param {string} suffix */
function digitsProblem(digits, suffix) {
  if (/^[\d.,]/.test(suffix)) return "write the number without separators, 1200.5 or 1200,5.";
  if (AMBIGUOUS.test(digits)) return `write ${withPoint(digits)} or ${digits.replace(",", "")}.`;
  return "";
}

/** A product without the rounding of its last digits: 91.44 m for 300 ft. @param {number} value */
const thirteenDigits = (value) => Number(value.toPrecision(13));

/** The number of digits with a decimal point or comma. @param {string} digits */
const withPoint = (digits) => Number(digits.replace(",", "."));

/** The accepted units of a quantity: "m, km and ft". @param {Quantity} quantity */
function unitList(quantity) {
  const names = [...acceptedUnits(quantity).keys()];
  return `${names.slice(0, -1).join(", ")} and ${names[names.length - 1]}`;
}
