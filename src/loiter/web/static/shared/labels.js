// @ts-check
/**
 * What the page calls controls, words and directions.
 *
 * @typedef {import("./types.js").Direction} Direction
 * @typedef {import("./types.js").Letter} Letter
 */
import { html } from "./dom.js";

/** @type {Record<Letter, string>} */
export const CONTROLS = { L: "left", S: "straight", R: "right" };

/** @type {Record<Direction, string>} */
export const DIRECTIONS = { cw: "clockwise", ccw: "counter-clockwise" };

/** @type {Record<Direction, string>} */
export const DIRECTION_ARROWS = { cw: "↻", ccw: "↺" };

/**
 * A word with each letter in the colour of its control; "hold" for the empty word.
 *
 * @param {string} word
 */
export function wordLabel(word) {
  const letters = Array.from(word, (letter) => html("span", { class: letter }, [letter]));
  return html("span", { class: "word" }, letters.length > 0 ? letters : ["hold"]);
}
