// @ts-check
/**
 * The search for the fastest clear entry, where the plan is not clear of the fence. It takes a second, so it runs in a
 * worker, when a drag pauses; a search that is no longer needed is ended.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/page_state.js").PageState} PageState
 * @typedef {import("../shared/types.js").ClearEntry} ClearEntry
 * @typedef {{answer?: ClearEntry, sentence?: string}} Found
 */

/** A worker with the library: of the served page a module, of the site its one script. */
function startWorker() {
  const served = document.querySelector('script[type="module"]');
  if (served instanceof HTMLScriptElement)
    return new Worker(new URL("requests/clear_worker.js", served.src), { type: "module" });
  const script = document.scripts[document.scripts.length - 1].text;
  return new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
}

/** A function that searches for the scene of the store. @param {Store} store */
export function clearRequest(store) {
  /** @type {Worker | null} */
  let worker = null;
  let isBusy = false;

  /** @param {number} revision @param {Found} found */
  function show(revision, { answer, sentence }) {
    isBusy = false;
    const state = store.get();
    if (revision !== state.revision) return;
    const { playback, requests, fence } = state;
    store.update({
      clear: answer ?? null,
      lap: playback.playing || playback.time_s > 0 ? (answer?.lap ?? state.lap) : null,
      fence: sentence && fence ? { ...fence, refusal: sentence } : fence,
      requests: { ...requests, clear: answer ? "idle" : "failed" },
    });
  }

  return () => {
    const { scene, revision, requests } = store.get();
    if (requests.clear !== "stale") return;
    if (isBusy) worker?.terminate();
    if (isBusy || !worker) worker = startWorker();
    isBusy = true;
    worker.onmessage = ({ data }) => show(revision, data);
    worker.onerror = () => show(revision, { sentence: "This browser cannot search for a clear entry." });
    worker.postMessage(scene);
    store.update({ requests: { ...requests, clear: "asking" } });
  };
}
