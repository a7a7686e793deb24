// @ts-check
/**
 * The camera of the plan view: which part of the plane the view shows.
 *
 * @import {Store} from "../state/store.js"
 * @import {Camera, PageState} from "../state/page_state.js"
 * @import {Scene} from "../shared/types.js"
 * @import {Point, View} from "../shared/geometry.js"
 * @typedef {ReturnType<typeof createCamera>} PlanCamera
 */
import { byId } from "../shared/dom.js";
import { contains, fitted, unitVector, zoomed } from "../shared/geometry.js";
import { splitAnswer } from "../shared/maneuver.js";
import { zonePoints } from "../scene/fence.js";
import { tidy } from "../shared/units.js";
import { HEADING_HANDLE_PX } from "./handles.js";
import { turnRadiusOf } from "../shared/turning.js";

// Pixels between the contents and the edges, for buttons, dial, labels and key; fewer on a small screen.
const MARGINS = { left: 84, right: 64, top: 40, bottom: 64 };
const FULL_MARGINS_PX = { width: 640, height: 420 };

const KEPT_MARGIN_PX = 16;

/**
 * The view that the user has chosen, for a link: its middle and width in metres; null if the user has not moved it.
 *
 * @param {Camera} camera
 */
export function spanOf({ view, moved }) {
  if (!moved) return null;
  return [view.east, view.north, view.width / view.scale].map((metres) => tidy(metres, 0.1 / view.scale));
}

/** @param {Store} store */
export function createCamera(store) {
  const viewNow = () => store.get().camera.view;
  const isInView = () => contains(viewNow(), contentsOf(store.get(), false), KEPT_MARGIN_PX);
  /** @param {View} view */
  const move = (view) => store.update({ camera: { view, moved: true } });
  const fit = () => store.update(fitState(store.get()));

  /** The present view, zoomed about a point as far as the limits allow. @param {Point} point @param {number} factor */
  const zoomAt = (point, factor, view = viewNow()) =>
    move(zoomed(view, point, allowedScale(view.scale * factor, view.scale, store.get()) / view.scale));

  return {
    view: viewNow,
    /** Show a view that the user has chosen. */
    move,
    /** Show all of the scene. */
    fit,
    /** Show all of the scene, unless it is in view. */
    keepInView: () => isInView() || fit(),
    /** @param {number} factor */
    zoom: (factor) => zoomAt(middleOf(viewNow()), factor),
    zoomAt,
    /** @param {number[]} span middle east and north, width; metres */
    showSpan: ([east, north, wide]) => move({ ...viewNow(), east, north, scale: viewNow().width / wide }),
    /** A function that goes back to the present view. */
    bookmark: () => {
      const { camera } = store.get();
      return () => store.update({ camera });
    },
    /** @param {number} width @param {number} height pixels */
    resize: (width, height) => {
      const { view, moved } = store.get().camera;
      const isHidden = width === 0 || height === 0;
      if (isHidden || (view.width === width && view.height === height)) return;
      store.update({ camera: { view: { ...view, width, height }, moved } });
      if (!moved && !isInView()) fit();
    },
  };
}

// The view is at most this many times as wide as the scene, and at least this share of the smaller radius.
const WIDEST = 20;
const NARROWEST = 0.02;

/**
 * The least and the largest scale of the plan view: the scene never becomes a dot, and never one white screen.
 *
 * @param {PageState} state
 */
export function scaleLimits(state) {
  const { camera, scene } = state;
  const radius = Math.min(Math.abs(scene.orbit.radius_m), turnRadiusOf(scene.aircraft));
  const [least, most] = [fitState(state).camera.view.scale / WIDEST, camera.view.width / (NARROWEST * radius)];
  return Number.isFinite(most) ? { least, most: Math.max(least, most) } : { least, most: Infinity };
}

/**
 * A scale within the limits. Where the present scale is beyond a limit, zooming back is all that is allowed.
 *
 * @param {number} wanted
 * @param {number} now
 * @param {PageState} state
 */
