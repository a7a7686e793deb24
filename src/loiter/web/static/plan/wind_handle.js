// @ts-check
/**
 * The dial of the wind and its handle.
 *
 * @typedef {import("../shared/types.js").Scene} Scene
 * @typedef {import("../shared/geometry.js").View} View
 * @typedef {import("../shared/geometry.js").Point} Point
 * @typedef {import("./handles.js").Handle} Handle
 * @typedef {import("./handles.js").Stage} Stage
 */
import { withWind } from "../scene/scene.js";
import { polyline, setAttributes, svg } from "../shared/dom.js";
import { headingOf, pointAt, unitVector } from "../shared/geometry.js";
import { fixed, quantityText, tidy } from "../shared/units.js";
import { handleParts } from "./handles.js";

const DIAL_PX = { small: 28, large: 42 }; // radius; it stands for half the airspeed
const NARROW_PX = 500; // narrower views get the small dial
const RIGHT_PX = 64; // from the middle to the edge: half the width of the longest label

/** The radius of the dial, pixels. @param {View} view */
const dialRadius = (view) => (view.width < NARROW_PX ? DIAL_PX.small : DIAL_PX.large);

/** The middle of the dial. @param {View} view @returns {Point} */
function dialMiddle(view) {
  const r = dialRadius(view);
  return [view.width - RIGHT_PX, r + (r === DIAL_PX.large ? 30 : 14)];
}

// Keeps the scale of the dial finite while no airspeed is typed.
const LEAST_AIRSPEED_M_S = 1e-9;

/** Pixels on the dial per metre per second. @param {Stage} stage */
const dialScale = ({ view, scene }) =>
  (2 * dialRadius(view)) / Math.max(scene.aircraft.airspeed_m_s, LEAST_AIRSPEED_M_S);

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
  parts: handleParts(18, 12, svg("path", { d: "M0-9 6.5 5H-6.5Z", class: "tip" })),
  position: (stage) => {
    const { speed_m_s, from_deg } = windOf(stage.scene);
    const distance = Math.min(speed_m_s * dialScale(stage), 2 * dialRadius(stage.view));
    return pointAt(dialMiddle(stage.view), from_deg + 180, distance);
  },
  dragTo: (stage, [x, y]) => {
    const [left, top] = dialMiddle(stage.view);
    const distance = Math.hypot(x - left, y - top);
    // Calm next to the middle; at most 95 % of the airspeed.
    const share = distance < 3 ? 0 : Math.min(1, (1.9 * dialRadius(stage.view)) / distance);
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

/** The dial: the outer ring is half the airspeed, the inner one a quarter. */
export function windDial() {
  const rings = [svg("circle"), svg("circle", { class: "half" })];
  const dial = svg("g", { class: "dial" }, rings);
  const shaft = svg("path", { class: "shaft" });
  const text = svg("text", { class: "dialtext halo", "text-anchor": "middle" });
  /** @param {Stage} stage */
  function draw(stage) {
    const [x, y] = dialMiddle(stage.view);
    const r = dialRadius(stage.view);
    rings.forEach((ring, i) => ring.setAttribute("r", String(r / (i + 1))));
    dial.setAttribute("transform", `translate(${x} ${y})`);
    shaft.setAttribute("d", polyline([[x, y], WIND.position(stage)]));
    setAttributes(text, { x, y: y + r + 18 });
    text.textContent = stage.scene.wind ? WIND.text(stage.scene, stage.units) : "wind: calm";
  }
  return { group: svg("g", { class: "air" }, [dial, text, shaft]), draw };
}
