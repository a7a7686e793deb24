// @ts-check
/**
 * All fields of the page, and their error marks: those of the scene, of the position of (0, 0) on Earth, and of the
 * altitude.
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 * @import {PlanCamera} from "../plan/camera.js"
 * @import {Field, Source} from "./input_fields.js"
 * @import {Altitude, Origin} from "../shared/types.js"
 *
 * @typedef {Record<string, Field>} Fields  by their ids
 */
import { byId, show } from "../shared/dom.js";
import { remember } from "../shared/storage.js";
import { asUnits, tidy } from "../shared/units.js";
import { needsHome } from "./altitude.js";
import { pairProblem, parseAngle, parsePair } from "./coordinates.js";
import { choiceField, numberFields } from "./input_fields.js";
import { fenceFields } from "./fence_fields.js";
import { legFields } from "./leg_fields.js";
import { placeFields } from "./place_fields.js";
import { sceneFields } from "./scene_fields.js";
import { slotFields } from "./slot_fields.js";

/**
 * @param {Store} store
 * @param {Actions} actions
 * @param {PlanCamera} camera  keeps the scene in view after a number is typed
 * @returns {Fields}
 */
export function createFields(store, actions, camera) {
  const fields = {
    ...sceneFields(store, (scene, event) => {
      actions.changeScene(scene, event);
      camera.keepInView();
    }),
    ...originFields(store, actions),
    ...placeFields(store, (scene, event, more) => {
      actions.changeScene(scene, event, more);
      camera.keepInView();
    }),
    ...altitudeFields(store, actions),
    ...fenceFields(store, actions),
    ...slotFields(store, actions.changeScene),
    ...legFields(store, (scene, event) => {
      actions.changeScene(scene, event);
      camera.keepInView();
    }),
  };
  unitsChoice(store, actions);
  markErrors(store, fields, "scene");
  markErrors(store, fields, "file");
  return fields;
}

/** @param {Store} store @param {Actions} actions */
function unitsChoice(store, actions) {
  const select = byId("units", HTMLSelectElement);
  select.addEventListener("change", () => {
    remember("units", select.value);
    actions.changeUnits(asUnits(select.value));
  });
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

/** @param {Store} store @param {Actions} actions */
export function originFields(store, actions) {
  /** @param {keyof Origin} name @returns {Source} */
  const sourceOf = (name) => ({
    quantity: () => "degrees",
    get: () => store.get().place[name],
    parse: (text) => parseAngle(text, name),
    shown: (value) => tidy(value, 1e-7), // 1 cm
    takeAll(text, event) {
      const pair = isOneNumber(text) ? null : parsePair(text);
      if (!pair || pairProblem(pair)) return false;
      // Neither field of the pair is wrong any more, nor missing in a file.
      const { scene, fieldErrors } = store.get();
      const { latitude, longitude, ...file } = fieldErrors.file;
      actions.changeScene({ ...scene, origin: pair }, event, { place: pair, fieldErrors: { ...fieldErrors, file } });
      (name === "latitude_deg" ? fields.longitude : fields.latitude).redraw?.();
      return true;
    },
    set(value, event) {
      const place = { ...store.get().place, [name]: value };
      actions.changeScene({ ...store.get().scene, origin: originOf(place) }, event, { place });
    },
    optional: true,
  });
  const fields = numberFields({ latitude: sourceOf("latitude_deg"), longitude: sourceOf("longitude_deg") }, store);
  return fields;
}

/** Whether a text is one number, such as 47,1 with a decimal comma, and no pair. @param {string} text */
const isOneNumber = (text) => /^\s*[+-]?\d+(,\d*)?\s*°?\s*$/.test(text.replace("−", "-"));

/** The origin, or null while a number is missing. @param {Partial<Origin>} place @returns {Origin | null} */
const originOf = ({ latitude_deg, longitude_deg }) =>
  latitude_deg !== undefined && longitude_deg !== undefined ? { latitude_deg, longitude_deg } : null;

/** @param {Store} store @param {Actions} actions */
export function altitudeFields(store, actions) {
  /** @param {Altitude} changes @param {Event} [event] */
  const change = (changes, event) => actions.changeAltitude({ ...store.get().altitude, ...changes }, event);
  /** @param {"altitude_m" | "home_altitude_m"} name @returns {Source} */
  const sourceOf = (name) => ({
    quantity: () => "length",
    get: () => store.get().altitude[name],
    set: (value, event) => change({ [name]: value }, event),
    optional: true,
  });
  const reference = choiceField(
    byId("altitude-reference", HTMLElement),
    () => store.get().altitude.altitude_reference ?? "",
    (altitude_reference) => change({ altitude_reference }),
  );
  store.watch(
    ({ altitude }) => [altitude],
    ({ altitude }) => {
      show(byId("home", HTMLElement), needsHome(altitude));
      reference.draw();
    },
  );
  const numbers = numberFields({ altitude: sourceOf("altitude_m"), "home-altitude": sourceOf("home_altitude_m") }, store);
  return { ...numbers, "altitude-reference": reference };
}
