// @ts-check
/**
 * The fields of the slot: its bearing, which is empty where the scene has no slot, and the time at which it is there.
 *
 * @import {Store} from "../state/store.js"
 * @import {Change} from "./scene_fields.js"
 * @import {Field} from "./input_fields.js"
 */
import { withoutSlot, withSlot } from "../scene/slot.js";
import { byId, show } from "../shared/dom.js";
import { wrapped } from "../shared/geometry.js";
import { numberField } from "./input_fields.js";
import { parseNumber } from "./number_text.js";

/** @param {Store} store @param {Change} change @returns {Record<string, Field>} */
export function slotFields(store, change) {
  const scene = () => store.get().scene;
  const units = () => store.get().units;
  const fields = {
    "slot-bearing": numberField(byId("slot-bearing", HTMLInputElement), {
      quantity: () => "direction",
      units,
      get: () => scene().slot?.phase_deg,
      parse(text) {
        const entry = parseNumber(text, "direction", units());
        return "value" in entry ? { value: wrapped(entry.value) } : entry;
      },
      set: (phase_deg, event) => change(phase_deg === undefined ? withoutSlot(scene()) : withSlot(scene(), { phase_deg }), event),
      optional: true,
    }),
    "slot-at": numberField(byId("slot-at", HTMLInputElement), {
      quantity: () => "time",
      units,
      get: () => scene().slot?.at_s,
      set: (at_s, event) => at_s !== undefined && change(withSlot(scene(), { at_s }), event),
    }),
  };
  store.watch(
    (state) => [state.scene.slot, state.units],
    (state) => {
      show(byId("slot-time", HTMLElement), state.scene.slot !== null);
      for (const field of Object.values(fields)) field.draw();
    },
  );
  return fields;
}
