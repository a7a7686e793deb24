// @ts-check
/**
 * Map tiles behind the plan view, once the user has switched them on: until then nothing is requested from another
 * machine. They are drawn by a document of its own, whose security policy allows pictures from the one tile server.
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 */
import { markInvalid, errorLine } from "../fields/input_fields.js";
import { byId, html, show } from "../shared/dom.js";
import { recall, remember } from "../shared/storage.js";

/** The tile server unless the user gives another: that of OpenStreetMap. */
const DEFAULT_TILES = "https://tile.openstreetmap.org/{z}/{x}/{y}.png";

/** @param {Store} store @param {Actions} actions */
export function tileLayer(store, actions) {
  const box = byId("plan-box", HTMLElement);
  /** @type {HTMLIFrameElement | null} */
  let frame = null;

  function send() {
    const { camera, scene, theme } = store.get();
    if (scene.origin) frame?.contentWindow?.postMessage({ view: camera.view, origin: scene.origin, theme }, location.origin);
  }
  /** @param {string | null} template */
  function use(template) {
    frame?.remove();
    frame = null;
    if (template === null) return;
    const src = `map.html?${new URLSearchParams({ tiles: template })}`;
    frame = html("iframe", { id: "tiles", src, title: "Map", tabindex: "-1", "aria-hidden": "true" });
    box.prepend(frame);
  }
  addEventListener("message", ({ source, origin, data }) => {
    if (frame === null || source !== frame.contentWindow || origin !== location.origin) return;
    // After a tile has arrived too: then those of the scale before may go.
    if (data.isLoaded !== false) send();
    else actions.say(`No map: ${hostOf(store.get().tiles)} does not send its tiles.`, true);
  });
  store.watch(
    ({ tiles, scene }) => [tiles, scene.origin === null],
    ({ tiles, scene }) => {
      use(scene.origin === null ? null : tiles);
      drawAttribution(scene.origin === null ? null : tiles);
      box.classList.toggle("mapped", frame !== null);
    },
  );
  store.watch(({ tiles, camera, scene, theme }) => [tiles, camera, scene.origin, theme], send);
  tileSwitch(store, actions);
}

/** @param {string | null} template */
const hostOf = (template) => new URL(template ?? DEFAULT_TILES).host;

/** Who made the map. @param {string | null} template */
function drawAttribution(template) {
  const line = byId("attribution", HTMLElement);
  show(line, template !== null);
  if (template === DEFAULT_TILES)
    line.replaceChildren(
      "© ",
      html("a", { href: "https://www.openstreetmap.org/copyright", target: "_blank", rel: "noopener noreferrer" }, [
        "OpenStreetMap contributors",
      ]),
    );
  else line.textContent = template === null ? "" : `Tiles: ${hostOf(template)}`;
}

/** The switch, and the field for the address of a tile server. @param {Store} store @param {Actions} actions */
function tileSwitch(store, actions) {
  const toggle = byId("map-tiles", HTMLInputElement);
  const field = byId("tile-server", HTMLInputElement);
  const line = errorLine(field);
  // A page from a folder may not show the document that draws the tiles.
  show(byId("map-switch", HTMLElement), location.protocol !== "file:");
  field.placeholder = DEFAULT_TILES;
  field.value = recall("tiles") ?? "";

  function change() {
    const template = field.value.trim() || DEFAULT_TILES;
    const problem = problemOf(template);
    markInvalid(field, problem !== "");
    line.textContent = problem;
    remember("tiles", field.value.trim());
    if (problem !== "") toggle.checked = false;
    store.update({ tiles: toggle.checked ? template : null });
    const lacksPlace = toggle.checked && store.get().scene.origin === null;
    if (problem !== "" || lacksPlace) field.closest("details")?.setAttribute("open", "");
    if (lacksPlace) {
      byId("latitude", HTMLInputElement).focus();
      actions.say("The map needs the position of (0, 0) on Earth.", true);
    }
  }
  // Browsers restore the state of a switch after a reload; the map is never on unless the user has switched it on.
  toggle.checked = false;
  toggle.addEventListener("change", change);
  field.addEventListener("change", change);
}

/** What is wrong with the address of a tile server, or nothing. @param {string} template */
function problemOf(template) {
  const sentence = `The tile server is "${template}": write a URL with {z}, {x} and {y}, such as ${DEFAULT_TILES}.`;
  if (!["{z}", "{x}", "{y}"].every((part) => template.includes(part))) return sentence;
  return /^https?:\/\/[\w.:[\]-]+\//.test(template) && URL.canParse(template) ? "" : sentence;
}
