// @ts-check
/**
 * The list of the fence's zones: new ones, their rule, the corners of polygons, and the margin.
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 * @import {Scene, Zone} from "../shared/types.js"
 * @import {View} from "../shared/geometry.js"
 * @import {Field, Source} from "./input_fields.js"
 */
import {
  freeName,
  isPolygon,
  LEAST_CORNERS,
  withCornerMore,
  withMargin,
  withoutCorner,
  withoutZone,
  withZone,
  withZones,
  zonesOf,
} from "../scene/fence.js";
import { byId, fill, part, show } from "../shared/dom.js";
import { toWorld } from "../shared/geometry.js";
import { sixDigits, tidy, unitOf } from "../shared/units.js";
import { numberField } from "./input_fields.js";
import { parseNumber } from "./number_text.js";

// Where a new zone appears on the plan, and its size, as shares of the width and the height.
const NEW = { right: 0.7, down: 0.3, size: 0.07, step: 0.05 };

/** What the buttons of a zone do: the scene afterwards. @type {Record<string, (scene: Scene, i: number) => Scene>} */
const BUTTONS = {
  remove: withoutZone,
  "more-corners": (scene, i) => changed(scene, i, (zone) => (isPolygon(zone) ? withCornerMore(zone) : zone)),
  "fewer-corners": (scene, i) => changed(scene, i, (zone) => (isPolygon(zone) ? withoutCorner(zone) : zone)),
};

/** @param {Scene} scene @param {number} i @param {(zone: Zone) => Zone} change */
const changed = (scene, i, change) => withZone(scene, i, change(zonesOf(scene)[i]));

/** @param {Store} store @param {Actions} actions @returns {Record<string, Field>} */
export function fenceFields(store, actions) {
  const list = byId("zones", HTMLElement);
  /** @param {Event} event @returns {[string, number]} */
  const pointed = ({ target }) => {
    const control = /** @type {HTMLElement} */ (target).closest("[data-act]");
    return [control?.getAttribute("data-act") ?? "", Number(control?.getAttribute("data-zone"))];
  };
  list.addEventListener("click", (event) => {
    const [act, i] = pointed(event);
    if (!BUTTONS[act]) return;
    actions.changeScene(BUTTONS[act](store.get().scene, i), event);
    if (act === "remove") byId("add-circle", HTMLElement).focus();
  });
  list.addEventListener("change", (event) => {
    const [, i] = pointed(event);
    const inclusion = /** @type {HTMLSelectElement} */ (event.target).value === "in";
    actions.changeScene(changed(store.get().scene, i, (zone) => ({ ...zone, inclusion })), event);
  });
  for (const [id, kind] of Object.entries({ "add-circle": "circle", "add-polygon": "polygon" }))
    byId(id, HTMLButtonElement).addEventListener("click", (event) => {
      const { scene, camera } = store.get();
      const zones = zonesOf(scene);
      const zone = newZone(kind, camera.view, zones);
      actions.changeScene(withZones(scene, [...zones, zone]), event);
      actions.say(`Zone ${zone.name}: drag it, or press Tab in the plan to reach it.`);
    });
  store.watch(
    ({ scene }) => [scene.fence],
    ({ scene }) => {
      const zones = zonesOf(scene);
      fill(list, zones.map(rowOf));
      list.querySelectorAll("select").forEach((select, i) => (select.value = zones[i].inclusion ? "in" : "out"));
      show(byId("fence", HTMLElement), zones.length > 0);
    },
  );
  return { margin: marginField(store, actions) };
}

/** @param {Store} store @param {Actions} actions */
function marginField(store, actions) {
  const input = byId("margin", HTMLInputElement);
  /** @type {Source} */
  const source = {
    quantity: () => "length",
    get: () => store.get().scene.fence?.margin_m ?? undefined,
    parse(text) {
      const entry = parseNumber(text, "length", store.get().units);
      return "value" in entry && entry.value < 0 ? { problem: `is ${text.trim()}: it must be zero or more.` } : entry;
    },
    set: (value, event) => actions.changeScene(withMargin(store.get().scene, value ?? null), event),
    optional: true,
  };
  store.watch(
    ({ units, fence }) => [units, fence],
    ({ units, fence }) => {
      if (fence?.check) input.placeholder = String(sixDigits(fence.check.margin_m / unitOf("length", units).size));
    },
  );
  return numberField(input.id, source, store);
}

/** A new zone in a corner of the plan. @param {string} kind @param {View} view @param {Zone[]} zones @returns {Zone} */
function newZone(kind, view, zones) {
  const down = NEW.down + NEW.step * zones.length;
  const size_px = NEW.size * Math.min(view.width, view.height) + 12;
  const resolution = 1 / view.scale;
  const [x, y] = [NEW.right * view.width, (down % 0.8) * view.height];
  /** @param {number} right @param {number} up @returns {[number, number]} */
  const place = (right, up) => {
    const [east, north] = toWorld(view, [x + right * size_px, y - up * size_px]);
    return [tidy(east, resolution), tidy(north, resolution)];
  };
  const name = freeName(zones);
  if (kind === "polygon") return { name, corners: [place(-1, -1), place(1, -1), place(1, 1), place(-1, 1)], inclusion: false };
  const [east_m, north_m] = place(0, 0);
  return { name, east_m, north_m, radius_m: tidy(size_px / view.scale, resolution), inclusion: false };
}

/** The row of a zone. @param {Zone} zone @param {number} i */
function rowOf(zone, i) {
  /** @param {string} act @param {string} label @param {string} text @param {boolean} [disabled] */
  const button = (act, label, text, disabled = false) =>
    part("button", { type: "button", class: "icon", "data-act": act, "data-zone": i, "aria-label": label, "aria-disabled": String(disabled) }, [text]);
  const rule = part("select", { "data-act": "rule", "data-zone": i, "aria-label": `Rule of zone ${zone.name}` }, [
    part("option", { value: "out" }, ["stay out"]),
    part("option", { value: "in" }, ["stay in"]),
  ]);
  const corners = isPolygon(zone)
    ? [
        part("span", { class: "corners" }, [
          button("fewer-corners", `Remove a corner of zone ${zone.name}`, "−", zone.corners.length <= LEAST_CORNERS),
          part("span", {}, [`${zone.corners.length} corners`]),
          button("more-corners", `Add a corner to zone ${zone.name}`, "+"),
        ]),
      ]
    : [];
  return part("li", {}, [
    part("span", { class: "name" }, [zone.name]),
    rule,
    button("remove", `Remove zone ${zone.name}`, "×"),
    ...corners,
  ]);
}
