// @ts-check
/**
 * The headline and the numbers of the plan.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Answer, Maneuver, Scene, Segment} from "../shared/types.js"
 */
import { byId, fill, part } from "../shared/dom.js";
import { DIRECTIONS, DIRECTION_ARROWS, splitAnswer, wordLabel } from "../shared/maneuver.js";
import { flownOf } from "../state/page_state.js";
import { fenceText } from "./fence_verdict.js";
import { clockText, decimalsFor, fixed, quantityText, signedTimeDifference, timeText } from "../shared/units.js";

const TIE_S = 1e-9; // durations closer than this count as ties

/** @param {Store} store */
export function factsView(store) {
  store.watch((state) => [state.answer, state.clear, state.leg, state.failure, countdownOf(state)], drawHeadline);
  store.watch(({ answer, clear, units }) => [answer, clear, units], drawFacts);
  // For screen readers, only when a drag pauses.
  store.watch(
    ({ announced, clear, leg }) => [announced, clear, leg],
    (state) => state.announced && (byId("spoken", HTMLElement).textContent = `${instructionOf(state)} ${fenceText(state)}`.trim()),
  );
}

const DOING = { L: "turn left", S: "fly straight", R: "turn right" };

/**
 * What the ghost does and until when, while the plan is played or its time is moved; nothing at its start.
 *
 * @param {PageState} state
 */
function countdownOf(state) {
  const answer = flownOf(state);
  const { playing, time_s } = state.playback;
  if (!answer || !(playing || time_s > 0)) return "";
  const hold = `hold ${DIRECTIONS[answer.turn]}`;
  const end = state.leg ? "at the point" : hold;
  const i = answer.segments.findIndex(({ start_s, duration_s }) => time_s < start_s + duration_s);
  if (i < 0) return `${capitalized(end)}.`;
  const doing = (/** @type {Segment} */ { name, letter }) => (name === "hold" ? hold : name === "leave" ? "leave straight" : DOING[letter]);
  const { start_s, duration_s } = answer.segments[i];
  const next = answer.segments[i + 1];
  const left = clockText(start_s + duration_s - time_s, 1);
  return `${capitalized(doing(answer.segments[i]))}, then ${next ? doing(next) : end} in ${left}.`;
}

const capitalized = (/** @type {string} */ text) => text.charAt(0).toUpperCase() + text.slice(1);

/** A text of the library with long times in minutes. @param {string} text */
const inMinutes = (text) =>
  text.replace(/(\d+\.(\d+)) s\b/g, (_, seconds, decimals) => clockText(Number(seconds), decimals.length));

/** @param {PageState} state */
function drawHeadline(state) {
  const { answer, failure, clear, scene } = state;
  const headline = byId("instruction", HTMLElement);
  const text = failure?.headline ?? (countdownOf(state) || instructionOf(state));
  // What to do, then how to hold, each on lines of its own; a unit stays beside its number.
  const [now, hold] = text.replaceAll(/(\d) (s|min)\b/g, "$1\u00a0$2").split(/(?<=\.) (?=Hold )/);
  fill(headline, hold ? [now, " ", part("span", { class: "hold" }, [hold + (failure || scene.fence || scene.leg ? "" : tieText(answer))])] : [now]);
  headline.classList.toggle("bad", failure !== null || (clear !== null && !clear.maneuver));
}

/** What the pilot does; where no clear entry is found, nothing. @param {PageState} state */
function instructionOf({ answer, clear, leg }) {
  if (clear && !clear.maneuver) return "No clear entry is found.";
  return inMinutes(leg?.instruction ?? clear?.instruction ?? answer?.instruction ?? "");
}

/** That the other direction takes the same time, if it does. @param {Answer | null} answer */
function tieText(answer) {
  const other = answer && splitAnswer(answer).best.find(({ turn }) => turn !== answer.turn);
  return other ? ` To hold ${DIRECTIONS[other.turn]} takes the same time.` : "";
}

/** @param {PageState} state */
function drawFacts(state) {
  const { answer, clear, scene, units } = state;
  const flown = flownOf(state);
  if (!answer || !flown) return;
  const { radius_m } = scene.orbit;
  const path = quantityText(flown.length_m, "length", units, decimalsFor(radius_m, units));
  setFact("time", timeText(flown.duration_s, scene));
  setFact("path", path, answer.wind.speed_m_s > 0 ? "through the air" : "");
  setFact("word", wordLabel(flown.word), DIRECTIONS[flown.turn]);
  setFact("other", clear?.maneuver ? "–" : otherDirectionText(answer, scene));
  if (scene.slot) setFact("optimal", "–");
  else setFact("optimal", clear?.maneuver ? "–" : String(answer.optimal), clear?.maneuver ? "round a fence" : optimalText(answer));
  setFact("bank-on-circle", bankText(flown));
}

/** @param {string} id @param {string | ReturnType<typeof part>} value @param {string} [note] */
function setFact(id, value, note = "") {
  fill(byId(id, HTMLElement), [value, ...(note ? [part("small", {}, [note])] : [])]);
}

/** How much later a hold in the other direction is joined. @param {Answer} answer @param {Scene} scene */
function otherDirectionText({ other_turn_later_s }, scene) {
  if (other_turn_later_s === null) return "cannot be held";
  if (Math.abs(other_turn_later_s) < TIE_S) return "the same time";
  return signedTimeDifference(other_turn_later_s, scene);
}

/** The optimal maneuvers. @param {Answer} answer */
function optimalText(answer) {
  const { best } = splitAnswer(answer);
  return best.length > 1 ? best.map(({ word, turn }) => `${word} ${DIRECTION_ARROWS[turn]}`).join(", ") : "unique";
}

/** The bank angles of the hold. @param {Maneuver} maneuver */
export function bankText({ hold }) {
  const [least, most] = [fixed(hold.least_bank_deg, 1), fixed(hold.largest_bank_deg, 1)];
  return least === most ? `${most}°` : `${least} to ${most}°`;
}
