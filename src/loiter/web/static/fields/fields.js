// @ts-check
/**
 * All fields of the page, and their error marks.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/actions.js").Actions} Actions
 * @typedef {import("../plan/camera.js").PlanCamera} PlanCamera
 * @typedef {import("./number_field.js").Field} Field
 * @typedef {Record<string, Field>} Fields  by their ids
 */
import { byId } from "../shared/dom.js";
import { altitudeFields } from "./altitude_fields.js";
import { originFields } from "./origin_fields.js";
import { sceneFields } from "./scene_fields.js";

/**
 * @param {Store} store
 * @param {Actions} actions
 * @param {PlanCamera} camera  follows a scene that is typed
 * @returns {Fields}
 */
export function createFields(store, actions, camera) {
  const fields = {
    ...sceneFields(store, (scene, event) => {
      actions.changeScene(scene, event);
      camera.keepInView();
    }),
    ...originFields(store, actions),
    ...altitudeFields(store),
  };
  unitsChoice(store);
  markErrors(store, fields, "scene");
  markErrors(store, fields, "file");
  return fields;
}

/** @param {Store} store */
function unitsChoice(store) {
  const select = byId("units", HTMLSelectElement);
  select.addEventListener("change", () => store.update({ units: select.value === "aviation" ? "aviation" : "metric" }));
  store.watch(
    ({ units }) => [units],
    ({ units }) => (select.value = units),
  );
}

/**
 * Mark the fields that have errors, and open the section that hides them.
 *
 * @param {Store} store
 * @param {Fields} fields
 * @param {"scene" | "file"} subject
 */
function markErrors(store, fields, subject) {
  /** @type {string[]} */
  let marked = [];
  store.watch(
    ({ fieldErrors }) => [fieldErrors[subject]],
    ({ fieldErrors }) => {
      for (const id of marked) fields[id].refuse(null);
      marked = Object.keys(fieldErrors[subject]).filter((id) => fields[id]);
      for (const id of marked) {
        fields[id].refuse(fieldErrors[subject][id]);
        byId(id, HTMLElement).closest("details")?.setAttribute("open", "");
      }
    },
  );
}
