// @ts-check
/**
 * The fence in the plan view: what must not be entered is shaded, with the margin. Each zone has a handle that moves
 * it, and one for its radius or one at each of its corners.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Actions} from "../state/actions.js"
 * @import {CircleZone, PolygonZone, Scene, Zone} from "../shared/types.js"
 * @import {Box, Point, View} from "../shared/geometry.js"
 * @import {Handle, Stage} from "./handles.js"
 */
import { anchorOf, isPolygon, movedZone, withZone, withoutCorner, withoutZone, zonesOf } from "../scene/fence.js";
import { fill, part, polyline, svg } from "../shared/dom.js";
import { placeHandle } from "../shared/draggable.js";
import { pointAt, toScreen, toWorld } from "../shared/geometry.js";
import { decimalsFor, quantityText, tidy } from "../shared/units.js";
import { connect, stageOf } from "./handle_layer.js";
import { handleParts, positionText, resolutionOf, stepOf } from "./handles.js";

// Pixels from the handle of a zone down to its name: above the handle of a circle, and inside of a polygon.
const NAME_PX = { circle: -14, polygon: 24 };
const HANDLE_PX = 11; // around a handle: no label covers it
const LEAST_RADIUS_PX = 22; // from the centre to the handle of the radius
const RADIUS_BEARING_DEG = 45;

/** The zones, shaded where nothing may fly. @param {PageState} state */
export function drawFence({ camera: { view }, scene, fence }) {
  const margin_px = (fence?.check?.margin_m ?? scene.fence?.margin_m ?? 0) * view.scale;
  return zonesOf(scene).flatMap((zone) => {
    const d = outline(view, zone);
    const everywhere = `M-9 -9H${view.width + 9}V${view.height + 9}H-9Z`;
    const [x, y] = toScreen(view, ...anchorOf(zone));
    const forbidden = { d: zone.inclusion ? everywhere + d : d, "fill-rule": "evenodd", "stroke-width": 2 * margin_px };
    return [
      part("g", { class: "forbidden" }, [part("path", forbidden)]),
      part("path", { d, class: "edge" }),
      part("text", { x, y: y + nameOffset(zone), class: "halo", "text-anchor": "middle" }, [zone.name]),
    ];
  });
}

/** @param {Zone} zone */
const nameOffset = (zone) => (isPolygon(zone) ? NAME_PX.polygon : NAME_PX.circle);

/** What labels must not cover: the handles of zones, and their names. @param {PageState} state @returns {Box[]} */
export const fenceBoxes = ({ camera: { view }, scene }) =>
  zonesOf(scene).flatMap((zone) => {
    const [x, y] = toScreen(view, ...anchorOf(zone));
    const places = isPolygon(zone) ? zone.corners.map(([east, north]) => toScreen(view, east, north)) : [radiusPoint(view, zone)];
    const middle = y + nameOffset(zone) - 4;
    const name = { left: x - 4 * zone.name.length, right: x + 4 * zone.name.length, top: middle - 9, bottom: middle + 9 };
    return [name, ...[[x, y], ...places].map(([px, py]) => ({ left: px - HANDLE_PX, right: px + HANDLE_PX, top: py - HANDLE_PX, bottom: py + HANDLE_PX }))];
  });

/** Where the handle of the radius of a circle is. @param {View} view @param {CircleZone} zone */
const radiusPoint = (view, { east_m, north_m, radius_m }) =>
  pointAt(toScreen(view, east_m, north_m), RADIUS_BEARING_DEG, Math.max(LEAST_RADIUS_PX, radius_m * view.scale));

/** The outline of a zone as a path. @param {View} view @param {Zone} zone */
function outline(view, zone) {
  if (isPolygon(zone)) return `${polyline(zone.corners.map(([east, north]) => toScreen(view, east, north)))}Z`;
  const [x, y] = toScreen(view, zone.east_m, zone.north_m);
  const r = zone.radius_m * view.scale;
  return `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`;
}

/** @param {SVGSVGElement} root @param {SVGGElement} layer @param {SVGGElement} handles @param {Store} store @param {Actions} actions */
export function fenceLayer(root, layer, handles, store, actions) {
  const group = svg("g", { class: "zones" });
  handles.prepend(group);
  /** @type {{handle: Handle, group: SVGGElement}[]} */
  let drawn = [];
  let shape = "";
  store.watch(
    ({ camera, scene, fence }) => [camera, scene.fence, fence],
    (state) => fill(layer, drawFence(state)),
  );
  store.watch(
    ({ camera, scene, units }) => [camera, scene, units],
    ({ scene, units }) => {
      const wanted = JSON.stringify(zonesOf(scene).map((zone) => [zone.name, isPolygon(zone) && zone.corners.length]));
      if (wanted !== shape) rebuild(scene);
      shape = wanted;
      for (const one of drawn)
        placeHandle(one.group, one.handle.position(stageOf(store)), one.handle.value(scene), one.handle.text(scene, units));
    },
  );

  /** New handles, for zones that have come, gone, or have other corners. @param {Scene} scene */
  function rebuild(scene) {
    const focused = document.activeElement?.id ?? "";
    const had = group.contains(document.activeElement);
    drawn = zonesOf(scene).flatMap(handlesOf).map((handle) => ({ handle, group: svg("g", { id: handle.id }, handle.parts) }));
    group.replaceChildren(...drawn.map((one) => one.group));
    for (const one of drawn) connect(one.group, root, one.handle, store, actions);
    // The focus stays where it was, or goes to the plan.
    if (had) (drawn.find(({ handle }) => handle.id === focused)?.group ?? root).focus({ preventScroll: true });
  }
}

