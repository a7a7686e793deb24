// @ts-check
/**
 * The request for the plan of the scene.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/page_state.js").PageState} PageState
 * @typedef {import("../state/page_state.js").Failure} Failure
 * @typedef {import("../shared/types.js").Answer} Answer
 * @typedef {import("../shared/types.js").Scene} Scene
 * @typedef {import("./retry.js").Retries} Retries
 *
 * @typedef {object} Question
 * @property {Scene} scene
 * @property {number} revision
 */
import { refusalOf } from "../fields/field_names.js";
import { NO_MESSAGE } from "../state/page_state.js";
import { Problem, Unreachable, newestOnly, post } from "./api.js";

/**
 * A function that applies changes to the state and requests the plan of the scene.
 *
 * @param {Store} store
 * @param {Retries} retries
 * @returns {(changes: Partial<PageState>) => void}
 */
export function planRequest(store, retries) {
  const send = newestOnly(
    (/** @type {Question} */ { scene }) => post("/api/plan", scene),
    (/** @type {Answer} */ answer, question) => {
      retries.cancel();
      store.update(answered(store.get(), answer, question));
    },
    (error, { revision }) => store.update(failed(store.get(), error, revision, retries)),
  );
  return (changes) => {
    const state = { ...store.get(), ...changes };
    const revision = state.revision + 1;
    // First, so that the service works while the page draws.
    send({ scene: state.scene, revision });
    store.update({ ...changes, revision, requests: { plan: "asking", certificate: "stale", map: "stale" } });
  };
}

/**
 * @param {PageState} state
 * @param {Answer} answer
 * @param {Question} question
 * @returns {Partial<PageState>}
 */
function answered({ requests, faults, fieldErrors, revision: newest }, answer, { revision }) {
  return {
    answer,
    answeredRevision: revision,
    failure: null,
    proof: null,
    faults: { ...faults, certificate: null },
    fieldErrors: { ...fieldErrors, scene: {} },
    requests: { ...requests, plan: revision === newest ? "idle" : "asking" },
  };
}

/**
 * @param {PageState} state
 * @param {Error} error
 * @param {number} revision
 * @param {Retries} retries
 * @returns {Partial<PageState>}
 */
function failed({ requests, playback, fieldErrors, failure, message, revision: newest }, error, revision, retries) {
  const { sentence, fields } = refusalOf(error);
  return {
    answeredRevision: revision,
    failure: failureOf(error, sentence, retries),
    announced: null,
    message: failure ? message : NO_MESSAGE,
    playback: { ...playback, playing: false },
    fieldErrors: { ...fieldErrors, scene: fields },
    requests: { ...requests, plan: revision === newest ? "failed" : "asking" },
  };
}

/**
 * @param {Error} error
 * @param {string} sentence
 * @param {Retries} retries
 * @returns {Failure}
 */
function failureOf(error, sentence, retries) {
  if (!(error instanceof Unreachable))
    return {
      name: "refused",
      headline: "No plan for this scene",
      sentence,
      attempt: null,
      fittedRadius_m: error instanceof Problem ? error.fittedRadius_m : null,
    };
  return {
    name: "unreachable",
    headline: error.headline,
    sentence,
    attempt: retries.plan(error.wait_s),
    fittedRadius_m: null,
  };
}
