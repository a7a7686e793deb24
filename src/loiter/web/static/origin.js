// @ts-check
/**
 * Where (0, 0) lies on Earth, typed.
 *
 * @typedef {import("./types.js").Origin} Origin
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./plan.js").Shown} Shown
 */
import { numberField } from "./fields.js";
import { byId } from "./svg.js";

/**
 * @param {() => Shown} shown
 * @param {(scene: Scene, event: Event) => void} change
 */
export function originFields(shown, change) {
  /** @type {Partial<Origin>} */
  let typed = {}; // one of the two makes no place
  /** @param {keyof Origin} name @returns {import("./fields.js").Source} */
  const sourceOf = (name) => ({
    quantity: () => "degrees",
    units: () => shown().units,
    get: () => typed[name],
    set(value, event) {
      typed = { ...typed, [name]: value };
      const { latitude_deg, longitude_deg } = typed;
      const whole = latitude_deg !== undefined && longitude_deg !== undefined;
      change({ ...shown().scene, origin: whole ? { latitude_deg, longitude_deg } : null }, event);
    },
    optional: true,
  });
  const fields = {
    latitude: numberField(byId("latitude", HTMLInputElement), sourceOf("latitude_deg")),
    longitude: numberField(byId("longitude", HTMLInputElement), sourceOf("longitude_deg")),
  };

  /** The place of a scene that was opened. */
  function open() {
    typed = { ...shown().scene.origin };
    for (const field of Object.values(fields)) field.draw();
  }
  return { open, fields };
}
