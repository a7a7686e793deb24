// @ts-check
/**
 * Steps of the user, for undo and the browser's Back. A drag is one step, and so are several keys or letters in a row
 * in the same place, and all that changes without a pause.
 */
import { PAUSE_MS } from "../shared/dom.js";

const SAME_MS = 1200; // after a longer pause the same key or field begins a new step

/** Whether a change continues the step of the change before. @returns {(event: Event | undefined) => boolean} */
export function createStepper() {
  /** @type {EventTarget | null} */
  let last = null;
  let last_ms = -Infinity;
  let wasDrag = false;
  addEventListener("pointerdown", () => (last = null), { capture: true });
  return (event) => {
    const now_ms = performance.now();
    const isDrag = event instanceof PointerEvent;
    const target = event?.currentTarget ?? event?.target ?? null;
    const isSame = target !== null && target === last && isDrag === wasDrag;
    const rest_ms = now_ms - last_ms;
    const continues = rest_ms < PAUSE_MS || (isSame && (isDrag || rest_ms < SAME_MS));
    [last, last_ms, wasDrag] = [target, now_ms, isDrag];
    return continues;
  };
}
