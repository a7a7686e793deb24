// @ts-check
/**
 * Groups of buttons with one tab stop: Tab reaches the group, arrow keys, Home and End move inside it.
 */

import { setAttributes } from "./dom.js";

/** @type {Record<string, (index: number, count: number) => number>} */
const MOVES = {
  ArrowRight: (index, count) => (index + 1) % count,
  ArrowDown: (index, count) => (index + 1) % count,
  ArrowLeft: (index, count) => (index + count - 1) % count,
  ArrowUp: (index, count) => (index + count - 1) % count,
  Home: () => 0,
  End: (_, count) => count - 1,
};

/**
 * Give a group of buttons one tab stop. Returns a function to call when the buttons have been replaced.
 *
 * @param {HTMLElement} group
 */
export function roving(group) {
  const buttons = () =>
    Array.from(group.querySelectorAll(/** @type {"button"} */ ("button, input"))).filter((button) => !button.closest("[hidden]"));
  const indexOf = (/** @type {EventTarget | null} */ target) => buttons().findIndex((button) => button === target);
  let current = Math.max(
    0,
    buttons().findIndex((button) => button.getClientRects().length > 0),
  );
  function mark() {
    const all = buttons();
    current = Math.min(current, Math.max(0, all.length - 1));
    all.forEach((button, i) => setAttributes(button, { tabindex: i === current ? 0 : -1 }));
  }
  group.addEventListener("focusin", ({ target }) => {
    const index = indexOf(target);
    if (index < 0) return;
    current = index;
    mark();
  });
  group.addEventListener("keydown", (event) => {
    const [index, count] = [indexOf(event.target), buttons().length];
    const move = MOVES[event.key];
    if (!move || index < 0 || event.ctrlKey || event.metaKey || event.altKey) return;
    buttons()[move(index, count)].focus();
    event.preventDefault();
  });
  new MutationObserver(mark).observe(group, { subtree: true, attributeFilter: ["hidden"] });
  mark();
  return mark;
}
