// @ts-check
/**
 * Scenes: what is asked. A scene is the service's own request, never changed in place.
 *
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./types.js").Altitude} Altitude
 * @typedef {import("./types.js").Limit} Limit
 * @typedef {import("./types.js").Reference} Reference
 * @typedef {import("./types.js").Turn} Turn
 * @typedef {import("./types.js").Units} Units
 */

const UAV = { airspeed_m_s: 18, max_bank_deg: 35 };
const UNIT = { airspeed_m_s: 1, min_turn_radius_m: 1 };

/**
 * @param {[number, number, number]} pose east, north, heading
 * @param {number} radius_m
 * @param {Scene["aircraft"]} aircraft
 * @param {Scene["wind"]} wind
 * @returns {Scene}
 */
function scene([east_m, north_m, heading_deg], radius_m, aircraft, wind = null) {
  const orbit = { east_m: 0, north_m: 0, radius_m, turn: /** @type {Turn} */ ("either") };
  return {
    pose: { east_m, north_m, heading_deg },
    orbit: { ...orbit, velocity_east_m_s: 0, velocity_north_m_s: 0 },
    aircraft,
    wind,
    tolerance_m: 0,
    origin: null,
  };
}

/**
 * Scenes to begin with. Heading east over a circle about (0, 0) with a turn radius of 1 m, the reduced state is the
 * position: the paper's examples, and a start one hundredth of a turn radius inside the last arc of a circle of the turn
 * radius, beyond which the least time jumps.
 *
 * @type {{name: string, scene: Scene}[]}
 */
export const PRESETS = [
  { name: "Beside the circle", scene: scene([90, 60, 100], 80, UAV) },
  { name: "Far away", scene: scene([-1200, 500, 20], 80, UAV) },
  { name: "Inside the circle", scene: scene([20, -60, 30], 120, UAV) },
  { name: "In wind", scene: scene([-400, 120, 90], 120, UAV, { speed_m_s: 8, from_deg: 250 }) },
  { name: "Paper, example 1", scene: scene([4, 4, 90], 1, UNIT) },
  { name: "Paper, example 2", scene: scene([-0.53, 0.31, 90], 1, UNIT) },
  { name: "Just inside the jump", scene: scene([-0.954, 0.746, 90], 1, UNIT) },
];

/** @type {Record<Limit, string>} */
const LIMIT_KEYS = { max_bank_deg: "bank", min_turn_radius_m: "turn-radius", max_turn_rate_deg_s: "turn-rate" };

/** @type {Reference[]} */
export const REFERENCES = ["msl", "home", "ground"];

/** @type {Limit[]} */
export const LIMITS = ["max_bank_deg", "min_turn_radius_m", "max_turn_rate_deg_s"];

/**
 * The limit that a scene gives.
 *
 * @param {Scene} given
 * @returns {Limit}
 */
export function limitOf(given) {
  return LIMITS.find((name) => given.aircraft[name] !== undefined) ?? "max_bank_deg";
}

/**
 * Whether the air or the circle moves: then plans take a search, and the state does not reduce to a plane.
 *
 * @param {Scene} given
 */
export function drifts({ wind, orbit }) {
  return wind !== null || orbit.velocity_east_m_s !== 0 || orbit.velocity_north_m_s !== 0;
}

// A circle of the turn radius comes out a rounding off 1.
const ROUNDING = 1e-9;

/**
 * Whether the paper proves the optimum of a scene: still air, a circle at rest, of the turn radius.
 *
 * @param {Scene} given
 * @param {number} radius  of the circle, turn radii
 */
export function inThePaper(given, radius) {
  return !drifts(given) && given.tolerance_m === 0 && Math.abs(radius - 1) < ROUNDING;
}

/**
 * What a link holds beside the view.
 *
 * @typedef {{scene: Scene, units: Units, altitude: Altitude}} Linked
 */

/**
 * A scene, the units it is shown in, the altitude of missions, as far as it is given, and the view, if it is the user's
 * own, as the fragment of a link, in the names of the command line's options.
 *
 * @param {Linked} linked
 * @param {number[] | null} view  middle east and north, width: metres
 * @returns {string}
 */
