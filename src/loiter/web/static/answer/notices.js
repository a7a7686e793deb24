// @ts-check
/**
 * The message over the plan view, and a scene without a plan: the page says why, disables everything that needs the
 * plan, and shows the previous plan faintly.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/actions.js").Actions} Actions
 * @typedef {import("../requests/requests.js").Requests} Requests
 * @typedef {import("../requests/retry.js").Attempt} Attempt
 */
import { byId, show } from "../shared/dom.js";

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

const REASON_IDS = "no-plan refusal"; // the elements that say why a button is disabled

/**
 * @param {Store} store
 * @param {Actions} actions
 * @param {Requests} requests
 */
export function failureView(store, actions, requests) {
  const button = byId("again", HTMLButtonElement);
  button.addEventListener("click", requests.retry);
  // Runs before the listeners of the buttons themselves.
  addEventListener("click", (event) => stopDisabled(event) && actions.say("This scene has no plan.", true), {
    capture: true,
  });
  store.watch(
    ({ failure }) => [failure],
    ({ failure }) => {
      byId("main", HTMLElement).classList.toggle("stale", failure !== null);
      show(byId("refusal", HTMLElement), failure !== null);
      setDisabled(failure !== null);
      byId("why", HTMLElement).textContent = failure?.sentence ?? "";
      show(byId("retry", HTMLElement), failure?.name === "unreachable");
      byId("attempt", HTMLElement).textContent = attemptText(failure?.attempt ?? null);
      button.textContent = failure?.attempt ? "Try now" : "Try again";
    },
  );
}

/**
 * Stop a click on a disabled button. Returns whether the button was disabled.
 *
 * @param {Event} event
 */
function stopDisabled(event) {
  const target = event.target instanceof Element ? event.target.closest("[data-needs-plan]") : null;
  if (target?.getAttribute("aria-disabled") !== "true") return false;
  event.stopImmediatePropagation();
  event.preventDefault();
  return true;
}

/**
 * Disable or enable what uses the plan of the scene. Buttons can still be focused, so that they can say why.
 *
 * @param {boolean} disabled
 */
function setDisabled(disabled) {
  for (const each of document.querySelectorAll("[data-needs-plan]")) {
    if (each instanceof HTMLInputElement) each.disabled = disabled;
    else each.setAttribute("aria-disabled", String(disabled));
    if (disabled) each.setAttribute("aria-describedby", REASON_IDS);
    else each.removeAttribute("aria-describedby");
  }
  for (const each of document.querySelectorAll("[data-shows-plan]")) each.toggleAttribute("inert", disabled);
}

/** @param {Attempt | null} attempt */
const attemptText = (attempt) =>
  attempt
    ? `Retrying in ${attempt.wait_s} s, attempt ${attempt.number} of ${attempt.of}.`
    : "All attempts have failed.";
