// @ts-check
/**
 * Links to a scene: its numbers as the fragment of the address, named like the options of the command line.
 *
 * @import {Aircraft, Altitude, Leg, Limit, Reference, Scene, Turn, Units} from "../shared/types.js"
 *
 * @typedef {object} Linked
 * @property {Scene} scene
 * @property {Units | null} units  null where the link leaves them to its reader
 * @property {Altitude} altitude
 * @property {number[] | null} view  middle east and north, width: metres; null unless the user has moved the view
 */
import { asUnits, powerBelow, tidy, tidyAbove } from "../shared/units.js";
import { LIMITS, limitOf, orbitMoves, withWind } from "./scene.js";
import { turnRadiusOf } from "../shared/turning.js";

/** @type {Record<Limit, string>} */
const LIMIT_KEYS = { max_bank_deg: "bank", min_turn_radius_m: "turn-radius", max_turn_rate_deg_s: "turn-rate" };

/** @type {Reference[]} */
const REFERENCES = ["msl", "home", "ground"];

/** The fragment of a link. Altitudes that are not given are left out. @param {Linked} linked @returns {string} */
export function toLink({ scene, units, altitude, view }) {
  const parts = [...sceneParts(scene), ...altitudeParts(altitude)];
  if (view) parts.push(`view=${view}`);
  if (units === "aviation") parts.push(`units=${units}`);
  return `#${parts.join("&")}`;
}

// Share of turn radius and airspeed to which a link rounds lengths and speeds: 1 micrometre, for a turn radius of 47 m.
const PRECISION = 1e-7;
const ANGLE_DEG = 1e-7; // at a distance of 1 km, 2 micrometres
const PLACE_DEG = 1e-9; // 0.1 mm on the ground
const ALTITUDE_M = 1e-4;
const TIME_S = 1e-7;

/**
 * Numbers of a link, with the fewest decimals that still give the same plan.
 *
 * @param {number[]} values
 * @param {number} resolution
 */
const joined = (values, resolution) => values.map((value) => tidy(value, resolution)).join();

/** @param {Scene} scene */
function sceneParts(scene) {
  const { pose, orbit, aircraft, wind, tolerance_m, origin } = scene;
  const limit = limitOf(aircraft);
  const length = powerBelow(turnRadiusOf(aircraft), PRECISION);
  const speed = powerBelow(aircraft.airspeed_m_s, PRECISION);
  const [centre, heading] = [joined([orbit.east_m, orbit.north_m], length), joined([pose.heading_deg], ANGLE_DEG)];
  const parts = [
    `pose=${joined([pose.east_m, pose.north_m], length)},${heading}`,
    // Upwards, so that a circle of the least radius can still be held.
    `orbit=${centre},${tidyAbove(orbit.radius_m, length)}`,
    `turn=${orbit.turn}`,
    `airspeed=${joined([aircraft.airspeed_m_s], speed)}`,
    `${LIMIT_KEYS[limit]}=${limitNumber(aircraft, limit, length)}`,
  ];
  if (wind) parts.push(`wind=${joined([wind.speed_m_s], speed)},${joined([wind.from_deg], ANGLE_DEG)}`);
  if (orbitMoves(scene))
    parts.push(`orbit-velocity=${joined([orbit.velocity_east_m_s, orbit.velocity_north_m_s], speed)}`);
  if (tolerance_m !== 0) parts.push(`tolerance=${tolerance_m}`);
  if (origin) parts.push(`origin=${joined([origin.latitude_deg, origin.longitude_deg], PLACE_DEG)}`);
  return [...parts, ...fenceParts(scene, length), ...slotParts(scene), ...legParts(scene, length, speed)];
}

/**
 * The limit of an aircraft, rounded towards tighter turns, so that the circle can still be held.
 *
 * @param {Aircraft} aircraft
 * @param {Limit} limit
 * @param {number} length  resolution of lengths
 */
function limitNumber(aircraft, limit, length) {
  const value = aircraft[limit] ?? 0;
  return limit === "min_turn_radius_m" ? -tidyAbove(-value, length) : tidyAbove(value, ANGLE_DEG);
}

