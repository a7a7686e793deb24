// @ts-check
/**
 * Requests to the service. Its errors are problem documents (RFC 9457), whose `detail` is a sentence for a person.
 *
 * @typedef {import("./types.js").Scene} Scene
 */

/** What went wrong, in the service's sentence. */
export class Problem extends Error {
  /**
   * @param {string} sentence
   * @param {string} [kind]  the last part of the problem's type: "radius-too-small"
   * @param {string[]} [places]  the places in the request that it is about: "aircraft/airspeed_m_s"
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
   * @param {number} [wait_s]  how long it asks to be left alone
   */
  constructor(headline, sentence, wait_s = 0) {
    super(sentence);
    this.headline = headline;
    this.wait_s = wait_s;
  }
}

// The service answers within a minute, be it with 503.
const LONGEST_MS = 70_000;

// Too many requests, and what proxies and the service say when it is not there or too busy.
const TEMPORARY = [429, 502, 503, 504];

/**
 * The answer to a scene, or to a scene with options.
 *
 * @param {string} path
 * @param {object} body
 * @returns {Promise<any>}
 */
export async function post(path, body) {
  return read(await send(path, body), (response) => response.json());
}

/**
 * @param {string} path
 * @returns {Promise<any>}
 */
export async function get(path) {
  return read(await send(path), (response) => response.json());
}

/**
 * The file that is the answer to a scene with options, and its name.
 *
 * @param {string} path
 * @param {object} body
 * @returns {Promise<{content: Blob, name: string | undefined}>}
 */
export async function file(path, body) {
  const response = await send(path, body);
  const name = /filename="?([^";]+)"?/.exec(response.headers.get("Content-Disposition") ?? "")?.[1];
  return { content: await read(response, () => response.blob()), name };
}

/**
 * @param {string} path
 * @param {object} [body]  of a POST
 * @returns {Promise<Response>}
 */
function send(path, body) {
  const signal = AbortSignal.timeout(LONGEST_MS);
  if (!body) return fetch(path, { signal }).catch(silent);
  const headers = { "Content-Type": "application/json" };
  return fetch(path, { method: "POST", headers, body: JSON.stringify(body), signal }).catch(silent);
}

/** @returns {never} */
function silent() {
  throw new Unreachable("The service does not answer", "Is loiter serve still running?");
}

/**
 * What a response holds, which ends early where the service does.
 *
 * @template T
 * @param {Response} response
 * @param {(response: Response) => Promise<T>} content
 * @returns {Promise<T>}
 */
async function read(response, content) {
  if (!response.ok) throw await problemOf(response);
  return content(response).catch(silent);
}

/** @param {Response} response */
async function problemOf(response) {
  const { type = "", title, detail, errors = [] } = await response.json().catch(() => ({}));
  const places = errors.flatMap((/** @type {{pointer?: string}} */ { pointer }) => pointer?.replace("#/", "") ?? []);
  const sentence = detail ?? title ?? `The service answered ${response.status}.`;
  if (TEMPORARY.includes(response.status)) return new Unreachable("The service is busy", sentence, waitOf(response));
  return new Problem(sentence, type.slice(type.lastIndexOf(":") + 1), places);
}

/** The seconds for which a response asks to be left alone; it may name a date instead. @param {Response} response */
const waitOf = (response) => Number(response.headers.get("Retry-After")) || 0;

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
      const answer = await request(asked).catch((error) => failed(error, asked));
      if (answer) done(answer, asked);
    } finally {
      busy = false;
      const next = waiting;
      waiting = null;
      if (next) run(next.asked);
    }
  }
  return (asked) => {
    if (busy) waiting = { asked };
    else run(asked);
  };
}
