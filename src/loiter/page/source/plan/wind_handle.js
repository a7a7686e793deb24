// @ts-check
/**
 * The dial of the wind and its handle.
 *
 * @import {Scene} from "../shared/types.js"
 * @import {Box, Point, View} from "../shared/geometry.js"
 * @import {Handle, Stage} from "./handles.js"
 */
import { withWind } from "../scene/scene.js";
import { polyline, setAttributes, setText, svg } from "../shared/dom.js";
import { headingOf, overlaps, pointAt, positionToScreen, unitVector } from "../shared/geometry.js";
import { fixed, quantityText, tidy } from "../shared/units.js";
import { handleParts, handlePoints } from "./handles.js";

const DIAL_PX = { small: 30, large: 42 }; // radius; it stands for the airspeed
const NARROW_PX = 500; // narrower views get the small dial
const TEXT_PX = { half: 64, above: 22, below: 24 }; // half the width of the longest text, the lines above and below
const REACH_PX = 26; // of a finger around a handle

// Room for the buttons on the left, for the numbers of the grid and the key below.
const EDGES_PX = { left: 56, right: 4, top: 6, bottom: 52 };

/** The radius of the dial, pixels. @param {View} view */
const dialRadius = (view) => (view.width < NARROW_PX ? DIAL_PX.small : DIAL_PX.large);

/** The box of a dial and its texts. @param {View} view @param {Point} middle @returns {Box} */
function boxAround(view, [x, y]) {
  const r = dialRadius(view);
  const { half, above, below } = TEXT_PX;
  return { left: x - half, right: x + half, top: y - r - above, bottom: y + r + below };
}

/** The places of the dial, best first. @param {View} view @returns {Point[]} */
function dialPlaces(view) {
  const { width, height } = view;
  const r = dialRadius(view);
  const [left, right] = [EDGES_PX.left + TEXT_PX.half, width - EDGES_PX.right - TEXT_PX.half];
  const [top, bottom] = [EDGES_PX.top + TEXT_PX.above + r, height - EDGES_PX.bottom - TEXT_PX.below - r];
  const [middle, half] = [(left + right) / 2, (top + bottom) / 2];
  return [
    [right, top],
    [left, bottom],
    [left, top],
    [right, bottom],
    [right, half],
    [left, half],
    [middle, top],
    [middle, bottom],
  ];
}

/**
 * The middle of the dial: the first place where it lies over no handle and not over the circle, or at least over no
 * handle.
 *
 * @param {Stage} stage
 * @returns {Point}
 */
function dialMiddle(stage) {
  const { view, scene } = stage;
  const r = Math.abs(scene.orbit.radius_m) * view.scale;
  const circle = Array.from({ length: 48 }, (_, k) => pointAt(positionToScreen(view, scene.orbit), 7.5 * k, r));
  const isFree = (/** @type {Point[]} */ points, /** @type {number} */ reach) => (/** @type {Point} */ place) => {
    const { left, right, top, bottom } = boxAround(view, place);
    const grown = { left: left - reach, right: right + reach, top: top - reach, bottom: bottom + reach };
    return points.every(([x, y]) => !overlaps(grown, { left: x, right: x, top: y, bottom: y }));
  };
  const places = dialPlaces(view);
  const offHandles = places.filter(isFree(handlePoints(stage), REACH_PX));
  return offHandles.find(isFree(circle, 0)) ?? offHandles[0] ?? places[0];
}

/** The box of the dial and its texts. @param {Stage} stage */
export const dialBox = (stage) => boxAround(stage.view, dialMiddle(stage));

// Keeps the scale of the dial finite while no airspeed is typed.
const LEAST_AIRSPEED_M_S = 1e-9;

/** Pixels on the dial per metre per second. @param {Stage} stage */
const dialScale = ({ view, scene }) =>
  dialRadius(view) / Math.max(scene.aircraft.airspeed_m_s, LEAST_AIRSPEED_M_S);

/** The wind of a scene, with zero speed in still air. @param {Scene} scene */
const windOf = ({ wind }) => wind ?? { speed_m_s: 0, from_deg: 0 };

/**
 * The scene with a wind that moves the air by these components, metres per second.
 *
 * @param {Scene} scene
 * @param {number} east
 * @param {number} north
 * @returns {Scene}
 */
function withAirMotion(scene, east, north) {
  const speed_m_s = tidy(Math.hypot(east, north), scene.aircraft.airspeed_m_s / 180);
  return withWind(scene, { speed_m_s, from_deg: tidy(headingOf(-east, -north), 1) % 360 });
}

/** @type {Handle} */
export const WIND = {
  id: "wind",
  label: "Wind",
  // An arrowhead only in wind: in calm air it would look like a north arrow.
  parts: [
    ...handleParts(18, 12, svg("circle", { r: 6.5, class: "knob" })),
    svg("path", { d: "M0-9 6.5 5H-6.5Z", class: "tip" }),
  ],
  position: (stage) => {
    const { speed_m_s, from_deg } = windOf(stage.scene);
    const distance = Math.min(speed_m_s * dialScale(stage), dialRadius(stage.view));
    return pointAt(dialMiddle(stage), from_deg + 180, distance);
  },
  dragTo: (stage, [x, y]) => {
    const [left, top] = dialMiddle(stage);
    const distance = Math.hypot(x - left, y - top);
    // Calm next to the middle; at most 95 % of the airspeed.
    const share = distance < 3 ? 0 : Math.min(1, (0.95 * dialRadius(stage.view)) / distance);
    const speed = share / dialScale(stage);
    return withAirMotion(stage.scene, (x - left) * speed, (top - y) * speed);
  },
  moveBy: ({ scene }, right, up) => {
    const { speed_m_s, from_deg } = windOf(scene);
    const [east, north] = unitVector(from_deg + 180);
    const step = scene.aircraft.airspeed_m_s / 100;
    return withAirMotion(scene, speed_m_s * east + right * step, speed_m_s * north + up * step);
  },
  value: (scene) => windOf(scene).speed_m_s,
  text: ({ wind }, units) =>
    wind ? `${quantityText(wind.speed_m_s, "speed", units, 1)} from ${fixed(wind.from_deg, 0)}°` : "calm",
};

/** The dial: the outer ring is the airspeed, the inner one half of it. */
export function windDial() {
  const rings = [svg("circle"), svg("circle", { class: "half" })];
  const dial = svg("g", { class: "dial" }, rings);
  const shaft = svg("path", { class: "shaft" });
  const title = svg("text", { class: "dialtitle halo", "text-anchor": "middle" }, ["wind"]);
  const text = svg("text", { class: "dialtext halo", "text-anchor": "middle" });
  /** @param {Stage} stage */
  function draw(stage) {
    const [x, y] = dialMiddle(stage);
    const r = dialRadius(stage.view);
    rings.forEach((ring, i) => setAttributes(ring, { r: r / (i + 1) }));
    setAttributes(dial, { transform: `translate(${x} ${y})` });
    setAttributes(shaft, { d: polyline([[x, y], WIND.position(stage)]) });
    setAttributes(title, { x, y: y - r - 8 });
    setAttributes(text, { x, y: y + r + 18 });
    setText(text, WIND.text(stage.scene, stage.units));
  }
  return { group: svg("g", { class: "air" }, [dial, title, text, shaft]), draw };
}
