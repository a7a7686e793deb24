// @ts-check
/**
 * What takes long is computed in a worker, so that the page stays quick; what is no longer needed is ended.
 *
 * @import {Store} from "../state/store.js"
 */

/** A worker with the library: the page's one script. */
function startWorker() {
  const script = document.scripts[document.scripts.length - 1].text;
  return new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
}

/**
 * A function that asks a worker about the scene of the store, and shows the answer, or a sentence that says why there
 * is none, unless the scene has changed.
 *
 * @template T
 * @param {Store} store
 * @param {"clear" | "certificate"} asked
 * @param {(found: {answer?: T, sentence?: string}) => void} show
 */
export function workerTask(store, asked, show) {
  /** @type {Worker | null} */
  let worker = null;
  let isBusy = false;
  return () => {
    const { scene, revision } = store.get();
    if (isBusy) worker?.terminate();
    if (isBusy || !worker) worker = startWorker();
    isBusy = true;
    /** @param {{answer?: T, sentence?: string}} found */
    const done = (found) => {
      isBusy = false;
      if (revision === store.get().revision) show(found);
    };
    worker.onmessage = ({ data }) => done(data);
    worker.onerror = () => done({ sentence: "This browser starts no workers." });
    worker.postMessage({ asked, scene });
    store.update({ requests: { ...store.get().requests, [asked]: "asking" } });
  };
}
