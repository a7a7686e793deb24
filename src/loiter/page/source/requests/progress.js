// @ts-check
/**
 * The progress of the answers as data attributes of the plan view, for which tests and measurements wait; and the
 * delay from a move of the pointer to the drawing of its path, as entries "move to path" of the browser's performance
 * timeline.
 *
 * @import {Store} from "../state/store.js"
 *
 * @typedef {ReturnType<typeof createLatency>} Latency
 */
import { byId } from "../shared/dom.js";
import { isSettled } from "../state/page_state.js";

/** Start last, so that everything is drawn when an attribute changes. @param {Store} store */
export function publishProgress(store) {
  const { dataset } = byId("plan", SVGSVGElement);
  store.watch(
    (state) => [state.revision, state.failure, isSettled(state)],
    (state) => {
      dataset.failure = state.failure ? "refused" : "";
      dataset.drawn = String(state.revision);
      if (isSettled(state)) dataset.rested = String(state.revision);
    },
  );
}

/** @param {Store} store */
export function createLatency(store) {
  /** @type {{revision: number, time_ms: number} | null} */
  let move = null; // of the pointer, whose path is not drawn yet

  return {
    /** @param {PointerEvent} event */
    moved: (event) => (move = { revision: store.get().revision + 1, time_ms: event.timeStamp }),

    /** Start after the plan view, so that the path is drawn when the delay is measured. */
    measure: () =>
      store.watch(
        ({ revision }) => [revision],
        ({ revision, failure }) => {
          performance.clearMeasures("move to path");
          if (move?.revision === revision && !failure)
            performance.measure("move to path", { start: move.time_ms, end: performance.now() });
        },
      ),
  };
}
