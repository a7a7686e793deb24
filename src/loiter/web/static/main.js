// @ts-check
/**
 * The page: one state, changed in one place. A scene goes to the service; its answer is drawn.
 *
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./types.js").Answer} Answer
 * @typedef {import("./types.js").Proof} Proof
 * @typedef {import("./types.js").Synthesis} Synthesis
 * @typedef {import("./types.js").Units} Units
 */
import { answerView } from "./answer.js";
import { get, latest, post } from "./api.js";
import { placeOf } from "./compass.js";
import { controls } from "./controls.js";
import { SPEEDS, clock, speedFor } from "./flight.js";
import { planView } from "./plan.js";
import { reachFor, reducedView } from "./reduced.js";
import { PRESETS, drifts, fromLink, toLink } from "./scene.js";
import { byId, html } from "./svg.js";
import { takeAway } from "./take.js";
import { themes } from "./theme.js";
import { timeLine } from "./timeline.js";
import { at } from "./track.js";

const REST_MS = 140; // what waits until a drag pauses: certificate, map, link, texts; in wind the losers too
const CELLS = 280; // of the map, a side: 1.5 pixels each, and the curves cover the steps

/**
 * `whole` tells whether the answer has every candidate, or the best of each direction alone.
 *
 * @type {{scene: Scene, units: Units, answer: Answer | null, whole: boolean, asked: number, drawn: number}}
 */
const state = { scene: PRESETS[0].scene, units: "metric", answer: null, whole: true, asked: 0, drawn: 0 };
const shown = () => state;
const message = byId("message", HTMLElement);
const spoken = byId("spoken", HTMLElement);
const plan = byId("plan", SVGSVGElement);
let failed = false;
let fitNext = true;
/** @type {number[] | null} */
let spanNext = null; // the view of the link that was opened

/**
 * Pointer moves whose path is not drawn yet: the scene's number and when the move happened.
 *
 * @type {{asked: number, at: number}[]}
 */
const moves = [];

/**
 * @param {string} sentence
 * @param {boolean} [bad]
 */
function say(sentence, bad = false) {
  message.textContent = sentence;
  message.classList.toggle("bad", bad);
}

/**
 * The one way a scene changes.
 *
 * @param {Scene} scene
 * @param {Event} [event] what changed it
 */
function change(scene, event) {
  state.scene = scene;
  if (!failed) say("");
  // All candidates in drifting air take the service longer than a frame: they wait until the drag rests.
  demand(!drifts(scene));
  if (event instanceof PointerEvent) moves.push({ asked: state.asked, at: event.timeStamp });
  view.drawScene();
  panel.draw(shown());
  rest();
}

/** @param {boolean} whole */
function demand(whole) {
  state.asked += 1;
  plan.dataset.asked = String(state.asked);
  ask({ scene: state.scene, number: state.asked, whole });
}

const ask = latest(
  async (/** @type {{scene: Scene, number: number, whole: boolean}} */ { scene, whole }) =>
    /** @type {Answer} */ (await (await post(whole ? "/api/plan" : "/api/fastest", scene)).json()),
  (answer, { number, whole }) => {
    if (failed) say("");
    fail(false);
    [state.answer, state.drawn, state.whole] = [answer, number, whole];
    answered();
  },
  (error, { number }) => {
    fail(true);
    state.drawn = number;
    settle(number);
    say(error.message, true);
    plan.dataset.drawn = String(number);
  },
);

/**
 * The last good plan stays, faint, while a scene has none.
 *
 * @param {boolean} on
 */
function fail(on) {
  failed = on;
  byId("main", HTMLElement).classList.toggle("stale", on);
}

function answered() {
  if (fitNext) arrive(state.answer);
  else view.drawAnswer();
  settle(state.drawn);
  words.draw(shown());
  reduced.draw();
  line.plan(state.answer);
  words.prove(null);
  fly(ghost.time());
  plan.dataset.drawn = String(state.drawn);
}

/**
 * The first answer to a scene that was opened.
 *
 * @param {Answer | null} answer
 */
function arrive(answer) {
  fitNext = false;
  view.fit();
  if (spanNext) view.showSpan(spanNext);
  spanNext = null;
  speed(speedFor(answer?.duration_s ?? 0));
}

