// @ts-check
/**
 * The time line: control, switching function and adjoint of the optimum, with the instants of switching. It is the
 * certificate made visible: phi > 0 turns left, phi < 0 right, phi = 0 allows straight flight, and psi1 meets lambda
 * exactly where phi vanishes.
 *
 * @typedef {import("./types.js").Answer} Answer
 * @typedef {import("./types.js").Proof} Proof
 */
import { pointOf } from "./draggable.js";
import { byId, polyline, set, show, svg } from "./svg.js";
import { reading } from "./track.js";
import { fixed, nice } from "./units.js";

const LEFT = 34;
const RIGHT = 74;
const STRIP = { top: 4, height: 22 };
const PHI = { top: 36, height: 52 };
const PSI = { top: 98, height: 52 };
const AXIS = 166;

/** @typedef {{top: number, height: number}} Band */

/**
 * @param {(time_s: number) => void} seek
 */
export function timeLine(seek) {
  const root = byId("timeline", SVGSVGElement);
  const [back, strip, lines, ticks, reads] = ["back", "strip", "lines", "ticks", "reads"].map((name) =>
    svg("g", { class: `layer ${name}` }),
  );
  const cursor = svg("path", { class: "cursor" });
  root.append(back, strip, lines, ticks, cursor, reads);
  let width = 700;
  /** @type {Answer | null} */
  let answer = null;
  /** @type {Proof | null} */
  let proof = null;

  const end = () => answer?.duration_s || 1;
  const across = (/** @type {number} */ time) => LEFT + (time / end()) * (width - LEFT - RIGHT);

  /** @param {Answer | null} next */
  function plan(next) {
    answer = next;
    proof = null;
    draw();
  }

  /** @param {Proof} next */
  function prove(next) {
    proof = next;
    draw();
  }

  function draw() {
    const segments = answer?.segments ?? [];
    strip.replaceChildren(
      ...segments.flatMap(({ letter, start_s, duration_s }) =>
        block(letter, across(start_s), across(start_s + duration_s)),
      ),
    );
    ticks.replaceChildren(
      ...(segments.length > 0 ? axis(end(), across, width) : []),
      ...segments
        .slice(1)
        .map(({ start_s }) => svg("path", { d: `M${across(start_s)} ${STRIP.top}V${AXIS - 12}`, class: "switchline" })),
    );
    root.classList.toggle("unproved", proof === null);
    if (proof) drawProof(proof);
  }

  /** @param {Proof} given */
  function drawProof({ series, certificate }) {
    const psi = [...series.psi1, ...series.psi2, ...(certificate.lambda === null ? [] : [certificate.lambda]), 0];
    const phiY = scaleFor([...series.phi, 0], PHI);
    const psiY = scaleFor(psi, PSI);
    const line = (
      /** @type {number[]} */ values,
      /** @type {(value: number) => number} */ y,
      /** @type {string} */ name,
    ) => svg("path", { d: polyline(values.map((value, i) => [across(series.time_s[i]), y(value)])), class: name });
    back.replaceChildren(...level(phiY(0), width), ...level(psiY(0), width), ...names());
    lines.replaceChildren(
      line(series.phi, phiY, "phi"),
      line(series.psi1, psiY, "psi1"),
      line(series.psi2, psiY, "psi2"),
      ...(certificate.lambda === null
        ? []
        : [svg("path", { d: `M${LEFT} ${psiY(certificate.lambda)}H${width - RIGHT}`, class: "lambda" })]),
    );
  }

  /** @param {number} time */
  function fly(time) {
    const x = across(Math.min(time, end()));
    cursor.setAttribute("d", `M${x.toFixed(1)} 0V${AXIS - 6}`);
    show(reads, proof !== null);
    if (!proof || proof.series.time_s.length === 0) return;
    const read = reading(proof.series.time_s, time);
    const { phi, psi1, psi2 } = proof.series;
    reads.replaceChildren(
      svg("text", { x: width - RIGHT + 8, y: STRIP.top + 16 }, [`${fixed(time, 2)} s`]),
      svg("text", { x: width - RIGHT + 8, y: PHI.top + 30, class: "phi" }, [`φ ${fixed(read(phi), 3)}`]),
      svg("text", { x: width - RIGHT + 8, y: PSI.top + 16, class: "psi1" }, [`ψ₁ ${fixed(read(psi1), 3)}`]),
      svg("text", { x: width - RIGHT + 8, y: PSI.top + 34, class: "psi2" }, [`ψ₂ ${fixed(read(psi2), 3)}`]),
      ...(proof.certificate.lambda === null
        ? []
        : [
            svg("text", { x: width - RIGHT + 8, y: PSI.top + 52, class: "lam" }, [
              `λ ${fixed(proof.certificate.lambda, 3)}`,
            ]),
          ]),
    );
  }

  /** @param {number} next pixels */
  function resize(next) {
    width = Math.max(260, next);
    set(root, { width, height: AXIS + 8, viewBox: `0 0 ${width} ${AXIS + 8}` });
    draw();
  }

  const seekAt = (/** @type {PointerEvent} */ event) =>
    seek(((pointOf(root, event)[0] - LEFT) / (width - LEFT - RIGHT)) * end());
  root.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    root.setPointerCapture(event.pointerId);
    seekAt(event);
  });
  root.addEventListener("pointermove", (event) => {
    if (root.hasPointerCapture(event.pointerId)) seekAt(event);
  });
  return { plan, prove, fly, resize };
}

/**
 * A piece of the control: a bar in the colour of its letter.
 *
 * @param {string} letter
 * @param {number} from
 * @param {number} to
 */
function block(letter, from, to) {
  const bar = svg("rect", {
    x: from,
    y: STRIP.top,
    width: Math.max(0.5, to - from),
    height: STRIP.height,
    class: `bar ${letter}`,
  });
  if (to - from < 16) return [bar];
  const words = /** @type {Record<string, string>} */ ({ L: "left", S: "straight", R: "right" });
  const text = to - from < 64 ? letter : words[letter];
  return [
    bar,
    svg("text", { x: (from + to) / 2, y: STRIP.top + 15.5, "text-anchor": "middle", class: "barname" }, [text]),
  ];
}

/**
 * The height at which a value is drawn in a band that shows all values.
 *
 * @param {number[]} values
 * @param {Band} band
 */
function scaleFor(values, { top, height }) {
  const least = Math.min(...values);
  const span = Math.max(...values) - least || 1;
  return (/** @type {number} */ value) => top + height - ((value - least) / span) * height;
}

/**
 * @param {number} y
 * @param {number} width
 */
function level(y, width) {
  return [svg("path", { d: `M${LEFT} ${y}H${width - RIGHT}`, class: "zero" })];
}

function names() {
  return [
    svg("text", { x: 6, y: STRIP.top + 16 }, ["u"]),
    svg("text", { x: 6, y: PHI.top + 30 }, ["φ"]),
    svg("text", { x: 6, y: PSI.top + 30 }, ["ψ"]),
  ];
}

/**
 * @param {number} end seconds
 * @param {(time: number) => number} across
 * @param {number} width
 */
function axis(end, across, width) {
  const step = nice((end * 64) / (width - LEFT - RIGHT));
  const decimals = Math.max(0, -Math.floor(Math.log10(step)));
  const count = Math.floor(end / step + 1e-9);
  return Array.from({ length: count + 1 }, (_, k) =>
    svg("text", { x: across(k * step), y: AXIS + 3, "text-anchor": "middle", class: "tick" }, [
      `${fixed(k * step, decimals)}${k === count ? " s" : ""}`,
    ]),
  );
}
