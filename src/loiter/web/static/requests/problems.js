// @ts-check
/** Errors of the service. */

/** A refusal, with the sentence of the service. */
export class Problem extends Error {
  /**
   * @param {string} sentence
   * @param {string} [kind]  the last part of the problem's type: "radius-too-small"
   * @param {string[]} [places]  the parts of the request that it refuses: "aircraft/airspeed_m_s"
   */
  constructor(sentence, kind = "", places = []) {
    super(sentence);
    this.kind = kind;
    this.places = places;
  }
}

/** The service does not answer now, but may later. */
export class Unreachable extends Problem {
  /**
   * @param {string} headline
   * @param {string} sentence
   * @param {number} [wait_s]  how long it asks clients to wait
   */
  constructor(headline, sentence, wait_s = 0) {
    super(sentence);
    this.headline = headline;
    this.wait_s = wait_s;
  }
}

// Too many requests; and what a proxy or the service answers when it is absent or too busy.
const TEMPORARY = [429, 502, 503, 504];

/**
 * The error in a response: a problem document (RFC 9457), whose `detail` is a sentence for the user.
 *
 * @param {Response} response
 */
export async function problemOf(response) {
  const { type = "", title, detail, errors = [] } = await response.json().catch(() => ({}));
  const places = errors.flatMap((/** @type {{pointer?: string}} */ { pointer }) => pointer?.replace("#/", "") ?? []);
  const sentence = detail ?? title ?? `The service answered ${response.status}.`;
  if (TEMPORARY.includes(response.status)) return new Unreachable("The service is busy", sentence, waitOf(response));
  return new Problem(sentence, type.slice(type.lastIndexOf(":") + 1), places);
}

/** The seconds that a response asks clients to wait; 0 if it names a date instead. @param {Response} response */
const waitOf = (response) => Number(response.headers.get("Retry-After")) || 0;