function allowedScale(wanted, now, state) {
  const { least, most } = scaleLimits(state);
  return Math.min(Math.max(wanted, Math.min(least, now)), Math.max(most, now));
}

/** The middle of a view, pixels. @param {View} view @returns {Point} */
export const middleOf = ({ width, height }) => [width / 2, height / 2];

/**
 * Show all of the scene after its first answer, then the view of its link. Start last, so that the plan view has its
 * size beside the new texts.
 *
 * @param {Store} store
 * @param {PlanCamera} camera
 */
export function showOpenedScenes(store, camera) {
  store.watch(
    ({ revision }) => [revision],
    ({ opening, revision }) => {
      if (!opening || revision < opening.revision) return;
      const box = byId("plan-box", HTMLElement);
      camera.resize(box.clientWidth, box.clientHeight);
      camera.fit();
      if (opening.span) camera.showSpan(opening.span);
      store.update({ opening: null });
    },
  );
}

/** @param {Pick<PageState, "camera" | "scene" | "answer" | "leg">} state */
function fitState({ camera, ...state }) {
  const { scene } = state;
  const contents = contentsOf(state, true);
  const margins = marginsOf(camera.view);
  const view = fitted(camera.view, contents, margins);
  // The handle of the heading has the same length at every scale; a second step brings it into view.
  const [east, north] = unitVector(scene.pose.heading_deg);
  const reach = HEADING_HANDLE_PX / view.scale;
  contents.push([scene.pose.east_m + reach * east, scene.pose.north_m + reach * north]);
  return {
    camera: { view: fitted(view, contents, margins), moved: false },
    radiusBearing_deg: freeBearing(scene, contents.slice(0, -1)),
  };
}

/** @param {View} view */
function marginsOf({ width, height }) {
  const share = Math.min(1, width / FULL_MARGINS_PX.width, height / FULL_MARGINS_PX.height);
  const { left, right, top, bottom } = MARGINS;
  return { left: left * share, right: right * share, top: top * share, bottom: bottom * share };
}

/**
 * Points of everything that a view should show: aircraft, circle, optimal paths, and at first every other candidate.
 *
 * @param {Pick<PageState, "scene" | "answer" | "leg">} state
 * @param {boolean} isFirst
 * @returns {Point[]}
 */
function contentsOf({ scene, answer, leg }, isFirst) {
  const { pose, orbit } = scene;
  const { best: fastest, others } = answer ? splitAnswer(answer) : { best: [], others: [] };
  const best = leg ? [leg.maneuver] : fastest;
  const centres = best.map(({ join_over_ground: centre }) => [centre.centre_east_m, centre.centre_north_m]);
  const r = Math.abs(orbit.radius_m);
  return [
    [pose.east_m, pose.north_m],
    ...(scene.leg ? [scene.leg.exit_to] : []),
    ...(isFirst ? zonePoints(scene) : []),
    ...[...best, ...(isFirst && !leg ? others : [])].flatMap(({ track }) => track.east_m.map((east, i) => /** @type {Point} */ ([east, track.north_m[i]]))),
    ...[[orbit.east_m, orbit.north_m], ...centres].flatMap(([east, north]) => [
      /** @type {Point} */ ([east - r, north - r]),
      /** @type {Point} */ ([east + r, north + r]),
    ]),
  ];
}

/**
 * The bearing at which the circle is farthest from all other points: there is room for the handle of the radius.
 *
 * @param {Scene} scene
 * @param {Point[]} points
 */
function freeBearing({ orbit }, points) {
  const bearings = Array.from({ length: 24 }, (_, k) => 15 * k + 7);
  const distances = bearings.map((bearing) => {
    const [east, north] = unitVector(bearing).map((part) => part * orbit.radius_m);
    return Math.min(...points.map(([x, y]) => Math.hypot(x - orbit.east_m - east, y - orbit.north_m - north)));
  });
  return bearings[distances.indexOf(Math.max(...distances))];
}
