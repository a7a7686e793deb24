// @ts-check
/**
 * The fields for the numbers of a scene.
 *
 * @import {Limit, Scene} from "../shared/types.js"
 * @import {Quantity} from "../shared/units.js"
 * @import {Store} from "../state/store.js"
 * @import {Source} from "./input_fields.js"
 *
 * @typedef {(scene: Scene, event: Event) => void} Change
 *
 * @typedef {object} Part  a number of a scene
 * @property {Quantity} quantity
 * @property {(scene: Scene) => number | undefined} get
 * @property {(scene: Scene, value: number) => Scene} set
 */
import { LIMITS, limitOf, withOrbit, withPose, withWind } from "../scene/scene.js";
import { byId, setText } from "../shared/dom.js";
import { wrapped } from "../shared/geometry.js";
import { tidy } from "../shared/units.js";
import { choiceField, numberFields } from "./input_fields.js";
import { parseNumber } from "./number_text.js";
import { limitFor, turnRadiusOf } from "../shared/turning.js";

const CALM = "Calm air: set a speed first."; // why the direction of the wind is disabled

/** @param {Quantity} quantity @param {keyof Scene["pose"]} name @returns {Part} */
const posePart = (quantity, name) => ({
  quantity,
  get: ({ pose }) => pose[name],
  set: (scene, value) => withPose(scene, { [name]: value }),
});

/** @param {Quantity} quantity @param {Exclude<keyof Scene["orbit"], "turn">} name @returns {Part} */
const orbitPart = (quantity, name) => ({
  quantity,
  get: ({ orbit }) => orbit[name],
  set: (scene, value) => withOrbit(scene, { [name]: value }),
});

/** @type {Record<string, Part>} */
const PARTS = {
  east: posePart("length", "east_m"),
  north: posePart("length", "north_m"),
  course: posePart("direction", "heading_deg"),
  airspeed: {
    quantity: "speed",
    get: ({ aircraft }) => aircraft.airspeed_m_s,
    set: (scene, airspeed_m_s) => ({ ...scene, aircraft: { ...scene.aircraft, airspeed_m_s } }),
  },
  "centre-east": orbitPart("length", "east_m"),
  "centre-north": orbitPart("length", "north_m"),
  "circle-radius": orbitPart("length", "radius_m"),
  "velocity-east": orbitPart("speed", "velocity_east_m_s"),
  "velocity-north": orbitPart("speed", "velocity_north_m_s"),
  "wind-speed": {
    quantity: "speed",
    get: ({ wind }) => wind?.speed_m_s ?? 0,
    set: (scene, speed_m_s) => withWind(scene, { speed_m_s, from_deg: scene.wind?.from_deg ?? 270 }),
  },
  "wind-from": {
    quantity: "direction",
    get: ({ wind }) => wind?.from_deg,
    set: (scene, from_deg) => ({ ...scene, wind: scene.wind && { ...scene.wind, from_deg } }),
  },
};

/** @type {Record<Limit, Quantity>} */
const LIMIT_QUANTITIES = { max_bank_deg: "degrees", min_turn_radius_m: "length", max_turn_rate_deg_s: "rate" };

/** The number of the limit that a scene gives. @param {Scene} scene @returns {Part} */
const limitPart = ({ aircraft }) => ({
  quantity: LIMIT_QUANTITIES[limitOf(aircraft)],
  get: (scene) => scene.aircraft[limitOf(aircraft)],
  set: (scene, value) => ({ ...scene, aircraft: { ...scene.aircraft, [limitOf(aircraft)]: value } }),
});

/** The number that a field shows. @param {string} id @param {Scene} scene @returns {Part} */
const partOf = (id, scene) => (id === "limit" ? limitPart(scene) : PARTS[id]);

/** @param {Store} store @param {Change} change */
export function sceneFields(store, change) {
  const ids = [...Object.keys(PARTS), "limit"];
  const fields = numberFields(Object.fromEntries(ids.map((id) => [id, sourceOf(id, store, change)])), store);
  limitChoice(store, change);
  const turn = choiceField(
    byId("turn", HTMLElement),
    () => store.get().scene.orbit.turn,
    (turn, event) => change(withOrbit(store.get().scene, { turn }), event),
  );
  store.watch(({ scene }) => [scene.orbit.turn], turn.draw);
  store.watch(
    ({ scene }) => [scene.wind === null],
    ({ scene }) => {
      byId("wind-from", HTMLInputElement).disabled = scene.wind === null;
      setText(byId("wind-calm", HTMLElement), scene.wind ? "" : CALM);
    },
  );
  return fields;
}

/**
 * The number of the scene that a field shows and sets.
 *
 * @param {string} id
 * @param {Store} store
 * @param {Change} change
 * @returns {Source}
 */
function sourceOf(id, store, change) {
  const part = () => partOf(id, store.get().scene);
  return {
    quantity: () => part().quantity,
    get: () => part().get(store.get().scene),
    parse(text) {
      const { quantity } = part();
      const entry = parseNumber(text, quantity, store.get().units);
      return quantity === "direction" && "value" in entry ? { value: wrapped(entry.value ?? 0) } : entry;
    },
    set(value, event) {
      if (value !== undefined) change(part().set(store.get().scene, value), event);
    },
  };
}

/**
 * The choice between bank, turn radius and turn rate. The new limit keeps the turn radius.
 *
 * @param {Store} store
 * @param {Change} change
 */
function limitChoice(store, change) {
  const select = byId("limit-kind", HTMLSelectElement);
  select.addEventListener("change", (event) => {
    const { scene } = store.get();
    const limit = LIMITS.find((name) => name === select.value) ?? "max_bank_deg";
    const { airspeed_m_s } = scene.aircraft;
    const value = limitFor(limit, airspeed_m_s, turnRadiusOf(scene.aircraft));
    change({ ...scene, aircraft: { airspeed_m_s, [limit]: tidy(value, value / 1000) } }, event);
  });
  store.watch(
    ({ scene }) => [limitOf(scene.aircraft)],
    ({ scene }) => {
      select.value = limitOf(scene.aircraft);
      byId("limit", HTMLInputElement).setAttribute("aria-label", select.selectedOptions[0].text);
    },
  );
}