export function toLink({ scene: given, units, altitude }, view) {
  const { pose, orbit, aircraft, wind, tolerance_m, origin } = given;
  const limit = limitOf(given);
  const parts = [
    `pose=${pose.east_m},${pose.north_m},${pose.heading_deg}`,
    `orbit=${orbit.east_m},${orbit.north_m},${orbit.radius_m}`,
    `turn=${orbit.turn}`,
    `airspeed=${aircraft.airspeed_m_s}`,
    `${LIMIT_KEYS[limit]}=${aircraft[limit]}`,
  ];
  if (wind) parts.push(`wind=${wind.speed_m_s},${wind.from_deg}`);
  if (orbit.velocity_east_m_s !== 0 || orbit.velocity_north_m_s !== 0)
    parts.push(`orbit-velocity=${orbit.velocity_east_m_s},${orbit.velocity_north_m_s}`);
  if (tolerance_m !== 0) parts.push(`tolerance=${tolerance_m}`);
  if (origin) parts.push(`origin=${origin.latitude_deg},${origin.longitude_deg}`);
  const { altitude_m, altitude_reference, home_altitude_m } = altitude;
  if (altitude_m !== undefined) parts.push(`altitude=${altitude_m}`);
  if (altitude_reference) parts.push(`altitude-reference=${altitude_reference}`);
  if (home_altitude_m !== undefined) parts.push(`home-altitude=${home_altitude_m}`);
  if (view) parts.push(`view=${view}`);
  if (units !== "metric") parts.push(`units=${units}`);
  return `#${parts.join("&")}`;
}

/**
 * What `toLink` wrote. Throws an Error with a sentence where the fragment is no scene.
 *
 * @param {string} hash
 * @returns {Linked & {view: number[] | null}}
 */
export function fromLink(hash) {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const [east_m, north_m, heading_deg] = numbers(given, "pose", 3);
  const [centreEast, centreNorth, radius_m] = numbers(given, "orbit", 3);
  const circle = { east_m: centreEast, north_m: centreNorth, radius_m };
  const limit = LIMITS.find((name) => given.has(LIMIT_KEYS[name])) ?? "max_bank_deg";
  const [velocity_east_m_s, velocity_north_m_s] = numbers(given, "orbit-velocity", 2, [0, 0]);
  return {
    scene: {
      pose: { east_m, north_m, heading_deg },
      orbit: { ...circle, turn: turnOf(given), velocity_east_m_s, velocity_north_m_s },
      aircraft: { airspeed_m_s: numbers(given, "airspeed", 1)[0], [limit]: numbers(given, LIMIT_KEYS[limit], 1)[0] },
      wind: given.has("wind") ? windOf(numbers(given, "wind", 2)) : null,
      tolerance_m: numbers(given, "tolerance", 1, [0])[0],
      origin: given.has("origin") ? originOf(numbers(given, "origin", 2)) : null,
    },
    units: given.get("units") === "aviation" ? "aviation" : "metric",
    altitude: altitudeOf(given),
    view: given.has("view") ? viewOf(numbers(given, "view", 3)) : null,
  };
}

/**
 * Links of earlier versions have no altitude.
 *
 * @param {URLSearchParams} given
 * @returns {Altitude}
 */
function altitudeOf(given) {
  const [altitude_m, home_altitude_m] = ["altitude", "home-altitude"].map((name) =>
    given.has(name) ? numbers(given, name, 1)[0] : undefined,
  );
  const text = given.get("altitude-reference");
  const altitude_reference = REFERENCES.find((reference) => reference === text);
  if (text !== null && !altitude_reference)
    throw new Error(`The link's altitude-reference is ${text}: it must be msl, home or ground.`);
  return { altitude_m, altitude_reference, home_altitude_m };
}

/** @param {number[]} values */
const windOf = ([speed_m_s, from_deg]) => (speed_m_s === 0 ? null : { speed_m_s, from_deg });

/** @param {number[]} values */
const originOf = ([latitude_deg, longitude_deg]) => ({ latitude_deg, longitude_deg });

/** @param {number[]} values */
function viewOf([east, north, wide]) {
  if (wide <= 0) throw new Error(`The link's view is ${wide} m wide: it must be wider than that.`);
  return [east, north, wide];
}

/**
 * @param {URLSearchParams} given
 * @returns {Turn}
 */
function turnOf(given) {
  const turn = given.get("turn") ?? "either";
  if (turn !== "either" && turn !== "cw" && turn !== "ccw")
    throw new Error(`The link's turn is ${turn}: it must be cw, ccw or either.`);
  return turn;
}

/**
 * @param {URLSearchParams} given
 * @param {string} name
 * @param {number} count
 * @param {number[]} [fallback]
 * @returns {number[]}
 */
function numbers(given, name, count, fallback) {
  const text = given.get(name);
  if (text === null && fallback) return fallback;
  const values = (text ?? "").split(",").map((word) => (word.trim() === "" ? NaN : Number(word)));
  if (values.length !== count || !values.every(Number.isFinite))
    throw new Error(
      `The link's ${name} is "${text ?? ""}": it needs ${count === 1 ? "a number" : `${count} numbers`}.`,
    );
  return values;
}
