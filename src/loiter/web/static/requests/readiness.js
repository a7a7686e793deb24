// @ts-check
/**
 * Whether the service has loaded its machine code. It is compiled once per machine, in some 20 s; until then the map
 * waits, and plans take longer. The page asks only if an answer is missing for a while.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/page_state.js").PageState} PageState
 */
import { get } from "./api.js";

const PATIENCE_MS = 700; // an answer that takes longer is explained
const INTERVAL_MS = 1500; // between two questions

/** @param {Store} store */
export function watchReadiness(store) {
  let timer = 0;

  async function ask() {
    const health = await get("/healthz").catch(() => ({}));
    timer = 0;
    store.update({ isCompiling: isWaiting(store.get()) && health.ready === false });
    if (isWaiting(store.get())) timer = window.setTimeout(ask, INTERVAL_MS);
  }
  store.watch(
    (state) => [isWaiting(state)],
    (state) => {
      clearTimeout(timer);
      if (isWaiting(state)) timer = window.setTimeout(ask, PATIENCE_MS);
      else if (state.isCompiling) store.update({ isCompiling: false });
    },
  );
}

/**
 * Whether an answer is awaited. During a drag a plan always is; it counts once it is late.
 *
 * @param {PageState} state
 */
const isWaiting = ({ isLate, requests }) => isLate || requests.certificate === "asking" || requests.map === "asking";
