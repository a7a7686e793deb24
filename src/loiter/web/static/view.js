// @ts-check
/**
 * A view of the plane: which metres lie where on the screen. Immutable; y grows downwards on the screen.
 *
 * @typedef {object} View
 * @property {number} scale  pixels per metre
 * @property {number} east  what lies in the middle, metres
 * @property {number} north
 * @property {number} width  pixels
 * @property {number} height
 * @typedef {[number, number]} Point
 */

// From a screen that shows micrometres to one that shows the Earth many times over.
const SCALES = { least: 1e-7, most: 1e7 };

/**
 * @param {View} view
 * @param {number} east
 * @param {number} north
 * @returns {Point}
 */
export function toScreen(view, east, north) {
  return [view.width / 2 + (east - view.east) * view.scale, view.height / 2 - (north - view.north) * view.scale];
}

/**
 * @param {View} view
 * @param {Point} point
 * @returns {Point} east and north, metres
 */
export function toWorld(view, [x, y]) {
  return [view.east + (x - view.width / 2) / view.scale, view.north - (y - view.height / 2) / view.scale];
}

/**
 * The view with a point of the screen held still and everything else `factor` times as large.
 *
 * @param {View} view
 * @param {Point} point
 * @param {number} factor
 * @returns {View}
 */
export function zoomed(view, point, factor) {
  const scale = Math.min(SCALES.most, Math.max(SCALES.least, view.scale * factor));
  const [east, north] = toWorld(view, point);
  const share = view.scale / scale;
  return { ...view, scale, east: east + (view.east - east) * share, north: north + (view.north - north) * share };
}

/**
 * The view moved so that what was under a finger stays under it.
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
 * @param {View} view for its size
 * @param {Point[]} points east and north
 * @param {Margins} margins
 * @returns {View}
 */
export function fitted(view, points, { left, right, top, bottom }) {
  const [east, north] = [0, 1].map((axis) => {
    const values = points.map((point) => point[axis]);
    return [Math.min(...values), Math.max(...values)];
  });
  const wide = (view.width - left - right) / Math.max(east[1] - east[0], Number.MIN_VALUE);
  const high = (view.height - top - bottom) / Math.max(north[1] - north[0], Number.MIN_VALUE);
  const scale = Math.min(SCALES.most, Math.max(SCALES.least, Math.min(wide, high)));
  const middle = [(east[0] + east[1]) / 2, (north[0] + north[1]) / 2];
  return {
    ...view,
    scale,
    east: middle[0] + (right - left) / 2 / scale,
    north: middle[1] + (top - bottom) / 2 / scale,
  };
}

/**
 * Whether all points are on the screen, a margin from its edges.
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
