// @ts-check
/**
 * The buttons that save the plan in a file, or copy its command line, its Python or its link.
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 * @import {Fields} from "../fields/fields.js"
 * @import {FieldErrors} from "../state/page_state.js"
 * @import {Format} from "./formats.js"
 */
import { refusalOf } from "../fields/field_names.js";
import { fileOf } from "../requests/answers.js";
import { linkOf } from "../scene/address.js";
import { byId, html, show } from "../shared/dom.js";
import { currentPlan } from "../state/page_state.js";
import { FORMATS, LEG_FORMATS, altitudeFor, missingFor, savedText } from "./formats.js";

const KEPT_MS = 60_000; // an address of a file is kept until the browser has surely read it

/** @param {Store} store @param {Actions} actions @param {Fields} fields */
export function exportPanel(store, actions, fields) {
  /** @param {FieldErrors} file */
  const mark = (file) => store.update({ fieldErrors: { ...store.get().fieldErrors, file } });

  /** Mark what is missing, and go to the first field. @param {FieldErrors} missing */
  function askFor(missing) {
    mark(missing);
    const [[first, sentence]] = Object.entries(missing);
    const field = byId(first, HTMLElement);
    (field.querySelector("input") ?? field).focus();
    actions.say(sentence, true);
  }

  /** @param {Error} error */
  function refuse(error) {
    const refusal = refusalOf(error, store.get().units);
    mark(refusal.fields);
    actions.say(refusal.sentence, true);
  }

  /** @type {Format | null} */
  let waiting = null; // the file that is saved once nothing is missing

  /** @param {Format} format */
  function save(format) {
    const missing = missingFor(format.kind, store.get(), fields);
    const isReady = Object.keys(missing).length === 0;
    waiting = isReady ? null : format;
    if (isReady) saveFile(format, store, actions).catch(refuse);
    else askFor(missing);
  }

  for (const format of FORMATS) {
    const button = formatButton(format);
    button.addEventListener("click", () => save(format));
    byId("formats", HTMLElement).append(button);
    store.watch(
      ({ scene }) => [scene.leg === null],
      ({ scene }) => show(button, !scene.leg || LEG_FORMATS.includes(format.format)),
    );
  }
  // Enter in a field, and a tap on a choice, lead to the next one that is missing, and at last to the file.
  const earth = byId("earth", HTMLElement);
  let isTapped = false; // arrow keys choose too, and do not lead on
  addEventListener("pointerdown", ({ target }) => {
    isTapped = earth.contains(/** @type {Node} */ (target));
    if (!isTapped) waiting = null;
  });
  earth.addEventListener("keydown", ({ key, target }) => {
    isTapped = false;
    if (key === "Enter" && waiting && target instanceof HTMLInputElement) save(waiting);
  });
  earth.addEventListener("change", ({ target }) => {
    if (isTapped && waiting && target instanceof HTMLInputElement && target.type === "radio") save(waiting);
  });
}

/** @param {Format} format */
function formatButton({ format, name, use, about }) {
  const label = { title: about ? `${use}: ${about}` : use, "aria-label": `Save ${name}, ${use}` };
  return html("button", { type: "button", ...label, "data-format": format, "data-needs-plan": "" }, [name]);
}

/** @param {Format} format @param {Store} store @param {Actions} actions */
async function saveFile({ format, kind }, store, actions) {
  const state = store.get();
  const options = { ...state.scene, ...altitudeFor(kind, state.altitude) };
  const name = `${state.scene.leg ? "leg" : "entry"}.${format}`;
  download(await fileOf(format, options), name);
  actions.say(savedText(name, kind, state));
}

/** @param {Blob} content @param {string} name */
function download(content, name) {
  const address = URL.createObjectURL(content);
  html("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), KEPT_MS);
}

/** Where to find what a page is not allowed to copy. @type {Record<string, string>} */
const WHERE = { Link: "the address of the page is the link", text: "select the text under Command and Python" };

/** @param {Store} store @param {Actions} actions */
export function copyButtons(store, actions) {
  copyButton("copy-python", "Python", () => textsOf(store.get())?.python, actions);
  copyButton("copy-command", "Command", () => textsOf(store.get())?.command, actions);
  copyButton("copy-link", "Link", () => linkOf(store.get()), actions);
  store.watch(
    ({ announced }) => [announced],
    ({ announced, leg }) => {
      const texts = announced && (leg ?? announced);
      byId("python", HTMLElement).textContent = texts?.python ?? "";
      byId("command", HTMLElement).textContent = texts?.command ?? "";
    },
  );
}

/** Command and Python of the leg or the plan. @param {import("../state/page_state.js").PageState} state */
const textsOf = (state) => currentPlan(state) && (state.leg ?? currentPlan(state));

/**
 * @param {string} id
 * @param {string} name
 * @param {() => string | undefined} text  undefined while the scene has no plan
 * @param {Actions} actions
 */
function copyButton(id, name, text, actions) {
  byId(id, HTMLButtonElement).addEventListener("click", () => {
    const copied = text();
    if (copied === undefined) return actions.say("The plan of this scene is not ready yet.", true);
    // Browsers have no clipboard for pages without https.
    (navigator.clipboard?.writeText(copied) ?? Promise.reject()).then(
      () => actions.say(`${name} copied.`),
      () => actions.say(`The browser does not let this page copy: ${WHERE[name] ?? WHERE.text}.`, true),
    );
  });
}
