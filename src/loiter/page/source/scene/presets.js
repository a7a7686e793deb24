// @ts-check
/**
 * Example scenes.
 *
 * @import {Scene} from "../shared/types.js"
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 */
import { byId, html } from "../shared/dom.js";

const UAV = { airspeed_m_s: 18, max_bank_deg: 35 };
/** @type {import("../shared/types.js").Zone} */
const MAST = { name: "mast", east_m: -150, north_m: 90, radius_m: 60, inclusion: false };
/** @type {import("../shared/types.js").Zone} */
const FIELD = { name: "field", corners: [[-500, -150], [150, -150], [150, 250], [-500, 250]], inclusion: true };
/** @type {import("../shared/types.js").Leg} */
const CLIMB = { exit_to: [600, 0], hold_s: 0, turns: 0, start_altitude_m: 500, altitude_m: 700, climb_rate_m_s: 2.5, descent_rate_m_s: null };
const UNIT = { airspeed_m_s: 1, min_turn_radius_m: 1 };

/**
 * @param {[number, number, number]} pose east, north, heading
 * @param {number} radius_m
 * @param {Scene["aircraft"]} aircraft
 * @param {Scene["wind"]} wind
 * @returns {Scene}
 */
function scene([east_m, north_m, heading_deg], radius_m, aircraft, wind = null) {
  return {
    pose: { east_m, north_m, heading_deg },
    orbit: { east_m: 0, north_m: 0, radius_m, turn: "either", velocity_east_m_s: 0, velocity_north_m_s: 0 },
    aircraft,
    wind,
    tolerance_m: 0,
    origin: null,
    fence: null,
    slot: null,
    leg: null,
  };
}

/**
 * In the examples of the paper the aircraft heads east, the circle is about (0, 0) and the turn radius is 1 m, so that
 * the reduced state equals the position. In the last one the start is one hundredth of a turn radius inside the last
 * arc of a circle of the turn radius; just outside it the minimum time is much longer.
 *
 * @type {{name: string, scene: Scene}[]}
 */
export const PRESETS = [
  { name: "Beside the circle", scene: scene([90, 60, 100], 80, UAV) },
  { name: "Far away", scene: scene([-1200, 500, 20], 80, UAV) },
  { name: "Inside the circle", scene: scene([20, -60, 30], 120, UAV) },
  { name: "Round a fence", scene: { ...scene([-400, 120, 90], 80, UAV), fence: { zones: [MAST, FIELD], margin_m: null } } },
  { name: "Into a slot", scene: { ...scene([-400, 120, 90], 120, UAV), slot: { phase_deg: 200, at_s: 0 } } },
  { name: "Climb and leave", scene: { ...scene([-400, 120, 90], 120, UAV), leg: CLIMB } },
  { name: "In wind", scene: scene([-400, 120, 90], 120, UAV, { speed_m_s: 8, from_deg: 250 }) },
  { name: "Paper, example 1", scene: scene([4, 4, 90], 1, UNIT) },
  { name: "Paper, example 2", scene: scene([-0.53, 0.31, 90], 1, UNIT) },
  { name: "Just inside the jump", scene: scene([-0.954, 0.746, 90], 1, UNIT) },
];

/** The buttons that open the examples. The place on Earth stays. @param {Store} store @param {Actions} actions */
export function presetButtons(store, actions) {
  for (const { name, scene } of PRESETS) {
    const button = html("button", { type: "button" }, [name]);
    button.addEventListener("click", () =>
      actions.openScene({ scene: { ...scene, origin: store.get().scene.origin } }),
    );
    byId("presets", HTMLElement).append(button);
  }
}
