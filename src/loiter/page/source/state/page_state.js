// @ts-check
/**
 * The state of the page. A plan, its certificate and the map are each in one of four states: `idle` (that of the scene),
 * `stale` (the scene has changed; computed again when the drag pauses), `asking` (being computed) and `failed`.
 *
 * @import {Altitude, Answer, FenceCheck, Origin, Proof, Scene, Synthesis, Units} from "../shared/types.js"
 * @import {View} from "../shared/geometry.js"
 *
 * @typedef {"idle" | "stale" | "asking" | "failed"} Status
 * @typedef {"light" | "dark"} Theme
 * @typedef {{text: string, bad: boolean}} Message
 * @typedef {Record<string, string>} FieldErrors  sentences by the ids of the fields
 *
 * @typedef {object} Camera
 * @property {View} view
 * @property {boolean} moved  whether the user has panned or zoomed
 *
 * @typedef {object} Opening  a scene that was opened and has no answer yet
 * @property {number} revision
 * @property {number[] | null} span  the view in its link: middle east and north, width; metres
 *
 * @typedef {object} Failure  the reason why the scene has no plan
 * @property {string} headline
 * @property {string} sentence
 * @property {number | null} fittedRadius_m  the least radius that can be held, if the circle is too small
 *
 * @typedef {object} MapOptions  the map that belongs to a plan
 * @property {string} title
 * @property {string} query
 * @property {boolean} drifts  whether air or circle move, or the scene has a slot, so that the map does not show the plan
 *
 * @typedef {object} Playback
 * @property {boolean} playing
 * @property {number} time_s
 * @property {number} speed  times real time
 *
 * @typedef {object} PageState
 * @property {Scene} scene
 * @property {Units} units
 * @property {Theme} theme
 * @property {boolean} theory  whether verdict, phi, psi and the reduced plane are shown
 * @property {Altitude} altitude
 * @property {Partial<Origin>} place  latitude and longitude as far as they are typed
 * @property {string | null} tiles  the address of the map tiles that the user has switched on
 * @property {Camera} camera  of the plan view
 * @property {number} mapSide  of the map, pixels
 * @property {number} timelineWidth  pixels
 * @property {number} radiusBearing_deg  the position on the circle of the handle for its radius
 * @property {Opening | null} opening
 * @property {number} revision  number of the newest scene
 * @property {number} step  number of the step of the user that led here, for undo and the browser's Back
 * @property {number} lastStep  the newest step; larger than `step` after an undo
 * @property {number} pausedRevision  number of the newest scene after which a drag has paused
 * @property {Record<"plan" | "certificate" | "map" | "clear", Status>} requests
 * @property {Answer | null} answer  the newest plan
 * @property {import("../shared/types.js").Track | null} lap  a round of the circle after joining, once it is played
 * @property {{check: FenceCheck | null, refusal: string} | null} fence  whether the plan stays clear of the scene's
 *   fence, or why that is not known
 * @property {import("../shared/types.js").ClearEntry | null} clear  the search for a clear entry, where the plan is not
 * @property {import("../shared/types.js").LegPlan | null} leg  the leg of the scene, if it has one
 * @property {Failure | null} failure
 * @property {Answer | null} announced  the plan of the last pause: its text is read out and can be copied
 * @property {Proof | null} proof  the certificate of the plan
 * @property {{certificate: string | null}} faults  why the certificate is missing
 * @property {MapOptions | null} wantedMap
 * @property {string} shownMap  query of the map that is shown
 * @property {Synthesis | null} synthesis
 * @property {number | null} highlighted  index of the candidate under the pointer
 * @property {Playback} playback
 * @property {Record<"scene" | "file", FieldErrors>} fieldErrors  for the scene, and for a file to save
 * @property {Message} message
 */
import { PRESETS } from "../scene/presets.js";
import { stateAt } from "../shared/maneuver.js";

/** @type {Message} */
export const NO_MESSAGE = { text: "", bad: false };

/** @type {PageState} */
export const INITIAL_STATE = {
  scene: PRESETS[0].scene,
  units: "metric",
  theme: "light",
  theory: true,
  altitude: {},
  place: {},
  tiles: null,
  camera: { view: { scale: 1, east: 0, north: 0, width: 800, height: 600 }, moved: false },
  mapSide: 380,
  timelineWidth: 700,
  radiusBearing_deg: 150,
  opening: null,
  revision: 0,
  pausedRevision: 0,
  step: 0,
  lastStep: 0,
  requests: { plan: "idle", certificate: "idle", map: "idle", clear: "idle" },
  answer: null,
  lap: null,
  fence: null,
  clear: null,
  leg: null,
  failure: null,
  announced: null,
  proof: null,
  faults: { certificate: null },
  wantedMap: null,
  shownMap: "",
  synthesis: null,
  highlighted: null,
  playback: { playing: false, time_s: 0, speed: 1 },
  fieldErrors: { scene: {}, file: {} },
  message: NO_MESSAGE,
};

/** The plan of the present scene, or null while there is none. @param {PageState} state */
export const currentPlan = ({ requests, answer }) => (requests.plan === "idle" ? answer : null);

/** What is flown: the leg, or the newest plan or, where that is not clear of the fence, the clear entry. @param {PageState} state */
export const flownOf = ({ answer, clear, leg }) => answer && (leg?.maneuver ?? clear?.maneuver ?? answer);

/** Whether the plan is flown, which the certificate is of: no leg, and no entry round a fence. @param {PageState} state */
export const isPlanFlown = ({ clear, leg }) => !leg && !clear?.maneuver;

/** The duration of what is flown, seconds. @param {PageState} state */
export const durationOf = (state) => flownOf(state)?.duration_s ?? 0;

/** The time on the path that is shown, seconds. @param {PageState} state */
export const shownTime = (state) => Math.min(state.playback.time_s, durationOf(state));

/** Whether no request is waiting or under way. @param {PageState} state */
export function isSettled({ revision, pausedRevision, failure, requests }) {
  if (pausedRevision !== revision) return false;
  const done = (/** @type {Status} */ status) => status === "idle" || status === "failed";
  return failure !== null || (done(requests.certificate) && done(requests.map) && done(requests.clear));
}

/** The time at which the playback ends, seconds: after a lap of the circle. @param {PageState} state */
export const endOf = (state) => state.lap?.time_s.at(-1) ?? durationOf(state);

/** The state of the ghost (the moving copy of the aircraft); null while it is at the start. @param {PageState} state */
export function ghostOf(state) {
  const { playback, lap } = state;
  const flown = flownOf(state);
  const { playing, time_s } = playback;
  if (!flown || !(playing || time_s > 0)) return null;
  if (lap && time_s > durationOf(state)) return stateAt(lap, time_s);
  return flown.segments.length > 0 ? stateAt(flown.track, shownTime(state)) : null;
}
