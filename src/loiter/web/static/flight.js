// @ts-check
/**
 * The clock of the ghost that flies the plan.
 */

/** Playing speeds, times real time. */
export const SPEEDS = [1, 2, 5, 10, 20, 50, 100];

const REST_S = 1.2; // how long the ghost rests at the end before it starts anew

/**
 * The slowest speed that flies a plan within some ten seconds.
 *
 * @param {number} duration_s
 */
export function speedFor(duration_s) {
  return SPEEDS.find((speed) => duration_s / speed <= 10) ?? SPEEDS[SPEEDS.length - 1];
}

/**
 * @param {() => number} duration  of the plan, seconds
 * @param {(time_s: number) => void} show
 */
export function clock(duration, show) {
  let time = 0;
  let speed = 1;
  let playing = false;
  let last = 0;
  let rested = 0;
  /** @param {number} now milliseconds */
  function tick(now) {
    if (!playing) return;
    const passed = Math.min(0.1, (now - last) / 1000);
    last = now;
    const end = duration();
    if (time >= end) {
      rested += passed;
      if (rested >= REST_S) [time, rested] = [0, 0];
    } else time = Math.min(end, time + speed * passed);
    show(time);
    requestAnimationFrame(tick);
  }
  return {
    time: () => Math.min(time, duration()),
    playing: () => playing,
    /** @param {boolean} on */
    play(on) {
      if (on === playing) return;
      playing = on;
      if (!on) return;
      if (time >= duration()) time = 0;
      [last, rested] = [performance.now(), 0];
      requestAnimationFrame(tick);
    },
    /** @param {number} to seconds */
    seek(to) {
      time = Math.min(duration(), Math.max(0, to));
      show(time);
    },
    /** @param {number} times */
    setSpeed(times) {
      speed = times;
    },
  };
}
