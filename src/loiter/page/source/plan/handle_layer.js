// @ts-check
/**
 * The handles on the plan view, the line to the handle of the heading, and the dial of the wind.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Actions} from "../state/actions.js"
 * @import {Handle, Stage} from "./handles.js"
 */
import { polyline, setAttributes, show, svg } from "../shared/dom.js";
import { makeHandle, placeHandle } from "../shared/draggable.js";
import { pointAt, positionToScreen } from "../shared/geometry.js";
import { AIRCRAFT, CENTRE, HEADING, HEADING_HANDLE_PX, radiusHandle } from "./handles.js";
import { SLOT } from "./slot_layer.js";
import { WIND, windDial } from "./wind_handle.js";

/** @param {SVGSVGElement} root @param {SVGGElement} layer @param {Store} store @param {Actions} actions */
export function createHandles(root, layer, store, actions) {
  const stage = () => stageOf(store);
  const lever = svg("path", { class: "lever" });
  const dial = windDial();
  // Later handles lie on top, so that the aircraft can always be reached.
  const handles = [CENTRE, radiusHandle(), SLOT, WIND, HEADING, AIRCRAFT].map((handle) => ({
    handle,
    group: svg("g", { id: handle.id }, handle.parts),
  }));
  layer.append(dial.group, lever, ...handles.map(({ group }) => group));
  for (const { handle, group } of handles) connect(group, root, handle, store, actions);
  store.watch(
    ({ camera, scene, units, radiusBearing_deg }) => [camera, scene, units, radiusBearing_deg],
    ({ scene, units }) => {
      for (const { handle, group } of handles) {
        show(group, handle.isShown?.(scene) ?? true);
        placeHandle(group, handle.position(stage()), handle.value(scene), handle.text(scene, units));
      }
      rotate(layer, "#aircraft .aeroplane", scene.pose.heading_deg);
      rotate(layer, "#wind .tip", (scene.wind?.from_deg ?? 180) + 180);
      layer.querySelector("#wind")?.classList.toggle("calm", scene.wind === null);
      setAttributes(lever, { d: leverOf(stage()) });
      dial.draw(stage());
    },
  );
}

/** @param {Store} store @returns {Stage} */
export const stageOf = (store) => stageAt(store.get());

/** What handles depend on. @param {PageState} state @returns {Stage} */
export function stageAt({ camera, scene, units, radiusBearing_deg }) {
  return { view: camera.view, scene, units, radiusBearing_deg };
}

/** @param {SVGGElement} layer @param {string} selector @param {number} deg */
function rotate(layer, selector, deg) {
  setAttributes(/** @type {Element} */ (layer.querySelector(selector)), { transform: `rotate(${deg})` });
}

/**
 * Let a handle change the scene.
 *
 * @param {SVGGElement} group
 * @param {SVGSVGElement} root
 * @param {Handle} handle
 * @param {Store} store
 * @param {Actions} actions
 */
export function connect(group, root, handle, store, actions) {
  const stage = () => stageOf(store);
  makeHandle(group, root, handle.label, {
    begin: () => handle.dragBegins?.(stage()),
    position: () => handle.position(stage()),
    dragTo: (point, event) => {
      const scene = handle.dragTo(stage(), point);
      if (handle.bearing) store.update({ radiusBearing_deg: handle.bearing(stage(), point) });
      actions.changeScene(scene, event);
    },
    moveBy: (right, up, event) => actions.changeScene(handle.moveBy(stage(), right, up), event),
    remove: handle.remove && ((event) => actions.changeScene(/** @type {any} */ (handle).remove(stage()), event)),
  });
}

/** @param {Stage} stage */
function leverOf({ view, scene }) {
  const aircraft = positionToScreen(view, scene.pose);
  return polyline([19, HEADING_HANDLE_PX - 7].map((far) => pointAt(aircraft, scene.pose.heading_deg, far)));
}
