// @ts-check
/**
 * The request for the certificate of the plan.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../shared/types.js").Proof} Proof
 * @typedef {import("../shared/types.js").Scene} Scene
 * @typedef {import("./retry.js").Retries} Retries
 */
import { post } from "./api.js";
import { faultOf } from "./fault.js";
import { newestOnly } from "./newest.js";

/**
 * A function that requests the certificate for the scene. An answer to an earlier scene is dropped.
 *
 * @param {Store} store
 * @param {Retries} retries
 */
export function certificateRequest(store, retries) {
  const setStatus = (/** @type {"idle" | "asking" | "failed"} */ certificate) => ({
    requests: { ...store.get().requests, certificate },
  });
  const isCurrent = (/** @type {{revision: number}} */ { revision }) => revision === store.get().revision;
  const send = newestOnly(
    (/** @type {{scene: Scene, revision: number}} */ { scene }) => post("/api/certificate", scene),
    (/** @type {Proof} */ proof, question) => {
      if (isCurrent(question)) store.update({ proof, ...setStatus("idle") });
    },
    (error, question) => {
      if (!isCurrent(question)) return;
      const certificate = faultOf(error, retries, "Not checked");
      store.update({ faults: { ...store.get().faults, certificate }, ...setStatus("failed") });
    },
  );
  return () => {
    const { scene, revision } = store.get();
    store.update(setStatus("asking"));
    send({ scene, revision });
  };
}
