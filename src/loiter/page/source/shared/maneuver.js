// @ts-check
/**
 * Maneuvers: names of controls and directions, segments, and the state at a time.
 *
 * @import {Alternative, Answer, Direction, Letter, Maneuver, Scene, Track} from "./types.js"
 *
 * @typedef {{east_m: number, north_m: number, heading_deg: number, x: number, y: number}} Instant
 */
import { part } from "./dom.js";

/** @type {Record<Letter, string>} */
export const CONTROLS = { L: "left", S: "straight", R: "right" };

/** @type {Record<Direction, string>} */
export const DIRECTIONS = { cw: "clockwise", ccw: "counter-clockwise" };

/** @type {Record<Direction, string>} */
export const DIRECTION_ARROWS = { cw: "↻", ccw: "↺" };

/** A word with each letter in the colour of its control; "hold" for the empty word. @param {string} word */
export function wordLabel(word) {
  const letters = Array.from(word, (letter) => part("span", { class: letter }, [letter]));
  return part("span", { class: "word" }, letters.length > 0 ? letters : ["hold"]);
}

/**
 * The index of the last sample at or before a time, but not the last sample itself.
 *
 * @param {number[]} times
 * @param {number} time
 */
function indexBefore(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

/**
 * The two samples next to a time, and the share of the second: linear between samples, constant beyond the ends.
 *
 * @param {number[]} times
 * @param {number} time
 */
function bracket(times, time) {
  const i = indexBefore(times, time);
  const j = Math.min(i + 1, times.length - 1);
  const width = times[j] - times[i];
  return { i, j, share: width > 0 ? Math.min(1, Math.max(0, (time - times[i]) / width)) : 0 };
}

/**
 * A function that gives the value of a series at a time.
 *
 * @param {number[]} times
 * @param {number} time
 * @returns {(values: number[]) => number}
 */
export function interpolator(times, time) {
  const { i, j, share } = bracket(times, time);
  return (values) => values[i] + share * (values[j] - values[i]);
}

/**
 * The pose on a track at a time. Across north the heading takes the short way.
 *
 * @param {Omit<Track, "x" | "y">} track
 * @param {number} time
 * @returns {import("./types.js").Pose}
 */
export function poseAt({ time_s, east_m, north_m, heading_deg }, time) {
  const { i, j, share } = bracket(time_s, time);
  const read = interpolator(time_s, time);
  const turned = ((((heading_deg[j] - heading_deg[i]) % 360) + 540) % 360) - 180;
  return { east_m: read(east_m), north_m: read(north_m), heading_deg: heading_deg[i] + share * turned };
}

/** The state of a maneuver at a time. @param {Track} track @param {number} time @returns {Instant} */
export function stateAt(track, time) {
  const read = interpolator(track.time_s, time);
  return { ...poseAt(track, time), x: read(track.x), y: read(track.y) };
}

const TURN_SAMPLES = 121; // of the first turn of a hold, whose other turns are flown over the same ground

/**
 * The indices of the samples of each segment, both ends included, and of a hold those of one turn.
 *
 * @param {Maneuver} maneuver
 * @returns {{letter: Letter, indices: number[]}[]}
 */
export function piecesOf(maneuver) {
  const times = maneuver.track.time_s;
  // Times of samples and of switches are sums of the same durations; they differ by rounding only.
  const near = 1e-9 * (1 + maneuver.duration_s);
  return maneuver.segments.map(({ letter, name, start_s, duration_s }) => {
    const end_s = start_s + duration_s;
    const indices = times.flatMap((t, i) => (t >= start_s - near && t <= end_s + near ? [i] : []));
    return { letter, indices: name === "hold" ? indices.slice(0, TURN_SAMPLES) : indices };
  });
}

/**
 * The optimal maneuvers of an answer, and the others, fastest first.
 *
 * @param {Answer} answer
 * @returns {{best: Maneuver[], others: Alternative[]}}
 */
export function splitAnswer(answer) {
  const { alternatives, optimal } = answer;
  return { best: [answer, ...alternatives.slice(0, optimal - 1)], others: alternatives.slice(optimal - 1) };
}

/** Whether the scene allows the direction of a maneuver. @param {Scene} scene @param {Maneuver} maneuver */
export const isAllowed = ({ orbit }, { turn }) => orbit.turn === "either" || orbit.turn === turn;
