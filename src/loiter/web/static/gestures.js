// @ts-check
/**
 * Moving a view: pan, zoom, show all.
 *
 * @typedef {import("./view.js").View} View
 * @typedef {import("./view.js").Point} Point
 */
import { pointOf } from "./draggable.js";
import { panned, zoomed } from "./view.js";

/**
 * Pan with the pointer or the arrow keys, zoom with the wheel or plus and minus, both with two fingers; 0 fits. One
 * finger that moves up or down scrolls the page: a plan as large as a phone's screen must not hold the page fast.
 *
 * @param {SVGSVGElement} root
 * @param {() => View} viewed
 * @param {(view: View) => void} look
 * @param {() => void} fit
 * @param {() => () => void} bookmark  gives what puts the view back to where it is now
 */
export function gestures(root, viewed, look, fit, bookmark) {
  pans(root, viewed, look, bookmark);
  root.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1);
      look(zoomed(viewed(), pointOf(root, event), Math.exp(-pixels / 500)));
    },
    { passive: false },
  );
  root.addEventListener("keydown", (event) => {
    const view = viewed();
    /** @type {Record<string, () => void>} */
    const keys = {
      ArrowLeft: () => look(panned(view, 60, 0)),
      ArrowRight: () => look(panned(view, -60, 0)),
      ArrowUp: () => look(panned(view, 0, 60)),
      ArrowDown: () => look(panned(view, 0, -60)),
      "+": () => look(zoomed(view, [view.width / 2, view.height / 2], 1.25)),
      "-": () => look(zoomed(view, [view.width / 2, view.height / 2], 0.8)),
      0: fit,
    };
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    keys[event.key]();
    event.preventDefault();
  });
}

/**
 * Pan with one pointer, pan and zoom with two.
 *
 * @param {SVGSVGElement} root
 * @param {() => View} viewed
 * @param {(view: View) => void} look
 * @param {() => () => void} bookmark
 */
function pans(root, viewed, look, bookmark) {
  /** @type {Map<number, Point>} */
  const fingers = new Map();
  let back = bookmark(); // to the view when the first finger came down
  root.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    if (fingers.size === 0) back = bookmark();
    fingers.set(event.pointerId, pointOf(root, event));
    root.setPointerCapture(event.pointerId);
  });
  root.addEventListener("pointermove", (event) => {
    const from = fingers.get(event.pointerId);
    if (!from) return;
    const to = pointOf(root, event);
    fingers.set(event.pointerId, to);
    const still = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    look(still ? pinched(viewed(), from, to, still) : panned(viewed(), to[0] - from[0], to[1] - from[1]));
  });
  // The browser takes the move for scrolling: its first pixels were not meant for the view.
  root.addEventListener("pointercancel", (event) => fingers.has(event.pointerId) && fingers.size === 1 && back());
  for (const end of /** @type {const} */ (["pointerup", "pointercancel", "lostpointercapture"]))
    root.addEventListener(end, (event) => fingers.delete(event.pointerId));
  // Two fingers are for the view, also where they move up or down.
  root.addEventListener("touchstart", (event) => event.touches.length > 1 && event.preventDefault(), {
    passive: false,
  });
}

/**
 * The view after one of two fingers has moved: what lies midway between them stays there, and the scale follows their
 * distance.
 *
 * @param {View} view
 * @param {Point} from
 * @param {Point} to
 * @param {Point} still  where the other finger is
 * @returns {View}
 */
function pinched(view, from, to, still) {
  const apart = (/** @type {Point} */ [x, y]) => Math.max(1, Math.hypot(x - still[0], y - still[1]));
  /** @type {Point} */
  const middle = [(to[0] + still[0]) / 2, (to[1] + still[1]) / 2];
  const moved = panned(view, (to[0] - from[0]) / 2, (to[1] - from[1]) / 2);
  return zoomed(moved, middle, apart(to) / apart(from));
}
