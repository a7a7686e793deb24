// @ts-check
/**
 * The plan of the scene.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 */
import { refusalOf } from "../fields/field_names.js";
import { NO_MESSAGE } from "../state/page_state.js";
import { zonesOf } from "../scene/fence.js";
import { Problem, fenceCheckOf, legOf, planOf } from "./answers.js";

/**
 * A function that applies changes to the state, with the plan of the scene.
 *
 * @param {Store} store
 * @returns {(changes: Partial<PageState>) => void}
 */
export function planRequest(store) {
  return (changes) => {
    const state = { ...store.get(), ...changes };
    store.update({ ...changes, revision: state.revision + 1, ...outcome(state) });
  };
}

/** @param {PageState} state @returns {Partial<PageState>} */
function outcome(state) {
  try {
    const answer = planOf(state.scene);
    const leg = state.scene.leg ? legOf(state.scene) : null;
    const fence = fenceOf(state);
    const isBlocked = fence?.check?.clear === false && !leg && !state.scene.slot;
    return {
      answer,
      leg,
      fence,
      clear: null,
      lap: null,
      failure: null,
      proof: null,
      faults: { ...state.faults, certificate: null },
      fieldErrors: { ...state.fieldErrors, scene: {} },
      requests: { plan: "idle", certificate: "stale", map: "stale", clear: isBlocked ? "stale" : "idle" },
    };
  } catch (error) {
    return failed(state, /** @type {Error} */ (error));
  }
}

/** @param {PageState} state @returns {PageState["fence"]} */
function fenceOf({ scene, units }) {
  if (zonesOf(scene).length === 0) return null;
  try {
    return { check: fenceCheckOf(scene), refusal: "" };
  } catch (error) {
    return { check: null, refusal: refusalOf(/** @type {Error} */ (error), units).sentence };
  }
}

/** @param {PageState} state @param {Error} error @returns {Partial<PageState>} */
function failed({ scene, leg, playback, fieldErrors, failure, message, units }, error) {
  const { sentence, fields } = refusalOf(error, units);
  const fittedRadius_m = error instanceof Problem ? error.fittedRadius_m : null;
  return {
    failure: { headline: "No plan for this scene", sentence, fittedRadius_m },
    lap: null,
    announced: null,
    message: failure ? message : NO_MESSAGE,
    playback: { ...playback, playing: false },
    fieldErrors: { ...fieldErrors, scene: fields },
    fence: null,
    clear: null,
    leg: scene.leg && leg,
    requests: { plan: "failed", certificate: "stale", map: "stale", clear: "idle" },
  };
}
