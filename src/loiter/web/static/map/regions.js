// @ts-check
/**
 * The regions of the map and their words. The hue is that of the word's first control, the strength distinguishes
 * words.
 *
 * @typedef {import("../shared/types.js").Synthesis} Synthesis
 * @typedef {import("../shared/geometry.js").View} View
 *
 * @typedef {[number, number, number, number]} Colour  red, green, blue, alpha; 0 to 255
 */
import { svg } from "../shared/dom.js";
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

/**
 * @param {HTMLCanvasElement} canvas
 * @param {Synthesis} synthesis
 */
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

/**
 * The colour of a word in the present theme.
 *
 * @param {string} word
 * @returns {Colour}
 */
function colourOf(word) {
  const theme = getComputedStyle(document.documentElement);
  const hex = theme.getPropertyValue(`--${word[0] || "S"}`).trim();
  const [red, green, blue] = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
  return [red, green, blue, Math.round(255 * (STRENGTH[word] ?? OTHER_STRENGTH))];
}

const LEAST_DEPTH_PX = 12; // regions that are narrower have no label, only a colour

/**
 * The word of each region, where it is farthest from the border, in each half of the plane.
 *
 * @param {View} view
 * @param {Synthesis} synthesis
 */
export function drawRegionLabels(view, { region, words, x, y }) {
  const middle = y.length >> 1;
  const halves = [
    { rows: region.slice(0, middle), first: 0 },
    { rows: region.slice(middle), first: middle },
  ];
  return words.flatMap((word, index) =>
    halves.flatMap(({ rows, first }) => {
      const { depth, row, column } = deepestCell(rows, index);
      if (depth * (x[1] - x[0]) * view.scale < LEAST_DEPTH_PX) return [];
      const [left, top] = toScreen(view, x[column], y[first + row]);
      return [svg("text", { x: left, y: top + 4, "text-anchor": "middle" }, [word])];
    }),
  );
}

/**
 * The cell of a region that is farthest from the other regions, and its depth: the number of steps along rows and
 * columns to the nearest cell outside.
 *
 * @param {number[][]} rows
 * @param {number} index
 */
function deepestCell(rows, index) {
  const depths = depthsOf(rows, index);
  let deepest = { depth: 0, row: 0, column: 0 };
  depths.forEach((values, row) =>
    values.forEach((depth, column) => {
      if (depth >= deepest.depth && depth > 0) deepest = { depth, row, column };
    }),
  );
  return deepest;
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
