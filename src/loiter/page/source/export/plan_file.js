// @ts-check
/**
 * A mission of QGroundControl, dropped on the page or opened: its first loiter is the circle, and the place before it
 * that of the aircraft.
 *
 * @import {Altitude, Scene} from "../shared/types.js"
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 */
import { withOrbit, withPose } from "../scene/scene.js";
import { withZones } from "../scene/fence.js";
import { byId } from "../shared/dom.js";
import { REACH_M, toLocal } from "../shared/earth.js";
import { headingOf } from "../shared/geometry.js";
import { tidy } from "../shared/units.js";

/** Where each command that flies a circle has its radius: NAV_LOITER_UNLIM, _TURNS, _TIME, _TO_ALT. @type {Record<number, number>} */
const RADIUS_AT = { 17: 2, 18: 2, 19: 2, 31: 1 };

/** The members of a fence and its areas that may be lists or objects; others may be zones too, or their holes. */
const KNOWN = new Set(["circles", "polygons", "breachReturn", "circle", "polygon", "center"]);

/** The reference of each frame of MAVLink. @type {Record<number, import("../shared/types.js").Reference>} */
const REFERENCES = { 0: "msl", 3: "home", 10: "ground" };

/**
 * The scene of a plan, and the altitude of its mission. Throws an Error with a sentence.
 *
 * @param {string} text  of the file
 * @param {Scene} scene  has what the plan does not say
 * @returns {{scene: Scene, altitude: Altitude | null}}  no altitude where the plan has a fence alone
 */
export function sceneOfPlan(text, scene) {
  const { fileType, mission, geoFence } = parsed(text);
  if (fileType !== "Plan" || !Array.isArray(mission?.items)) throw new Error("This file is no plan of QGroundControl.");
  const items = mission.items.filter((/** @type {any} */ { type, params }) => type === "SimpleItem" && params?.length === 7);
  const at = items.findIndex((/** @type {any} */ { command }) => command in RADIUS_AT);
  if (at < 0) {
    const placed = withFence(scene, geoFence);
    if (!placed.fence || placed === scene) throw new Error("This plan has no loiter.");
    return { scene: placed, altitude: null };
  }
  const { command, frame, params } = items[at];
  const signed_m = params[RADIUS_AT[command]];
  if (!signed_m) throw new Error("The loiter of this plan has no radius: the autopilot uses its own.");
  const origin = { latitude_deg: params[4], longitude_deg: params[5] };
  const circle = { east_m: 0, north_m: 0, radius_m: Math.abs(signed_m), velocity_east_m_s: 0, velocity_north_m_s: 0 };
  const [home, ...places] = [mission.plannedHomePosition, ...items.slice(0, at).map((/** @type {any} */ item) => item.params.slice(4))]
    .filter((place) => place?.[0] || place?.[1])
    .map(([latitude_deg, longitude_deg]) => toLocal(origin, { latitude_deg, longitude_deg }));
  return {
    scene: withFence(
      withPose({ ...withOrbit(scene, { ...circle, turn: signed_m < 0 ? "ccw" : "cw" }), origin, fence: null, leg: null }, poseOf([home, ...places])),
      geoFence,
    ),
    altitude: {
      altitude_m: params[6],
      altitude_reference: REFERENCES[frame],
      home_altitude_m: mission.plannedHomePosition?.[2],
    },
  };
}

/**
 * A scene with the fence of a plan, if it has one. A scene without a place on Earth has its (0, 0) in the first zone.
 *
 * @param {Scene} scene
 * @param {any} fence  the plan's geoFence
 * @returns {Scene}
 */
function withFence(scene, fence) {
  const unknown = [fence, ...list(fence?.circles), ...list(fence?.polygons), ...list(fence?.circles).map(({ circle }) => circle)]
    .flatMap((one) => Object.entries(one ?? {}))
    .find(([name, value]) => !KNOWN.has(name) && value !== null && typeof value === "object" && Object.keys(value).length > 0);
  if (unknown) throw new Error(`The fence of this plan has ${unknown[0]}, which is not known and may restrict the flight.`);
  const circles = list(fence?.circles).map(({ circle, inclusion }, i) => ({ name: `circle ${i + 1}`, inclusion, corners: [circle?.center], radius_m: circle?.radius }));
  const polygons = list(fence?.polygons).map(({ polygon, inclusion }, i) => ({ name: `polygon ${i + 1}`, inclusion, corners: list(polygon), radius_m: 0 }));
  const areas = [...polygons, ...circles];
  if (areas.length === 0) return scene;
  const isPlace = (/** @type {any} */ place) => Array.isArray(place) && place.length === 2 && place.every(Number.isFinite);
  const fault = areas.find(
    ({ corners, radius_m, inclusion }) => !corners.every(isPlace) || !(Number.isFinite(radius_m) && radius_m >= 0) || typeof inclusion !== "boolean",
  );
  if (fault) throw new Error(`The fence of this plan has a fault in ${fault.name}.`);
  const [[latitude_deg, longitude_deg]] = areas[0].corners;
  const origin = scene.origin ?? { latitude_deg, longitude_deg };
  const zones = areas.map(({ name, inclusion, corners, radius_m }) => {
    /** @type {[number, number][]} */
    const places = corners.map(([latitude, longitude]) => {
      const [east, north] = toLocal(origin, { latitude_deg: latitude, longitude_deg: longitude });
      return [tidy(east, 0.001), tidy(north, 0.001)];
    });
    if (!radius_m) return { name, inclusion, corners: places };
    const [[east_m, north_m]] = places;
    return { name, inclusion, east_m, north_m, radius_m };
  });
  return withZones({ ...scene, origin }, zones);
}

/** @param {unknown} value @returns {any[]} */
const list = (value) => (Array.isArray(value) ? value : []);

/** The object in a JSON text. @param {string} text @returns {any} */
function parsed(text) {
  try {
    return JSON.parse(text) ?? {};
  } catch {
    throw new Error("This file is no plan of QGroundControl: it is not JSON.");
  }
}

/**
 * The aircraft at the last place before the loiter, as it comes from the place before; what is not known stays.
 *
 * @param {number[][]} places  east and north, metres
 * @returns {Partial<Scene["pose"]>}
 */
function poseOf(places) {
  const [[east, north] = [NaN, NaN], before] = places.filter(Boolean).reverse();
  if (!(Math.hypot(east, north) <= REACH_M)) return {};
  const [fromEast, fromNorth] = before ?? [2 * east, 2 * north]; // towards the circle
  const heading_deg = tidy(headingOf(east - fromEast, north - fromNorth), 0.1);
  return { east_m: tidy(east, 0.01), north_m: tidy(north, 0.01), heading_deg };
}

/** Open a plan that is dropped on the page or chosen. @param {Store} store @param {Actions} actions */
export function planOpener(store, actions) {
  /** @param {File | undefined} file */
  async function open(file) {
    if (!file) return;
    try {
      const { scene, altitude } = sceneOfPlan(await file.text(), store.get().scene);
      actions.openScene({ scene, ...(altitude ? { altitude } : {}), place: { ...scene.origin } });
      const parts = altitude ? `Circle, aircraft${scene.fence ? ", fence" : ""} and altitude are` : "The fence is";
      actions.say(`${parts} ${altitude ? "those" : "that"} of ${file.name}.`);
    } catch (error) {
      actions.say(/** @type {Error} */ (error).message, true);
    }
  }
  const chooser = byId("open-plan", HTMLInputElement);
  chooser.addEventListener("change", () => open(chooser.files?.[0]).finally(() => (chooser.value = "")));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    open(event.dataTransfer?.files[0]);
  });
}
