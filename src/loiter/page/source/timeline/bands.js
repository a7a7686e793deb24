// @ts-check
/**
 * The drawings of the time line: a strip for the control u, a band for phi and one for psi, and an axis.
 *
 * @import {Letter, Proof, Segment} from "../shared/types.js"
 * @typedef {{top: number, height: number}} Band
 * @typedef {ReturnType<typeof timeScale>} TimeScale
 */
import { part, polyline } from "../shared/dom.js";
import { CONTROLS, interpolator } from "../shared/maneuver.js";
import { clock, decimalsOfStep, fixed, roundStep } from "../shared/units.js";

// Pixels
const LEFT = 34;
const RIGHT = 74;
const STRIP = { top: 4, height: 22 };
const PHI = { top: 36, height: 52 };
const PSI = { top: 98, height: 52 };
const AXIS = { plain: 46, theory: 166 }; // without and with the bands of phi and psi
const TICK_SPACING = 64;
const LEAST_WIDTH = { letter: 16, word: 64 }; // of a bar with a label

/** The height of the time line. @param {boolean} theory */
export const heightOf = (theory) => (theory ? AXIS.theory : AXIS.plain) + 8;

/**
 * Pixels from times, and times from pixels.
 *
 * @param {number} width
 * @param {number} duration_s
 * @param {boolean} theory  whether the bands of phi and psi are shown
 */
export function timeScale(width, duration_s, theory) {
  const [end, length] = [duration_s || 1, width - LEFT - RIGHT];
  return {
    x: (/** @type {number} */ time) => LEFT + (Math.min(time, end) / end) * length,
    time: (/** @type {number} */ x) => ((x - LEFT) / length) * end,
    end,
    right: width - RIGHT,
    length,
    axis: theory ? AXIS.theory : AXIS.plain,
  };
}

/** Bars of the control. @param {Segment[]} segments @param {TimeScale} scale */
export function drawControls(segments, { x }) {
  return segments.flatMap(({ letter, name, start_s, duration_s }) => drawBar(letter, x(start_s), x(start_s + duration_s), name));
}

/** @param {Letter} letter @param {number} from @param {number} to @param {string} [name] */
function drawBar(letter, from, to, name = CONTROLS[letter]) {
  const width = to - from;
  const box = { x: from, y: STRIP.top, width: Math.max(0.5, width), height: STRIP.height };
  const bar = part("rect", { ...box, class: `bar ${letter}` });
  if (width < LEAST_WIDTH.letter) return [bar];
  const text = width < LEAST_WIDTH.word ? letter : name;
  const middle = { x: (from + to) / 2, y: STRIP.top + 15.5, "text-anchor": "middle" };
  return [bar, part("text", { ...middle, class: "barname" }, [text])];
}

/** Lines at the switching times. @param {Segment[]} segments @param {TimeScale} scale */
export function drawSwitches(segments, { x, axis }) {
  const line = (/** @type {number} */ time) => `M${x(time)} ${STRIP.top}V${axis - 12}`;
  return segments.slice(1).map(({ start_s }) => part("path", { d: line(start_s), class: "switchline" }));
}

/** The spacing of times: whole parts of a minute, or whole minutes, from ten seconds on. @param {number} least */
const timeStep = (least) =>
  least <= 5 ? roundStep(least) : ([10, 20, 30].find((step) => step >= least) ?? 60 * roundStep(least / 60));

/** The numbers of the time axis. @param {TimeScale} scale */
export function drawAxis({ x, end, length, axis }) {
  const step = timeStep((end * TICK_SPACING) / length);
  // The end itself may be off by rounding.
  const count = Math.floor(end / step + 1e-9);
  const unit = end < 60 ? " s" : " min";
  const text = (/** @type {number} */ k) =>
    (end < 60 ? fixed(k * step, decimalsOfStep(step)) : clock(k * step, 0)) + (k === count ? unit : "");
  return Array.from({ length: count + 1 }, (_, k) =>
    part("text", { x: x(k * step), y: axis + 3, "text-anchor": "middle", class: "tick" }, [text(k)]),
  );
}

/**
 * The lines of phi, psi1, psi2 and lambda, and behind them zero lines and names.
 *
 * @param {Proof} proof
 * @param {TimeScale} scale
 */
export function drawSeries({ series, certificate: { lambda } }, { x, right }) {
  const { time_s, phi, psi1, psi2 } = series;
  const lambdas = lambda === null ? [] : [lambda];
  const phiY = valueScale([...phi, 0], PHI);
  const psiY = valueScale([...psi1, ...psi2, ...lambdas, 0], PSI);
  const line = (/** @type {number[]} */ values, /** @type {(value: number) => number} */ y) =>
    polyline(values.map((value, i) => [x(time_s[i]), y(value)]));
  const level = (/** @type {number} */ y) => `M${LEFT} ${y}H${right}`;
  return {
    back: [
      part("path", { d: level(phiY(0)), class: "zero" }),
      part("path", { d: level(psiY(0)), class: "zero" }),
      ...drawNames(),
    ],
    lines: [
      part("path", { d: line(phi, phiY), class: "phi" }),
      part("path", { d: line(psi1, psiY), class: "psi1" }),
      part("path", { d: line(psi2, psiY), class: "psi2" }),
      ...lambdas.map((value) => part("path", { d: level(psiY(value)), class: "lambda" })),
    ],
  };
}

/**
 * The function that gives the height of a value in a band that shows all values.
 *
 * @param {number[]} values
 * @param {Band} band
 */
function valueScale(values, { top, height }) {
  const least = Math.min(...values);
  const span = Math.max(...values) - least || 1;
  return (/** @type {number} */ value) => top + height - ((value - least) / span) * height;
}

function drawNames() {
  return [
    part("text", { x: 6, y: STRIP.top + 16 }, ["u"]),
    part("text", { x: 6, y: PHI.top + 30 }, ["φ"]),
    part("text", { x: 6, y: PSI.top + 30 }, ["ψ"]),
  ];
}

/**
 * The values at a time, to the right of the bands.
 *
 * @param {Proof} proof
 * @param {number} time
 * @param {TimeScale} scale
 */
export function drawReadings({ series, certificate: { lambda } }, time, { right }) {
  if (series.time_s.length === 0) return [];
  const read = interpolator(series.time_s, time);
  const text = (/** @type {number} */ y, /** @type {string} */ content, kind = "") =>
    part("text", { x: right + 8, y, class: kind }, [content]);
  return [
    text(STRIP.top + 16, time < 60 ? `${fixed(time, 2)} s` : clock(time, 1)),
    text(PHI.top + 30, `φ ${fixed(read(series.phi), 3)}`, "phi"),
    text(PSI.top + 16, `ψ₁ ${fixed(read(series.psi1), 3)}`, "psi1"),
    text(PSI.top + 34, `ψ₂ ${fixed(read(series.psi2), 3)}`, "psi2"),
    ...(lambda === null ? [] : [text(PSI.top + 52, `λ ${fixed(lambda, 3)}`, "lam")]),
  ];
}
