// @ts-check
/**
 * The altitude of a leg over time, below the time line and with its scale.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 */
import { byId, fill, part, polyline, setAttributes, setSize, show } from "../shared/dom.js";
import { interpolator } from "../shared/maneuver.js";
import { quantityText, timeText } from "../shared/units.js";
import { durationOf, shownTime } from "../state/page_state.js";
import { timeScale } from "./bands.js";

const BAND = { top: 18, bottom: 52, height: 72 }; // pixels

/** @param {Store} store */
export function altitudeView(store) {
  const root = byId("altitude-profile", SVGSVGElement);
  store.watch(
    (state) => [state.leg, state.timelineWidth, state.units, shownTime(state)],
    (state) => {
      const altitudes = state.leg?.altitudes ?? null;
      show(byId("altitude-box", HTMLElement), altitudes !== null);
      if (!altitudes) return;
      setSize(root, state.timelineWidth, BAND.height);
      fill(root, drawn(altitudes, state));
      setAttributes(root, { "aria-label": sentence(altitudes, state) });
    },
  );
}

/** @typedef {{time_s: number[], altitude_m: number[]}} Altitudes */

/** @param {Altitudes} altitudes @param {PageState} state */
function drawn({ time_s, altitude_m }, state) {
  const { leg, units } = state;
  const { x, right } = timeScale(state.timelineWidth, durationOf(state), false);
  const [least, most] = [Math.min(...altitude_m), Math.max(...altitude_m)];
  const y = (/** @type {number} */ altitude) => BAND.bottom - ((altitude - least) / (most - least || 1)) * (BAND.bottom - BAND.top);
  const now = shownTime(state);
  const here = interpolator(time_s, now)(altitude_m);
  const text = (/** @type {number} */ altitude) => quantityText(altitude, "length", units, 0);
  const [start, end] = [altitude_m[0], altitude_m[altitude_m.length - 1]];
  /** @type {[number, number][]} */
  const line = altitude_m.map((altitude, i) => [x(time_s[i]), y(altitude)]);
  const levels = [leg?.join_s ?? 0, leg?.exit_s ?? 0].map((time) =>
    part("path", { d: `M${x(time)} ${BAND.top - 6}V${BAND.bottom + 4}`, class: "switchline" }),
  );
  // The names of the two levels stand where the line is not.
  const name = (/** @type {number} */ altitude, /** @type {number} */ at, /** @type {string} */ anchor) =>
    part("text", { x: at, y: y(altitude) + (altitude === most ? -5 : 12), "text-anchor": anchor }, [text(altitude)]);
  return [
    part("text", { x: 6, y: (BAND.top + BAND.bottom) / 2 + 4 }, ["h"]),
    ...levels,
    part("path", { d: polyline(line), class: "altitude" }),
    name(start, x(0), "start"),
    ...(end === start ? [] : [name(end, right, "end")]),
    part("circle", { cx: x(now), cy: y(here), r: 5, class: "here" }),
    part("text", { x: right + 8, y: (BAND.top + BAND.bottom) / 2 + 4, class: "now" }, [text(here)]),
  ];
}

/** The profile in words. @param {Altitudes} altitudes @param {PageState} state */
function sentence({ time_s, altitude_m }, { scene, units }) {
  const [start, end] = [altitude_m[0], altitude_m[altitude_m.length - 1]].map((one) => quantityText(one, "length", units, 0));
  return `Altitude over time: from ${start} at the start to ${end} after ${timeText(time_s[1], scene)}`;
}
