// @ts-check
/**
 * The fields for the altitude of missions.
 *
 * @typedef {import("../shared/types.js").Altitude} Altitude
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("./number_field.js").Source} Source
 */
import { REFERENCES } from "../scene/link.js";
import { byId, show } from "../shared/dom.js";
import { needsHome } from "./altitude.js";
import { choiceField } from "./choice_field.js";
import { numberField } from "./number_field.js";

/** @param {Store} store */
export function altitudeFields(store) {
  /** @param {Altitude} changes */
  const change = (changes) => store.update({ altitude: { ...store.get().altitude, ...changes } });
  /** @param {"altitude_m" | "home_altitude_m"} name @returns {Source} */
  const sourceOf = (name) => ({
    quantity: () => "length",
    units: () => store.get().units,
    get: () => store.get().altitude[name],
    set: (value) => change({ [name]: value }),
    optional: true,
  });
  const fields = {
    altitude: numberField(byId("altitude", HTMLInputElement), sourceOf("altitude_m")),
    "altitude-reference": choiceField(
      byId("altitude-reference", HTMLSelectElement),
      () => store.get().altitude.altitude_reference ?? "",
      (value) => change({ altitude_reference: REFERENCES.find((reference) => reference === value) }),
    ),
    "home-altitude": numberField(byId("home-altitude", HTMLInputElement), sourceOf("home_altitude_m")),
  };
  store.watch(
    ({ altitude, units }) => [altitude, units],
    ({ altitude }) => {
      show(byId("home", HTMLElement), needsHome(altitude));
      for (const field of Object.values(fields)) field.draw();
    },
  );
  return fields;
}
