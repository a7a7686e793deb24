// @ts-check
/**
 * The answers that the page needs. Each change of the scene is answered at once by a plan with every candidate; its
 * certificate and map follow when the drag pauses.
 *
 * @import {Store} from "../state/store.js"
 * @typedef {ReturnType<typeof createRequests>} Requests
 */
import { PAUSE_MS, debounced } from "../shared/dom.js";
import { clearRequest } from "./clear_request.js";
import { certificateRequest, mapRequest } from "./pause_requests.js";
import { planRequest } from "./plan_request.js";

/** @param {Store} store */
export function createRequests(store) {
  const askCertificate = certificateRequest(store);
  const askMap = mapRequest(store);
  const askClear = clearRequest(store);

  const pauseLater = debounced(PAUSE_MS, () => {
    const { failure, answer, revision } = store.get();
    if (failure || !answer) return store.update({ pausedRevision: revision });
    store.update({ announced: answer, pausedRevision: revision });
    askMap(answer);
    askCertificate();
    askClear();
  });
  store.watch(
    ({ revision }) => [revision],
    ({ revision }) => revision > 0 && pauseLater(),
  );
  return { askPlan: planRequest(store) };
}
