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
 * @typedef {object} Field
 * @property {Quantity} quantity
 * @property {(scene: Scene) => number | undefined} get
 * @property {(scene: Scene, value: number) => Scene} set
 */
import { limitFor } from "./compass.js";
import { LIMITS, limitOf } from "./scene.js";
import { byId } from "./svg.js";
import { shortened, tidy, unit } from "./units.js";

/** @param {keyof Scene["pose"]} name @returns {Field["set"]} */
const inPose = (name) => (scene, value) => ({ ...scene, pose: { ...scene.pose, [name]: value } });
/** @param {keyof Scene["orbit"]} name @returns {Field["set"]} */
const inOrbit = (name) => (scene, value) => ({ ...scene, orbit: { ...scene.orbit, [name]: value } });

/** @type {Record<string, Field>} */
const FIELDS = {
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

/** @type {Field} */
const LIMIT_FIELD = {
  quantity: "degrees",
  get: (scene) => scene.aircraft[limitOf(scene)],
  set: (scene, value) => ({ ...scene, aircraft: { ...scene.aircraft, [limitOf(scene)]: value } }),
};

/**
 * @param {() => Shown} shown
 * @param {(scene: Scene, event: Event) => void} change
 * @param {(sentence: string) => void} complain
 */
export function controls(shown, change, complain) {
  const inputs = Object.fromEntries([...Object.keys(FIELDS), "limit"].map((id) => [id, byId(id, HTMLInputElement)]));
  const kind = byId("limit-kind", HTMLSelectElement);
  const turns = Array.from(document.querySelectorAll("input[name=turn]")).filter(
    (each) => each instanceof HTMLInputElement,
  );

  /** @param {string} id @param {Scene} scene @returns {{field: Field, quantity: Quantity}} */
  const fieldOf = (id, scene) =>
    id === "limit"
      ? { field: LIMIT_FIELD, quantity: QUANTITIES[limitOf(scene)] }
      : { field: FIELDS[id], quantity: FIELDS[id].quantity };

  for (const [id, input] of Object.entries(inputs))
    input.addEventListener("input", (event) => {
      const { scene, units } = shown();
      const { field, quantity } = fieldOf(id, scene);
      const value = input.valueAsNumber;
      input.setAttribute("aria-invalid", String(!Number.isFinite(value)));
      if (!Number.isFinite(value)) return complain(`${labelOf(input)} needs a number.`);
      change(field.set(scene, value * unit(quantity, units).size), event);
    });
  for (const input of Object.values(inputs)) input.addEventListener("blur", () => draw(shown()));
  for (const input of turns)
    input.addEventListener("change", (event) => {
      const { scene } = shown();
      change({ ...scene, orbit: { ...scene.orbit, turn: /** @type {Turn} */ (input.value) } }, event);
    });
  kind.addEventListener("change", (event) => {
    const { scene, answer } = shown();
    const name = LIMITS.find((limit) => limit === kind.value) ?? "max_bank_deg";
    const { airspeed_m_s } = scene.aircraft;
    const value = limitFor(name, airspeed_m_s, answer?.aircraft.turn_radius_m ?? scene.orbit.radius_m);
    change({ ...scene, aircraft: { airspeed_m_s, [name]: tidy(value, value / 1000) } }, event);
  });

  /** @param {Shown} now */
  function draw({ scene, units }) {
    for (const [id, input] of Object.entries(inputs)) {
      const { field, quantity } = fieldOf(id, scene);
      const { name, size } = unit(quantity, units);
      const suffix = input.nextElementSibling;
      if (suffix) suffix.textContent = name;
      // What is being typed stays as it is typed.
      if (document.activeElement === input) continue;
      input.removeAttribute("aria-invalid");
      const value = field.get(scene);
      input.value = value === undefined ? "" : String(shortened(value / size));
    }
    inputs["wind-from"].disabled = scene.wind === null;
    kind.value = limitOf(scene);
    for (const input of turns) input.checked = input.value === scene.orbit.turn;
  }
  return { draw };
}

/** @param {HTMLInputElement} input */
const labelOf = (input) =>
  input.getAttribute("aria-label") ?? input.labels?.[0]?.querySelector("span")?.textContent ?? "The field";
