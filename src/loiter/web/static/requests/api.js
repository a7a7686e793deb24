// @ts-check
/** Requests to the service. */
import { Unreachable, problemOf } from "./problems.js";

// The service answers within a minute, if only with 503.
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
