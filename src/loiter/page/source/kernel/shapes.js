// @ts-nocheck
// What the checks of fences have of shapely in Python: outlines that cross themselves, points within them, distances.
import { Mask, Vector, filled } from "./numpy.js";

/** A polygon by its corners, and whether points are within it. */
export const shapely = {
  Polygon: (corners) => ({ corners: Array.from(corners, ([x, y]) => [x, y]) }),
  prepare() {},
  /** Whether a polygon contains points or, of several polygons, which of them contain a point. */
  contains_xy(polygon, x, y) {
    if (Array.isArray(polygon)) return filled([polygon.length], (i) => Number(contains(polygon[i], x, y)), Mask);
    return x instanceof Vector ? filled(x.shape, (i) => Number(contains(polygon, x[i], y[i])), Mask) : contains(polygon, x, y);
  },
};

/** The edges of an outline, from corner to corner. */
const edgesOf = (corners) => corners.map((corner, i) => [corner, corners[(i + 1) % corners.length]]);

/** Whether a point is within an outline: a ray to the east crosses it an odd number of times. */
function contains({ corners }, x, y) {
  let is = false;
  for (const [[ax, ay], [bx, by]] of edgesOf(corners)) if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) is = !is;
  return is;
}

/** On which side of the line from a to b a point is: positive on the left, 0 on the line. */
const sideOf = ([ax, ay], [bx, by], [x, y]) => (bx - ax) * (y - ay) - (by - ay) * (x - ax);

const isWithin = ([ax, ay], [bx, by], [x, y]) =>
  x >= Math.min(ax, bx) && x <= Math.max(ax, bx) && y >= Math.min(ay, by) && y <= Math.max(ay, by);

/** A point that two edges have in common, or null. */
function commonPoint([a, b], [c, d]) {
  const [sa, sb, sc, sd] = [sideOf(c, d, a), sideOf(c, d, b), sideOf(a, b, c), sideOf(a, b, d)];
  if (sa * sb < 0 && sc * sd < 0) return [0, 1].map((i) => a[i] + (sa / (sa - sb)) * (b[i] - a[i]));
  const ends = [
    [a, c, d, sa],
    [b, c, d, sb],
    [c, a, b, sc],
    [d, a, b, sd],
  ];
  return ends.find(([point, from, to, side]) => side === 0 && isWithin(from, to, point))?.[0] ?? null;
}

/** `loiter.fences.model._invalidity`: why an outline bounds no area, in words; empty if it does. */
export function invalidity({ corners }) {
  const [first, second] = corners;
  if (corners.every((corner) => sideOf(first, second, corner) === 0)) return "has corners on one line: it has no area";
  const edges = edgesOf(corners);
  for (let i = 0; i < edges.length; i++)
    for (let j = i + 1; j < edges.length; j++) {
      const point = j === i + 1 ? folded(edges[i], edges[j]) : i === 0 && j === edges.length - 1 ? folded(edges[j], edges[i]) : commonPoint(edges[i], edges[j]);
      if (point) return `crosses or touches itself at ${point[0].toFixed(1)} m east, ${point[1].toFixed(1)} m north`;
    }
  return "";
}

/** The end of the shorter of two edges that meet, where they lie on each other; otherwise null. */
function folded([a, b], [, c]) {
  const goesBack = (a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]) > 0;
  if (sideOf(a, b, c) !== 0 || !goesBack) return null;
  return isWithin(a, b, c) ? c : a;
}

/** `loiter.fences.model._gap_m`: the distance between two zones; zero or less where they have a common point. */
export function gap_m(...zones) {
  const [one, other] = zones.map((zone) => (zone.corners ? zone._polygon : { corners: [[zone.east_m, zone.north_m]] }));
  const radii = zones.reduce((total, { radius_m = 0 }) => total + radius_m, 0);
  const isInside = [one, other].some((shape, i) => shape.corners.length > 2 && contains(shape, ...[other, one][i].corners[0]));
  const apart = (from, to) => from.corners.flatMap((point) => edgesOf(to.corners).map((edge) => distance(point, edge)));
  const crosses = edgesOf(one.corners).some((edge) => edgesOf(other.corners).some((edge2) => commonPoint(edge, edge2)));
  return (isInside || crosses ? 0 : Math.min(...apart(one, other), ...apart(other, one))) - radii;
}

/** The distance of a point from an edge. */
function distance([x, y], [[ax, ay], [bx, by]]) {
  const square = (bx - ax) ** 2 + (by - ay) ** 2;
  const share = square === 0 ? 0 : Math.min(1, Math.max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / square));
  return Math.hypot(ax + share * (bx - ax) - x, ay + share * (by - ay) - y);
}
