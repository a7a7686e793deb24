// @ts-check
/**
 * The page: one state, changed in one place. A scene goes to the service; its answer is drawn.
 *
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./types.js").Altitude} Altitude
 * @typedef {import("./types.js").Answer} Answer
 * @typedef {import("./types.js").Proof} Proof
 * @typedef {import("./types.js").Synthesis} Synthesis
 * @typedef {import("./types.js").Units} Units
 */
import { altitudeFields } from "./altitude.js";
import { answerView } from "./answer.js";
import { Problem, Unreachable, get, latest, post } from "./api.js";
import { placeOf, turnRadiusOf } from "./compass.js";
import { controls } from "./controls.js";
import { failureView } from "./failure.js";
import { nameOf } from "./fields.js";
import { SPEEDS, clock, speedFor } from "./flight.js";
import { blamed, inWords } from "./names.js";
import { originFields } from "./origin.js";
import { planView } from "./plan.js";
import { reachFor, reducedView } from "./reduced.js";
import { retrying } from "./retry.js";
import { PRESETS, drifts, fromLink, inThePaper, toLink } from "./scene.js";
import { byId, html } from "./svg.js";
import { exportPanel } from "./export_panel.js";
import { themes } from "./theme.js";
import { timeLine } from "./timeline.js";
import { at } from "./track.js";

const REST_MS = 140; // what waits until a drag pauses: certificate, map, link, texts; in wind the losers too
const CELLS = 280; // of the map, a side: 1.5 pixels each, and the curves cover the steps

/**
 * `whole` tells whether the answer has every candidate, or the best of each direction alone.
 *
 * @type {{scene: Scene, units: Units, altitude: Altitude, answer: Answer | null, whole: boolean, asked: number,
 *   drawn: number}}
 */
const state = { scene: PRESETS[0].scene, units: "metric", altitude: {}, answer: null, whole: true, asked: 0, drawn: 0 };
const shown = () => ({ ...state, current: !failure && state.drawn === state.asked });
const message = byId("message", HTMLElement);
const spoken = byId("spoken", HTMLElement);
const plan = byId("plan", SVGSVGElement);
/** @type {import("./scene.js").Linked} */
const FIRST = { scene: PRESETS[0].scene, units: "metric", altitude: {} };
/** @type {import("./failure.js").Failure | null} */
let failure = null; // why the scene has no plan
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
 * The fields that are marked: for a scene that was refused, and for a file.
 *
 * @typedef {"scene" | "file"} Matter
 * @type {Record<Matter, string[]>}
 */
const marked = { scene: [], file: [] };

/**
 * Mark the fields that a refusal is about, and give its sentence in the page's own names.
 *
 * @param {Error} error
 * @param {Matter} matter
 */
function refuse(error, matter) {
  const sentence = inWords(error.message, (id) => nameOf(byId(id, HTMLElement)));
  const ids = error instanceof Problem ? blamed(error) : [];
  mark(Object.fromEntries(ids.map((id) => [id, sentence])), matter);
  return sentence;
}

/**
 * Mark fields, each with a sentence, and no others any more.
 *
 * @param {Record<string, string>} sentences  by the ids of the fields
 * @param {Matter} matter
 */
function mark(sentences, matter) {
  for (const id of marked[matter]) fields[id].refuse(null);
  marked[matter] = Object.keys(sentences).filter((id) => fields[id]);
  for (const id of marked[matter]) {
    fields[id].refuse(sentences[id]);
    byId(id, HTMLElement).closest("details")?.setAttribute("open", "");
  }
}

/** @param {string} id of a field */
const typo = (id) => fields[id]?.typo() ?? "";

/**
 * Ask for what a file needs: mark the fields, and go to the first.
 *
 * @param {Record<string, string>} sentences
 */
function ask(sentences) {
  mark(sentences, "file");
  const [[first, sentence]] = Object.entries(sentences);
  byId(first, HTMLElement).focus();
  say(sentence, true);
}

/**
 * The one way a scene changes.
 *
 * @param {Scene} scene
 * @param {Event} [event] what changed it
 */
function change(scene, event) {
  state.scene = scene;
  say("");
  // All candidates in drifting air take the service longer than a frame: they wait until the drag rests.
  demand(!drifts(scene));
  if (event instanceof PointerEvent) moves.push({ asked: state.asked, at: event.timeStamp });
  view.drawScene();
  panel.draw();
  rest();
}

/** @param {boolean} whole */
function demand(whole) {
  state.asked += 1;
  plan.dataset.asked = String(state.asked);
  askPlan({ scene: state.scene, number: state.asked, whole });
}

const askPlan = latest(
  async (/** @type {{scene: Scene, number: number, whole: boolean}} */ { scene, whole }) =>
    /** @type {Answer} */ (await post(whole ? "/api/plan" : "/api/fastest", scene)),
  (answer, { number, whole }) => {
    retries.rest();
    fail(null);
    mark({}, "scene");
    [state.answer, state.drawn, state.whole] = [answer, number, whole];
    answered();
  },
  (error, { number }) => {
    state.drawn = number;
    fail(failureOf(error));
    settle(number);
    // The plan that comes later has to be seen whole too.
    if (fitNext && failure?.name === "refused") arrive(null);
    else if (fitNext) view.fit();
    plan.dataset.drawn = String(number);
  },
);

/**
 * @param {Error} error
 * @returns {import("./failure.js").Failure}
 */
