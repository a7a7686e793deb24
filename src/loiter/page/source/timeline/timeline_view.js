// @ts-check
/**
 * The time line: control, switching function and costate of the optimal maneuver, with the switching times. It shows
 * what the certificate checks: phi > 0 turns left, phi < 0 turns right, phi = 0 allows straight flight, and psi1 equals
 * lambda where phi vanishes.
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 */
import { byId, fill, observeSize, setAttributes, setSize, show, svg, svgLayers } from "../shared/dom.js";
import { pointOf } from "../shared/draggable.js";
import { durationOf, flownOf, isPlanFlown, shownTime } from "../state/page_state.js";
import { drawAxis, drawControls, drawReadings, drawSeries, drawSwitches, heightOf, timeScale } from "./bands.js";

const LEAST_WIDTH_PX = 260;

/** @param {Store} store @param {Actions} actions */
export function timelineView(store, actions) {
  const root = byId("timeline", SVGSVGElement);
  const { reads, ...below } = svgLayers("back", "strip", "lines", "ticks", "reads");
  const cursor = svg("path", { class: "cursor" });
  root.append(...Object.values(below), cursor, reads);
  observeSize(byId("line-box", HTMLElement), (boxWidth) => {
    store.update({ timelineWidth: Math.max(LEAST_WIDTH_PX, boxWidth) });
  });
  store.watch(
    (state) => [state.timelineWidth, showsTheory(state)],
    (state) => {
      setSize(root, state.timelineWidth, heightOf(showsTheory(state)));
      root.classList.toggle("plain", !showsTheory(state));
    },
  );
  watchPlan(root, below, store);
  watchTime(cursor, reads, store);
  seekWithPointer(root, store, actions);
}

/** Whether the bands of the certificate are shown. @param {import("../state/page_state.js").PageState} state */
const showsTheory = ({ theory, leg }) => theory && !leg;

/** @param {Store} store */
const scaleNow = (store) => timeScale(store.get().timelineWidth, durationOf(store.get()), showsTheory(store.get()));

/**
 * @param {SVGSVGElement} root
 * @param {Record<"back" | "strip" | "lines" | "ticks", SVGGElement>} layers
 * @param {Store} store
 */
function watchPlan(root, { back, strip, lines, ticks }, store) {
  store.watch(
    (state) => [flownOf(state), state.timelineWidth, state.theory],
    (state) => {
      const flown = flownOf(state);
      if (!flown) return;
      fill(strip, drawControls(flown.segments, scaleNow(store)));
      fill(ticks, [...drawAxis(scaleNow(store)), ...drawSwitches(flown.segments, scaleNow(store))]);
    },
  );
  store.watch(
    ({ proof, clear, leg, timelineWidth }) => [proof, clear, leg, timelineWidth],
    (state) => {
      const { proof } = state;
      // The certificate is that of the plan, not of the entry round a fence or the leg.
      if (!isPlanFlown(state)) return [back, lines].forEach((layer) => fill(layer, []));
      // The lines of the previous certificate stay visible, drawn faintly.
      root.classList.toggle("unproved", proof === null);
      if (!proof) return;
      const drawn = drawSeries(proof, scaleNow(store));
      fill(back, drawn.back);
      fill(lines, drawn.lines);
    },
  );
}

/** @param {SVGPathElement} cursor @param {SVGGElement} reads @param {Store} store */
function watchTime(cursor, reads, store) {
  store.watch(
    (state) => [shownTime(state), flownOf(state), state.proof, state.timelineWidth, state.theory],
    (state) => {
      const time = shownTime(state);
      setAttributes(cursor, { d: `M${scaleNow(store).x(time).toFixed(1)} 0V${scaleNow(store).axis - 10}` });
      const isProved = state.proof !== null && isPlanFlown(state);
      show(reads, isProved);
      if (isProved && state.proof) fill(reads, drawReadings(state.proof, time, scaleNow(store)));
    },
  );
}

/** @param {SVGSVGElement} root @param {Store} store @param {Actions} actions */
function seekWithPointer(root, store, actions) {
  /** @param {PointerEvent} event */
  function seek(event) {
    if (!store.get().failure) actions.seek(scaleNow(store).time(pointOf(root, event)[0]));
  }
  root.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    root.setPointerCapture(event.pointerId);
    seek(event);
  });
  root.addEventListener("pointermove", (event) => {
    if (root.hasPointerCapture(event.pointerId)) seek(event);
  });
}
