// @ts-check
/**
 * Marks on the optimal paths, where the control changes and where the circle is joined, with labels that cover as
 * little as possible, and never each other.
 *
 * @import {Maneuver, Scene} from "../shared/types.js"
 * @import {Box, Point, View} from "../shared/geometry.js"
 */
import { part } from "../shared/dom.js";
import { overlaps, pointAt, positionToScreen, toScreen, unitVector } from "../shared/geometry.js";
import { poseAt } from "../shared/maneuver.js";
import { timeText } from "../shared/units.js";

// Pixels: a label at the start of the last segment is left out if its point is nearer than this to another.
const LEAST_DISTANCE = { join: 26, aircraft: 30 };

// Pixels: mean width of a character, half the height of a label, and the strips with the numbers of the grid.
const CHARACTER_PX = 6.6;
const LETTER_PX = 9.4; // of a word
const HALF_HEIGHT_PX = 9;
const GRID_NUMBERS_PX = { left: 44, bottom: 22 };

// What it costs to cover a point, a label or a control of the page, or the edge of the view.
const COST = { point: 1, box: 100, edge: 1000 };

/**
 * @param {View} view
 * @param {Maneuver[]} best
 * @param {Maneuver[]} others
 * @param {Scene} scene
 * @param {Box[]} boxes  that no label may cover: the dial of the wind, buttons, the key
 * @param {{point: Point, text: string}[]} breaches  where the plan enters the fence
 */
export function drawMarks(view, best, others, scene, boxes, breaches) {
  const flown = best.filter(({ segments }) => segments.length > 0);
  const covered = flown.flatMap((maneuver) => coveredPoints(view, maneuver, scene));
  const taken = [...boxes, ...numberStrips(view)];
  const dots = flown.flatMap((maneuver) => [
    ...switchesOf(view, maneuver).map((point) => dot(point, 4.5, "switch")),
    dot(positionToScreen(view, maneuver.join), 6, "join"),
  ]);
  const joins = flown.map(({ join, join_s, duration_s }) => ({
    point: positionToScreen(view, join),
    text: `join ${timeText(join_s ?? duration_s, scene)}`,
    most: Infinity,
  }));
  const peelOffs = flown.flatMap((maneuver) => peelOffLabels(view, maneuver, scene));
  const words = others.map(({ track, word }) => ({ point: middleOf(view, track), text: word, most: COST.box, kind: "other" }));
  const entered = breaches.map((breach) => ({ ...breach, most: Infinity, kind: "entered" }));
  return [...dots, ...[...joins, ...entered, ...peelOffs, ...words].flatMap((one) => label(view, one, covered, taken))];
}

/** Half way along a track. @param {View} view @param {Maneuver["track"]} track */
function middleOf(view, { east_m, north_m }) {
  const i = east_m.length >> 1;
  return toScreen(view, east_m[i], north_m[i]);
}

/** Where the control changes. @param {View} view @param {Maneuver} maneuver */
const switchesOf = (view, { segments }) => segments.slice(1).map(({ start }) => positionToScreen(view, start));

/**
 * The label at the start of the last segment, if there is room.
 *
 * @param {View} view
 * @param {Maneuver} maneuver
 * @param {Scene} scene
 * @returns {Label[]}
 */
function peelOffLabels(view, maneuver, scene) {
  const { segments, join } = maneuver;
  const point = switchesOf(view, maneuver).at(-1);
  if (!point || isCrowded(point, positionToScreen(view, join), positionToScreen(view, scene.pose))) return [];
  const last = segments[segments.length - 1];
  return [{ point, text: `${last.name ?? "peel off"} ${timeText(last.start_s, scene)}`, most: COST.box }];
}

/** The strips with the numbers of the grid. @param {View} view @returns {Box[]} */
function numberStrips({ width, height }) {
  const { left, bottom } = GRID_NUMBERS_PX;
  return [
    { left: 0, right: left, top: 0, bottom: height },
    { left: 0, right: width, top: height - bottom, bottom: height },
  ];
}

