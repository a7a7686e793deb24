// @ts-check
/**
 * The point that a leg flies to, on the plan view: its handle, and the button that sets it and drops it.
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 * @import {PlanCamera} from "./camera.js"
 * @import {Handle} from "./handles.js"
 */
import { exitOf, withExit, withLeg, withoutLeg } from "../scene/leg.js";
import { byId, show, svg } from "../shared/dom.js";
import { placeHandle } from "../shared/draggable.js";
import { positionToScreen, toWorld } from "../shared/geometry.js";
import { connect, stageOf } from "./handle_layer.js";
import { handleParts, positionText, stepped, tidyPosition } from "./handles.js";

/** @type {Handle} */
const EXIT = {
  id: "exit",
  label: "Exit point",
  parts: handleParts(20, 14, svg("path", { d: "M-5 9V-9L8-4.5-5 0", class: "flag" })),
  position: ({ view, scene }) => positionToScreen(view, exitOf(scene)),
  dragTo: (stage, point) => withExit(stage.scene, tidyPosition(stage, toWorld(stage.view, point))),
  moveBy: (stage, right, up) => withExit(stage.scene, stepped(stage, exitOf(stage.scene), right, up)),
  remove: ({ scene }) => withoutLeg(scene),
  value: (scene) => exitOf(scene).east_m,
  text: (scene, units) => positionText(exitOf(scene), scene, units),
};

/** @param {SVGSVGElement} root @param {SVGGElement} handles @param {Store} store @param {Actions} actions @param {PlanCamera} camera */
export function exitLayer(root, handles, store, actions, camera) {
  const group = svg("g", { id: EXIT.id }, EXIT.parts);
  handles.prepend(group);
  connect(group, root, EXIT, store, actions);
  const button = byId("add-exit", HTMLButtonElement);
  button.addEventListener("click", (event) => {
    const { scene } = store.get();
    actions.changeScene(scene.leg ? withoutLeg(scene) : withLeg(scene, {}), event);
    if (store.get().scene.leg) actions.say("Drag the flag, or press Tab in the plan to reach it.");
    camera.keepInView();
  });
  store.watch(
    ({ camera, scene, units }) => [camera, scene, units],
    ({ scene, units }) => {
      button.setAttribute("aria-pressed", String(scene.leg !== null));
      if (!scene.leg && group.contains(document.activeElement)) root.focus({ preventScroll: true });
      show(group, scene.leg !== null);
      if (scene.leg) placeHandle(group, EXIT.position(stageOf(store)), EXIT.value(scene), EXIT.text(scene, units));
    },
  );
}
