// @ts-check
/**
 * The playback: its clock and its controls.
 *
 * @import {Store} from "../state/store.js"
 * @import {Actions} from "../state/actions.js"
 */
import { byId, html } from "../shared/dom.js";
import { durationOf, endOf, shownTime } from "../state/page_state.js";

/** Playing speeds, times real time. */
export const SPEEDS = [1, 2, 5, 10, 20, 50, 100];

const WANTED_S = 10; // longest playback at the speed of a new scene
const REST_S = 1.2; // at the end, before the playback starts again
const LONGEST_FRAME_S = 0.1; // a page that was hidden does not jump

/** The slowest speed that plays a plan within some ten seconds. @param {number} duration_s */
export function speedFor(duration_s) {
  return SPEEDS.find((speed) => duration_s / speed <= WANTED_S) ?? SPEEDS[SPEEDS.length - 1];
}

/** Advance the time while the page plays. @param {Store} store */
export function runClock(store) {
  let frame = 0;
  let last_ms = 0;
  let rested_s = 0;

  /** @param {number} now_ms */
  function tick(now_ms) {
    const passed_s = Math.min(LONGEST_FRAME_S, (now_ms - last_ms) / 1000);
    last_ms = now_ms;
    const { playback } = store.get();
    const end_s = endOf(store.get());
    const isAtEnd = playback.time_s >= end_s;
    rested_s = isAtEnd ? rested_s + passed_s : 0;
    const next_s = isAtEnd && rested_s >= REST_S ? 0 : playback.time_s + playback.speed * passed_s;
    frame = requestAnimationFrame(tick);
    store.update({ playback: { ...playback, time_s: Math.min(end_s, next_s) } });
  }

  store.watch(
    ({ playback }) => [playback.playing],
    ({ playback }) => {
      cancelAnimationFrame(frame);
      if (!playback.playing) return;
      [last_ms, rested_s] = [performance.now(), 0];
      frame = requestAnimationFrame(tick);
    },
  );
}

/** Choose a fitting speed when a scene is opened. @param {Store} store */
export function chooseSpeed(store) {
  let waiting = false;
  store.watch(
    ({ opening }) => [opening],
    (state) => {
      const { opening, failure, playback } = state;
      if (!opening && waiting) {
        const speed = speedFor(failure ? 0 : durationOf(state));
        store.update({ playback: { ...playback, speed } });
      }
      waiting = opening !== null;
    },
  );
}

/** @param {Store} store @param {Actions} actions */
export function player(store, actions) {
  playButton(store, actions);
  speedChoice(store, actions);
  timeSlider(store, actions);
  runClock(store);
  chooseSpeed(store);
}

/** @param {Store} store @param {Actions} actions */
function playButton(store, actions) {
  const button = byId("play", HTMLButtonElement);
  button.addEventListener("click", () => actions.play(!store.get().playback.playing));
  store.watch(
    ({ playback }) => [playback.playing],
    ({ playback: { playing } }) => {
      button.setAttribute("aria-pressed", String(playing));
      button.setAttribute("aria-label", playing ? "Pause" : "Play");
    },
  );
}

/** @param {Store} store @param {Actions} actions */
function speedChoice(store, actions) {
  const select = byId("speed", HTMLSelectElement);
  select.append(...SPEEDS.map((speed) => html("option", { value: speed }, [`${speed}×`])));
  select.addEventListener("change", () => actions.setSpeed(Number(select.value)));
  store.watch(
    ({ playback }) => [playback.speed],
    ({ playback }) => (select.value = String(playback.speed)),
  );
}

/** @param {Store} store @param {Actions} actions */
function timeSlider(store, actions) {
  const slider = byId("clock", HTMLInputElement);
  const steps = Number(slider.max);
  slider.addEventListener("input", () => {
    actions.play(false);
    actions.seek((Number(slider.value) / steps) * durationOf(store.get()));
  });
  store.watch(
    (state) => [shownTime(state), durationOf(state)],
    (state) => {
      const time = shownTime(state);
      slider.value = String(time > 0 ? (steps * time) / durationOf(state) : 0);
      slider.setAttribute("aria-valuetext", `${time.toFixed(1)} seconds`);
    },
  );
}
