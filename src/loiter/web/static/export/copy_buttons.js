// @ts-check
/**
 * Command line, Python and link: shown, and copied.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/actions.js").Actions} Actions
 */
import { linkOf } from "../scene/address.js";
import { byId } from "../shared/dom.js";
import { currentPlan } from "../state/page_state.js";

/**
 * @param {Store} store
 * @param {Actions} actions
 */
export function copyButtons(store, actions) {
  copyButton("copy-python", "Python", () => currentPlan(store.get())?.python, actions);
  copyButton("copy-command", "Command", () => currentPlan(store.get())?.command, actions);
  copyButton("copy-link", "Link", () => linkOf(store.get()), actions);
  store.watch(
    ({ announced }) => [announced],
    ({ announced }) => {
      byId("python", HTMLElement).textContent = announced?.python ?? "";
      byId("command", HTMLElement).textContent = announced?.command ?? "";
    },
  );
}

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
    navigator.clipboard.writeText(copied).then(
      () => actions.say(`${name} copied.`),
      () => actions.say("The browser does not let this page copy; select the text instead.", true),
    );
  });
}
