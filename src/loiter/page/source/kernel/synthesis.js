// @ts-check
/**
 * The optimal synthesis of the reduced plane on a grid, and the curves between its regions: `loiter.arrays.partition`
 * without NumPy.
 *
 * @typedef {import("../shared/types.js").Synthesis} Synthesis
 * @typedef {import("../shared/types.js").Turn} Turn
 * @typedef {import("./kernel.js").Entry} Entry
 * @typedef {[number, number]} Point
 * @typedef {(x: number, y: number) => Entry} Optimum
 */
import { Side, entry_duration, optimum, rounded_radius } from "./kernel.js";
import { JUMP, LARGEST_GAP, NARROW, SHARE, VANISHING, _kind } from "./library.js";
import { letters } from "./python.js";

const SIDES = { either: Side.EITHER, cw: Side.CW, ccw: Side.CCW };

/**
 * The map of `cells` by `cells` points, |x|, |y| <= `reach`; none is on an axis.
 *
 * @param {{radius: number, turn: Turn, reach: number, cells: number}} options
 * @returns {Promise<Synthesis>}
 */
export async function synthesis({ radius, turn, reach, cells }) {
  /** @type {Optimum} */
  const best = (x, y) => optimum(x, y, rounded_radius(radius), SIDES[turn], 0);
  const line = Array.from({ length: cells }, (_, i) => ((i + 0.5) / cells) * 2 * reach - reach);
  /** @type {Entry[][]} */
  const entries = [];
  const pause = pauses();
  for (const y of line) {
    entries.push(line.map((x) => best(x, y)));
    await pause();
  }
  const codes = [...new Set(entries.flatMap((row) => row.map(({ word }) => word)))].sort((a, b) => a - b);
  const index = new Map(codes.map((code, i) => [code, i]));
  const region = entries.map((row) => row.map(({ word }) => index.get(word) ?? -1));
  const curves = boundaries(line, entries, best, radius).flatMap(({ kind, words, points }) =>
    linesOf(points, LARGEST_GAP * (line[1] - line[0])).map((found) => ({
      kind,
      words,
      x: found.map(([x]) => x),
      y: found.map(([, y]) => y),
    })),
  );
  return { radius, turn, x: line, y: line, words: codes.map(letters), region, curves };
}

const SLICE_MS = 6; // of work, after which the browser may draw and answer its user

/** A function to await in long work. */
function pauses() {
  let began = performance.now();
  return async () => {
    if (performance.now() - began < SLICE_MS) return;
    await new Promise((resolve) => setTimeout(resolve));
    began = performance.now();
  };
}

/** Whether two optima lie in the same region. @param {Entry} a @param {Entry} b */
const isSame = (a, b) => a.word === b.word && a.side === b.side;

/**
 * The curves by kind and words; each edge of the grid whose ends differ gives one point.
 *
 * @param {number[]} line
 * @param {Entry[][]} entries
 * @param {Optimum} best
 * @param {number} radius
 */
function boundaries(line, entries, best, radius) {
  /** @type {Map<string, {kind: string, words: string[], points: Point[]}>} */
  const found = new Map();
  const near = NARROW * (line[1] - line[0]);
  /** @param {Point} first @param {Point} second */
  function cross(first, second) {
    const [a, b] = narrowed(first, second, best, near);
    const [left, right] = [best(...a), best(...b)];
    const words = [letters(left.word), letters(right.word)];
    const jumps = radius === 1 && Math.abs(entry_duration(left) - entry_duration(right)) > JUMP;
    const kind = jumps ? "jump" : _kind(words[0], words[1], Math.min(left.t1, right.t1) < VANISHING);
    const key = [kind, ...words.sort()].join(" ");
    if (!found.has(key)) found.set(key, { kind, words, points: [] });
    found.get(key)?.points.push([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
  }
  entries.forEach((row, j) =>
    row.forEach((entry, i) => {
      if (i > 0 && !isSame(entry, row[i - 1])) cross([line[i - 1], line[j]], [line[i], line[j]]);
      if (j > 0 && !isSame(entry, entries[j - 1][i])) cross([line[i], line[j - 1]], [line[i], line[j]]);
    }),
  );
  return [...found].sort(([a], [b]) => (a < b ? -1 : 1)).map(([, curve]) => curve);
}

/**
 * Two points on either side of a boundary between two others, at most `near` apart.
 *
 * @param {Point} first
 * @param {Point} second
 * @param {Optimum} best
 * @param {number} near
 */
function narrowed(first, second, best, near) {
  const start = best(...first);
  while (Math.max(Math.abs(second[0] - first[0]), Math.abs(second[1] - first[1])) > near) {
    /** @type {Point} */
    const middle = [first[0] + SHARE * (second[0] - first[0]), first[1] + SHARE * (second[1] - first[1])];
    if (isSame(best(...middle), start)) first = middle;
    else second = middle;
  }
  return [first, second];
}

/**
 * Points as lines: each is followed by the nearest of the others within `gap`; a line whose ends are close is closed.
 *
 * @param {Point[]} points
 * @param {number} gap
 */
function linesOf(points, gap) {
  const remaining = [...points].sort(([a], [b]) => a - b);
  const lines = [];
  while (remaining.length > 0) {
    const line = remaining.splice(0, 1);
    for (let turned = 0; turned < 2; turned++) {
      extend(line, remaining, gap);
      line.reverse();
    }
    line.reverse();
    const closed = line.length > LARGEST_GAP && distance(line[line.length - 1], line[0]) <= gap;
    lines.push(closed ? [...line, line[0]] : line);
  }
  return lines;
}

/** Move the nearest points from `remaining` to the end of a line. @param {Point[]} line @param {Point[]} remaining @param {number} gap */
function extend(line, remaining, gap) {
  while (remaining.length > 0) {
    const end = line[line.length - 1];
    let nearest = 0;
    for (let i = 1; i < remaining.length; i++)
      if (distance(remaining[i], end) < distance(remaining[nearest], end)) nearest = i;
    if (distance(remaining[nearest], end) > gap) return;
    line.push(...remaining.splice(nearest, 1));
  }
}

/** @param {Point} a @param {Point} b */
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