/** The fence: each zone with its rule, a circle with three numbers, a polygon with two for each corner. @param {Scene} scene @param {number} length resolution */
function fenceParts({ fence }, length) {
  if (!fence) return [];
  const zones = fence.zones.map((zone) => {
    const values = "corners" in zone ? zone.corners.flat() : [zone.east_m, zone.north_m, zone.radius_m];
    const name = encodeURIComponent(zone.name.replaceAll(",", " "));
    return `zone=${name},${zone.inclusion ? "in" : "out"},${joined(values, length)}`;
  });
  return [...zones, ...(fence.margin_m === null ? [] : [`margin=${joined([fence.margin_m], length)}`])];
}

/** The slot, named like the options of the command line. @param {Scene} scene */
function slotParts({ slot }) {
  if (!slot) return [];
  const at = slot.at_s === 0 ? [] : [`slot-at=${joined([slot.at_s], TIME_S)}`];
  return [`slot=${joined([slot.phase_deg], ANGLE_DEG)}`, ...at];
}

/** The numbers of a leg in a link, beside the point: their keys and names, and how they are rounded. @type {[string, Exclude<keyof Leg, "exit_to">, "seconds" | "speed" | "altitude"][]} */
const LEG_KEYS = [
  ["hold", "hold_s", "seconds"],
  ["turns", "turns", "seconds"],
  ["start-altitude", "start_altitude_m", "altitude"],
  ["to-altitude", "altitude_m", "altitude"],
  ["climb-rate", "climb_rate_m_s", "speed"],
  ["descent-rate", "descent_rate_m_s", "speed"],
];

/** @param {Scene} scene @param {number} length resolution @param {number} speed resolution */
function legParts({ leg }, length, speed) {
  if (!leg) return [];
  const resolutions = { seconds: 1e-6, speed, altitude: ALTITUDE_M };
  const numbers = LEG_KEYS.flatMap(([key, name, kind]) => (leg[name] === null || (leg[name] === 0 && kind === "seconds") ? [] : [`${key}=${joined([leg[name]], resolutions[kind])}`]));
  return [`exit-to=${joined(leg.exit_to, length)}`, ...numbers];
}

/** @param {URLSearchParams} parameters @returns {Leg | null} */
function legOf(parameters) {
  if (!parameters.has("exit-to")) return null;
  const [east, north] = numbers(parameters, "exit-to", 2);
  const values = LEG_KEYS.map(([key, name, kind]) => [name, parameters.has(key) ? numbers(parameters, key, 1)[0] : kind === "seconds" ? 0 : null]);
  return { exit_to: [east, north], ...Object.fromEntries(values) };
}

/** @param {Altitude} altitude */
function altitudeParts({ altitude_m, altitude_reference, home_altitude_m }) {
  const parts = [];
  if (altitude_m !== undefined) parts.push(`altitude=${joined([altitude_m], ALTITUDE_M)}`);
  if (altitude_reference) parts.push(`altitude-reference=${altitude_reference}`);
  if (home_altitude_m !== undefined) parts.push(`home-altitude=${joined([home_altitude_m], ALTITUDE_M)}`);
  return parts;
}

/**
 * What a fragment written by `toLink` links to. Throws an Error with a sentence if the fragment has an error.
 *
 * @param {string} fragment
 * @returns {Linked}
 */
