// @ts-check
/**
 * The message over the plan view, and a scene without a plan: the page says why, disables everything that needs the
 * plan, shows the previous plan faintly, and offers a radius for a circle that is too small.
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 */
import { withOrbit } from "../scene/scene.js";
import { byId, html, show } from "../shared/dom.js";
import { powerBelow, sixDigits, tidyAbove, unitOf } from "../shared/units.js";

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

/** @param {Store} store @param {Actions} actions */
export function failureView(store, actions) {
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
    },
  );
}

/**
 * The buttons that replace a circle that cannot be held by the circle with the least radius that can be: beside the
 * message, and below the field.
 *
 * @param {Store} store
 * @param {Actions} actions
 */
export function fitView(store, actions) {
  const inForm = html("button", { type: "button", class: "offer", tabindex: -1 });
  const buttons = [byId("fit-circle", HTMLButtonElement), inForm];
  byId("circle-radius-fault", HTMLElement).after(inForm);
  for (const button of buttons)
    button.addEventListener("click", (event) => {
      const { scene, failure } = store.get();
      if (!failure?.fittedRadius_m) return;
      actions.changeScene(withOrbit(scene, { radius_m: rounded(failure.fittedRadius_m) }), event);
      actions.say(`A circle of ${text(scene.orbit.radius_m)} cannot be held; this is the least radius.`);
    });
  store.watch(
    ({ failure, units }) => [failure, units],
    ({ failure }) => {
      const radius_m = failure?.fittedRadius_m ?? null;
      for (const button of buttons) {
        show(button, radius_m !== null);
        if (radius_m !== null) button.textContent = `Use ${text(rounded(radius_m))}, the least radius`;
      }
    },
  );

  /** The least radius, rounded up to some 5 digits. @param {number} radius_m */
  const rounded = (radius_m) => tidyAbove(radius_m, powerBelow(radius_m, 1e-4));

  /** A radius with the digits of its field. @param {number} radius_m */
  function text(radius_m) {
    const { name, size } = unitOf("length", store.get().units);
    return `${sixDigits(radius_m / size)} ${name}`;
  }
}

/** Stop a click on a disabled button. Returns whether the button was disabled. @param {Event} event */
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
