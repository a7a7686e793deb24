// @ts-check
/**
 * Reading a sampled maneuver: its pieces, and where it is at a time.
 *
 * @typedef {import("./types.js").Track} Track
 * @typedef {import("./types.js").Maneuver} Maneuver
 * @typedef {import("./types.js").Letter} Letter
 * @typedef {import("./types.js").Answer} Answer
 * @typedef {import("./types.js").Alternative} Alternative
 * @typedef {{east_m: number, north_m: number, heading_deg: number, x: number, y: number}} Instant
 */

/**
 * The index of the last sample at or before a time, at most the last but one.
 *
 * @param {number[]} times
 * @param {number} time
 */
export function before(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

/**
 * The values of a series at a time, linear between its samples; beyond its ends those of the ends.
 *
 * @param {number[]} times
 * @param {number} time
 * @returns {(values: number[]) => number}
 */
export function reading(times, time) {
  const i = before(times, time);
  const j = Math.min(i + 1, times.length - 1);
  const width = times[j] - times[i];
  const share = width > 0 ? Math.min(1, Math.max(0, (time - times[i]) / width)) : 0;
  return (values) => values[i] + share * (values[j] - values[i]);
}

/**
 * Where a maneuver is at a time.
 *
 * @param {Track} track
 * @param {number} time
 * @returns {Instant}
 */
export function at(track, time) {
  const read = reading(track.time_s, time);
  const { east_m, north_m, heading_deg, x, y } = track;
  const from = heading_deg[before(track.time_s, time)];
  // Headings nearest to the first, so that none is read across north the long way round.
  const unwound = heading_deg.map((heading) => from + ((((heading - from) % 360) + 540) % 360) - 180);
  return { east_m: read(east_m), north_m: read(north_m), heading_deg: read(unwound), x: read(x), y: read(y) };
}

/**
 * The samples of each piece, both ends included.
 *
 * @param {Maneuver} maneuver
 * @returns {{letter: Letter, indices: number[]}[]}
 */
export function pieces(maneuver) {
  const times = maneuver.track.time_s;
  // Times of samples and of switches are sums of the same durations and differ by rounding.
  const near = 1e-9 * (1 + maneuver.duration_s);
  return maneuver.segments.map(({ letter, start_s, duration_s }) => {
    const end_s = start_s + duration_s;
    return { letter, indices: times.flatMap((t, i) => (t >= start_s - near && t <= end_s + near ? [i] : [])) };
  });
}

/**
 * The optimal maneuvers of an answer, and the others.
 *
 * @param {Answer} answer
 * @returns {{best: Maneuver[], others: Alternative[]}}
 */
export function sorted(answer) {
  const { alternatives, optimal } = answer;
  return { best: [answer, ...alternatives.slice(0, optimal - 1)], others: alternatives.slice(optimal - 1) };
}
