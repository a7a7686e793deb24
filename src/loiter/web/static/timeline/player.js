// @ts-check
/**
 * The controls of the playback.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/actions.js").Actions} Actions
 */
import { byId, html } from "../shared/dom.js";
import { durationOf, shownTime } from "../state/page_state.js";
import { SPEEDS, chooseSpeed, runClock } from "./clock.js";

/**
 * @param {Store} store
 * @param {Actions} actions
 */
export function player(store, actions) {
  playButton(store, actions);
  speedChoice(store, actions);
  timeSlider(store, actions);
  runClock(store);
  chooseSpeed(store);
}

/**
 * @param {Store} store
 * @param {Actions} actions
 */
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

/**
 * @param {Store} store
 * @param {Actions} actions
 */
function speedChoice(store, actions) {
  const select = byId("speed", HTMLSelectElement);
  select.append(...SPEEDS.map((speed) => html("option", { value: speed }, [`${speed}×`])));
  select.addEventListener("change", () => actions.setSpeed(Number(select.value)));
  store.watch(
    ({ playback }) => [playback.speed],
    ({ playback }) => (select.value = String(playback.speed)),
  );
}

/**
 * @param {Store} store
 * @param {Actions} actions
 */
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
