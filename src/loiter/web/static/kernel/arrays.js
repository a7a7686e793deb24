// @ts-nocheck
// What the translated library has elsewhere in Python: NumPy's ufuncs of the kernel, and checks of argument types.
import { InvalidArgument } from "./errors.js";
import { ABSENT, Word, encode as encoded, fly, reduce as reduced } from "./kernel.js";
import { heading_vector } from "./library.js";
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
export function reduce(east_m, north_m, heading_deg, orbit, aircraft) {
  const r = aircraft.turn_radius_m;
  const state = (east, north, heading) =>
    reduced((east - orbit.east_m) / r, (north - orbit.north_m) / r, ...heading_vector(heading));
  return elementwise(state)(east_m, north_m, heading_deg);
}

/** `loiter.kernel.words.encode`, whose controls may be fewer than three. */
export const encode = (u1, u2 = ABSENT, u3 = ABSENT) => encoded(u1, u2, u3);

/** `loiter.verify.trajectory.word_of`. */
export const word_of = (maneuver) => Word[maneuver.word || "EMPTY"];