function failureOf(error) {
  const sentence = refuse(error, "scene");
  if (!(error instanceof Unreachable))
    return { name: "refused", headline: "No plan for this scene", sentence, attempt: null };
  const attempt = retries.plan(error.wait_s);
  return { name: "unreachable", headline: error.headline, sentence, attempt };
}

/**
 * The last good plan stays, faint, while a scene has none.
 *
 * @param {import("./failure.js").Failure | null} why
 */
function fail(why) {
  if (!why && !failure) return;
  if (!failure) say("");
  failure = why;
  failing.draw(why);
  plan.dataset.failure = why?.name ?? "";
  if (!why) return;
  playing(false);
  exporting.draw();
  words.unproved("–");
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
    if (move && !failure) performance.measure("move to path", { start: move.at, end: now });
  }
}

let resting = 0;
/** What need not follow every move of a drag. */
function rest() {
  clearTimeout(resting);
  resting = window.setTimeout(async () => {
    if (state.drawn < state.asked) return rest();
    relink();
    if (failure || !state.answer) return rested();
    if (!state.whole) {
      demand(true);
      return rest();
    }
    spoken.textContent = state.answer.instruction;
    exporting.draw();
    askMap(state.answer);
    askProof({ scene: state.scene, number: state.asked });
  }, REST_MS);
}

const link = () => toLink(state, view.span());
const relink = () => history.replaceState(null, "", link());
let looking = 0;
/** The address follows the view once it rests. */
function moved() {
  clearTimeout(looking);
  looking = window.setTimeout(relink, REST_MS);
}

const askProof = latest(
  async (/** @type {{scene: Scene, number: number}} */ { scene }) =>
    /** @type {Proof} */ (await post("/api/certificate", scene)),
  (proof, { number }) => {
    proved = number;
    lacks.proof = false;
    if (number === state.asked) {
      line.prove(proof);
      words.prove(proof, state.answer !== null && inThePaper(state.scene, state.answer.reduced.radius));
    }
    fly(ghost.time());
    rested();
  },
  (error, { number }) => {
    proved = number;
    if (number === state.asked) words.unproved(`Not checked: ${missed("proof", error)}`);
    rested();
  },
);

let proved = 0;
let mapped = ""; // the map that is asked for
let mapShown = "";
const askMapAt = latest(
  async (/** @type {string} */ query) => /** @type {Synthesis} */ (await get(`/api/synthesis?${query}`)),
  (synthesis, query) => {
    mapShown = query;
    lacks.map = false;
    reduced.map(synthesis);
    missing("");
    rested();
  },
  (error) => {
    mapped = mapShown;
    missing(`Not the map of this scene: ${missed("map", error)}`);
    rested();
  },
);

/** Say why the map is not that of the scene. @param {string} sentence */
function missing(sentence) {
  byId("map-fault", HTMLElement).textContent = sentence;
  byId("map", HTMLElement).classList.toggle("missing", sentence !== "");
}

/** What of the last scene the service has not answered. */
const lacks = { proof: false, map: false };

/**
 * Why something is missing of a plan that is there; a service that does not answer is asked again for all of it.
 *
 * @param {"proof" | "map"} part
 * @param {Error} error
 */
function missed(part, error) {
  lacks[part] = error instanceof Unreachable;
  if (!(error instanceof Unreachable)) return error.message;
  const attempt = retries.plan(error.wait_s);
  return `${error.headline}.${attempt ? ` Asking again in ${attempt.wait_s} s.` : ""}`;
}

const retries = retrying(() => {
  demand(!drifts(state.scene));
  rest();
});

/** Tell those who watch that nothing is under way any more. */
function rested() {
  const quiet = failure || (proved === state.asked && mapped === mapShown);
  if (!quiet || state.drawn !== state.asked) return;
  plan.dataset.rested = String(state.asked);
  if (!failure && !lacks.proof && !lacks.map) retries.stop();
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
  if (failure) return;
  const place = placeOf(x, y, state.scene, turnRadiusOf(state.scene.aircraft));
  change({ ...state.scene, pose: { ...state.scene.pose, ...place } }, event);
});
const line = timeLine((time) => !failure && ghost.seek(time));
const words = answerView(hover);
const failing = failureView(() => retries.now(), say);
const panel = controls(shown, typed);
const origin = originFields(shown, change);
const heights = altitudeFields(shown, (altitude) => {
  state.altitude = altitude;
  moved();
});
const exporting = exportPanel(shown, () => location.origin + location.pathname + link(), {
  say,
  refuse: (error) => say(error instanceof Unreachable ? `Not saved: ${error.headline}. ${error.message}` : refuse(error, "file"), true),
  ask,
  typo,
});
/** @type {Record<string, import("./fields.js").Field>} */
const fields = { ...panel.fields, ...origin.fields, ...heights.fields };

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
  try {
    const linked = location.hash.length < 2 ? { ...FIRST, view: null } : fromLink(location.hash);
    show(linked);
    spanNext = linked.view;
  } catch (error) {
    show(FIRST);
    say(/** @type {Error} */ (error).message, true);
  }
}

/** @param {import("./scene.js").Linked} linked */
function show({ scene, units, altitude }) {
  [state.units, unitsChoice.value, state.altitude] = [units, units, altitude];
  begin(scene);
  origin.open();
  heights.draw();
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
    panel.draw();
    heights.draw();
    words.draw(shown());
    exporting.draw();
    rest();
  });
  addEventListener("hashchange", open);
  // The network is back, or the user: then there is no reason to wait.
  addEventListener("online", impatient);
  addEventListener("visibilitychange", impatient);
}

function impatient() {
  if (failure?.name === "unreachable" && document.visibilityState === "visible") retries.now();
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
