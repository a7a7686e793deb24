// @ts-check
/** Requests to the service, its errors, and a queue for requests. */

/** A refusal, with the sentence of the service. */
export class Problem extends Error {
  /**
   * @param {string} sentence
   * @param {string} [kind]  the last part of the problem's type: "radius-too-small"
   * @param {string[]} [places]  the parts of the request that it refuses: "aircraft/airspeed_m_s"
   * @param {number | null} [fittedRadius_m]  the least radius that can be held, if the circle is too small
   */
  constructor(sentence, kind = "", places = [], fittedRadius_m = null) {
    super(sentence);
    this.kind = kind;
    this.places = places;
    this.fittedRadius_m = fittedRadius_m;
  }
}

/** The service does not answer now, but may later. */
export class Unreachable extends Problem {
  /**
   * @param {string} headline
   * @param {string} sentence
   * @param {number} [wait_s]  how long the service asks clients to wait
   */
  constructor(headline, sentence, wait_s = 0) {
    super(sentence);
    this.headline = headline;
    this.wait_s = wait_s;
  }
}

// Statuses of too many requests, and of a service that is absent or too busy; a proxy may send them too.
const TEMPORARY = [429, 502, 503, 504];

/**
 * The error in a response: a problem document (RFC 9457), whose `detail` is a sentence for the user.
 *
 * @param {Response} response
 */
export async function problemOf(response) {
  const { type = "", title, detail, errors = [], fitted_radius_m } = await response.json().catch(() => ({}));
  const places = errors.flatMap((/** @type {{pointer?: string}} */ { pointer }) => pointer?.replace("#/", "") ?? []);
  const sentence = detail ?? title ?? `The service answered ${response.status}.`;
  if (TEMPORARY.includes(response.status)) return new Unreachable("The service is busy", sentence, waitOf(response));
  return new Problem(sentence, type.slice(type.lastIndexOf(":") + 1), places, fitted_radius_m);
}

/** The seconds that a response asks clients to wait; 0 if it names a date instead. @param {Response} response */
const waitOf = (response) => Number(response.headers.get("Retry-After")) || 0;

// The service answers within a minute, with 503 if the answer takes longer.
const TIMEOUT_MS = 70_000;

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
 * The file for a scene with options, and its name.
 *
 * @param {string} path
 * @param {object} body
 * @returns {Promise<{content: Blob, name: string | undefined}>}
 */
export async function getFile(path, body) {
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
  const signal = AbortSignal.timeout(TIMEOUT_MS);
  if (!body) return fetch(path, { signal }).catch(noAnswer);
  const headers = { "Content-Type": "application/json" };
  return fetch(path, { method: "POST", headers, body: JSON.stringify(body), signal }).catch(noAnswer);
}

/** @returns {never} */
function noAnswer() {
  throw new Unreachable("The service does not answer", "Is loiter serve still running?");
}

/**
 * The content of a response; an incomplete one counts as no answer.
 *
 * @template T
 * @param {Response} response
 * @param {(response: Response) => Promise<T>} content
 * @returns {Promise<T>}
 */
async function read(response, content) {
  if (!response.ok) throw await problemOf(response);
  return content(response).catch(noAnswer);
}

/**
 * A queue of one: while a request is under way, only the newest later question is kept. So the service never
 * works on more than one state of a drag, and the last state always gets its answer.
 *
 * @template Question, Answer
 * @param {(question: Question) => Promise<Answer>} send
 * @param {(answer: Answer, question: Question) => void} answered
 * @param {(error: Error, question: Question) => void} failed
 * @returns {(question: Question) => void}
 */
export function newestOnly(send, answered, failed) {
  let busy = false;
  /** @type {{question: Question} | null} */
  let waiting = null;
  /** @param {Question} question */
  async function run(question) {
    busy = true;
    try {
      const answer = await send(question).catch((error) => failed(error, question));
      if (answer) answered(answer, question);
    } finally {
      busy = false;
      const next = waiting;
      waiting = null;
      if (next) run(next.question);
    }
  }
  return (question) => {
    if (busy) waiting = { question };
    else run(question);
  };
}
