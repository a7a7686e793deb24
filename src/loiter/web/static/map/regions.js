// @ts-check
/**
 * The regions of the map. The hue is that of the word's first control, the strength tells words apart.
 *
 * @typedef {import("../shared/types.js").Synthesis} Synthesis
 * @typedef {[number, number, number, number]} Colour  red, green, blue, alpha; 0 to 255
 */

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