/**
 * Measure how long the moves up to a scene waited for its path.
 *
 * @param {number} number
 */
function settle(number) {
  const now = performance.now();
  while (moves.length > 0 && moves[0].asked <= number) {
    const move = moves.shift();
    if (move && !failed) performance.measure("move to path", { start: move.at, end: now });
  }
}

let resting = 0;
/** What need not follow every move of a drag. */
function rest() {
  clearTimeout(resting);
  resting = window.setTimeout(async () => {
    if (state.drawn < state.asked) return rest();
    relink();
    if (failed || !state.answer) return rested();
    if (!state.whole) {
      demand(true);
      return rest();
    }
    spoken.textContent = state.answer.instruction;
    taking.draw();
    askMap(state.answer);
    askProof({ scene: state.scene, number: state.asked });
  }, REST_MS);
}

const link = () => toLink(state.scene, state.units, view.span());
const relink = () => history.replaceState(null, "", link());
let looking = 0;
/** The address follows the view once it rests. */
function moved() {
  clearTimeout(looking);
  looking = window.setTimeout(relink, REST_MS);
}

const askProof = latest(
  async (/** @type {{scene: Scene, number: number}} */ { scene }) =>
    /** @type {Proof} */ (await (await post("/api/certificate", scene)).json()),
  (proof, { number }) => {
    proved = number;
    if (number === state.asked) [line, words].forEach((each) => each.prove(proof));
    fly(ghost.time());
    rested();
  },
  (error, { number }) => {
    proved = number;
    say(error.message, true);
    rested();
  },
);

let proved = 0;
let mapped = ""; // the map that is asked for
let mapShown = "";
const askMapAt = latest(
  async (/** @type {string} */ query) => /** @type {Synthesis} */ (await (await get(`/api/synthesis?${query}`)).json()),
  (synthesis, query) => {
    mapShown = query;
    reduced.map(synthesis);
    rested();
  },
  (error) => {
    mapped = mapShown;
    say(error.message, true);
    rested();
  },
);

/** Tell those who watch that nothing is under way any more. */
function rested() {
  const quiet = failed || (proved === state.asked && mapped === mapShown);
  if (quiet && state.drawn === state.asked) plan.dataset.rested = String(state.asked);
}

/** @param {Answer} answer */
function askMap({ reduced: here }) {
  const { turn } = state.scene.orbit;
  byId("map", HTMLElement).classList.toggle("drifts", drifts(state.scene));
  // Circles of the turn radius come out a rounding off; the map is that of the kernel, from 1 up.
  const radius = Math.max(1, Number(here.radius.toFixed(3)));
  byId("map-title", HTMLElement).textContent =
    `R = ${Number(radius.toPrecision(3))}, ${turn === "either" ? "either way" : turn}`;
  const query = new URLSearchParams({
    radius: String(radius),
    turn: state.scene.orbit.turn,
    reach: String(reachFor(radius, here)),
    cells: String(CELLS),
  }).toString();
  if (query !== mapped) askMapAt(query);
  mapped = query;
}

/** @param {number} time */
function fly(time) {
  const { answer } = state;
  slider.value = String(answer && answer.duration_s > 0 ? (1000 * time) / answer.duration_s : 0);
  slider.setAttribute("aria-valuetext", `${time.toFixed(1)} seconds`);
  if (!answer || answer.segments.length === 0) return [view, reduced].forEach((each) => each.fly(null));
  const instant = at(answer.track, time);
  view.fly(ghost.playing() || time > 0 ? instant : null);
  reduced.fly(ghost.playing() || time > 0 ? instant : null);
  line.fly(time);
}

/** @param {number | null} index */
function hover(index) {
  view.highlight(index);
  words.highlight(index);
}

const slider = byId("clock", HTMLInputElement);
const ghost = clock(() => state.answer?.duration_s ?? 0, fly);
const view = planView(shown, change, hover, moved);
const reduced = reducedView(shown, (x, y, event) => {
  if (!state.answer) return;
  const place = placeOf(x, y, state.scene, state.answer.aircraft.turn_radius_m);
  change({ ...state.scene, pose: { ...state.scene.pose, ...place } }, event);
});
const line = timeLine((time) => ghost.seek(time));
const words = answerView(hover);
const panel = controls(shown, typed, (sentence) => say(sentence, true));
const taking = takeAway(shown, () => location.origin + location.pathname + link(), say);

