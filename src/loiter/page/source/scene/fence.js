// @ts-check
/**
 * The fence of a scene: zones to stay in or out of, and scenes with a zone changed.
 *
 * @import {PolygonZone, Scene, Zone} from "../shared/types.js"
 */

/** The zones of a scene. @param {Scene} scene */
export const zonesOf = ({ fence }) => fence?.zones ?? [];

/** A scene with these zones; without zones it has no fence, and its margin is gone. @param {Scene} scene @param {Zone[]} zones @returns {Scene} */
export const withZones = (scene, zones) => ({
  ...scene,
  fence: zones.length > 0 ? { margin_m: scene.fence?.margin_m ?? null, zones } : null,
});

/** A scene with one zone replaced. @param {Scene} scene @param {number} i @param {Zone} zone */
export const withZone = (scene, i, zone) =>
  withZones(
    scene,
    zonesOf(scene).map((one, k) => (k === i ? zone : one)),
  );

/** @param {Scene} scene @param {number} i */
export const withoutZone = (scene, i) =>
  withZones(
    scene,
    zonesOf(scene).filter((_, k) => k !== i),
  );

/** @param {Scene} scene @param {number | null} margin_m */
export const withMargin = (scene, margin_m) => ({ ...scene, fence: scene.fence ? { ...scene.fence, margin_m } : null });

/** @param {Zone} zone @returns {zone is PolygonZone} */
export const isPolygon = (zone) => "corners" in zone;

/** The first name that no zone has: A to Z, then A1. @param {Zone[]} zones */
export function freeName(zones) {
  for (let i = 0; ; i++) {
    const name = String.fromCharCode(65 + (i % 26)) + (i < 26 ? "" : String(Math.floor(i / 26)));
    if (zones.every((zone) => zone.name !== name)) return name;
  }
}

/**
 * Where the handle is that moves a zone: in the middle of a circle to stay out of, otherwise on the boundary, since the
 * path and the circle are inside; of a polygon, in the middle of its northernmost edge.
 *
 * @param {Zone} zone
 * @returns {[number, number]}
 */
export function anchorOf(zone) {
  if (!isPolygon(zone)) return [zone.east_m - (zone.inclusion ? zone.radius_m : 0), zone.north_m];
  const middles = zone.corners.map(([x, y], i) => {
    const [nextX, nextY] = zone.corners[(i + 1) % zone.corners.length];
    return /** @type {[number, number]} */ ([(x + nextX) / 2, (y + nextY) / 2]);
  });
  return middles.reduce((best, middle) => (middle[1] > best[1] ? middle : best));
}

/** A zone that is moved. @param {Zone} zone @param {number} east metres @param {number} north @returns {Zone} */
export function movedZone(zone, east, north) {
  if (!isPolygon(zone)) return { ...zone, east_m: zone.east_m + east, north_m: zone.north_m + north };
  return { ...zone, corners: zone.corners.map(([x, y]) => [x + east, y + north]) };
}

/** A polygon with one more corner, in the middle of its longest edge. @param {PolygonZone} zone @returns {PolygonZone} */
export function withCornerMore(zone) {
  const { corners } = zone;
  const next = (/** @type {number} */ i) => corners[(i + 1) % corners.length];
  const lengths = corners.map(([x, y], i) => Math.hypot(next(i)[0] - x, next(i)[1] - y));
  const i = lengths.indexOf(Math.max(...lengths));
  /** @type {[number, number]} */
  const middle = [(corners[i][0] + next(i)[0]) / 2, (corners[i][1] + next(i)[1]) / 2];
  return { ...zone, corners: [...corners.slice(0, i + 1), middle, ...corners.slice(i + 1)] };
}

export const LEAST_CORNERS = 3;

/** A polygon without a corner, by default the last one; a triangle stays. @param {PolygonZone} zone @param {number} [k] @returns {PolygonZone} */
export function withoutCorner(zone, k = zone.corners.length - 1) {
  return zone.corners.length > LEAST_CORNERS ? { ...zone, corners: zone.corners.filter((_, i) => i !== k) } : zone;
}

/** Where the handles of zones are, but for those of radii. @param {Scene} scene */
export const zoneHandles = (scene) => zonesOf(scene).flatMap((zone) => [anchorOf(zone), ...(isPolygon(zone) ? zone.corners : [])]);

/** Points that enclose all zones of a scene. @param {Scene} scene @returns {[number, number][]} */
export const zonePoints = (scene) =>
  zonesOf(scene).flatMap((zone) => {
    if (isPolygon(zone)) return zone.corners;
    const { east_m, north_m, radius_m } = zone;
    return /** @type {[number, number][]} */ ([
      [east_m - radius_m, north_m - radius_m],
      [east_m + radius_m, north_m + radius_m],
    ]);
  });