export function fromLink(fragment) {
  const parameters = new URLSearchParams(fragment.replace(/^#/, ""));
  return {
    scene: sceneOf(parameters),
    units: parameters.has("units") ? asUnits(parameters.get("units")) : null,
    altitude: altitudeOf(parameters),
    view: parameters.has("view") ? viewOf(numbers(parameters, "view", 3)) : null,
  };
}

/** @param {URLSearchParams} parameters @returns {Scene} */
function sceneOf(parameters) {
  const [east_m, north_m, heading_deg] = numbers(parameters, "pose", 3);
  const scene = {
    pose: { east_m, north_m, heading_deg },
    orbit: orbitOf(parameters),
    aircraft: aircraftOf(parameters),
    wind: null,
    tolerance_m: numbers(parameters, "tolerance", 1, [0])[0],
    origin: parameters.has("origin") ? originOf(numbers(parameters, "origin", 2)) : null,
    fence: fenceOf(parameters),
    slot: parameters.has("exit-to") ? null : slotOf(parameters),
    leg: legOf(parameters),
  };
  const [speed_m_s, from_deg] = numbers(parameters, "wind", 2, [0, 0]);
  return withWind(scene, { speed_m_s, from_deg });
}

/** @param {URLSearchParams} parameters @returns {import("../shared/types.js").Slot | null} */
function slotOf(parameters) {
  if (!parameters.has("slot") && !parameters.has("slot-at")) return null;
  return { phase_deg: numbers(parameters, "slot", 1)[0], at_s: numbers(parameters, "slot-at", 1, [0])[0] };
}

/** @param {URLSearchParams} parameters @returns {import("../shared/types.js").Fence | null} */
function fenceOf(parameters) {
  const zones = parameters.getAll("zone").map(zoneOf);
  if (zones.length === 0) return null;
  const [margin_m] = parameters.has("margin") ? numbers(parameters, "margin", 1) : [null];
  return { zones, margin_m };
}

/** @param {string} text @returns {import("../shared/types.js").Zone} */
function zoneOf(text) {
  const [name, rule, ...texts] = text.split(",");
  const values = texts.map((one) => (one.trim() === "" ? NaN : Number(one)));
  const isCircle = values.length === 3;
  if (!(rule === "in" || rule === "out") || !values.every(Number.isFinite) || !(isCircle || (values.length >= 6 && values.length % 2 === 0)))
    throw new Error(`The link's zone is "${text}": it needs a name, in or out, and three numbers for a circle or two for each corner.`);
  const inclusion = rule === "in";
  if (isCircle) return { name, east_m: values[0], north_m: values[1], radius_m: values[2], inclusion };
  const corners = Array.from({ length: values.length / 2 }, (_, k) => /** @type {[number, number]} */ ([values[2 * k], values[2 * k + 1]]));
  return { name, corners, inclusion };
}

/** @param {URLSearchParams} parameters */
function orbitOf(parameters) {
  const [east_m, north_m, radius_m] = numbers(parameters, "orbit", 3);
  const [velocity_east_m_s, velocity_north_m_s] = numbers(parameters, "orbit-velocity", 2, [0, 0]);
  return { east_m, north_m, radius_m, turn: turnOf(parameters), velocity_east_m_s, velocity_north_m_s };
}

/** @param {URLSearchParams} parameters */
function aircraftOf(parameters) {
  const limit = LIMITS.find((name) => parameters.has(LIMIT_KEYS[name])) ?? "max_bank_deg";
  const [airspeed_m_s] = numbers(parameters, "airspeed", 1);
  return { airspeed_m_s, [limit]: numbers(parameters, LIMIT_KEYS[limit], 1)[0] };
}

/** Links of earlier versions have no altitude. @param {URLSearchParams} parameters @returns {Altitude} */
function altitudeOf(parameters) {
  const [altitude_m, home_altitude_m] = ["altitude", "home-altitude"].map((name) =>
    parameters.has(name) ? numbers(parameters, name, 1)[0] : undefined,
  );
  const text = parameters.get("altitude-reference");
  const altitude_reference = REFERENCES.find((reference) => reference === text);
  if (text !== null && !altitude_reference)
    throw new Error(`The link's altitude-reference is ${text}: it must be msl, home or ground.`);
  return { altitude_m, altitude_reference, home_altitude_m };
}

/** @param {number[]} values */
const originOf = ([latitude_deg, longitude_deg]) => ({ latitude_deg, longitude_deg });

/** @param {number[]} values */
function viewOf([east, north, wide]) {
  if (wide <= 0) throw new Error(`The link's view is ${wide} m wide: it must be wider than 0 m.`);
  return [east, north, wide];
}

/** @param {URLSearchParams} parameters @returns {Turn} */
function turnOf(parameters) {
  const turn = parameters.get("turn") ?? "either";
  if (turn !== "either" && turn !== "cw" && turn !== "ccw")
    throw new Error(`The link's turn is ${turn}: it must be cw, ccw or either.`);
  return turn;
}

/**
 * The numbers of a parameter. Throws an Error with a sentence if there are not `count` of them.
 *
 * @param {URLSearchParams} parameters
 * @param {string} name
 * @param {number} count
 * @param {number[]} [fallback]
 * @returns {number[]}
 */
function numbers(parameters, name, count, fallback) {
  const text = parameters.get(name);
  if (text === null && fallback) return fallback;
  const values = (text ?? "").split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
  if (values.length !== count || !values.every(Number.isFinite))
    throw new Error(
      `The link's ${name} is "${text ?? ""}": it needs ${count === 1 ? "a number" : `${count} numbers`}.`,
    );
  return values;
}
