// @ts-check
/**
 * The plan view: grid, circle, paths, ghost, and the handles that change the scene.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Actions} from "../state/actions.js"
 * @import {Box} from "../shared/geometry.js"
 * @import {PlanCamera} from "./camera.js"
 */
import { boxWithin, byId, fill, observeSize, setAttributes, setSize, show, svg, svgLayers, watchPointed } from "../shared/dom.js";
import { orbitMoves } from "../scene/scene.js";
import { positionToScreen, toScreen } from "../shared/geometry.js";
import { splitAnswer } from "../shared/maneuver.js";
import { decimalsFor, quantityText } from "../shared/units.js";
import { ghostOf } from "../state/page_state.js";
import { drawCircle, drawGrid } from "./background.js";
import { scaleLimits } from "./camera.js";
import { gestures } from "./gestures.js";
import { createHandles, stageAt } from "./handle_layer.js";
import { AEROPLANE } from "./handles.js";
import { breachMark, fenceBoxes, fenceLayer } from "./fence_layer.js";
import { exitLayer } from "./exit_layer.js";
import { drawMarks } from "./marks.js";
import { drawBest, drawBlocked, drawOther, placeCallout } from "./paths.js";
import { slotBoxes, slotLayer } from "./slot_layer.js";
import { dialBox } from "./wind_handle.js";

/** @param {Store} store @param {Actions} actions @param {PlanCamera} camera */
export function planView(store, actions, camera) {
  const root = byId("plan", SVGSVGElement);
  const layers = svgLayers("grid", "fence", "circle", "others", "blocked", "best", "slot", "marks", "wind", "handles");
  const { handles, ...below } = layers;
  const ghost = svg("g", { class: "ghost" }, [svg("path", { d: AEROPLANE })]);
  const moving = svg("circle", { class: "moving" });
  const callout = svg("text", { class: "halo callout" });
  root.append(...Object.values(below), moving, ghost, callout, handles);

  const box = byId("plan-box", HTMLElement);
  /** @type {Box[]} */
  let overlays = [];
  observeSize(box, (width, height) => {
    setSize(root, width, height);
    overlays = [...box.querySelectorAll(".corner, .key")].map((element) => boxWithin(element, box));
    camera.resize(width, height);
  });
  camera.fit();
  gestures(root, camera);
  zoomButtons(store, camera);
  createHandles(root, handles, store, actions);
  fenceLayer(root, layers.fence, handles, store, actions);
  exitLayer(root, handles, store, actions, camera);
  watchScene(root, layers, store, () => overlays);
  watchPointed(layers.others, ".other", actions.highlight);
  watchHighlight(root, layers.others, callout, store);
  watchGhost(ghost, moving, store);
  slotLayer(root, layers.slot, handles, store);
}

/** @param {Store} store @param {PlanCamera} camera */
function zoomButtons(store, camera) {
  byId("fit", HTMLButtonElement).addEventListener("click", camera.fit);
  byId("zoom-in", HTMLButtonElement).addEventListener("click", () => camera.zoom(1.4));
  byId("zoom-out", HTMLButtonElement).addEventListener("click", () => camera.zoom(1 / 1.4));
  store.watch(
    ({ camera }) => [camera],
    (state) => {
      const { least, most } = scaleLimits(state);
      const { scale } = state.camera.view;
      const isAt = { "zoom-in": scale >= most * (1 - 1e-9), "zoom-out": scale <= least * (1 + 1e-9) };
      for (const [id, is] of Object.entries(isAt)) byId(id, HTMLElement).setAttribute("aria-disabled", String(is));
    },
  );
}

/**
 * @param {SVGSVGElement} root
 * @param {Record<string, SVGGElement>} layers
 * @param {Store} store
 * @param {() => Box[]} overlays
 */
