// @ts-check
/**
 * Handles: things on a drawing that a mouse, a finger or the arrow keys move. To assistive software each is a slider
 * whose text tells both of its numbers.
 *
 * @typedef {[number, number]} Point
 * @typedef {object} Moves
 * @property {() => Point} where  where the handle is now, pixels of the drawing
 * @property {(point: Point, event: Event) => void} to  drag it to a point
 * @property {(right: number, up: number, event: Event) => void} by  move it by steps: 1, with shift 10
 */

import { set } from "./svg.js";

// A slider has to have ends; the plane has none.
const FAR = 1e9;

/** @type {Record<string, Point>} */
const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * Where a pointer is on a drawing, pixels from its upper left corner.
 *
 * @param {Element} drawing
 * @param {MouseEvent} event
 * @returns {Point}
 */
export function pointOf(drawing, event) {
  const box = drawing.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/**
 * Make a group of a drawing a handle.
 *
 * @param {SVGGElement} group
 * @param {Element} drawing
 * @param {string} label
 * @param {Moves} moves
 */
export function makeHandle(group, drawing, label, moves) {
  group.classList.add("handle");
  set(group, { tabindex: 0, role: "slider", "aria-label": label, "aria-valuemin": -FAR, "aria-valuemax": FAR });
  drags(group, drawing, moves);
  group.addEventListener("keydown", (event) => {
    const arrow = ARROWS[event.key];
    if (!arrow || event.ctrlKey || event.metaKey || event.altKey) return;
    const steps = event.shiftKey ? 10 : 1;
    moves.by(arrow[0] * steps, arrow[1] * steps, event);
    event.preventDefault();
    event.stopPropagation();
  });
}

/**
 * @param {SVGGElement} group
 * @param {Element} drawing
 * @param {Moves} moves
 */
function drags(group, drawing, { where, to }) {
  /** @type {{pointer: number, offset: Point} | null} */
  let held = null;
  // Else the browser takes a vertical move for scrolling and cancels the drag: Chromium asks the drawing, not the group
  // in it, for its touch-action.
  group.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });
  group.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || held) return;
    const [x, y] = pointOf(drawing, event);
    const [left, top] = where();
    // A handle is dragged by the point where it was taken, so that it does not jump under the pointer.
    held = { pointer: event.pointerId, offset: [x - left, y - top] };
    group.setPointerCapture(event.pointerId);
    group.classList.add("held");
    group.focus({ preventScroll: true });
    event.preventDefault();
    event.stopPropagation();
  });
  group.addEventListener("pointermove", (event) => {
    if (held?.pointer !== event.pointerId) return;
    const [x, y] = pointOf(drawing, event);
    to([x - held.offset[0], y - held.offset[1]], event);
    event.stopPropagation();
  });
  for (const end of /** @type {const} */ (["pointerup", "pointercancel", "lostpointercapture"]))
    group.addEventListener(end, (event) => {
      if (held?.pointer !== event.pointerId) return;
      held = null;
      group.classList.remove("held");
    });
}

/**
 * Tell what a handle stands at.
 *
 * @param {SVGGElement} group
 * @param {Point} point where it is drawn
 * @param {number} value
 * @param {string} text
 */
export function place(group, [x, y], value, text) {
  const transform = `translate(${x.toFixed(2)} ${y.toFixed(2)})`;
  set(group, { transform, "aria-valuenow": value, "aria-valuetext": text });
}
