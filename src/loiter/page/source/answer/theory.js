// @ts-check
/**
 * The theory behind the plan: the verdict of the certificate, the lines of phi and psi, and the reduced plane. It is
 * open on wide screens, and behind the button "Why" on others.
 *
 * @import {Store} from "../state/store.js"
 */
import { byId, show } from "../shared/dom.js";

/** Screens with room for the theory beside the plan and the fields. */
const WIDE = "(min-width: 1181px)";

const PARTS = ["proof", "map-part"];

/** @param {Store} store */
export function theoryView(store) {
  const button = byId("theory", HTMLButtonElement);
  const wide = matchMedia(WIDE);
  let isChosen = false;
  store.update({ theory: wide.matches });
  wide.addEventListener("change", () => isChosen || store.update({ theory: wide.matches }));
  button.addEventListener("click", () => {
    isChosen = true;
    store.update({ theory: !store.get().theory });
  });
  store.watch(
    ({ theory }) => [theory],
    ({ theory }) => {
      button.setAttribute("aria-expanded", String(theory));
      byId("main", HTMLElement).classList.toggle("theory", theory);
      for (const id of PARTS) show(byId(id, HTMLElement), theory);
    },
  );
}

/** The link that skips header and examples. The address must stay the link to the scene. */
export function skipLink() {
  document.querySelector(".skip")?.addEventListener("click", (event) => {
    byId("plan", SVGSVGElement).focus();
    event.preventDefault();
  });
}
