// @ts-check
/**
 * Asking again a service that does not answer: a bounded number of times, each time after a longer wait.
 */

/** Seconds before each attempt: two minutes in all. */
export const WAITS_S = [1, 2, 4, 8, 15, 30, 30, 30];

const LONGEST_S = 60; // what a service that is busy may ask for

/**
 * @typedef {object} Attempt
 * @property {number} wait_s  until it is made
 * @property {number} number  from 1
 * @property {number} of  how many there are
 */

/** @param {() => void} again  makes an attempt */
export function retrying(again) {
  let made = 0;
  let timer = 0;
  /** @type {Attempt | null} */
  let next = null;

  function attempt() {
    [timer, next] = [0, null];
    made += 1;
    again();
  }

  return {
    /**
     * Plan the next attempt, unless one is planned already.
     *
     * @param {number} [least_s]  what the service asked for
     * @returns {Attempt | null} null where no attempt is left
     */
    plan(least_s = 0) {
      if (timer === 0 && made < WAITS_S.length) {
        const wait_s = Math.max(WAITS_S[made], Math.min(least_s, LONGEST_S));
        next = { wait_s, number: made + 1, of: WAITS_S.length };
        timer = window.setTimeout(attempt, 1000 * wait_s);
      }
      return next;
    },
    /** Ask at once, and begin to count anew. */
    now() {
      this.stop();
      again();
    },
    /** The service has answered: no attempt is needed now, but it counts those that were made. */
    rest() {
      clearTimeout(timer);
      [timer, next] = [0, null];
    },
    /** The service has answered everything. */
    stop() {
      this.rest();
      made = 0;
    },
  };
}
