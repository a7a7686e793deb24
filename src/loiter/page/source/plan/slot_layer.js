// @ts-check
/**
 * The slot in the plan view: its handle, on the circle at its bearing, and while the ghost flies, where it is by then.
 *
 * @import {Store} from "../state/store.js"
 * @import {Scene} from "../shared/types.js"
 * @import {Handle} from "./handles.js"
 */
import { slotPoseOf } from "../requests/answers.js";
import { withoutSlot, withSlot } from "../scene/slot.js";
import { setAttributes, show, svg } from "../shared/dom.js";
import { headingOf, pointAt, positionToScreen, wrapped } from "../shared/geometry.js";
import { fixed, tidy } from "../shared/units.js";
import { ghostOf } from "../state/page_state.js";
import { bearingFromCentre, handleParts, pointOnCircle } from "./handles.js";

const LABEL_PX = 22; // from the handle in to its name

/** A gap in the circle, for an aircraft that flies north. */
const shape = (/** @type {string} */ kind) => svg("rect", { x: -12, y: -5, width: 24, height: 10, rx: 5, class: kind });

/** @param {Scene} scene */
const bearingOf = ({ slot }) => slot?.phase_deg ?? 0;

/** @type {Handle} */
export const SLOT = {
  id: "slot",
  label: "Slot",
  parts: [...handleParts(20, 15, shape("knob")), svg("text", { class: "halo", "text-anchor": "middle" }, ["slot"])],
  isShown: ({ slot }) => slot !== null,
  position: (stage) => pointOnCircle(stage, bearingOf(stage.scene)),
  dragTo: (stage, point) => withSlot(stage.scene, { phase_deg: tidy(bearingFromCentre(stage, point), 0.1) % 360 }),
  moveBy: ({ scene }, right, up) => withSlot(scene, { phase_deg: tidy(wrapped(bearingOf(scene) + right - up), 1e-6) }),
  remove: ({ scene }) => withoutSlot(scene),
  value: bearingOf,
  text: ({ slot }) => `${fixed(slot?.phase_deg ?? 0, 1)} degrees from the centre at ${fixed(slot?.at_s ?? 0, 1)} seconds`,
};

/** What labels must not cover: the handle, and its name. @param {import("./handles.js").Stage} stage */
export function slotBoxes(stage) {
  if (!stage.scene.slot) return [];
  const handle = SLOT.position(stage);
  return [handle, pointAt(handle, bearingOf(stage.scene) + 180, LABEL_PX)].map(([x, y]) => ({ left: x - 15, right: x + 15, top: y - 10, bottom: y + 10 }));
}

/** @param {SVGSVGElement} root @param {SVGGElement} layer @param {SVGGElement} handles @param {Store} store */
export function slotLayer(root, layer, handles, store) {
  const group = /** @type {SVGGElement} */ (handles.querySelector("#slot"));
  const [knob, name] = ["rect", "text"].map((tag) => /** @type {SVGElement} */ (group.querySelector(tag)));
  const moving = shape("slot-now");
  layer.append(moving);
  store.watch(
    ({ scene }) => [scene.slot],
    ({ scene }) => {
      const [x, y] = pointAt([0, 0], bearingOf(scene) + 180, LABEL_PX);
      setAttributes(knob, { transform: `rotate(${bearingOf(scene)})` });
      setAttributes(name, { x, y: y + 4 });
      // The focus goes to the plan.
      if (!scene.slot && group.contains(document.activeElement)) root.focus({ preventScroll: true });
    },
  );
  store.watch(
    ({ playback, answer, scene, camera }) => [playback.time_s, playback.playing, answer, scene.slot, camera],
    (state) => {
      const { answer, camera, playback, scene } = state;
      const isShown = answer !== null && scene.slot !== null && ghostOf(state) !== null;
      show(moving, isShown);
      if (!isShown) return;
      const pose = slotPoseOf(scene, answer.turn, playback.time_s);
      const { east_m, north_m, velocity_east_m_s, velocity_north_m_s } = scene.orbit;
      const [east, north] = [east_m + velocity_east_m_s * playback.time_s, north_m + velocity_north_m_s * playback.time_s];
      const [x, y] = positionToScreen(camera.view, pose);
      const bearing = headingOf(pose.east_m - east, pose.north_m - north);
      setAttributes(moving, { transform: `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${bearing.toFixed(1)})` });
    },
  );
}
