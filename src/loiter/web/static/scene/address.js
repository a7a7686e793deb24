// @ts-check
/**
 * The address of the page is a link to what it shows.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/page_state.js").PageState} PageState
 * @typedef {import("../state/actions.js").Actions} Actions
 */
import { spanOf } from "../plan/camera.js";
import { PAUSE_MS, debounced } from "../shared/dom.js";
import { fromLink, toLink } from "./link.js";
import { PRESETS } from "./presets.js";

/** @type {import("./link.js").Linked} */
const FIRST = { scene: PRESETS[0].scene, units: "metric", altitude: {}, view: null };

/** The fragment that links to the state. @param {PageState} state */
const fragmentOf = ({ scene, units, altitude, camera }) => toLink({ scene, units, altitude, view: spanOf(camera) });

/** The link to the state. @param {PageState} state */
export const linkOf = (state) => location.origin + location.pathname + fragmentOf(state);

/**
 * Open the link in the address, now and whenever it changes.
 *
 * @param {Actions} actions
 */
export function openAddress(actions) {
  addEventListener("hashchange", () => open(actions));
  open(actions);
}

/**
 * Keep the address up to date.
 *
 * @param {Store} store
 */
export function writeAddress(store) {
  const write = debounced(PAUSE_MS, () => history.replaceState(null, "", fragmentOf(store.get())));
  store.watch(({ scene, units, altitude, camera }) => [scene, units, altitude, camera], write);
}

/** @param {Actions} actions */
function open(actions) {
  const { linked, error } = read(location.hash);
  const { scene, units, altitude, view } = linked;
  actions.openScene({ scene, units, altitude, place: { ...scene.origin } }, view);
  if (error) actions.say(error, true);
}

/** What a fragment links to; the first preset if there is none, or if it has an error. @param {string} hash */
function read(hash) {
  if (hash.length < 2) return { linked: FIRST, error: "" };
  try {
    return { linked: fromLink(hash), error: "" };
  } catch (error) {
    return { linked: FIRST, error: /** @type {Error} */ (error).message };
  }
}
