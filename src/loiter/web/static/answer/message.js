// @ts-check
/**
 * The message over the plan view.
 *
 * @typedef {import("../state/store.js").Store} Store
 */
import { byId } from "../shared/dom.js";

/** @param {Store} store */
export function messageView(store) {
  const element = byId("message", HTMLElement);
  store.watch(
    ({ message }) => [message],
    ({ message: { text, bad } }) => {
      element.textContent = text;
      element.classList.toggle("bad", bad);
    },
  );
}
