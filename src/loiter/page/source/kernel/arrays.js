// @ts-nocheck
// What the translated library has elsewhere in Python: NumPy's ufuncs of the kernel, and checks of argument types.
import { InvalidArgument } from "./errors.js";
import {
  ABSENT,
  Side,
  Status,
  Word,
  encode as encoded,
  fly,
  least_time,
  optimum,
  path_to_pose as first_path_to_pose,
  reduce as reduced,
  rounded_radius,
  set_of,
  side_or_near,
  synthesis_status_of as status_of,
  wind_search_fastest,
} from "./kernel.js";
import { elementwise, str } from "./python.js";

/** `loiter.errors.instance` and `in_unit`: the page makes no values of other classes. */
export const unchecked = () => {};
export const same = (value) => value;

/** `loiter.errors._refuse`. */
export function refuse(argument, value, need) {
  throw InvalidArgument(argument, `is ${str(value)}: it must be ${need}`);
}

/** `loiter.planning.flight._fly_arrays`. */
export const fly_arrays = () => elementwise(fly);

/** `loiter.arrays.reduce`: reduced states of positions and headings, in turn radii. */
export const reducer = (heading_vector) =>
  function (east_m, north_m, heading_deg, orbit, aircraft) {
    const r = aircraft.turn_radius_m;
    const state = (east, north, heading) =>
      reduced((east - orbit.east_m) / r, (north - orbit.north_m) / r, ...heading_vector(heading));
    return elementwise(state)(east_m, north_m, heading_deg);
  };

/** `loiter.kernel.motion.reduce`, of arrays too. */
export const reduce_states = elementwise(reduced);

const SIDES = { cw: Side.CW, ccw: Side.CCW, either: Side.EITHER };

/** `loiter.arrays.min_time`: the least times from reduced states. */
export const min_time = (x, y, radius, turn) =>
  elementwise((a, b) => (status_of(a, b, radius, 0) === Status.OK ? least_time(a, b, rounded_radius(radius), side_or_near(b, SIDES[turn]), 0) : NaN))(x, y);

/** `loiter.arrays.min_time_in_wind`; `angle` is the direction of the heading. */
export const min_time_in_wind = (x, y, angle, radius, turn, wind_x, wind_y) =>
  elementwise(function (a, b, heading) {
    const problem = { x: a, y: b, c: Math.cos(heading), s: Math.sin(heading), R: radius, side: SIDES[turn], wx: wind_x, wy: wind_y, tolerance: 0 };
    const { t1, t2, t3 } = wind_search_fastest(problem);
    return t1 + t2 + t3;
  })(x, y, angle);

/** `loiter.fences.airs._optima`: word, three durations and side of the fastest entries from arrays of reduced states. */
const infinite = [0, Infinity, Infinity, Infinity, 0];
export const optima = elementwise(function (x, y, radius, side) {
  if (status_of(x, y, radius, 0) !== Status.OK) return infinite;
  const { word, t1, t2, t3, side: held } = optimum(x, y, rounded_radius(radius), side, 0);
  return [word, t1, t2, t3, held];
});

/** `loiter.fences.airs._optima_in_wind`. */
export const optima_in_wind = elementwise(function (x, y, c, s, R, side, wx, wy) {
  const { status, word, t1, t2, t3, side: held } = wind_search_fastest({ x, y, c, s, R, side, wx, wy, tolerance: 0 });
  return status === Status.OK ? [word, t1, t2, t3, held] : infinite;
});

/** `loiter.compiled.ufuncs.path_to_pose`, of arrays of words and poses. */
const durations = elementwise(function (word, ...numbers) {
  const { time, t1, t2, t3 } = first_path_to_pose(set_of(word), ...numbers);
  return [time < Infinity ? t1 : Infinity, t2, t3];
});
export const path_to_pose = (words, ...numbers) => (words.length ? durations(words, ...numbers) : [words, words, words]);

/** `loiter.fences.taut.least_length_m`: a bound that needs shapely, and is none here. */
export const no_length = () => 0;

/** `loiter.kernel.words.encode`, whose controls may be fewer than three. */
export const encode = (u1, u2 = ABSENT, u3 = ABSENT) => encoded(u1, u2, u3);

/** `loiter.certificate.trajectory.word_of`. */
export const word_of = (maneuver) => Word[maneuver.word || "EMPTY"];

/** The nodes and weights of Gauss's quadrature, `numpy.polynomial.legendre.leggauss(8)`. */
const [HALF, WEIGHT] = [[0.18343464249564978, 0.525532409916329, 0.7966664774136267, 0.9602898564975362], [0.36268378337836166, 0.3137066458778869, 0.22238103445337443, 0.10122853629037706]];
export const NODES = [...HALF.map((one) => -one), ...HALF];
export const WEIGHTS = [...WEIGHT, ...WEIGHT];
