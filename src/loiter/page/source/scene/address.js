// @ts-check
/**
 * The address of the page is a link to what it shows. Each step of the user is an entry in the history of the browser,
 * so that Back, and the button that undoes, return to the state before.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Actions} from "../state/actions.js"
 *
 * @typedef {Pick<PageState, "step" | "scene" | "place" | "altitude" | "camera">} Entry  of the history
 */
import { spanOf } from "../plan/camera.js";
import { PAUSE_MS, byId, debounced, isTyping } from "../shared/dom.js";
import { recall } from "../shared/storage.js";
import { asUnits } from "../shared/units.js";
import { fromLink, toLink } from "./link.js";
import { PRESETS } from "./presets.js";

/** @type {import("./link.js").Linked} */
const FIRST = { scene: PRESETS[0].scene, units: null, altitude: {}, view: null };

let opened = ""; // the link that the page showed last without a step of the user

/** The fragment that links to the state. @param {PageState} state */
const fragmentOf = ({ scene, units, altitude, camera }) => toLink({ scene, units, altitude, view: spanOf(camera) });

/** The link to the state. @param {PageState} state */
export const linkOf = (state) => location.href.replace(/[?#].*/, "") + fragmentOf(state);

/**
 * Open the link in the address: now, whenever the user changes it, and after Back and Forward.
 *
 * @param {Store} store
 * @param {Actions} actions
 */
export function openAddress(store, actions) {
  addEventListener("popstate", ({ state }) => isEntry(state) && actions.returnTo(state));
  // Back and Forward change the address too, but have an entry.
  addEventListener("hashchange", () => isEntry(history.state) || open(actions));
  // After a reload the steps before can still be undone.
  const { step } = isEntry(history.state) ? history.state : { step: 0 };
  open(actions);
  store.update({ step, lastStep: step });
}

/** Whether the address is a link that the user has set and that is not opened yet. */
const isUnopened = () => history.state === null && location.hash !== opened;

/** @param {unknown} state @returns {state is Entry} */
const isEntry = (state) => typeof state === "object" && state !== null && "step" in state && "scene" in state;

/**
 * Keep address and history up to date: a new entry for each step, the same entry for other changes.
 *
 * @param {Store} store
 */
export function writeAddress(store) {
  let last = store.get();
  let isWritten = false;

  /** @param {PageState} state */
  function write(state) {
    // Its event is still to come; what is written now would take its place.
    if (isUnopened()) return;
    const { step, scene, place, altitude, camera } = state;
    /** @type {Entry} */
    const entry = { step, scene, place, altitude, camera };
    // An entry without a state is new: the user has opened the page, or a link on it.
    // In a page that embeds this one, Back belongs to that page.
    if (parent === window && isEntry(history.state) && step > history.state.step) history.pushState(entry, "", fragmentOf(state));
    else history.replaceState(entry, "", fragmentOf(state));
    opened = "";
    isWritten = true;
  }
  const writeLater = debounced(PAUSE_MS, () => isWritten || write(last));
  store.watch(
    ({ scene, units, altitude, camera, place, step }) => [scene, units, altitude, camera, place, step],
    (state) => {
      // The state before a step is complete; it must not be lost because the step follows at once.
      if (state.step > last.step && !isWritten) write(last);
      [last, isWritten] = [state, false];
      writeLater();
    },
  );
  return { flush: () => isWritten || write(last) };
}

/**
 * The buttons that undo and redo a step, and their keys: ctrl Z, ctrl Y and ctrl shift Z.
 *
 * @param {Store} store
 * @param {{flush: () => void}} address
 */
export function undoButtons(store, { flush }) {
  /** @param {"back" | "forward"} direction */
  function go(direction) {
    const { step, lastStep } = store.get();
    if (direction === "back" ? step === 0 : step === lastStep) return;
    flush();
    history[direction]();
  }
  const buttons = { back: byId("undo", HTMLButtonElement), forward: byId("redo", HTMLButtonElement) };
  buttons.back.addEventListener("click", () => go("back"));
  buttons.forward.addEventListener("click", () => go("forward"));
  addEventListener("keydown", (event) => {
    const direction = directionOf(event);
    // In a field these keys undo the typing.
    if (!direction || isTyping(event.target)) return;
    go(direction);
    event.preventDefault();
  });
  store.watch(
    ({ step, lastStep }) => [step, lastStep],
    ({ step, lastStep }) => {
      buttons.back.setAttribute("aria-disabled", String(step === 0));
      buttons.forward.setAttribute("aria-disabled", String(step === lastStep));
    },
  );
}

/** @param {KeyboardEvent} event @returns {"back" | "forward" | null} */
function directionOf({ key, ctrlKey, metaKey, altKey, shiftKey }) {
  if (!(ctrlKey || metaKey) || altKey) return null;
  if (key.toLowerCase() === "z") return shiftKey ? "forward" : "back";
  return key.toLowerCase() === "y" ? "forward" : null;
}

/** @param {Actions} actions */
function open(actions) {
  opened = location.hash;
  const { linked, error } = read(opened);
  const { scene, units, altitude, view } = linked;
  actions.openScene({ scene, units: units ?? asUnits(recall("units")), altitude, place: { ...scene.origin } }, view);
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
