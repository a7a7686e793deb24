// @ts-check
/**
 * Requests to the service. Its errors are problem documents (RFC 9457), whose `detail` is a sentence for a person.
 *
 * @typedef {import("./types.js").Scene} Scene
 */

/** What went wrong, in the service's sentence. */
export class Problem extends Error {}

/**
 * @param {string} path
 * @param {object} body
 * @returns {Promise<Response>}
 */
export async function post(path, body) {
  return checked(
    fetch(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) }),
  );
}

/**
 * @param {string} path
 * @returns {Promise<Response>}
 */
export async function get(path) {
  return checked(fetch(path));
}

/**
 * @param {Promise<Response>} asked
 * @returns {Promise<Response>}
 */
async function checked(asked) {
  const response = await asked.catch(() => {
    throw new Problem("The service does not answer; is loiter serve still running?");
  });
  if (!response.ok) throw new Problem(await sentence(response));
  return response;
}

/** @param {Response} response */
async function sentence(response) {
  const document = await response.json().catch(() => ({}));
  return document.detail ?? document.title ?? `The service answered ${response.status}.`;
}

/**
 * A queue of one: while a request is under way only the latest of those that follow waits. So the service never works on
 * more than one state of a drag, and the last one is always answered.
 *
 * @template A, B
 * @param {(asked: A) => Promise<B>} request
 * @param {(answer: B, asked: A) => void} done
 * @param {(error: Error, asked: A) => void} failed
 * @returns {(asked: A) => void}
 */
export function latest(request, done, failed) {
  let busy = false;
  /** @type {{asked: A} | null} */
  let waiting = null;
  /** @param {A} asked */
  async function run(asked) {
    busy = true;
    try {
      done(await request(asked), asked);
    } catch (error) {
      failed(/** @type {Error} */ (error), asked);
    }
    busy = false;
    const next = waiting;
    waiting = null;
    if (next) run(next.asked);
  }
  return (asked) => {
    if (busy) waiting = { asked };
    else run(asked);
  };
}
