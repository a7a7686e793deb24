// @ts-check
/**
 * The map of the reduced plane: the fastest word in each region, the curves between the regions, and the state of the
 * aircraft (Fig. 4 of the paper).
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Point} from "../shared/geometry.js"
 */
import { byId, fill, observeSize, setAttributes, setSize, show, svg, svgLayers } from "../shared/dom.js";
import { toScreen } from "../shared/geometry.js";
import { splitAnswer } from "../shared/maneuver.js";
import { ghostOf } from "../state/page_state.js";
import { drawAxes, drawCurve, drawReducedPath, drawTargets, mapViewOf } from "./map_lines.js";
import { drawRegionLabels, paintRegions, regionLabels } from "./regions.js";
import { stateHandle } from "./state_handle.js";

/** @param {Store} store @param {Actions} actions */
export function mapView(store, actions) {
  const root = byId("reduced", SVGSVGElement);
  const layers = svgLayers("axes", "curves", "way", "words", "targets");
  const ghost = svg("circle", { r: 5, class: "ghostdot" });
  const state = svg("g", { id: "state", "data-needs-plan": "" });
  root.append(...Object.values(layers), ghost, state);

  observeSize(byId("map", HTMLElement), (side) => {
    if (side === 0) return; // while it is hidden
    setSize(root, side, side);
    store.update({ mapSide: side });
  });
  drawSynthesis(layers, store);
  drawPlan(layers, ghost, store);
  drawWords(layers.words, store);
  stateHandle(state, root, store, actions);
  drawNotes(store);
  drawWait(store);
}

/** @param {Record<string, SVGGElement>} layers @param {Store} store */
function drawSynthesis(layers, store) {
  const canvas = byId("regions", HTMLCanvasElement);
  store.watch(
    ({ synthesis, theme }) => [synthesis, theme],
    ({ synthesis }) => synthesis && paintRegions(canvas, synthesis),
  );
  store.watch(
    ({ synthesis, mapSide }) => [synthesis, mapSide],
    (state) => {
      const { synthesis } = state;
      if (!synthesis) return;
      const view = mapViewOf(state);
      fill(layers.axes, drawAxes(view));
      fill(layers.curves, synthesis.curves.map((curve) => drawCurve(view, curve)));
      fill(layers.targets, drawTargets(view, synthesis));
    },
  );
}

/** @param {Record<string, SVGGElement>} layers @param {SVGCircleElement} ghost @param {Store} store */
function drawPlan(layers, ghost, store) {
  store.watch(
    ({ answer, synthesis, mapSide }) => [answer, synthesis, mapSide],
    (state) => {
      const best = state.answer ? splitAnswer(state.answer).best : [];
      fill(layers.way, best.flatMap((maneuver) => drawReducedPath(mapViewOf(state), maneuver)));
    },
  );
  store.watch(
    (state) => [state.playback, state.answer, state.synthesis, state.mapSide],
    (state) => {
      const instant = ghostOf(state);
      show(ghost, instant !== null);
      if (!instant) return;
      const [cx, cy] = toScreen(mapViewOf(state), instant.x, instant.y);
      setAttributes(ghost, { cx: cx.toFixed(2), cy: cy.toFixed(2) });
    },
  );
}

/** Why the map is not there yet. @param {Store} store */
function drawWait(store) {
  const note = byId("map-wait", HTMLElement);
  store.watch(
    ({ requests, synthesis }) => [requests.map, synthesis === null],
    ({ requests, synthesis }) => {
      const text = synthesis ? "" : "The map is being computed.";
      note.textContent = requests.map === "asking" ? text : "";
    },
  );
}

/** The words of the regions, beside the path and the state. @param {SVGGElement} layer @param {Store} store */
function drawWords(layer, store) {
  /** @type {ReturnType<typeof regionLabels>} */
  let labels = [];
  store.watch(
    ({ synthesis, mapSide }) => [synthesis, mapSide],
    (state) => (labels = state.synthesis ? regionLabels(mapViewOf(state), state.synthesis) : []),
  );
  store.watch(
    ({ answer, synthesis, mapSide }) => [answer, synthesis, mapSide],
    (state) => fill(layer, drawRegionLabels(labels, statePoint(state), pathPoints(state))),
  );
}

/** Where the state is drawn. @param {PageState} state @returns {Point | null} */
const statePoint = (state) =>
  state.answer && toScreen(mapViewOf(state), state.answer.reduced.x, state.answer.reduced.y);

const STEP_PX = 8;

/** The points of a polyline, and more between those that are far apart. @param {Point[]} points @returns {Point[]} */
const between = (points) =>
  points.flatMap(([x, y], i) => {
    const [nextX, nextY] = points[i + 1] ?? [x, y];
    const count = Math.min(200, 1 + Math.floor(Math.hypot(nextX - x, nextY - y) / STEP_PX));
    return Array.from({ length: count }, (_, k) => {
      const share = k / count;
      return /** @type {Point} */ ([x + share * (nextX - x), y + share * (nextY - y)]);
    });
  });

/** Points on the optimal paths. @param {PageState} state @returns {Point[]} */
function pathPoints(state) {
  const view = mapViewOf(state);
  const tracks = state.answer ? splitAnswer(state.answer).best.map(({ track }) => track) : [];
  return tracks.flatMap(({ x, y }) => between(x.map((value, i) => toScreen(view, value, y[i]))));
}

/** The title of the map, and the notes where it does not fit the scene. @param {Store} store */
function drawNotes(store) {
  const box = byId("map", HTMLElement);
  store.watch(
    ({ wantedMap }) => [wantedMap],
    ({ wantedMap }) => {
      byId("map-title", HTMLElement).textContent = wantedMap?.title ?? "";
      box.classList.toggle("drifts", wantedMap?.drifts === true);
    },
  );
}
