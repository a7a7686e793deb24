// @ts-check
/**
 * The answers that wait until a drag pauses: the certificate of the plan, and the map of the reduced plane.
 *
 * @import {Store} from "../state/store.js"
 * @import {Answer, Proof, Scene} from "../shared/types.js"
 * @import {MapOptions, PageState} from "../state/page_state.js"
 */
import { drifts } from "../scene/scene.js";
import { certificateOf, mapOf } from "./answers.js";
import { workerTask } from "./worker_task.js";

/**
 * A function that checks the plan of the scene. The certificate of an entry into a slot takes as long as some frames of
 * the screen: it is made in a worker.
 *
 * @param {Store} store
 */
export function certificateRequest(store) {
  /** @param {{answer?: Proof, sentence?: string}} found */
  function show({ answer, sentence }) {
    const { faults, requests } = store.get();
    if (answer) store.update({ proof: answer, requests: { ...requests, certificate: "idle" } });
    else store.update({ faults: { ...faults, certificate: `Not checked: ${sentence}` }, requests: { ...requests, certificate: "failed" } });
  }
  const askWorker = workerTask(store, "certificate", show);
  /** @param {PageState["scene"]} scene */
  function check(scene) {
    try {
      show({ answer: certificateOf(scene) });
    } catch (error) {
      show({ sentence: /** @type {Error} */ (error).message });
    }
  }
  return () => (store.get().scene.slot ? askWorker() : check(store.get().scene));
}

const CELLS = 280; // along a side: 1.5 pixels each; the curves cover the steps between cells

/**
 * A function that draws the map for a plan, unless it is shown already. A map that is no longer needed is dropped.
 *
 * @param {Store} store
 */
export function mapRequest(store) {
  /** @param {"idle" | "asking"} map */
  const status = (map) => ({ requests: { ...store.get().requests, map } });
  /** @param {MapOptions} wanted */
  async function draw({ query }) {
    const synthesis = await mapOf(JSON.parse(query));
    if (query === store.get().wantedMap?.query) store.update({ synthesis, shownMap: query, ...status("idle") });
  }
  return (/** @type {Answer} */ answer) => {
    const { scene, shownMap } = store.get();
    const wantedMap = mapOptions(scene, answer);
    const isShown = wantedMap.query === shownMap;
    store.update({ wantedMap, ...status(isShown ? "idle" : "asking") });
    if (!isShown) draw(wantedMap);
  };
}

/** The map that belongs to a plan. @param {Scene} scene @param {Answer} answer @returns {MapOptions} */
function mapOptions(scene, { reduced }) {
  const { turn } = scene.orbit;
  // R of a circle of the turn radius may be below 1 by rounding; the map needs at least 1.
  const radius = Math.max(1, Number(reduced.radius.toFixed(3)));
  return {
    title: `R = ${Number(radius.toPrecision(3))}, ${turn === "either" ? "either way" : turn}`,
    query: JSON.stringify({ radius, turn, reach: reachFor(radius, reduced), cells: CELLS }),
    drifts: drifts(scene) || scene.slot !== null,
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
