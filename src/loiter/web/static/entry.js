// @ts-check
/**
 * Numbers as they are typed: with a decimal point or comma, with a unit or without.
 *
 * @typedef {import("./types.js").Units} Units
 * @typedef {import("./units.js").Quantity} Quantity
 * @typedef {{value: number} | {problem: string}} Entry  in metres, metres per second or degrees, or why there is none
 */
import { understood, unit } from "./units.js";

const NUMBER = /^([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+))(e[+-]?\d+)?\s*(.*)$/i;

// 1,200 is 1.2 to some and 1200 to others; 0,200 and 12,50 are decimals to everybody.
const EITHER = /^[+-]?[1-9]\d{0,2},\d{3}$/;

/**
 * What a text says, in a field that shows a quantity in a unit; without a unit of its own it has that one. The problem
 * is the rest of a sentence that begins with the name of the field.
 *
 * @param {string} text
 * @param {Quantity} quantity
 * @param {Units} units
 * @returns {Entry}
 */
export function entryOf(text, quantity, units) {
  const typed = text.trim();
  if (typed === "") return { problem: "needs a number." };
  const found = NUMBER.exec(typed.replaceAll("−", "-"));
  if (!found) return { problem: `is "${typed}": it must be a number.` };
  const [, digits, power = "", suffix] = found;
  if (/^[\d.,]/.test(suffix)) return { problem: `is "${typed}": write the number in one piece, 1200.5 or 1200,5.` };
  if (EITHER.test(digits)) return { problem: `is "${typed}": write ${pointed(digits)} or ${digits.replace(",", "")}.` };
  const size = suffix === "" ? unit(quantity, units).size : understood(quantity).get(suffix.toLowerCase());
  if (size === undefined) return { problem: `is "${typed}": the units understood here are ${listed(quantity)}.` };
  const value = pointed(digits + power) * size;
  return Number.isFinite(value) ? { value } : { problem: `is "${typed}": that is too large.` };
}

/** The number of digits with a decimal point or comma. @param {string} digits */
const pointed = (digits) => Number(digits.replace(",", "."));

/** The units of a quantity: "m, km and ft". @param {Quantity} quantity */
function listed(quantity) {
  const names = [...understood(quantity).keys()];
  return `${names.slice(0, -1).join(", ")} and ${names[names.length - 1]}`;
}
