// @ts-check
/**
 * The requests that wait until a drag pauses: the certificate of the plan, and the map of the reduced plane.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../shared/types.js").Proof} Proof
 * @typedef {import("../shared/types.js").Scene} Scene
 * @typedef {import("./retry.js").Retries} Retries
 * @typedef {import("../state/page_state.js").Fault} Fault
 * @typedef {import("../state/page_state.js").MapOptions} MapOptions
 * @typedef {import("../shared/types.js").Answer} Answer
 * @typedef {import("../shared/types.js").Synthesis} Synthesis
 */
import { drifts } from "../scene/scene.js";
import { get, newestOnly, post } from "./api.js";
import { faultOf } from "./retry.js";

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

const CELLS = 280; // along a side: 1.5 pixels each; the curves cover the steps between cells

/**
 * A function that requests the map for a plan, unless it is shown already. An answer for a map that is no longer needed
 * is dropped.
 *
 * @param {Store} store
 * @param {Retries} retries
 */
export function mapRequest(store, retries) {
  /** @param {"idle" | "asking" | "failed"} status @param {Fault | null} fault */
  const outcome = (status, fault) => {
    const { requests, faults } = store.get();
    return { requests: { ...requests, map: status }, faults: { ...faults, map: fault } };
  };
  const isWanted = (/** @type {string} */ query) => query === store.get().wantedMap?.query;
  const send = newestOnly(
    (/** @type {string} */ query) => get(`/api/synthesis?${query}`),
    (/** @type {Synthesis} */ synthesis, query) => {
      if (isWanted(query)) store.update({ synthesis, shownMap: query, ...outcome("idle", null) });
    },
    (error, query) => {
      if (isWanted(query)) store.update(outcome("failed", faultOf(error, retries, "The map does not show this scene")));
    },
  );
  return (/** @type {Answer} */ answer) => {
    const { scene, shownMap, faults } = store.get();
    const wantedMap = mapOptions(scene, answer);
    if (wantedMap.query === shownMap) return store.update({ wantedMap, ...outcome("idle", null) });
    store.update({ wantedMap, ...outcome("asking", faults.map) });
    send(wantedMap.query);
  };
}

/**
 * The map that belongs to a plan.
 *
 * @param {Scene} scene
 * @param {Answer} answer
 * @returns {MapOptions}
 */
function mapOptions(scene, { reduced }) {
  const { turn } = scene.orbit;
  // R of a circle of the turn radius may be below 1 by rounding; the map needs at least 1.
  const radius = Math.max(1, Number(reduced.radius.toFixed(3)));
  const options = { radius: String(radius), turn, reach: String(reachFor(radius, reduced)), cells: String(CELLS) };
  return {
    title: `R = ${Number(radius.toPrecision(3))}, ${turn === "either" ? "either way" : turn}`,
    query: new URLSearchParams(options).toString(),
    drifts: drifts(scene),
  };
}

/**
 * The reach of the map, turn radii: enough for the circle, doubled until the state is on the map.
 *
 * @param {number} radius
 * @param {{x: number, y: number}} state
 */
function reachFor(radius, { x, y }) {
  const least = Math.ceil(2 * (radius + 3)) / 2;
  const needed = Math.max(Math.abs(x), Math.abs(y)) * 1.04;
  return least * 2 ** Math.max(0, Math.min(12, Math.ceil(Math.log2(needed / least))));
}
