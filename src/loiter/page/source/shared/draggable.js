// @ts-check
/**
 * Handles: parts of a drawing that are moved by mouse, finger or arrow keys. Assistive software sees a slider, whose
 * text gives both coordinates.
 *
 * @import {Point} from "./geometry.js"
 *
 * @typedef {object} Moves
 * @property {() => void} [begin]  a drag begins
 * @property {() => Point} position  of the handle now, pixels of the drawing
 * @property {(point: Point, event: Event) => void} dragTo
 * @property {(right: number, up: number, event: Event) => void} moveBy  steps: 1, or 10 with the shift key
 * @property {(event: Event) => void} [remove]  the key Delete removes what the handle moves
 */
import { setAttributes } from "./dom.js";

// A slider must have limits; the plane has none.
const SLIDER_LIMIT = 1e9;

/** @type {Record<string, Point>} */
const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** The events after which a pointer is no longer down. */
export const POINTER_ENDS = /** @type {const} */ (["pointerup", "pointercancel", "lostpointercapture"]);

/** Whether a key is pressed together with ctrl, alt or meta: a shortcut of the browser. @param {KeyboardEvent} event */
export const isShortcut = (event) => event.ctrlKey || event.metaKey || event.altKey;

/**
 * The position of a pointer on a drawing, pixels from its upper left corner.
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
  const limits = { "aria-valuemin": -SLIDER_LIMIT, "aria-valuemax": SLIDER_LIMIT };
  setAttributes(group, { tabindex: 0, role: "slider", "aria-label": label, ...limits });
  followPointer(group, drawing, moves);
  group.addEventListener("keydown", (event) => {
    const arrow = ARROWS[event.key];
    if (moves.remove && ["Delete", "Backspace"].includes(event.key)) {
      moves.remove(event);
      return event.preventDefault();
    }
    if (!arrow || isShortcut(event)) return;
    const steps = event.shiftKey ? 10 : 1;
    moves.moveBy(arrow[0] * steps, arrow[1] * steps, event);
    event.preventDefault();
    event.stopPropagation();
  });
}

/**
 * @typedef {object} Grip  a pointer that holds a handle
 * @property {number} pointer
 * @property {Point} offset  of the pointer from the handle, so that the handle does not jump to the pointer
 *
 * @param {SVGGElement} group
 * @param {Element} drawing
 * @param {Moves} moves
 */
function followPointer(group, drawing, { begin, position, dragTo }) {
  /** @type {Grip | null} */
  let grip = null;
  // Without this the browser scrolls on a vertical move and cancels the drag: Chromium reads `touch-action` from the
  // drawing, not from the group in it.
  group.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });
  group.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || grip) return;
    begin?.();
    grip = { pointer: event.pointerId, offset: difference(pointOf(drawing, event), position()) };
    capture(group, event);
  });
  group.addEventListener("pointermove", (event) => {
    if (grip?.pointer !== event.pointerId) return;
    dragTo(difference(pointOf(drawing, event), grip.offset), event);
    event.stopPropagation();
  });
  for (const end of POINTER_ENDS)
    group.addEventListener(end, (event) => {
      if (grip?.pointer !== event.pointerId) return;
      grip = null;
      group.classList.remove("held");
    });
}

/** @param {Point} a @param {Point} b @returns {Point} */
const difference = (a, b) => [a[0] - b[0], a[1] - b[1]];

/** Send all further events of a pointer to a handle. @param {SVGGElement} group @param {PointerEvent} event */
function capture(group, event) {
  group.setPointerCapture(event.pointerId);
  group.classList.add("held");
  group.focus({ preventScroll: true });
  event.preventDefault();
  event.stopPropagation();
}

/**
 * Draw a handle at a point, and give its value to assistive software.
 *
 * @param {SVGGElement} group
 * @param {Point} point
 * @param {number} value
 * @param {string} text
 */
export function placeHandle(group, [x, y], value, text) {
  const transform = `translate(${x.toFixed(2)} ${y.toFixed(2)})`;
  setAttributes(group, { transform, "aria-valuenow": value, "aria-valuetext": text });
}