function watchScene(root, layers, store, overlays) {
  store.watch(
    ({ camera, units }) => [camera, units],
    ({ camera: { view }, units }) => {
      setAttributes(root, { "data-scale": view.scale, "data-east": view.east, "data-north": view.north });
      fill(layers.grid, drawGrid(view, units));
    },
  );
  store.watch(
    ({ camera, scene, answer }) => [camera, scene, answer],
    ({ camera, scene, answer }) => {
      root.setAttribute("data-scene", JSON.stringify(scene));
      fill(layers.circle, drawCircle(camera.view, scene, answer));
    },
  );
  // Not after a change of the scene: the paths are drawn when its answer arrives.
  store.watch(
    ({ camera, answer, clear, units }) => [camera, answer, clear, units],
    (state) => drawPaths(layers, state, overlays),
  );
}

/**
 * @param {Record<string, SVGGElement>} layers
 * @param {PageState} state
 * @param {() => Box[]} overlays
 */
function drawPaths(layers, state, overlays) {
  const {
    camera: { view },
    scene,
    answer,
    clear,
    leg,
  } = state;
  if (!answer) return [layers.best, layers.others, layers.blocked, layers.marks].forEach((layer) => fill(layer, []));
  const { best: fastest, others: slower } = splitAnswer(answer);
  const [flown, others] = [leg?.maneuver ?? clear?.maneuver, leg ? [] : slower];
  const best = flown ? [flown] : fastest;
  fill(layers.best, best.flatMap((maneuver) => drawBest(view, maneuver)));
  fill(layers.blocked, clear?.maneuver ? fastest.map((maneuver) => drawBlocked(view, maneuver)) : []);
  fill(layers.others, others.map((other) => drawOther(view, other, scene)));
  const breaches = breachesOf(state);
  const marks = drawMarks(view, best, others, scene, [dialBox(stageAt(state)), ...overlays(), ...fenceBoxes(state), ...slotBoxes(stageAt(state))], breaches);
  fill(layers.marks, [...breaches.map(({ point }) => breachMark(point)), ...marks]);
}

/** Where the plan enters zones, or is too close to them, and by how much. @param {PageState} state */
function breachesOf({ camera: { view }, scene, fence, units }) {
  return (fence?.check?.breaches ?? []).map((breach) => {
    const length = quantityText(Math.abs(breach.clearance_m), "length", units, decimalsFor(scene.orbit.radius_m, units));
    const text = breach.enters ? `${length} into ${breach.zone}` : `${length} from ${breach.zone}`;
    return { point: positionToScreen(view, breach), text };
  });
}

/**
 * Show which of the other paths is under the pointer, and how much later it joins.
 *
 * @param {SVGSVGElement} root
 * @param {SVGGElement} others
 * @param {SVGTextElement} callout
 * @param {Store} store
 */
function watchHighlight(root, others, callout, store) {
  store.watch(
    ({ highlighted, answer, camera }) => [highlighted, answer, camera],
    ({ highlighted, answer, camera, scene }) => {
      const other = answer && highlighted !== null ? splitAnswer(answer).others[highlighted] : undefined;
      Array.from(others.children).forEach((child, i) => child.classList.toggle("lit", i === highlighted));
      root.classList.toggle("comparing", other !== undefined);
      show(callout, other !== undefined);
      if (other) placeCallout(callout, camera.view, other, scene);
    },
  );
}

/**
 * Move the ghost along the path and round the circle, and a circle that moves.
 *
 * @param {SVGGElement} ghost
 * @param {SVGCircleElement} moving
 * @param {Store} store
 */
function watchGhost(ghost, moving, store) {
  store.watch(
    (state) => [state.playback.time_s, state.playback.playing, state.answer, state.clear, state.camera],
    (state) => {
      const { camera } = state;
      const instant = ghostOf(state);
      const { orbit } = state.scene;
      show(ghost, instant !== null);
      show(moving, instant !== null && orbitMoves(state.scene));
      if (!instant) return;
      const { time_s } = state.playback;
      const [east, north] = [orbit.velocity_east_m_s * time_s, orbit.velocity_north_m_s * time_s];
      const [cx, cy] = toScreen(camera.view, orbit.east_m + east, orbit.north_m + north);
      setAttributes(moving, { cx, cy, r: orbit.radius_m * camera.view.scale });
      const [x, y] = positionToScreen(camera.view, instant);
      const turned = `rotate(${instant.heading_deg.toFixed(2)})`;
      ghost.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)}) ${turned}`);
    },
  );
}
