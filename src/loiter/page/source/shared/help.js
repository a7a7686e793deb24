// @ts-check
/** The help: what the page is, its keys, and what its terms mean, each of which opens it at its explanation. */
import { byId, isTyping } from "./dom.js";

export function help() {
  const dialog = byId("help", HTMLDialogElement);
  /** @param {string} [term] */
  function open(term) {
    if (!dialog.open) dialog.showModal();
    if (term) byId(`about-${term}`, HTMLElement).scrollIntoView({ block: "center" });
  }
  byId("open-help", HTMLElement).addEventListener("click", () => open());
  byId("close-help", HTMLElement).addEventListener("click", () => dialog.close());
  // Beside it.
  dialog.addEventListener("click", ({ target }) => target === dialog && dialog.close());
  for (const button of document.querySelectorAll("[data-term]"))
    button.addEventListener("click", () => open(button.getAttribute("data-term") ?? ""));
  addEventListener("keydown", ({ key, target }) => key === "?" && !isTyping(target) && open());
}