/** The handles of a zone. @param {Zone} zone @param {number} i @returns {Handle[]} */
function handlesOf(zone, i) {
  const others = isPolygon(zone) ? zone.corners.map((_, k) => cornerHandle(zone, i, k)) : [radiusHandle(zone, i)];
  return [moveHandle(zone, i), ...others];
}

const square = () => svg("path", { d: "M-5.5-5.5H5.5V5.5H-5.5Z", class: "knob" });
const diamond = () => svg("path", { d: "M0-7 7 0 0 7-7 0Z", class: "knob" });

/** @param {Zone} zone @param {number} i @returns {Handle} */
function moveHandle({ name }, i) {
  const zoneOf = (/** @type {Scene} */ scene) => zonesOf(scene)[i];
  const middle = (/** @type {Scene} */ scene) => anchorOf(zoneOf(scene));
  /** @param {Stage} stage @param {number} east @param {number} north */
  const moved = ({ view, scene }, east, north) =>
    withZone(scene, i, tidied(movedZone(zoneOf(scene), east, north), resolutionOf(view)));
  return {
    id: `zone-${i}`,
    label: `Zone ${name}`,
    parts: handleParts(20, 13, diamond()),
    position: ({ view, scene }) => toScreen(view, ...middle(scene)),
    dragTo: (stage, point) => {
      const [east, north] = toWorld(stage.view, point);
      const [x, y] = middle(stage.scene);
      return moved(stage, east - x, north - y);
    },
    moveBy: (stage, right, up) => moved(stage, right * stepOf(stage), up * stepOf(stage)),
    remove: ({ scene }) => withoutZone(scene, i),
    value: (scene) => middle(scene)[0],
    text: (scene, units) => positionText(positionOf(middle(scene)), scene, units),
  };
}

/** @param {CircleZone} zone @param {number} i @returns {Handle} */
function radiusHandle({ name }, i) {
  const zoneOf = (/** @type {Scene} */ scene) => /** @type {CircleZone} */ (zonesOf(scene)[i]);
  /** @param {Stage} stage @param {number} radius */
  const withRadius = ({ view, scene }, radius) => {
    const radius_m = tidy(radius, resolutionOf(view));
    return radius_m > 0 ? withZone(scene, i, { ...zoneOf(scene), radius_m }) : scene;
  };
  const centre = (/** @type {Stage} */ { view, scene }) => toScreen(view, zoneOf(scene).east_m, zoneOf(scene).north_m);
  return {
    id: `zone-${i}-radius`,
    label: `Radius of zone ${name}`,
    parts: handleParts(20, 12, square()),
    position: ({ view, scene }) => radiusPoint(view, zoneOf(scene)),
    dragTo: (stage, [x, y]) => {
      const [cx, cy] = centre(stage);
      return withRadius(stage, Math.hypot(x - cx, y - cy) / stage.view.scale);
    },
    moveBy: (stage, right, up) => withRadius(stage, zoneOf(stage.scene).radius_m + (right + up) * stepOf(stage)),
    value: (scene) => zoneOf(scene).radius_m,
    text: (scene, units) =>
      quantityText(zoneOf(scene).radius_m, "length", units, decimalsFor(scene.orbit.radius_m, units)),
  };
}

/** @param {PolygonZone} zone @param {number} i @param {number} k @returns {Handle} */
function cornerHandle({ name }, i, k) {
  const zoneOf = (/** @type {Scene} */ scene) => /** @type {PolygonZone} */ (zonesOf(scene)[i]);
  const corner = (/** @type {Scene} */ scene) => zoneOf(scene).corners[k];
  /** @param {Stage} stage @param {Point} place east and north */
  const moved = ({ view, scene }, place) => {
    const corners = zoneOf(scene).corners.map((one, j) => (j === k ? place : one));
    return withZone(scene, i, tidied({ ...zoneOf(scene), corners }, resolutionOf(view)));
  };
  return {
    id: `zone-${i}-corner-${k}`,
    label: `Corner ${k + 1} of zone ${name}`,
    parts: handleParts(18, 12, square()),
    position: ({ view, scene }) => toScreen(view, ...corner(scene)),
    dragTo: (stage, point) => moved(stage, toWorld(stage.view, point)),
    moveBy: (stage, right, up) => {
      const [east, north] = corner(stage.scene);
      return moved(stage, [east + right * stepOf(stage), north + up * stepOf(stage)]);
    },
    remove: ({ scene }) => withZone(scene, i, withoutCorner(zoneOf(scene), k)),
    value: (scene) => corner(scene)[0],
    text: (scene, units) => positionText(positionOf(corner(scene)), scene, units),
  };
}

/** @param {[number, number]} place */
const positionOf = ([east_m, north_m]) => ({ east_m, north_m });

/** A zone whose numbers are as short as its resolution allows. @param {Zone} zone @param {number} resolution @returns {Zone} */
function tidied(zone, resolution) {
  const short = (/** @type {number} */ value) => tidy(value, resolution);
  if (isPolygon(zone)) return { ...zone, corners: zone.corners.map(([east, north]) => [short(east), short(north)]) };
  return { ...zone, east_m: short(zone.east_m), north_m: short(zone.north_m) };
}

/** A mark where a path enters a zone, or is too close to it. @param {Point} point */
export const breachMark = ([x, y]) => part("path", { d: "M-6-6 6 6M-6 6 6-6", class: "breach", transform: `translate(${x} ${y})` });
