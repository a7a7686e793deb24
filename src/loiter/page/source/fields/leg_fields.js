// @ts-check
/**
 * The fields of a leg: the point flown to, the least hold, and a climb or descent.
 *
 * @import {Store} from "../state/store.js"
 * @import {Leg} from "../shared/types.js"
 * @import {Quantity} from "../shared/units.js"
 * @import {Field, Source} from "./input_fields.js"
 * @import {Change} from "./scene_fields.js"
 *
 * @typedef {Exclude<keyof Leg, "exit_to">} Name
 */
import { exitOf, withExit, withLeg, withoutLeg } from "../scene/leg.js";
import { byId, show } from "../shared/dom.js";
import { numberFields } from "./input_fields.js";

/** The numbers of a leg, by their fields. An empty field stands for the last value. @type {Record<string, [Quantity, Name, 0 | null]>} */
const NUMBERS = {
  "leg-hold": ["time", "hold_s", 0],
  "leg-turns": ["count", "turns", 0],
  "leg-start-altitude": ["length", "start_altitude_m", null],
  "leg-altitude": ["length", "altitude_m", null],
  "climb-rate": ["climb", "climb_rate_m_s", null],
  "descent-rate": ["climb", "descent_rate_m_s", null],
};

/** @param {Store} store @param {Change} change @returns {Record<string, Field>} */
export function legFields(store, change) {
  /** @param {"east_m" | "north_m"} axis @returns {Source} */
  const place = (axis) => ({
    quantity: () => "length",
    get: () => (store.get().scene.leg ? exitOf(store.get().scene)[axis] : undefined),
    set: (value, event) => value !== undefined && change(withExit(store.get().scene, { [axis]: value }), event),
  });
  /** @param {[Quantity, Name, 0 | null]} number @returns {Source} */
  const number = ([quantity, name, empty]) => ({
    quantity: () => quantity,
    get() {
      const value = store.get().scene.leg?.[name] ?? empty;
      return value === empty || value === null ? undefined : value;
    },
    set: (value, event) => change(withLeg(store.get().scene, { [name]: value ?? empty }), event),
    optional: true,
  });
  /** @type {Record<string, Source>} */
  const sources = { "exit-east": place("east_m"), "exit-north": place("north_m") };
  for (const [id, one] of Object.entries(NUMBERS)) sources[id] = number(one);
  byId("drop-exit", HTMLButtonElement).addEventListener("click", (event) => {
    change(withoutLeg(store.get().scene), event);
    byId("add-exit", HTMLElement).focus();
  });
  let climbs = false;
  store.watch(
    ({ scene }) => [scene.leg],
    ({ scene }) => {
      const climbed = climbs;
      climbs = (scene.leg?.altitude_m ?? null) !== null;
      if (climbs && !climbed) byId("leg-climb", HTMLDetailsElement).open = true;
      show(byId("leg", HTMLElement), scene.leg !== null);
    },
  );
  return numberFields(sources, store);
}
