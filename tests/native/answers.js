// What the tests ask of the kernel in JavaScript, in Node and in a browser: rows of numbers to rows of numbers.

/** Status, side, word, durations, miss, least time, first control and adjoint of a state in still air. */
export function inStillAir(kernel, [x, y, given, side, tolerance]) {
  const status = kernel.synthesis_status_of(x, y, given, tolerance);
  if (status !== 0) return [status, 0, 0, NaN, NaN, NaN, NaN, NaN, NaN, NaN, NaN, NaN];
  const R = kernel.rounded_radius(given);
  const best = kernel.optimum(x, y, R, side, tolerance);
  const least = kernel.least_time(x, y, R, kernel.side_or_near(y, side), tolerance);
  const { lam, psi1, psi2 } = kernel.adjoint(x, y, R, best);
  const { t1, t2, t3 } = best;
  const miss = kernel.miss(x, y, R, best);
  return [0, best.side, best.word, t1, t2, t3, miss, least, kernel.first_control(R, best), lam, psi1, psi2];
}

/** Every number of a maneuver in wind. */
export function inWind(kernel, [x, y, c, s, R, side, wx, wy, tolerance]) {
  return Object.values(kernel.wind_search_fastest({ x, y, c, s, R, side, wx, wy, tolerance }));
}

/** The numbers of several maneuvers, one after the other. */
const flat = (maneuvers) => maneuvers.flatMap((maneuver) => Object.values(maneuver));

/** Every extremal in still air, then those that tie for the fastest. */
export function rankedInStillAir(kernel, [x, y, R, side, tolerance]) {
  if (kernel.synthesis_status_of(x, y, R, tolerance) !== 0) return [];
  const state = [x, y, kernel.rounded_radius(R), side, tolerance];
  return [...flat(kernel.synthesis_ranked(...state)), ...flat(kernel.synthesis_optima(...state))];
}

/** Every local minimum in wind, then those that tie for the fastest. */
export function rankedInWind(kernel, [x, y, c, s, R, side, wx, wy, tolerance]) {
  const problem = { x, y, c, s, R, side, wx, wy, tolerance };
  return [...flat(kernel.wind_search_ranked(problem)), ...flat(kernel.wind_search_optima(problem))];
}

/** Points of the synthesis and of a path: curves, the paper's region, the flow and the hold. */
export function around(kernel, [x, y, R, side, t]) {
  const u = side;
  return [
    kernel.switching_abscissa(y, R),
    kernel.last_arc_abscissa(y),
    kernel.region(x, Math.abs(y)),
    ...kernel.fly(x, y, 0.6, 0.8, u, t),
    ...kernel.flow(x, y, u, t),
    ...kernel.turn_adjoint(x, y, u, t),
    ...kernel.hold_pose(t, side || 1, R, 0.3 / R, -0.2),
    kernel.hold_rate(t, side || 1, R, 0.3 / R, -0.2),
    kernel.phase_of(x, y, side || 1, 0.3 / R, -0.2),
  ];
}
