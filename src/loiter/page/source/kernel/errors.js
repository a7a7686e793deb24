// @ts-nocheck
// The library's errors (`loiter.errors`), each with one sentence.

/** An error that the library raises on purpose; `kind` tells the page what it is. */
export class LoiterError extends Error {
  kind = "refused";
}

const simple = (kind) => (sentence) => Object.assign(new LoiterError(sentence), { kind });
export const [WindTooStrong, NotConverged, OutOfRange] = ["wind-too-strong", "not-converged", "out-of-range"].map(simple);
export const InvalidArgument = (argument, problem) =>
  Object.assign(new LoiterError(`${argument} ${problem}`), { kind: "invalid-argument", argument, problem });
export const RadiusTooSmall = (sentence, fitted_radius_m) =>
  Object.assign(new LoiterError(sentence), { kind: "radius-too-small", fitted_radius_m });
