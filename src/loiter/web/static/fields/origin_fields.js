// @ts-check
/**
 * The fields for the position of (0, 0) on Earth.
 *
 * @typedef {import("../shared/types.js").Origin} Origin
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/actions.js").Actions} Actions
 * @typedef {import("./number_field.js").Source} Source
 */
import { byId } from "../shared/dom.js";
import { numberField } from "./number_field.js";

/**
 * @param {Store} store
 * @param {Actions} actions
 */
export function originFields(store, actions) {
  /** @param {keyof Origin} name @returns {Source} */
  const sourceOf = (name) => ({
    quantity: () => "degrees",
    units: () => store.get().units,
    get: () => store.get().place[name],
    set(value, event) {
      const place = { ...store.get().place, [name]: value };
      store.update({ place });
      actions.changeScene({ ...store.get().scene, origin: originOf(place) }, event);
    },
    optional: true,
  });
  const fields = {
    latitude: numberField(byId("latitude", HTMLInputElement), sourceOf("latitude_deg")),
    longitude: numberField(byId("longitude", HTMLInputElement), sourceOf("longitude_deg")),
  };
  store.watch(
    ({ place }) => [place],
    () => Object.values(fields).forEach((field) => field.draw()),
  );
  return fields;
}

/** The origin, or null while a number is missing. @param {Partial<Origin>} place @returns {Origin | null} */
const originOf = ({ latitude_deg, longitude_deg }) =>
  latitude_deg !== undefined && longitude_deg !== undefined ? { latitude_deg, longitude_deg } : null;
