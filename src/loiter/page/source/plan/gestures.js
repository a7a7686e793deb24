// @ts-check
/**
 * Gestures and keys that move the plan view.
 *
 * @import {Point} from "../shared/geometry.js"
 * @import {PlanCamera} from "./camera.js"
 */
import { POINTER_ENDS, isShortcut, pointOf } from "../shared/draggable.js";
import { panned } from "../shared/geometry.js";

const KEY_PAN_PX = 60;
const LINE_PX = 16; // of a wheel that counts lines

/** @type {Record<string, (camera: PlanCamera) => void>} */
const KEYS = {
  ArrowLeft: (camera) => camera.move(panned(camera.view(), KEY_PAN_PX, 0)),
  ArrowRight: (camera) => camera.move(panned(camera.view(), -KEY_PAN_PX, 0)),
  ArrowUp: (camera) => camera.move(panned(camera.view(), 0, KEY_PAN_PX)),
  ArrowDown: (camera) => camera.move(panned(camera.view(), 0, -KEY_PAN_PX)),
  "+": (camera) => camera.zoom(1.25),
  "-": (camera) => camera.zoom(0.8),
  0: (camera) => camera.fit(),
};

/**
 * Pan with one pointer or the arrow keys, zoom with the wheel or plus and minus, do both with two fingers; 0 shows all.
 * One finger that moves up or down scrolls the page, because the plan may be as large as a phone's screen.
 *
 * @param {SVGSVGElement} root
 * @param {PlanCamera} camera
 */
export function gestures(root, camera) {
  followPointers(root, camera);
  root.addEventListener("wheel", (event) => zoomWithWheel(event, root, camera), { passive: false });
  root.addEventListener("keydown", (event) => {
    if (isShortcut(event) || !KEYS[event.key]) return;
    KEYS[event.key](camera);
    event.preventDefault();
  });
}

/** @param {WheelEvent} event @param {SVGSVGElement} root @param {PlanCamera} camera */
function zoomWithWheel(event, root, camera) {
  event.preventDefault();
  const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE_PX : 1);
  camera.zoomAt(pointOf(root, event), Math.exp(-pixels / 500));
}

/** Pan with one pointer, pan and zoom with two. @param {SVGSVGElement} root @param {PlanCamera} camera */
function followPointers(root, camera) {
  /** @type {Map<number, Point>} */
  const pointers = new Map();
  let goBack = camera.bookmark(); // to the view before the first pointer came down
  root.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    if (pointers.size === 0) goBack = camera.bookmark();
    pointers.set(event.pointerId, pointOf(root, event));
    root.setPointerCapture(event.pointerId);
  });
  root.addEventListener("pointermove", (event) => {
    const from = pointers.get(event.pointerId);
    if (!from) return;
    const to = pointOf(root, event);
    pointers.set(event.pointerId, to);
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    moveView(camera, from, to, other);
  });
  // The browser uses the move for scrolling: undo the pan of its first pixels.
  root.addEventListener("pointercancel", (event) => pointers.has(event.pointerId) && pointers.size === 1 && goBack());
  for (const end of POINTER_ENDS) root.addEventListener(end, (event) => pointers.delete(event.pointerId));
  // Two fingers always move the view, also up and down.
  const keepTwoFingers = (/** @type {TouchEvent} */ event) => event.touches.length > 1 && event.preventDefault();
  root.addEventListener("touchstart", keepTwoFingers, { passive: false });
}

/**
 * Move the view after a pointer has moved. With a second pointer the point midway between them stays there, and the scale
 * follows their distance.
 *
 * @param {PlanCamera} camera
 * @param {Point} from
 * @param {Point} to
 * @param {Point} [other]  where the second pointer is
 */
function moveView(camera, from, to, other) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  if (!other) return camera.move(panned(camera.view(), dx, dy));
  const distance = (/** @type {Point} */ [x, y]) => Math.max(1, Math.hypot(x - other[0], y - other[1]));
  /** @type {Point} */
  const middle = [(to[0] + other[0]) / 2, (to[1] + other[1]) / 2];
  camera.zoomAt(middle, distance(to) / distance(from), panned(camera.view(), dx / 2, dy / 2));
}
