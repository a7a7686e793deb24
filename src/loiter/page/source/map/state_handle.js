// @ts-check
/**
 * The handle of the state on the map: a drag moves the aircraft so that it has the new state.
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 * @import {Scene} from "../shared/types.js"
 * @import {Point, View} from "../shared/geometry.js"
 */
import { withPose } from "../scene/scene.js";
import { show, svg } from "../shared/dom.js";
import { makeHandle, placeHandle } from "../shared/draggable.js";
import { toScreen, toWorld, unitVector } from "../shared/geometry.js";
import { fixed, tidy } from "../shared/units.js";
import { mapViewOf, stepOf } from "./map_lines.js";
import { turnRadiusOf } from "../shared/turning.js";

const EDGE_PX = 4; // a state beyond the map is drawn this far from its edge

/** @param {SVGGElement} group @param {SVGSVGElement} root @param {Store} store @param {Actions} actions */
export function stateHandle(group, root, store, actions) {
  group.append(
    svg("circle", { r: 18, class: "touch" }),
    svg("circle", { r: 12, class: "focus" }),
    svg("circle", { r: 7, class: "statedot" }),
  );
  const view = () => mapViewOf(store.get());
  const state = () => store.get().answer?.reduced ?? { x: 0, y: 0 };
  const position = () => pinned(toScreen(view(), state().x, state().y), view());
  /** @param {number} x @param {number} y @param {Event} event */
  function move(x, y, event) {
    const { scene, failure } = store.get();
    if (failure) return;
    const { east_m, north_m } = positionOf(x, y, scene);
    // Finer than the map, so that the dot stays under the pointer.
    const resolution = (0.01 * turnRadiusOf(scene.aircraft)) / view().scale;
    actions.changeScene(withPose(scene, { east_m: tidy(east_m, resolution), north_m: tidy(north_m, resolution) }), event);
  }
  makeHandle(group, root, "State in the reduced plane", {
    position,
    dragTo: (point, event) => {
      const [x, y] = toWorld(view(), point);
      move(tidy(x, 0.05 / view().scale), tidy(y, 0.05 / view().scale), event);
    },
    moveBy: (right, up, event) => {
      const step = stepOf(view()) / 20;
      move(state().x + right * step, state().y + up * step, event);
    },
  });
  store.watch(
    ({ answer, synthesis, mapSide }) => [answer, synthesis, mapSide],
    ({ answer }) => {
      show(group, answer !== null);
      const { x, y } = state();
      placeHandle(group, position(), tidy(x, 1e-6), `x ${fixed(x, 2)}, y ${fixed(y, 2)} turn radii`);
    },
  );
}

/**
 * The position of an aircraft with this heading and the reduced state (x, y): the inverse of equation (2) of the paper,
 * a rotation. x counts along the heading, y to the left of it, both from the centre.
 *
 * @param {number} x turn radii
 * @param {number} y turn radii
 * @param {Scene} scene
 * @returns {{east_m: number, north_m: number}}
 */
function positionOf(x, y, { pose, orbit, aircraft }) {
  const [east, north] = unitVector(pose.heading_deg);
  const turnRadius_m = turnRadiusOf(aircraft);
  return {
    east_m: orbit.east_m + turnRadius_m * (x * east - y * north),
    north_m: orbit.north_m + turnRadius_m * (x * north + y * east),
  };
}

/** The nearest point on the map. @param {Point} point @param {View} view @returns {Point} */
function pinned([x, y], { width, height }) {
  const within = (/** @type {number} */ value, /** @type {number} */ side) =>
    Math.min(side - EDGE_PX, Math.max(EDGE_PX, value));
  return [within(x, width), within(y, height)];
}
