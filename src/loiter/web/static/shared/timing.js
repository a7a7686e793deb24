// @ts-check

/** Milliseconds without a change after which a drag counts as paused. */
export const PAUSE_MS = 140;

/**
 * A function that calls `act` once, when it has not been called for some time.
 *
 * @param {number} wait_ms
 * @param {() => void} act
 */
export function debounced(wait_ms, act) {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = window.setTimeout(act, wait_ms);
  };
}