/** @param {Scene} scene @param {Event} event */
function typed(scene, event) {
  change(scene, event);
  view.keep();
}

/**
 * A scene to begin with: seen whole, flown from its start.
 *
 * @param {Scene} scene
 */
function begin(scene) {
  fitNext = true;
  ghost.play(false);
  ghost.seek(0);
  change(scene);
}

/** The scene of the link, or the first preset where the link is none or spoilt. */
function open() {
  if (location.hash.length < 2) return begin(PRESETS[0].scene);
  try {
    const { scene, units, view: span } = fromLink(location.hash);
    [state.units, unitsChoice.value] = [units, units];
    begin(scene);
    showOrigin(scene);
    spanNext = span;
  } catch (error) {
    begin(PRESETS[0].scene);
    say(/** @type {Error} */ (error).message, true);
  }
}

const unitsChoice = byId("units", HTMLSelectElement);
const play = byId("play", HTMLButtonElement);
const speeds = byId("speed", HTMLSelectElement);

/** @param {boolean} on */
function playing(on) {
  ghost.play(on);
  play.setAttribute("aria-pressed", String(on));
  play.setAttribute("aria-label", on ? "Pause" : "Play");
  fly(ghost.time());
}

/** @param {number} times */
function speed(times) {
  speeds.value = String(times);
  ghost.setSpeed(times);
}

function wire() {
  speeds.append(...SPEEDS.map((times) => html("option", { value: times }, [`${times}×`])));
  speeds.addEventListener("change", () => ghost.setSpeed(Number(speeds.value)));
  play.addEventListener("click", () => playing(!ghost.playing()));
  slider.addEventListener("input", () => {
    const share = Number(slider.value) / 1000;
    playing(false);
    ghost.seek(share * (state.answer?.duration_s ?? 0));
  });
  const presets = byId("presets", HTMLElement);
  presets.append(
    ...PRESETS.map(({ name, scene }) => {
      const button = html("button", { type: "button" }, [name]);
      button.addEventListener("click", () => begin({ ...scene, origin: state.scene.origin }));
      return button;
    }),
  );
  byId("fit", HTMLButtonElement).addEventListener("click", view.fit);
  byId("closer", HTMLButtonElement).addEventListener("click", () => view.zoom(1.4));
  byId("farther", HTMLButtonElement).addEventListener("click", () => view.zoom(1 / 1.4));
  unitsChoice.addEventListener("change", () => {
    state.units = unitsChoice.value === "aviation" ? "aviation" : "metric";
    view.draw();
    panel.draw(shown());
    words.draw(shown());
    taking.draw();
    rest();
  });
  wireOrigin();
  addEventListener("hashchange", open);
}

const [latitude, longitude] = ["latitude", "longitude"].map((id) => byId(id, HTMLInputElement));

/** @param {Scene} scene */
function showOrigin({ origin }) {
  latitude.value = String(origin?.latitude_deg ?? "");
  longitude.value = String(origin?.longitude_deg ?? "");
}

function wireOrigin() {
  for (const input of [latitude, longitude])
    input.addEventListener("input", () => {
      const [latitude_deg, longitude_deg] = [latitude.valueAsNumber, longitude.valueAsNumber];
      const whole = Number.isFinite(latitude_deg) && Number.isFinite(longitude_deg);
      change({ ...state.scene, origin: whole ? { latitude_deg, longitude_deg } : null });
    });
}

/** Drawings are as large as their boxes. */
function follow() {
  const boxes = {
    plan: byId("plan-box", HTMLElement),
    map: byId("map", HTMLElement),
    line: byId("line-box", HTMLElement),
  };
  const measure = () => {
    view.resize(Math.round(boxes.plan.clientWidth), Math.round(boxes.plan.clientHeight));
    reduced.resize(Math.round(boxes.map.clientWidth));
    line.resize(Math.round(boxes.line.clientWidth));
    fly(ghost.time());
  };
  const observer = new ResizeObserver(measure);
  Object.values(boxes).forEach((box) => observer.observe(box));
  measure();
}

wire();
follow();
themes(byId("theme", HTMLButtonElement), () => reduced.drawMap());
open();
