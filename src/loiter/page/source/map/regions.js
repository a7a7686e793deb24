// @ts-check
/**
 * The regions of the map and their words. The hue is that of the word's first control, the strength distinguishes
 * words.
 *
 * @import {Synthesis} from "../shared/types.js"
 * @import {Point, View} from "../shared/geometry.js"
 *
 * @typedef {[number, number, number, number]} Colour  red, green, blue, alpha; 0 to 255
 */
import { part } from "../shared/dom.js";
import { toScreen } from "../shared/geometry.js";

const STRENGTH = /** @type {Record<string, number>} */ ({
  RSR: 0.18,
  RSL: 0.3,
  RL: 0.52,
  RLR: 0.72,
  R: 0.72,
  LSR: 0.18,
  LSL: 0.3,
  LR: 0.52,
  LRL: 0.72,
  L: 0.72,
  SR: 0.6,
  SL: 0.6,
});

const OTHER_STRENGTH = 0.4;

/** @type {Colour} */
const TRANSPARENT = [0, 0, 0, 0];

/** @param {HTMLCanvasElement} canvas @param {Synthesis} synthesis */
export function paintRegions(canvas, { region, words, x, y }) {
  setCanvasSize(canvas, x.length, y.length);
  const context = canvas.getContext("2d");
  if (!context) return;
  const image = context.createImageData(x.length, y.length);
  const colours = words.map(colourOf);
  region.forEach((row, j) => {
    // The first row has the lowest y; in the image it is the last.
    const start = 4 * (y.length - 1 - j) * x.length;
    row.forEach((index, i) => image.data.set(index < 0 ? TRANSPARENT : colours[index], start + 4 * i));
  });
  context.putImageData(image, 0, 0);
}

/** @param {HTMLCanvasElement} canvas @param {number} width @param {number} height */
function setCanvasSize(canvas, width, height) {
  canvas.width = width;
  canvas.height = height;
}

/** The colour of a word in the present theme. @param {string} word @returns {Colour} */
function colourOf(word) {
  const theme = getComputedStyle(document.documentElement);
  const hex = theme.getPropertyValue(`--${word[0] || "S"}`).trim();
  const [red, green, blue] = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
  return [red, green, blue, Math.round(255 * (STRENGTH[word] ?? OTHER_STRENGTH))];
}

const LEAST_DEPTH_PX = 12; // regions that are narrower have no label, only a colour
const PLACES = 8; // of a label, of which the first that is free is used
const APART_PX = 20; // between two places of a label
const STATE_PX = 9; // radius of the dot of the state
const HALF_LABEL_PX = { width: 18, height: 9 };

/**
 * The words of the regions, each with the places where its label may be, in each half of the plane, deepest inside the
 * region first.
 *
 * @param {View} view
 * @param {Synthesis} synthesis
 * @returns {{word: string, places: Point[]}[]}
 */
export function regionLabels(view, { region, words, x, y }) {
  const middle = y.length >> 1;
  const halves = [
    { rows: region.slice(0, middle), first: 0 },
    { rows: region.slice(middle), first: middle },
  ];
  const cell_px = (x[1] - x[0]) * view.scale;
  return words.flatMap((word, index) =>
    halves.map(({ rows, first }) => ({
      word,
      places: deepestCells(rows, index, LEAST_DEPTH_PX / cell_px, APART_PX / cell_px).map(({ row, column }) =>
        toScreen(view, x[column], y[first + row]),
      ),
    })),
  );
}

/**
 * Draw the labels where they cover neither the state nor the paths, or at least not the state; a label without such a
 * place is left out.
 *
 * @param {{word: string, places: Point[]}[]} labels
 * @param {Point | null} state
 * @param {Point[]} paths
 */
export function drawRegionLabels(labels, state, paths) {
  const { width, height } = HALF_LABEL_PX;
  const isClear = (/** @type {Point} */ [left, top], /** @type {Point} */ [x, y], /** @type {number} */ radius) =>
    Math.abs(x - left) > width + radius || Math.abs(y - top) > height + radius;
  return labels.flatMap(({ word, places }) => {
    const beside = places.filter((place) => state === null || isClear(place, state, STATE_PX));
    const place = beside.find((one) => paths.every((point) => isClear(one, point, 0))) ?? beside[0];
    return place ? [part("text", { x: place[0], y: place[1] + 4, "text-anchor": "middle" }, [word])] : [];
  });
}

/**
 * The cells of a region that are farthest from the other regions, at most `PLACES` of them, with a distance between
 * them. The depth of a cell is the number of steps along rows and columns to the nearest cell outside.
 *
 * @param {number[][]} rows
 * @param {number} index
 * @param {number} least  depth, cells
 * @param {number} apart  distance, cells
 */
function deepestCells(rows, index, least, apart) {
  const cells = depthsOf(rows, index).flatMap((values, row) =>
    values.flatMap((depth, column) => (depth >= least && depth > 0 ? [{ depth, row, column }] : [])),
  );
  /** @type {{depth: number, row: number, column: number}[]} */
  const found = [];
  let left = cells;
  while (left.length > 0 && found.length < PLACES) {
    const best = left.reduce((deepest, cell) => (cell.depth >= deepest.depth ? cell : deepest));
    found.push(best);
    left = left.filter(({ row, column }) => Math.hypot(row - best.row, column - best.column) > apart);
  }
  return found;
}

/**
 * The depths of all cells, in two sweeps: from above and left, then from below and right.
 *
 * @param {number[][]} rows
 * @param {number} index
 */
function depthsOf(rows, index) {
  const depths = rows.map((row) => row.map((value) => (value === index ? Infinity : 0)));
  const columns = [...rows[0].keys()];
  /** @param {number} row @param {number} column @param {number} from -1 from above and left, 1 from below and right */
  function relax(row, column, from) {
    const above = depths[row + from]?.[column] ?? 0;
    const beside = depths[row][column + from] ?? 0;
    depths[row][column] = Math.min(depths[row][column], above + 1, beside + 1);
  }
  rows.forEach((_, row) => columns.forEach((column) => relax(row, column, -1)));
  rows.forEach((_, i) => columns.forEach((_, j) => relax(rows.length - 1 - i, columns.length - 1 - j, 1)));
  return depths;
}
