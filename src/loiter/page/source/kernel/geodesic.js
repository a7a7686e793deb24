// @ts-nocheck
// Geodesics of WGS84, after T. Vincenty, Direct and inverse solutions of geodesics on the ellipsoid, Survey Review 23
// (1975): to a micrometre over the 100 km that the library takes (its own are those of pyproj).
import { elementwise } from "./python.js";

const [A, F, DEGREE, REACH_M, ROUNDS] = [6378137, 1 / 298.257223563, Math.PI / 180, 100_000, 20];
const B = A * (1 - F);

/** What both problems share: the series in the third flattening, for the cosine squared of the azimuth at the equator. */
function series(cos2) {
  const u2 = (cos2 * (A * A - B * B)) / (B * B);
  return {
    a: 1 + (u2 / 16384) * (4096 + u2 * (-768 + u2 * (320 - 175 * u2))),
    b: (u2 / 1024) * (256 + u2 * (-128 + u2 * (74 - 47 * u2))),
    c: (F / 16) * cos2 * (4 + F * (4 - 3 * cos2)),
  };
}
function arcCorrection(b, sigma, middle) {
  const [s, c] = [Math.sin(sigma), Math.cos(sigma)];
  const m2 = middle * middle;
  return b * s * (middle + (b / 4) * (c * (2 * m2 - 1) - (b / 6) * middle * (4 * s * s - 3) * (4 * m2 - 3)));
}
const longitudeCorrection = (c, sine, sigma, middle) =>
  (1 - c) * F * sine * (sigma + c * Math.sin(sigma) * (middle + c * Math.cos(sigma) * (2 * middle * middle - 1)));
const reducedLatitude = (degrees) => Math.atan2((1 - F) * Math.sin(degrees * DEGREE), Math.cos(degrees * DEGREE));
const shortest = (degrees) => degrees - 360 * Math.floor(degrees / 360 + 0.5);

/** Distance, and azimuths (radians) at both ends, from one place to another that is near. */
function inverse(lat1, lon1, lat2, lon2) {
  const [u1, u2, difference] = [reducedLatitude(lat1), reducedLatitude(lat2), shortest(lon2 - lon1) * DEGREE];
  const [s1, c1, s2, c2] = [Math.sin(u1), Math.cos(u1), Math.sin(u2), Math.cos(u2)];
  let [lambda, sigma, cos2, middle] = [difference, 0, 1, 0];
  for (let round = 0; round < ROUNDS; round++) {
    // c1 s2 - s1 c2 cos(lambda), without cancellation where the places are near.
    const along = Math.sin(u2 - u1) + 2 * s1 * c2 * Math.sin(lambda / 2) ** 2;
    const sine = Math.hypot(c2 * Math.sin(lambda), along);
    if (sine === 0) return { distance: 0, out: Math.PI, arrival: Math.PI };
    const cosine = s1 * s2 + c1 * c2 * Math.cos(lambda);
    sigma = Math.atan2(sine, cosine);
    const sinAzimuth = (c1 * c2 * Math.sin(lambda)) / sine;
    cos2 = 1 - sinAzimuth * sinAzimuth;
    middle = cos2 > 0 ? cosine - (2 * s1 * s2) / cos2 : 0;
    const next = difference + longitudeCorrection(series(cos2).c, sinAzimuth, sigma, middle);
    if (next === lambda) break;
    lambda = next;
  }
  const { a, b } = series(cos2);
  const turned = 2 * Math.sin(lambda / 2) ** 2;
  return {
    distance: B * a * (sigma - arcCorrection(b, sigma, middle)),
    out: Math.atan2(c2 * Math.sin(lambda), Math.sin(u2 - u1) + s1 * c2 * turned),
    arrival: Math.atan2(c1 * Math.sin(lambda), Math.sin(u2 - u1) - c1 * s2 * turned),
  };
}

/** Latitude and longitude, degrees, at a distance along an azimuth (radians). */
function direct(lat, lon, azimuth, distance) {
  const u1 = reducedLatitude(lat);
  const [s1, c1, sa, ca] = [Math.sin(u1), Math.cos(u1), Math.sin(azimuth), Math.cos(azimuth)];
  const sinAzimuth = c1 * sa;
  const { a, b, c } = series(1 - sinAzimuth * sinAzimuth);
  const start = Math.atan2(s1, c1 * ca);
  const flat = distance / (B * a);
  let [sigma, middle] = [flat, 1];
  for (let round = 0; round < ROUNDS; round++) {
    middle = Math.cos(2 * start + sigma);
    const next = flat + arcCorrection(b, sigma, middle);
    if (next === sigma) break;
    sigma = next;
  }
  const [s, k] = [Math.sin(sigma), Math.cos(sigma)];
  const lambda = Math.atan2(s * sa, c1 * k - s1 * s * ca);
  const north = Math.atan2(s1 * k + c1 * s * ca, (1 - F) * Math.hypot(sinAzimuth, s1 * s - c1 * k * ca));
  return [north / DEGREE, shortest(lon + (lambda - longitudeCorrection(c, sinAzimuth, sigma, middle)) / DEGREE)];
}

/** `loiter.geo.frame.to_plane`: east and north, metres, and the convergence, degrees. */
export const to_plane = elementwise((lat0, lon0, lat, lon) => {
  const { distance, out, arrival } = inverse(lat0, lon0, lat, lon);
  if (!(distance <= REACH_M) || !(Math.abs(lat) <= 90)) return [NaN, NaN, NaN];
  return [distance * Math.sin(out), distance * Math.cos(out), shortest((out - arrival) / DEGREE)];
});

/** `loiter.geo.frame.from_plane`: latitude and longitude, degrees. */
export const from_plane = elementwise((lat0, lon0, east, north) => {
  const distance = Math.hypot(east, north);
  return distance <= REACH_M ? direct(lat0, lon0, Math.atan2(east, north), distance) : [NaN, NaN];
});