/** @param {Point} point @param {number} r @param {string} kind */
const dot = ([cx, cy], r, kind) => part("circle", { cx, cy, r, class: kind });

/** @param {Point} point @param {Point} joined @param {Point} aircraft */
function isCrowded([x, y], joined, aircraft) {
  const distance = (/** @type {Point} */ other) => Math.hypot(x - other[0], y - other[1]);
  return distance(joined) < LEAST_DISTANCE.join || distance(aircraft) < LEAST_DISTANCE.aircraft;
}

/**
 * Points that labels should not cover: on the path, the circle, and the aircraft with the handle of its heading.
 *
 * @param {View} view
 * @param {Maneuver} maneuver
 * @param {Scene} scene
 * @returns {Point[]}
 */
function coveredPoints(view, { track, duration_s, join, join_over_ground }, { pose }) {
  const centre = toScreen(view, join_over_ground.centre_east_m, join_over_ground.centre_north_m);
  const joined = positionToScreen(view, join);
  const r = Math.hypot(joined[0] - centre[0], joined[1] - centre[1]);
  const aircraft = positionToScreen(view, pose);
  return [
    ...Array.from({ length: 81 }, (_, i) => positionToScreen(view, poseAt(track, (i / 80) * duration_s))),
    ...Array.from({ length: 72 }, (_, k) => pointAt(centre, 5 * k, r)),
    ...Array.from({ length: 16 }, (_, k) => pointAt(aircraft, pose.heading_deg, 5 * k - 12)),
  ];
}

/**
 * @typedef {object} Label
 * @property {Point} point
 * @property {string} text
 * @property {number} most  the label is left out if its best place costs as much
 * @property {string} [kind]
 */

/**
 * A text beside a point, on the side where it covers least. The place is added to `taken`.
 *
 * @param {View} view
 * @param {Label} one
 * @param {Point[]} covered
 * @param {Box[]} taken
 */
function label(view, { point, text, most, kind = "" }, covered, taken) {
  const width = (kind ? LETTER_PX : CHARACTER_PX) * text.length;
  // No place of the label reaches farther.
  const near = covered.filter(([x, y]) => Math.abs(x - point[0]) < width + 32 && Math.abs(y - point[1]) < 48);
  const places = [1, 2].flatMap((far) =>
    [0, 45, 90, 135, 180, 225, 270, 315].map((bearing) => {
      const box = placeAt(point, bearing, width, far);
      return { box, cost: costOf(box, view, near, taken) + far / 100 };
    }),
  );
  const { box, cost } = places.reduce((least, place) => (place.cost < least.cost ? place : least));
  if (cost >= most) return [];
  taken.push(box);
  return [part("text", { x: box.left, y: box.top + HALF_HEIGHT_PX + 4, class: `halo ${kind}` }, [text])];
}

/**
 * Where a label is if it lies at a bearing from a point.
 *
 * @param {Point} point
 * @param {number} bearing
 * @param {number} width
 * @param {number} far  1 beside the point, 2 twice as far
 * @returns {Box}
 */
function placeAt([x, y], bearing, width, far) {
  const [east, north] = unitVector(bearing);
  const isCentred = Math.abs(east) < 0.1;
  const left = x + 13 * far * east + (width / 2) * (isCentred ? -1 : Math.sign(east) - 1);
  const middle = y - 17 * far * north;
  return { left, right: left + width, top: middle - HALF_HEIGHT_PX, bottom: middle + HALF_HEIGHT_PX };
}

/** @param {Box} box @param {View} view @param {Point[]} covered @param {Box[]} taken */
function costOf(box, { width, height }, covered, taken) {
  const points = covered.filter(([x, y]) => overlaps(box, { left: x - 4, right: x + 4, top: y - 1, bottom: y + 1 }));
  const boxes = taken.filter((other) => overlaps(box, other));
  const isCut = box.left < 4 || box.right > width - 4 || box.top < 2 || box.bottom > height - 2;
  return COST.point * points.length + COST.box * boxes.length + (isCut ? COST.edge : 0);
}
