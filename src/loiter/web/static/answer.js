// @ts-check
/**
 * The answer in words and numbers, and every maneuver that loses.
 *
 * @typedef {import("./types.js").Answer} Answer
 * @typedef {import("./types.js").Maneuver} Maneuver
 * @typedef {import("./types.js").Proof} Proof
 * @typedef {import("./types.js").Scene} Scene
 * @typedef {import("./plan.js").Shown} Shown
 */
import { byId, html, wordOf } from "./svg.js";
import { sorted } from "./track.js";
import { decimalsFor, difference, fixed, length } from "./units.js";

const TURNS = { cw: "clockwise", ccw: "counter-clockwise" };
const ROUND = { cw: "↻", ccw: "↺" };

/**
 * @param {(index: number | null) => void} hover  one of the others is pointed at
 */
export function answerView(hover) {
  const instruction = byId("instruction", HTMLElement);
  const facts = {
    time: byId("time", HTMLElement),
    path: byId("path", HTMLElement),
    word: byId("word", HTMLElement),
    other: byId("other", HTMLElement),
    optimal: byId("optimal", HTMLElement),
    bank: byId("bank-on-circle", HTMLElement),
  };
  const list = byId("candidates", HTMLElement);
  const verdict = byId("verdict", HTMLElement);

  /** @param {Shown} shown */
  function draw({ answer, scene, units }) {
    if (!answer) return;
    const decimals = decimalsFor(scene.orbit.radius_m, "metric");
    const { best } = sorted(answer);
    instruction.textContent = answer.instruction;
    facts.time.textContent = `${fixed(answer.duration_s, Math.max(2, decimals))} s`;
    facts.path.replaceChildren(
      length(answer.length_m, units, decimalsFor(scene.orbit.radius_m, units)),
      ...(answer.wind.speed_m_s > 0 ? [html("small", {}, ["in the air"])] : []),
    );
    facts.word.replaceChildren(wordOf(answer.word), html("small", {}, [TURNS[answer.turn]]));
    facts.other.textContent = otherWay(answer);
    facts.optimal.replaceChildren(
      String(answer.optimal),
      html("small", {}, [
        best.length > 1 ? best.map(({ word, turn }) => `${word} ${ROUND[turn]}`).join(", ") : "unique",
      ]),
    );
    facts.bank.textContent = banks(answer);
    drawList(answer, scene);
  }

  /** @param {Answer} answer @param {Scene} scene */
  function drawList(answer, scene) {
    const { best, others } = sorted(answer);
    const rows = [
      ...best.map((maneuver) => row(maneuver, "optimal", "best")),
      ...others.map((other, index) => {
        const asked = scene.orbit.turn === "either" || scene.orbit.turn === other.turn;
        const later = `${other.later_s < 0 ? "−" : "+"}${difference(other.later_s)}`;
        return row(other, later, asked ? "" : "unasked", index);
      }),
    ];
    list.replaceChildren(...rows);
  }

  /**
   * @param {Maneuver} maneuver
   * @param {string} later
   * @param {string} kind
   * @param {number} [index]
   */
  function row({ word, turn, duration_s }, later, kind, index) {
    const cells = [
      wordOf(word),
      html("span", { class: "round", title: TURNS[turn] }, [ROUND[turn], html("span", { class: "sr" }, [TURNS[turn]])]),
      html("span", { class: "duration" }, [`${fixed(duration_s, 2)} s`]),
      html("span", { class: "later" }, [later]),
    ];
    const item = html("li", { class: kind });
    if (index === undefined) item.append(html("span", { class: "row" }, cells));
    else {
      const button = html("button", { type: "button", class: "row" }, cells);
      for (const event of ["pointerenter", "focus"]) button.addEventListener(event, () => hover(index));
      for (const event of ["pointerleave", "blur"]) button.addEventListener(event, () => hover(null));
      item.append(button);
    }
    return item;
  }

  /** @param {number | null} index */
  function highlight(index) {
    const buttons = list.querySelectorAll("button");
    buttons.forEach((button, i) => button.classList.toggle("lit", i === index));
  }

  /**
   * @param {Proof | null} proof  null while it is under way
   * @param {boolean} [proved]  whether the paper proves the optimum of the scene
   */
  function prove(proof, proved = false) {
    // The last verdict stays, faint, until the next.
    if (!proof && verdict.className === "unchecked") verdict.textContent = "…";
    verdict.classList.toggle("waiting", proof === null);
    if (!proof) return;
    verdict.className = proof.certificate.valid ? "valid" : "invalid";
    verdict.textContent = judged(proof, proved);
  }
  /**
   * What the conditions are not checked for.
   *
   * @param {string} sentence
   */
  function unproved(sentence) {
    verdict.className = "unchecked";
    verdict.textContent = sentence;
  }
  return { draw, highlight, prove, unproved };
}

/** @param {Answer} answer */
function otherWay({ other_turn_later_s }) {
  if (other_turn_later_s === null) return "cannot be held";
  if (Math.abs(other_turn_later_s) < 1e-9) return "the same time";
  return `${other_turn_later_s < 0 ? "−" : "+"}${difference(other_turn_later_s)}`;
}

/** @param {Answer} answer */
function banks({ hold }) {
  const [least, most] = [fixed(hold.least_bank_deg, 1), fixed(hold.largest_bank_deg, 1)];
  return least === most ? `${most}°` : `${least} to ${most}°`;
}

/**
 * The verdict in words. The conditions are necessary; that nothing is faster the paper proves for circles of the turn
 * radius in still air alone.
 *
 * @param {Proof} proof
 * @param {boolean} proved  whether the paper covers the scene
 */
function judged({ certificate }, proved) {
  const { valid, residuals, runner_up, margin_s } = certificate;
  if (!valid) return "Some condition of the maximum principle fails; loiter plan --certify tells which.";
  const margin =
    runner_up !== null && margin_s !== null ? ` Runner-up ${runner_up}, ${difference(margin_s)} later.` : "";
  const held = residuals.filter(({ verdict }) => verdict === "holds").length;
  const worth = proved ? "The paper proves that nothing is faster." : "They are necessary, not a proof of the optimum.";
  return `All ${held} conditions hold. ${worth}${margin}`;
}
