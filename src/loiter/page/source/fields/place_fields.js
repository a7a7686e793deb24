// @ts-check
/**
 * The fields for the positions of the aircraft and of the circle as latitude and longitude. Without a position of (0, 0)
 * on Earth the first position sets it, so that the scene keeps its shape; after that a position moves its object.
 *
 * @import {Origin, Scene} from "../shared/types.js"
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Field} from "./input_fields.js"
 *
 * @typedef {(scene: Scene, event: Event, more: Partial<PageState>) => void} Change
 */
import { withOrbit, withPose } from "../scene/scene.js";
import { exitOf, withExit } from "../scene/leg.js";
import { byId } from "../shared/dom.js";
import { REACH_M, originFor, toLocal, toPlace } from "../shared/earth.js";
import { powerBelow, tidy } from "../shared/units.js";
import { turnRadiusOf } from "../shared/turning.js";
import { pairProblem, parsePair } from "./coordinates.js";
import { errorLine, markInvalid } from "./input_fields.js";
import { nameOf } from "./field_names.js";

/**
 * @typedef {object} Object  that has a position
 * @property {(scene: Scene) => {east_m: number, north_m: number}} get
 * @property {(scene: Scene, position: {east_m: number, north_m: number}) => Scene} set
 */

/** @type {Record<string, Object>} */
const OBJECTS = {
  "aircraft-place": { get: ({ pose }) => pose, set: withPose },
  "circle-place": { get: ({ orbit }) => orbit, set: withOrbit },
  "exit-place": { get: exitOf, set: withExit },
};

const DECIMALS = 6; // 0.1 m

/** @param {Store} store @param {Change} change @returns {Record<string, Field>} */
export function placeFields(store, change) {
  const fields = Object.fromEntries(
    Object.entries(OBJECTS).map(([id, object]) => [id, placeField(byId(id, HTMLInputElement), object, store, change)]),
  );
  store.watch(
    ({ scene }) => [scene],
    () => Object.values(fields).forEach((field) => field.draw()),
  );
  return fields;
}

/**
 * @param {HTMLInputElement} input
 * @param {Object} object
 * @param {Store} store
 * @param {Change} change
 * @returns {Field}
 */
function placeField(input, object, store, change) {
  const line = errorLine(input);
  let error = "";
  /** @param {string} sentence */
  function mark(sentence) {
    error = sentence;
    line.textContent = sentence;
    markInvalid(input, sentence !== "");
  }
  function draw() {
    if (document.activeElement === input || error !== "") return;
    input.value = placeText(store.get().scene, object);
  }
  input.addEventListener("input", (event) => {
    mark("");
    const pair = parsePair(input.value);
    if (!pair || pairProblem(pair)) return;
    const { scene } = store.get();
    const next = scene.origin ? moveTo(scene, scene.origin, object, pair) : locate(scene, object, pair);
    if (!next) return;
    change(next, event, { place: { ...next.origin } });
  });
  // A sentence while the text is half typed would disturb.
  input.addEventListener("blur", () => {
    mark(input.value.trim() === "" ? "" : problemOf(input, store.get().scene));
    draw();
  });
  return { draw, refuse: (sentence) => mark(sentence ?? ""), typo: () => error };
}

/** What is wrong with the text of a field, or nothing. @param {HTMLInputElement} input @param {Scene} scene */
function problemOf(input, { origin }) {
  const pair = parsePair(input.value);
  if (!pair) return `${nameOf(input)} is "${input.value.trim()}": write 47.1, 8.2 or 47°06' N 8°12' E.`;
  const problem = pairProblem(pair);
  if (problem) return `${nameOf(input)} is "${input.value.trim()}": ${problem}`;
  if (!origin || Math.hypot(...toLocal(origin, pair)) <= REACH_M) return "";
  return `${nameOf(input)} is more than ${REACH_M / 1000} km from (0, 0): change the place of (0, 0) first.`;
}

/** The scene with an object moved to a place, or null if that is too far. @param {Scene} scene @param {Origin} origin @param {Object} object @param {Origin} place */
function moveTo(scene, origin, object, place) {
  const [east, north] = toLocal(origin, place);
  if (Math.hypot(east, north) > REACH_M) return null;
  const resolution = powerBelow(turnRadiusOf(scene.aircraft), 1e-4);
  return object.set(scene, { east_m: tidy(east, resolution), north_m: tidy(north, resolution) });
}

/** The scene with the place of (0, 0) at which an object is there. @param {Scene} scene @param {Object} object @param {Origin} place */
function locate(scene, object, place) {
  const { east_m, north_m } = object.get(scene);
  const { latitude_deg, longitude_deg } = originFor(place, east_m, north_m);
  return { ...scene, origin: { latitude_deg: tidy(latitude_deg, 1e-8), longitude_deg: tidy(longitude_deg, 1e-8) } };
}

/** The position of an object: "47.100000, 8.200000"; nothing while it is not known. @param {Scene} scene @param {Object} object */
function placeText(scene, object) {
  const { east_m, north_m } = object.get(scene);
  if (!scene.origin || !(Math.hypot(east_m, north_m) <= REACH_M)) return "";
  const { latitude_deg, longitude_deg } = toPlace(scene.origin, east_m, north_m);
  return `${latitude_deg.toFixed(DECIMALS)}, ${longitude_deg.toFixed(DECIMALS)}`;
}
