// @ts-check
/**
 * Compass headings, and views. A view maps the plane (metres, or turn radii) to the screen (pixels; y grows downwards).
 * Views are never changed in place.
 *
 * @typedef {object} View
 * @property {number} scale  pixels per metre
 * @property {number} east  coordinates of the middle, metres
 * @property {number} north
 * @property {number} width  pixels
 * @property {number} height
 * @typedef {[number, number]} Point
 *
 * @typedef {{left: number, right: number, top: number, bottom: number}} Box  on the screen, pixels
 */

/** Radians per degree. */
export const DEGREE = Math.PI / 180;

/**
 * The east and north components of the unit vector along a heading.
 *
 * @param {number} heading_deg
 * @returns {[number, number]}
 */
export function unitVector(heading_deg) {
  return [Math.sin(heading_deg * DEGREE), Math.cos(heading_deg * DEGREE)];
}

/** The heading along a vector, degrees in [0, 360). @param {number} east @param {number} north */
export function headingOf(east, north) {
  return (Math.atan2(east, north) / DEGREE + 360) % 360;
}

/** A heading as the same direction in [0, 360). @param {number} degrees */
export function wrapped(degrees) {
  return (((degrees % 360) + 360) % 360) + 0;
}

// Pixels per metre: from a screen that shows the whole Earth to one that shows micrometres.
const SCALES = { least: 1e-7, most: 1e7 };

/** @param {number} scale */
const allowedScale = (scale) => Math.min(SCALES.most, Math.max(SCALES.least, scale));

/**
 * The pixel of a point of the plane.
 *
 * @param {View} view
 * @param {number} east
 * @param {number} north
 * @returns {Point}
 */
export function toScreen(view, east, north) {
  return [view.width / 2 + (east - view.east) * view.scale, view.height / 2 - (north - view.north) * view.scale];
}

/** The pixel of a position. @param {View} view @param {{east_m: number, north_m: number}} position */
export const positionToScreen = (view, { east_m, north_m }) => toScreen(view, east_m, north_m);

/**
 * The point of the screen at a bearing and distance from another.
 *
 * @param {Point} from
 * @param {number} bearing_deg
 * @param {number} distance pixels
 * @returns {Point}
 */
export function pointAt([x, y], bearing_deg, distance) {
  const [east, north] = unitVector(bearing_deg);
  return [x + distance * east, y - distance * north];
}

/**
 * The point of the plane at a pixel.
 *
 * @param {View} view
 * @param {Point} point
 * @returns {Point} east and north, metres
 */
export function toWorld(view, [x, y]) {
  return [view.east + (x - view.width / 2) / view.scale, view.north - (y - view.height / 2) / view.scale];
}

/**
 * The view enlarged by `factor` about a fixed point of the screen.
 *
 * @param {View} view
 * @param {Point} point
 * @param {number} factor
 * @returns {View}
 */
export function zoomed(view, point, factor) {
  const scale = allowedScale(view.scale * factor);
  const [east, north] = toWorld(view, point);
  const share = view.scale / scale;
  return { ...view, scale, east: east + (view.east - east) * share, north: north + (view.north - north) * share };
}

/**
 * The view after its contents have moved on the screen.
 *
 * @param {View} view
 * @param {number} dx pixels to the right
 * @param {number} dy pixels down
 * @returns {View}
 */
export function panned(view, dx, dy) {
  return { ...view, east: view.east - dx / view.scale, north: view.north + dy / view.scale };
}

/** @typedef {{left: number, right: number, top: number, bottom: number}} Margins pixels */

/**
 * The view that shows all points within its margins.
 *
 * @param {View} view gives the size
 * @param {Point[]} points east and north
 * @param {Margins} margins
 * @returns {View}
 */
export function fitted(view, points, { left, right, top, bottom }) {
  const east = rangeOf(points.map((point) => point[0]));
  const north = rangeOf(points.map((point) => point[1]));
  const wide = (view.width - left - right) / Math.max(east.length, Number.MIN_VALUE);
  const high = (view.height - top - bottom) / Math.max(north.length, Number.MIN_VALUE);
  const scale = allowedScale(Math.min(wide, high));
  return {
    ...view,
    scale,
    east: east.middle + (right - left) / 2 / scale,
    north: north.middle + (top - bottom) / 2 / scale,
  };
}

/** Whether two boxes have common points. @param {Box} a @param {Box} b */
export const overlaps = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/** @param {number[]} values */
function rangeOf(values) {
  const [least, most] = [Math.min(...values), Math.max(...values)];
  return { middle: (least + most) / 2, length: most - least };
}

/**
 * Whether all points are on the screen, at least `margin` from its edges.
 *
 * @param {View} view
 * @param {Point[]} points east and north
 * @param {number} margin pixels
 */
export function contains(view, points, margin) {
  return points.every(([east, north]) => {
    const [x, y] = toScreen(view, east, north);
    return x >= margin && x <= view.width - margin && y >= margin && y <= view.height - margin;
  });
}
