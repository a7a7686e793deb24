// @ts-check
/**
 * The search for the fastest clear entry, where the plan is not clear of the fence. It takes a second, so it runs in a
 * worker, when a drag pauses.
 *
 * @import {Store} from "../state/store.js"
 * @import {ClearEntry} from "../shared/types.js"
 */
import { workerTask } from "./worker_task.js";

/** A function that searches for the scene of the store. @param {Store} store */
export function clearRequest(store) {
  /** @param {{answer?: ClearEntry, sentence?: string}} found */
  function show({ answer, sentence }) {
    const { playback, requests, fence, lap } = store.get();
    store.update({
      clear: answer ?? null,
      lap: playback.playing || playback.time_s > 0 ? (answer?.lap ?? lap) : null,
      fence: sentence && fence ? { ...fence, refusal: sentence } : fence,
      requests: { ...requests, clear: answer ? "idle" : "failed" },
    });
  }
  const search = workerTask(store, "clear", show);
  return () => store.get().requests.clear === "stale" && search();
}
