// @ts-check
/**
 * What can be dragged on the plan view: the aircraft, its heading, the circle's centre and radius, the wind. Each says
 * where it sits and which scene a drag or a key makes of the present one.
 *
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./types.js").Units} Units
 * @typedef {import("./view.js").View} View
 * @typedef {import("./view.js").Point} Point
 *
 * @typedef {object} Stage
 * @property {View} view
 * @property {Scene} scene
 * @property {Units} units
 *
 * @typedef {object} Handle
 * @property {string} id
 * @property {string} label
 * @property {SVGElement[]} parts  what it looks like
 * @property {(stage: Stage) => Point} at  where it sits, pixels
 * @property {(stage: Stage, point: Point) => Scene} to  dragged to a point
 * @property {(stage: Stage, right: number, up: number) => Scene} by  moved by steps
 * @property {(stage: Stage) => void} [taken]  a drag begins
 * @property {(scene: Scene) => number} value
 * @property {(scene: Scene, units: Units) => string} text
 */
import { heading, vector } from "./compass.js";
import { svg } from "./svg.js";
import { decimalsFor, fixed, length, nice, tidy, unit, wrapped } from "./units.js";
import { toScreen, toWorld } from "./view.js";

/** An aeroplane from above, nose up, some 30 pixels long. */
export const AEROPLANE =
  "M0-15C1.3-15 2-13 2-10.5V-5L15 2.2V5L2 2V9.2L6 12.2V14L0 12.6-6 14V12.2L-2 9.2V2L-15 5V2.2L-2-5V-10.5C-2-13-1.3-15 0-15Z";

/** Pixels from the aircraft to the handle that turns it. */
export const LEVER = 62;

const TINY = 30; // pixels: no handle of the radius is nearer to the centre
const DIALS = { small: 28, large: 42 }; // pixels: the wind dial's radius, half the airspeed
const GRID = 84; // pixels: lines of the grid are no closer

/**
 * The distance of the lines of the grid in the unit shown, and that unit in metres.
 *
 * @param {View} view
 * @param {Units} units
 */
export function gridOf(view, units) {
  const { name, size } = unit("length", units);
  return { name, size, step: nice(GRID / (view.scale * size)) };
}

/** What an arrow key moves by, metres: a twentieth of a square of the grid. @param {Stage} stage */
function stepOf({ view, units }) {
  const { step, size } = gridOf(view, units);
  return (step * size) / 20;
}

/** What a drag is rounded to, metres: a tenth of a pixel. @param {View} view */
const fineOf = (view) => 0.1 / view.scale;

/**
 * A place dragged to or moved by keys.
 *
 * @param {Stage} stage
 * @param {Point} place east and north
 */
function place({ view }, [east, north]) {
  return { east_m: tidy(east, fineOf(view)), north_m: tidy(north, fineOf(view)) };
}

/** @param {Scene} scene @param {Partial<Scene["pose"]>} pose @returns {Scene} */
const posed = (scene, pose) => ({ ...scene, pose: { ...scene.pose, ...pose } });

/** @param {Scene} scene @param {Partial<Scene["orbit"]>} orbit @returns {Scene} */
const circled = (scene, orbit) => ({ ...scene, orbit: { ...scene.orbit, ...orbit } });

/** @param {Stage} stage @returns {Point} */
const aircraftAt = ({ view, scene }) => toScreen(view, scene.pose.east_m, scene.pose.north_m);

/** @param {Stage} stage @returns {Point} */
const centreAt = ({ view, scene }) => toScreen(view, scene.orbit.east_m, scene.orbit.north_m);

/**
 * @param {Point} from
 * @param {number} bearing_deg
 * @param {number} far pixels
 * @returns {Point}
 */
function beyond([x, y], bearing_deg, far) {
  const [east, north] = vector(bearing_deg);
  return [x + far * east, y - far * north];
}

/** The bearing on the screen from one point to another. @param {Point} from @param {Point} to */
const bearingOf = (from, to) => heading(to[0] - from[0], from[1] - to[1]);

/** @param {{east_m: number, north_m: number}} there @param {Scene} scene @param {Units} units */
function told({ east_m, north_m }, { orbit }, units) {
  const decimals = decimalsFor(orbit.radius_m, units);
  return `${length(east_m, units, decimals)} east, ${length(north_m, units, decimals)} north`;
}

/** @param {number} r of the area that a finger finds @param {number} focus @param {SVGElement} shape */
const parts = (r, focus, shape) => [
  svg("circle", { r, class: "touch" }),
  svg("circle", { r: focus, class: "focus" }),
  shape,
];

const ring = () => svg("circle", { r: 6.5, class: "knob" });

/** @type {Handle} */
export const AIRCRAFT = {
  id: "aircraft",
  label: "Aircraft",
  parts: parts(24, 23, svg("path", { d: AEROPLANE, class: "aeroplane" })),
  at: aircraftAt,
  to: (stage, point) => posed(stage.scene, place(stage, toWorld(stage.view, point))),
  by: (stage, right, up) => {
    const { east_m, north_m } = stage.scene.pose;
    return posed(stage.scene, place(stage, [east_m + right * stepOf(stage), north_m + up * stepOf(stage)]));
  },
  value: ({ pose }) => pose.east_m,
  text: (scene, units) => told(scene.pose, scene, units),
};

