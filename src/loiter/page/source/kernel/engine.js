// @ts-check
/**
 * The answers of the library for scenes: computed by the kernel and the library that
 * are translated from Python.
 *
 * @typedef {import("../shared/types.js").Scene} Scene
 * @typedef {import("../shared/types.js").Answer} Answer
 * @typedef {import("../shared/types.js").Proof} Proof
 * @typedef {import("../shared/types.js").Track} Track
 * @typedef {Scene & import("../shared/types.js").Altitude} SceneWithAltitude
 */
import { LoiterError } from "./errors.js";
import * as translated from "./library.js";
import { plain } from "./python.js";

export { synthesis } from "./synthesis.js";

/** @type {any} */
const library = translated;

/** The plan of a scene and all alternatives. @param {Scene} scene @returns {Answer} */
export const plan = (scene) => plain(library.plan(placed(scene), slotOf(scene)));

/** The certificate of the first optimal maneuver. @param {Scene} scene @returns {Proof} */
export const certificate = (scene) => plain(library.certificate(placed(scene), slotOf(scene)));

/** A round of the circle after the first optimal maneuver. @param {Scene} scene @returns {Track} */
export const lap = (scene) => plain(library.lap(firstOf(scene)));

/**
 * Where the slot of a scene is at a time, if it moves in a direction of the hold.
 *
 * @param {Scene} scene
 * @param {import("../shared/types.js").Direction} turn
 * @param {number} time_s
 * @returns {import("../shared/types.js").Pose}
 */
export const slotPose = (scene, turn, time_s) => library.slot_pose(slotOf(scene), placed(scene).problem.with_turn(turn), time_s);

/** The way in, round and out of a scene with a leg. @param {Scene} scene @returns {import("../shared/types.js").LegPlan} */
export const legPlan = (scene) => plain(library.leg_plan(placed(scene), scene.leg));

/**
 * Whether the plan of a scene with a fence, or its leg, stays clear of it.
 *
 * @param {Scene} scene
 * @returns {import("../shared/types.js").FenceCheck}
 */
export const fenceCheck = (scene) =>
  plain(
    scene.leg
      ? library.leg_fence_check(placed(scene), scene.leg, ...fenced(scene))
      : library.fence_check(placed(scene), ...fenced(scene), slotOf(scene)),
  );

/** The fastest clear entry that is found. @param {Scene} scene @returns {import("../shared/types.js").ClearEntry} */
export const clearEntry = (scene) => plain(library.clear_plan(placed(scene), ...fenced(scene)));

const CHORD_ERROR_M = 1; // as in `loiter plan --save`

/**
 * The plan as a file: that of the leg or, where the plan is not clear of the scene's fence, of the fastest clear entry.
 *
 * @param {string} format  "geojson"
 * @param {SceneWithAltitude} options
 * @returns {{content: string, type: string}}
 */
export function file(format, { altitude_m = undefined, altitude_reference = "msl", home_altitude_m, ...scene }) {
  const ending = `.${format}`;
  const known = library.FILE_FORMATS.find((/** @type {{endings: string[]}} */ { endings }) => endings.includes(ending));
  if (scene.leg) return { content: library.leg_file(placed(scene), scene.leg, ending), type: known.media_type };
  const { frame } = placed(scene);
  // No clear entry is searched for into a slot.
  const isPlan = !scene.fence || scene.slot || fenceCheck(scene).clear;
  const maneuver = isPlan ? firstOf(scene) : library.clear_maneuver(placed(scene), ...fenced(scene));
  if (format === "svg") return { content: library.drawn_svg(maneuver), type: "image/svg+xml" };
  library.check_points(maneuver, CHORD_ERROR_M);
  const datum = library.AltitudeDatum(altitude_reference, home_altitude_m ?? null);
  const altitude = altitude_m === undefined ? null : datum.checked(altitude_m);
  // A mission with a loiter alone lets the autopilot choose its way there.
  const isWholePath = ["plan", "waypoints"].includes(format) && (!isPlan || Boolean(scene.slot));
  const autopilot = library.AUTOPILOTS.get("ardupilot");
  const options = library.SaveArguments(maneuver, frame, altitude, datum, null, CHORD_ERROR_M, autopilot, isWholePath);
  return { content: known.content(ending, options), type: known.media_type };
}

/** @param {Scene} scene */
function placed({ pose, orbit, aircraft, wind, tolerance_m = 0, origin }) {
  const problem = library.Problem(
    library.Pose(pose.east_m, pose.north_m, pose.heading_deg),
    library.Orbit(
      orbit.east_m,
      orbit.north_m,
      orbit.radius_m,
      orbit.turn,
      orbit.velocity_east_m_s,
      orbit.velocity_north_m_s,
    ),
    library.Aircraft(
      aircraft.airspeed_m_s,
      aircraft.max_bank_deg ?? null,
      aircraft.min_turn_radius_m ?? null,
      aircraft.max_turn_rate_deg_s ?? null,
    ),
    wind ? library.Wind(wind.speed_m_s, wind.from_deg) : undefined,
    tolerance_m,
  );
  const frame = origin ? library.LocalFrame(origin.latitude_deg, origin.longitude_deg) : null;
  return library.PlacedProblem(problem, frame);
}

/** The slot of a scene, as the library has it; null where it has none. @param {Scene} scene */
const slotOf = ({ slot }) => (slot ? library.Slot(slot.phase_deg, slot.at_s) : null);

/** The maneuver of the plan. @param {Scene} scene */
const firstOf = (scene) => library.first_maneuver(placed(scene).problem, slotOf(scene));

/** The fence of a scene and the margin, as the library has them. @param {Scene} scene */
function fenced({ fence }) {
  const { zones, margin_m } = fence ?? { zones: [], margin_m: null };
  const all = zones.map((zone) =>
    "corners" in zone
      ? library.PolygonZone(zone.name, zone.corners, zone.inclusion)
      : library.CircleZone(zone.name, zone.east_m, zone.north_m, zone.radius_m, zone.inclusion),
  );
  return [library.Fence(all), margin_m];
}

/**
 * An error of the library as a refusal of a scene: its sentence with the names of the scene's fields, its kind, and the
 * fields that it refuses. Other errors are thrown again.
 *
 * @param {any} error
 */
export function refusal(error) {
  if (!(error instanceof LoiterError)) throw error;
  const { kind, argument, problem, fitted_radius_m = null } = /** @type {any} */ (error);
  if (argument === undefined) return { sentence: error.message, kind, places: [], fitted_radius_m };
  // "zone 'mast'" is no path of a scene.
  const named = argument.includes("'") ? { name: argument, path: "" } : null;
  const { name, path } = library.SCENE_FIELDS.get(argument) ?? named ?? {
    name: argument.replaceAll(" ", "."),
    path: argument.replaceAll(" ", "/"),
  };
  return { sentence: `${name} ${problem}`, kind, places: path ? [path] : [], fitted_radius_m };
}
