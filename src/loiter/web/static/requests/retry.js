// @ts-check
/**
 * Retries for a service that does not answer: a limited number, with growing waits.
 *
 * @typedef {import("../state/page_state.js").Fault} Fault
 */
import { Unreachable } from "./api.js";

/** Seconds before each attempt: two minutes in total. */
const WAITS_S = [1, 2, 4, 8, 15, 30, 30, 30];

const LONGEST_S = 60; // longest wait that a busy service may demand

/**
 * @typedef {object} Attempt
 * @property {number} wait_s  until it is made
 * @property {number} number  from 1
 * @property {number} of  how many attempts there are
 *
 * @typedef {object} Retries
 * @property {(least_s: number) => Attempt | null} plan  plan an attempt, unless one is planned; null if none is left
 * @property {() => void} now  make an attempt at once, and count from the beginning
 * @property {() => void} cancel  drop the planned attempt, because the service has answered; keep the count
 * @property {() => void} reset  reset the count, because the service has answered everything
 */

/**
 * @param {() => void} ask  makes an attempt
 * @returns {Retries}
 */
export function createRetries(ask) {
  let made = 0;
  /** @type {{attempt: Attempt, timer: number} | null} */
  let planned = null;

  function run() {
    planned = null;
    made += 1;
    ask();
  }
  function cancel() {
    clearTimeout(planned?.timer);
    planned = null;
  }
  function reset() {
    cancel();
    made = 0;
  }
  return {
    plan(least_s) {
      const attempt = attemptAfter(made, least_s);
      if (!planned && attempt) planned = { attempt, timer: window.setTimeout(run, 1000 * attempt.wait_s) };
      return planned?.attempt ?? null;
    },
    now() {
      reset();
      ask();
    },
    cancel,
    reset,
  };
}

/**
 * @param {number} made  how many attempts were made
 * @param {number} least_s  wait that the service demands
 * @returns {Attempt | null}
 */
function attemptAfter(made, least_s) {
  if (made >= WAITS_S.length) return null;
  return { wait_s: Math.max(WAITS_S[made], Math.min(least_s, LONGEST_S)), number: made + 1, of: WAITS_S.length };
}

/**
 * The reason why a certificate or a map is missing. If the service does not answer, the next attempt is planned.
 *
 * @param {Error} error
 * @param {Retries} retries
 * @param {string} consequence  first words of the sentence
 * @returns {Fault}
 */
export function faultOf(error, retries, consequence) {
  if (!(error instanceof Unreachable)) return { sentence: `${consequence}: ${error.message}`, temporary: false };
  const attempt = retries.plan(error.wait_s);
  const next = attempt ? ` Retrying in ${attempt.wait_s} s.` : "";
  return { sentence: `${consequence}: ${error.headline}.${next}`, temporary: true };
}
