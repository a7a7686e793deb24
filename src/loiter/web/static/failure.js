// @ts-check
/**
 * A scene without a plan: the headline says why, what would use the last plan is switched off, and that plan is faint.
 *
 * @typedef {import("./retry.js").Attempt} Attempt
 *
 * @typedef {object} Failure
 * @property {"refused" | "unreachable"} name  the service refuses the scene, or does not answer
 * @property {string} headline
 * @property {string} sentence
 * @property {Attempt | null} attempt  when the service is asked again
 */
import { byId, show } from "./svg.js";

const REASON = "no-plan refusal"; // the elements that say why a button is off

/**
 * @param {() => void} again  ask the service at once
 * @param {(sentence: string, bad: boolean) => void} say
 */
export function failureView(again, say) {
  const main = byId("main", HTMLElement);
  const headline = byId("instruction", HTMLElement);
  const refusal = byId("refusal", HTMLElement);
  const why = byId("why", HTMLElement);
  const retry = byId("retry", HTMLElement);
  const attempt = byId("attempt", HTMLElement);
  const button = byId("again", HTMLButtonElement);
  button.addEventListener("click", again);
  // Before the buttons' own listeners.
  addEventListener("click", (event) => blocked(event) && say("This scene has no plan.", true), { capture: true });

  /** @param {Failure | null} failure */
  function draw(failure) {
    main.classList.toggle("stale", failure !== null);
    headline.classList.toggle("bad", failure !== null);
    show(refusal, failure !== null);
    switchOff(failure !== null);
    why.textContent = failure?.sentence ?? "";
    if (!failure) return;
    headline.textContent = failure.headline;
    show(retry, failure.name === "unreachable");
    attempt.textContent = told(failure.attempt);
    button.textContent = failure.attempt ? "Try now" : "Try again";
  }
  return { draw };
}

/**
 * Whether a click is on a button that is switched off; it goes no further then.
 *
 * @param {Event} event
 */
function blocked(event) {
  const target = event.target instanceof Element ? event.target.closest("[data-needs-plan]") : null;
  if (target?.getAttribute("aria-disabled") !== "true") return false;
  event.stopImmediatePropagation();
  event.preventDefault();
  return true;
}

/**
 * Switch off, or on again, what uses the plan of the scene. Buttons stay within reach of the keyboard, to say why.
 *
 * @param {boolean} off
 */
function switchOff(off) {
  for (const each of document.querySelectorAll("[data-needs-plan]")) {
    if (each instanceof HTMLInputElement) each.disabled = off;
    else each.setAttribute("aria-disabled", String(off));
    if (off) each.setAttribute("aria-describedby", REASON);
    else each.removeAttribute("aria-describedby");
  }
  for (const each of document.querySelectorAll("[data-shows-plan]")) each.toggleAttribute("inert", off);
}

/** @param {Attempt | null} attempt */
const told = (attempt) =>
  attempt
    ? `Asking again in ${attempt.wait_s} s, attempt ${attempt.number} of ${attempt.of}.`
    : "It was asked again and again, and does not answer.";
