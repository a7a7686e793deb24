// @ts-check
/**
 * The progress of the requests as data attributes of the plan view, for which tests and measurements wait; and the
 * delay from a move of the pointer to the drawing of its path, as entries "move to path" of the browser's performance
 * timeline.
 *
 * @typedef {import("../state/store.js").Store} Store
 *
 * @typedef {ReturnType<typeof createLatency>} Latency
 */
import { byId } from "../shared/dom.js";
import { isSettled } from "../state/page_state.js";

/** Start last, so that everything is drawn when an attribute changes. @param {Store} store */
export function publishProgress(store) {
  const { dataset } = byId("plan", SVGSVGElement);
  store.watch(
    (state) => [state.revision, state.answeredRevision, state.failure, isSettled(state)],
    (state) => {
      dataset.failure = state.failure?.name ?? "";
      dataset.asked = String(state.revision);
      dataset.drawn = String(state.answeredRevision);
      if (isSettled(state)) dataset.rested = String(state.revision);
    },
  );
}

/** @param {Store} store */
export function createLatency(store) {
  /** @type {{revision: number, time_ms: number}[]} */
  let moves = []; // of the pointer, whose path is not drawn yet

  return {
    /** @param {number} revision @param {PointerEvent} event */
    moved: (revision, event) => moves.push({ revision, time_ms: event.timeStamp }),

    /** Start after the plan view, so that the path is drawn when the delay is measured. */
    measure: () =>
      store.watch(
        ({ answeredRevision }) => [answeredRevision],
        ({ answeredRevision, failure }) => {
          const end = performance.now();
          const drawn = moves.filter(({ revision }) => revision <= answeredRevision);
          moves = moves.slice(drawn.length);
          if (!failure) for (const { time_ms } of drawn) performance.measure("move to path", { start: time_ms, end });
        },
      ),
  };
}