/** @type {Handle} */
export const HEADING = {
  id: "heading",
  label: "Heading of the aircraft",
  parts: parts(20, 12, ring()),
  at: (stage) => beyond(aircraftAt(stage), stage.scene.pose.heading_deg, LEVER),
  to: (stage, point) => posed(stage.scene, { heading_deg: tidy(bearingOf(aircraftAt(stage), point), 1) % 360 }),
  by: ({ scene }, right, up) => posed(scene, { heading_deg: tidy(wrapped(scene.pose.heading_deg + right - up), 1e-6) }),
  value: ({ pose }) => pose.heading_deg,
  text: ({ pose }) => `${fixed(pose.heading_deg, 0)} degrees`,
};

/** @type {Handle} */
export const CENTRE = {
  id: "centre",
  label: "Centre of the circle",
  parts: parts(20, 14, svg("path", { d: "M-8 0H8M0-8V8", class: "cross" })),
  at: centreAt,
  to: (stage, point) => circled(stage.scene, place(stage, toWorld(stage.view, point))),
  by: (stage, right, up) => {
    const { east_m, north_m } = stage.scene.orbit;
    return circled(stage.scene, place(stage, [east_m + right * stepOf(stage), north_m + up * stepOf(stage)]));
  },
  value: ({ orbit }) => orbit.east_m,
  text: (scene, units) => told(scene.orbit, scene, units),
};

/**
 * The handle of the radius, which may sit anywhere on the circle.
 *
 * @returns {{handle: Handle, turn: (bearing_deg: number) => void}}
 */
export function radiusHandle() {
  let bearing_deg = 150;
  let slack = 0; // by how many pixels it sits off a tiny circle, since it was taken
  /** @type {Handle} */
  const handle = {
    id: "radius",
    label: "Radius of the circle",
    parts: parts(20, 12, ring()),
    taken: ({ view, scene }) => (slack = Math.max(0, TINY - scene.orbit.radius_m * view.scale)),
    at: (stage) => {
      const real = Math.abs(stage.scene.orbit.radius_m) * stage.view.scale;
      return beyond(centreAt(stage), bearing_deg, Math.max(TINY, real));
    },
    to: (stage, point) => {
      const centre = centreAt(stage);
      bearing_deg = bearingOf(centre, point);
      const pixels = Math.hypot(point[0] - centre[0], point[1] - centre[1]) - slack;
      return circled(stage.scene, { radius_m: tidy(Math.max(1, pixels) / stage.view.scale, fineOf(stage.view)) });
    },
    by: (stage, right, up) => {
      const radius_m = tidy(stage.scene.orbit.radius_m + (right + up) * stepOf(stage), fineOf(stage.view));
      return radius_m > 0 ? circled(stage.scene, { radius_m }) : stage.scene;
    },
    value: ({ orbit }) => orbit.radius_m,
    text: ({ orbit }, units) => length(orbit.radius_m, units, decimalsFor(orbit.radius_m, units)),
  };
  return { handle, turn: (deg) => (bearing_deg = deg) };
}

/** The wind dial's radius, pixels. @param {View} view */
export const dialOf = (view) => (view.width < 500 ? DIALS.small : DIALS.large);

/** Where the wind dial is. @param {View} view @returns {Point} */
export function pivotOf(view) {
  const r = dialOf(view);
  return [view.width - Math.max(56, r + 22), r + (r === DIALS.large ? 30 : 14)];
}

/** Pixels on the dial for a metre per second, also while no airspeed is typed yet. @param {Stage} stage */
const perSpeed = ({ view, scene }) => (2 * dialOf(view)) / Math.max(scene.aircraft.airspeed_m_s, 1e-9);

/**
 * A scene with another wind: how the air moves, metres per second.
 *
 * @param {Scene} scene
 * @param {number} east
 * @param {number} north
 * @returns {Scene}
 */
function blown(scene, east, north) {
  const speed_m_s = tidy(Math.hypot(east, north), scene.aircraft.airspeed_m_s / 180);
  return { ...scene, wind: speed_m_s > 0 ? { speed_m_s, from_deg: tidy(heading(-east, -north), 1) % 360 } : null };
}

/** @type {Handle} */
export const WIND = {
  id: "wind",
  label: "Wind",
  parts: parts(18, 12, svg("path", { d: "M0-9 6.5 5H-6.5Z", class: "tip" })),
  at: (stage) => {
    const { speed_m_s, from_deg } = stage.scene.wind ?? { speed_m_s: 0, from_deg: 0 };
    return beyond(pivotOf(stage.view), from_deg + 180, Math.min(speed_m_s * perSpeed(stage), 2 * dialOf(stage.view)));
  },
  to: (stage, [x, y]) => {
    const [left, top] = pivotOf(stage.view);
    const far = Math.hypot(x - left, y - top);
    // Next to the middle it is calm; nearly as fast as the aircraft is fast enough.
    const share = (far < 3 ? 0 : Math.min(1, (1.9 * dialOf(stage.view)) / far)) / perSpeed(stage);
    return blown(stage.scene, (x - left) * share, (top - y) * share);
  },
  by: ({ scene }, right, up) => {
    const { speed_m_s, from_deg } = scene.wind ?? { speed_m_s: 0, from_deg: 0 };
    const [east, north] = vector(from_deg + 180);
    const step = scene.aircraft.airspeed_m_s / 100;
    return blown(scene, speed_m_s * east + right * step, speed_m_s * north + up * step);
  },
  value: ({ wind }) => wind?.speed_m_s ?? 0,
  text: ({ wind }, units) => {
    const { name, size } = unit("speed", units);
    return wind ? `${fixed(wind.speed_m_s / size, 1)} ${name} from ${fixed(wind.from_deg, 0)}°` : "calm";
  },
};
