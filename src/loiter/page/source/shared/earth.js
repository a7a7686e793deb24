// @ts-check
/**
 * WGS84 latitude and longitude to metres east and north of an origin and back: the azimuthal equidistant plane of the
 * library (`loiter.geo`), to a millimetre within 10 km and a decimetre within 100 km.
 *
 * @import {Origin} from "./types.js"
 */
import { DEGREE } from "./geometry.js";

const SEMI_MAJOR_M = 6378137;
const ECCENTRICITY2 = 0.00669437999014;

/** How far from the origin places may lie, metres: the limit of the library. */
export const REACH_M = 100_000;

/** The radii of curvature at a latitude, metres: along the meridian, and across it. @param {number} latitude_deg */
function curvatureRadii(latitude_deg) {
  const w2 = 1 - ECCENTRICITY2 * Math.sin(latitude_deg * DEGREE) ** 2;
  const across = SEMI_MAJOR_M / Math.sqrt(w2);
  return { along: (across * (1 - ECCENTRICITY2)) / w2, across };
}

/** Geocentric coordinates of a place on the ellipsoid, metres. @param {Origin} place */
function geocentric({ latitude_deg, longitude_deg }) {
  const { across } = curvatureRadii(latitude_deg);
  const [latitude, longitude] = [latitude_deg * DEGREE, longitude_deg * DEGREE];
  const fromAxis = across * Math.cos(latitude);
  const z = across * (1 - ECCENTRICITY2) * Math.sin(latitude);
  return [fromAxis * Math.cos(longitude), fromAxis * Math.sin(longitude), z];
}

/** Metres east and north of an origin. @param {Origin} origin @param {Origin} place @returns {[number, number]} */
export function toLocal(origin, place) {
  const [latitude, longitude] = [origin.latitude_deg * DEGREE, origin.longitude_deg * DEGREE];
  const start = geocentric(origin);
  const [x, y, z] = geocentric(place).map((value, i) => value - start[i]);
  const outwards = Math.cos(longitude) * x + Math.sin(longitude) * y;
  const east = Math.cos(longitude) * y - Math.sin(longitude) * x;
  const north = Math.cos(latitude) * z - Math.sin(latitude) * outwards;
  const flat = Math.hypot(east, north);
  if (flat === 0) return [0, 0];
  // The arc over a chord, on a circle with the ellipsoid's curvature in this direction (Euler).
  const { along, across } = curvatureRadii(origin.latitude_deg);
  const curvature = (north / flat) ** 2 / along + (east / flat) ** 2 / across;
  const half = (Math.hypot(x, y, z) * curvature) / 2;
  const arc = half < 1 ? (2 * Math.asin(half)) / curvature : Math.PI / curvature;
  return [(east / flat) * arc, (north / flat) * arc];
}

const ROUNDS = 6; // each leaves less than a tenth of the error within 100 km

/**
 * The place at metres east and north of an origin.
 *
 * @param {Origin} origin
 * @param {number} east_m
 * @param {number} north_m
 * @returns {Origin}
 */
export function toPlace(origin, east_m, north_m) {
  let place = origin;
  for (let round = 0; round < ROUNDS; round++) {
    const [east, north] = toLocal(origin, place);
    place = moved(place, east_m - east, north_m - north);
  }
  return place;
}

/**
 * The origin from which a place has these metres east and north.
 *
 * @param {Origin} place
 * @param {number} east_m
 * @param {number} north_m
 * @returns {Origin}
 */
export function originFor(place, east_m, north_m) {
  let origin = place;
  for (let round = 0; round < ROUNDS; round++) {
    const [east, north] = toLocal(origin, place);
    origin = moved(origin, east - east_m, north - north_m);
  }
  return origin;
}

/** A place a few metres on: exact only in the limit. @param {Origin} place @param {number} east @param {number} north */
function moved({ latitude_deg, longitude_deg }, east, north) {
  const { along, across } = curvatureRadii(latitude_deg);
  const shrink = Math.max(1e-6, Math.cos(latitude_deg * DEGREE));
  return {
    latitude_deg: Math.min(90, Math.max(-90, latitude_deg + north / along / DEGREE)),
    longitude_deg: longitude_deg + east / (across * shrink) / DEGREE,
  };
}
