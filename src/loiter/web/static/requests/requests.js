// @ts-check
/**
 * The requests of the page. Each change of the scene requests a plan with every candidate; its certificate and map are
 * requested when the drag pauses.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/page_state.js").PageState} PageState
 * @typedef {ReturnType<typeof createRequests>} Requests
 */
import { PAUSE_MS, debounced } from "../shared/dom.js";
import { isSettled } from "../state/page_state.js";
import { certificateRequest, mapRequest } from "./pause_requests.js";
import { planRequest } from "./plan_request.js";
import { createRetries } from "./retry.js";

/** @param {Store} store */
export function createRequests(store) {
  const retries = createRetries(() => askPlan({}));
  const askPlan = planRequest(store, retries);
  const askCertificate = certificateRequest(store, retries);
  const askMap = mapRequest(store, retries);

  const pauseLater = debounced(PAUSE_MS, () => {
    const { requests, failure, answer, revision } = store.get();
    if (requests.plan === "asking") return pauseLater();
    if (failure || !answer) return store.update({ pausedRevision: revision });
    store.update({ announced: answer, pausedRevision: revision });
    askMap(answer);
    askCertificate();
  });
  store.watch(
    ({ revision }) => [revision],
    ({ revision }) => revision > 0 && pauseLater(),
  );
  store.watch(
    (state) => [hasEverything(state)],
    (state) => hasEverything(state) && retries.reset(),
  );
  retryWhenBack(store, retries.now);
  return { askPlan, retry: retries.now };
}

/** Whether the service has answered all questions. @param {PageState} state */
const hasEverything = (state) =>
  isSettled(state) && !state.failure && !state.faults.certificate?.temporary && !state.faults.map?.temporary;

/**
 * Retry at once when the network or the user comes back.
 *
 * @param {Store} store
 * @param {() => void} retry
 */
function retryWhenBack(store, retry) {
  const retryIfVisible = () => {
    if (store.get().failure?.name === "unreachable" && document.visibilityState === "visible") retry();
  };
  addEventListener("online", retryIfVisible);
  addEventListener("visibilitychange", retryIfVisible);
}
