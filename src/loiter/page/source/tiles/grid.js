// @ts-check
/**
 * The tiles of a map in web Mercator, and where they lie on the screen.
 *
 * @import {Origin} from "../shared/types.js"
 * @import {Point, View} from "../shared/geometry.js"
 * @typedef {{z: number, x: number, y: number}} Tile
 */
import { REACH_M, toLocal, toPlace } from "../shared/earth.js";
import { DEGREE, toScreen, toWorld } from "../shared/geometry.js";

/** Pixels along a side of a tile. */
export const SIDE_PX = 256;

const EQUATOR_M = 2 * Math.PI * 6378137;
const MOST_ZOOM = 19;
const MOST_TILES = 150;

/** The column and row, with fractions, of a place. @param {Origin} place @param {number} z @returns {Point} */
function columnAndRow({ latitude_deg, longitude_deg }, z) {
  const count = 2 ** z;
  const latitude = Math.min(85, Math.max(-85, latitude_deg)) * DEGREE;
  return [(longitude_deg / 360 + 0.5) * count, (0.5 - Math.asinh(Math.tan(latitude)) / (2 * Math.PI)) * count];
}

/** The place at a column and row. @param {number} x @param {number} y @param {number} z @returns {Origin} */
function placeAt(x, y, z) {
  const count = 2 ** z;
  const latitude_deg = Math.atan(Math.sinh(Math.PI * (1 - (2 * y) / count))) / DEGREE;
  return { latitude_deg, longitude_deg: (x / count - 0.5) * 360 };
}

/** The zoom level whose pixels are nearest to those of the screen. @param {View} view @param {Origin} origin */
function zoomFor({ scale }, { latitude_deg }) {
  const level = Math.log2((EQUATOR_M * Math.cos(latitude_deg * DEGREE) * scale) / SIDE_PX);
  return Math.min(MOST_ZOOM, Math.max(0, Math.round(level)));
}

/**
 * The tiles that cover a view: none where it reaches beyond the local plane.
 *
 * @param {View} view
 * @param {Origin} origin  the place of (0, 0)
 * @returns {Tile[]}
 */
export function tilesFor(view, origin) {
  const z = zoomFor(view, origin);
  const corners = [0, view.width].flatMap((x) => [0, view.height].map((y) => toWorld(view, [x, y])));
  if (corners.some(([east, north]) => Math.hypot(east, north) > REACH_M)) return [];
  const found = corners.map(([east, north]) => columnAndRow(toPlace(origin, east, north), z));
  const [columns, rows] = [0, 1].map((axis) => {
    const values = found.map((point) => Math.floor(point[axis]));
    const least = Math.min(...values);
    return Array.from({ length: Math.max(...values) - least + 1 }, (_, i) => least + i);
  });
  const inside = rows.filter((y) => y >= 0 && y < 2 ** z);
  if (columns.length * inside.length > MOST_TILES) return [];
  return columns.flatMap((x) => inside.map((y) => ({ z, x, y })));
}

/**
 * The transformation of a tile, drawn with its upper left corner at (0, 0), to its place on the screen.
 *
 * @param {Tile} tile
 * @param {View} view
 * @param {Origin} origin
 */
export function matrixOf({ z, x, y }, view, origin) {
  const [corner, right, below] = [
    [x, y],
    [x + 1, y],
    [x, y + 1],
  ].map(([column, row]) => toScreen(view, ...toLocal(origin, placeAt(column, row, z))));
  const sides = [right, below].flatMap((end) => [end[0] - corner[0], end[1] - corner[1]]);
  // A little larger, so that no line of background shows between tiles.
  const shares = sides.map((side) => (side / SIDE_PX) * (1 + 0.3 / SIDE_PX));
  return [...shares, ...corner];
}

/** The address of a tile. @param {string} template @param {Tile} tile */
export function addressOf(template, { z, x, y }) {
  const column = ((x % 2 ** z) + 2 ** z) % 2 ** z;
  return template.replaceAll("{z}", String(z)).replaceAll("{x}", String(column)).replaceAll("{y}", String(y));
}
