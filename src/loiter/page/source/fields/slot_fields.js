// @ts-check
/**
 * The fields of the slot: its bearing, which is empty where the scene has no slot, and the time at which it is there.
 *
 * @import {Store} from "../state/store.js"
 * @import {Change} from "./scene_fields.js"
 * @import {Field, Source} from "./input_fields.js"
 */
import { withoutSlot, withSlot } from "../scene/slot.js";
import { byId, show } from "../shared/dom.js";
import { wrapped } from "../shared/geometry.js";
import { numberFields } from "./input_fields.js";
import { parseNumber } from "./number_text.js";

/** @param {Store} store @param {Change} change @returns {Record<string, Field>} */
export function slotFields(store, change) {
  const scene = () => store.get().scene;
  /** @type {Record<string, Source>} */
  const sources = {
    "slot-bearing": {
      quantity: () => "direction",
      get: () => scene().slot?.phase_deg,
      parse(text) {
        const entry = parseNumber(text, "direction", store.get().units);
        return "value" in entry ? { value: wrapped(entry.value) } : entry;
      },
      set: (phase_deg, event) => change(phase_deg === undefined ? withoutSlot(scene()) : withSlot(scene(), { phase_deg }), event),
      optional: true,
    },
    "slot-at": {
      quantity: () => "time",
      get: () => scene().slot?.at_s,
      set: (at_s, event) => at_s !== undefined && change(withSlot(scene(), { at_s }), event),
    },
  };
  store.watch(
    (state) => [state.scene.slot === null],
    (state) => show(byId("slot-time", HTMLElement), state.scene.slot !== null),
  );
  return numberFields(sources, store);
}
