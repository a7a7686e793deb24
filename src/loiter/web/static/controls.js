// @ts-check
/**
 * The numbers of a scene, typed.
 *
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./types.js").Limit} Limit
 * @typedef {import("./types.js").Turn} Turn
 * @typedef {import("./types.js").Units} Units
 * @typedef {import("./units.js").Quantity} Quantity
 * @typedef {import("./plan.js").Shown} Shown
 *
 * @typedef {object} Part  a number of a scene
 * @property {Quantity} quantity
 * @property {(scene: Scene) => number | undefined} get
 * @property {(scene: Scene, value: number) => Scene} set
 */
import { limitFor, turnRadiusOf } from "./compass.js";
import { numberField } from "./fields.js";
import { LIMITS, limitOf } from "./scene.js";
import { byId } from "./svg.js";
import { tidy } from "./units.js";

/** @param {keyof Scene["pose"]} name @returns {Part["set"]} */
const inPose = (name) => (scene, value) => ({ ...scene, pose: { ...scene.pose, [name]: value } });
/** @param {keyof Scene["orbit"]} name @returns {Part["set"]} */
const inOrbit = (name) => (scene, value) => ({ ...scene, orbit: { ...scene.orbit, [name]: value } });

/** @type {Record<string, Part>} */
const PARTS = {
  east: { quantity: "length", get: ({ pose }) => pose.east_m, set: inPose("east_m") },
  north: { quantity: "length", get: ({ pose }) => pose.north_m, set: inPose("north_m") },
  course: { quantity: "degrees", get: ({ pose }) => pose.heading_deg, set: inPose("heading_deg") },
  airspeed: {
    quantity: "speed",
    get: ({ aircraft }) => aircraft.airspeed_m_s,
    set: (scene, airspeed_m_s) => ({ ...scene, aircraft: { ...scene.aircraft, airspeed_m_s } }),
  },
  "centre-east": { quantity: "length", get: ({ orbit }) => orbit.east_m, set: inOrbit("east_m") },
  "centre-north": { quantity: "length", get: ({ orbit }) => orbit.north_m, set: inOrbit("north_m") },
  "circle-radius": { quantity: "length", get: ({ orbit }) => orbit.radius_m, set: inOrbit("radius_m") },
  "velocity-east": {
    quantity: "speed",
    get: ({ orbit }) => orbit.velocity_east_m_s,
    set: inOrbit("velocity_east_m_s"),
  },
  "velocity-north": {
    quantity: "speed",
    get: ({ orbit }) => orbit.velocity_north_m_s,
    set: inOrbit("velocity_north_m_s"),
  },
  "wind-speed": {
    quantity: "speed",
    get: ({ wind }) => wind?.speed_m_s ?? 0,
    set: (scene, speed_m_s) => ({
      ...scene,
      wind: speed_m_s === 0 ? null : { speed_m_s, from_deg: scene.wind?.from_deg ?? 270 },
    }),
  },
  "wind-from": {
    quantity: "degrees",
    get: ({ wind }) => wind?.from_deg,
    set: (scene, from_deg) => ({ ...scene, wind: scene.wind && { ...scene.wind, from_deg } }),
  },
};

/** @type {Record<Limit, Quantity>} */
const QUANTITIES = { max_bank_deg: "degrees", min_turn_radius_m: "length", max_turn_rate_deg_s: "rate" };

/** @type {Part} */
const LIMIT_PART = {
  quantity: "degrees",
  get: (scene) => scene.aircraft[limitOf(scene)],
  set: (scene, value) => ({ ...scene, aircraft: { ...scene.aircraft, [limitOf(scene)]: value } }),
};

/**
 * The part of a scene that a field shows.
 *
 * @param {string} id
 * @param {Scene} scene
 * @returns {Part}
 */
const partOf = (id, scene) => (id === "limit" ? { ...LIMIT_PART, quantity: QUANTITIES[limitOf(scene)] } : PARTS[id]);

/**
 * @param {() => Shown} shown
 * @param {(scene: Scene, event: Event) => void} change
 */
export function controls(shown, change) {
  const inputs = Object.fromEntries([...Object.keys(PARTS), "limit"].map((id) => [id, byId(id, HTMLInputElement)]));
  const kind = byId("limit-kind", HTMLSelectElement);
  const turns = Array.from(document.querySelectorAll("input[name=turn]")).filter(
    (each) => each instanceof HTMLInputElement,
  );
  const fields = Object.fromEntries(
    Object.entries(inputs).map(([id, input]) => [id, numberField(input, sourceOf(id, shown, change))]),
  );

  for (const input of turns)
    input.addEventListener("change", (event) => {
      const { scene } = shown();
      change({ ...scene, orbit: { ...scene.orbit, turn: /** @type {Turn} */ (input.value) } }, event);
    });
  kind.addEventListener("change", (event) => {
    const { scene } = shown();
    const name = LIMITS.find((limit) => limit === kind.value) ?? "max_bank_deg";
    const { airspeed_m_s } = scene.aircraft;
    const value = limitFor(name, airspeed_m_s, turnRadiusOf(scene.aircraft));
    change({ ...scene, aircraft: { airspeed_m_s, [name]: tidy(value, value / 1000) } }, event);
  });

  function draw() {
    const { scene } = shown();
    kind.value = limitOf(scene);
    inputs.limit.setAttribute("aria-label", kind.selectedOptions[0].text);
    inputs["wind-from"].disabled = scene.wind === null;
    for (const field of Object.values(fields)) field.draw();
    for (const input of turns) input.checked = input.value === scene.orbit.turn;
  }
  return { draw, fields };
}

/**
 * The number of a scene that a field shows and sets.
 *
 * @param {string} id
 * @param {() => Shown} shown
 * @param {(scene: Scene, event: Event) => void} change
 * @returns {import("./fields.js").Source}
 */
function sourceOf(id, shown, change) {
  return {
    quantity: () => partOf(id, shown().scene).quantity,
    units: () => shown().units,
    get: () => partOf(id, shown().scene).get(shown().scene),
    set(value, event) {
      const { scene } = shown();
      if (value !== undefined) change(partOf(id, scene).set(scene, value), event);
    },
  };
}
