// @ts-check
/**
 * @typedef {import("../state/page_state.js").Fault} Fault
 * @typedef {import("./retry.js").Retries} Retries
 */
import { Unreachable } from "./problems.js";

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
