// @ts-check
/**
 * Moving a view: pan, zoom, show all.
 *
 * @typedef {import("./view.js").View} View
 * @typedef {import("./view.js").Point} Point
 */
import { pointOf } from "./handle.js";
import { panned, zoomed } from "./view.js";

/**
 * Pan with the pointer or the arrow keys, zoom with the wheel, two fingers or plus and minus; 0 fits.
 *
 * @param {SVGSVGElement} root
 * @param {() => View} viewed
 * @param {(view: View) => void} look
 * @param {() => void} fit
 */
export function gestures(root, viewed, look, fit) {
  /** @type {Map<number, Point>} */
  const fingers = new Map();
  root.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    fingers.set(event.pointerId, pointOf(root, event));
    root.setPointerCapture(event.pointerId);
  });
  root.addEventListener("pointermove", (event) => {
    const from = fingers.get(event.pointerId);
    if (!from) return;
    const to = pointOf(root, event);
    fingers.set(event.pointerId, to);
    const still = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (!still) return look(panned(viewed(), to[0] - from[0], to[1] - from[1]));
    const wide = (/** @type {Point} */ [x, y]) => Math.max(1, Math.hypot(x - still[0], y - still[1]));
    look(zoomed(viewed(), still, wide(to) / wide(from)));
  });
  for (const end of /** @type {const} */ (["pointerup", "pointercancel", "lostpointercapture"]))
    root.addEventListener(end, (event) => fingers.delete(event.pointerId));
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
