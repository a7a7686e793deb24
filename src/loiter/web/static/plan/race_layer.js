// @ts-check
/**
 * The race: other guidance laws from the same start, each with its path, a ghost, and how much later it joins.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Actions} from "../state/actions.js"
 * @import {Racer} from "../shared/types.js"
 */
import { byId, html, polyline, setAttributes, show, svg } from "../shared/dom.js";
import { positionToScreen, toScreen } from "../shared/geometry.js";
import { poseAt } from "../shared/maneuver.js";
import { signedTimeDifference } from "../shared/units.js";
import { AEROPLANE } from "./handles.js";

/** @param {SVGGElement} layer @param {Store} store @param {Actions} actions */
export function raceLayer(layer, store, actions) {
  const button = byId("race", HTMLButtonElement);
  button.addEventListener("click", () => actions.race(!store.get().racing));
  store.watch(
    ({ racing }) => [racing],
    ({ racing }) => {
      button.setAttribute("aria-pressed", String(racing));
      layer.ownerSVGElement?.classList.toggle("racing", racing);
    },
  );
  /** @type {{ghost: SVGGElement, path: SVGPathElement, racer: Racer}[]} */
  let drawn = [];
  store.watch(
    ({ race }) => [race],
    (state) => {
      drawn = (state.race ?? []).map((racer, i) => ({ racer, ...shapesOf(racer, i) }));
      layer.replaceChildren(...drawn.map(({ path }) => path), ...drawn.map(({ ghost }) => ghost));
      const list = byId("results", HTMLElement);
      show(list, state.race !== null);
      list.replaceChildren(...drawn.map(({ racer }, i) => html("li", { class: `racer${i}` }, [resultOf(racer, state)])));
    },
  );
  store.watch(
    ({ race, camera }) => [race, camera],
    ({ camera: { view } }) => {
      for (const { path, racer } of drawn) {
        const { east_m, north_m } = racer.track;
        path.setAttribute("d", polyline(east_m.map((east, i) => toScreen(view, east, north_m[i]))));
      }
    },
  );
  store.watch(
    ({ race, camera, playback }) => [race, camera, playback.time_s],
    ({ camera: { view }, playback }) => {
      for (const { ghost, racer } of drawn) {
        const pose = poseAt(racer.track, playback.time_s);
        const [x, y] = positionToScreen(view, pose).map((pixel) => pixel.toFixed(2));
        ghost.setAttribute("transform", `translate(${x} ${y})`);
        setAttributes(/** @type {Element} */ (ghost.firstChild), { transform: `rotate(${pose.heading_deg.toFixed(1)})` });
      }
    },
  );
}

/** The path of a racer, and its ghost with its name. @param {Racer} racer @param {number} i */
function shapesOf({ law }, i) {
  // The names of those that fly together lie on different sides.
  const [x, y] = [
    [14, 22],
    [14, -12],
    [-14, -12],
  ][i];
  const name = svg("text", { x, y, "text-anchor": x < 0 ? "end" : "start", class: "halo" }, [law]);
  return {
    path: svg("path", { class: `racer${i}` }),
    ghost: svg("g", { class: `racer${i}` }, [svg("path", { d: AEROPLANE }), name]),
  };
}

/** How much later than the fastest entry a racer joins. @param {Racer} racer @param {PageState} state */
function resultOf({ law, joined_s }, { answer, scene }) {
  if (joined_s === null || !answer) return `${law}: has not joined`;
  return `${law} ${signedTimeDifference(joined_s - answer.duration_s, scene)}`;
}
