// @ts-check
/**
 * The progress of the requests, as data attributes of the plan view. Tests and measurements wait for them.
 *
 * @typedef {import("./store.js").Store} Store
 */
import { byId } from "../shared/dom.js";
import { isSettled } from "./page_state.js";

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
