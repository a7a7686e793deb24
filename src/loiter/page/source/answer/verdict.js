// @ts-check
/**
 * The verdict of the certificate in words.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Certificate, Scene} from "../shared/types.js"
 */
import { byId } from "../shared/dom.js";
import { timeDifference, timeText } from "../shared/units.js";

/** @param {Store} store */
export function verdictView(store) {
  const verdict = byId("verdict", HTMLElement);
  store.watch(
    ({ failure, faults, proof, clear, leg }) => [failure, faults.certificate, proof, clear, leg],
    (state) => {
      const { kind, text } = verdictOf(state);
      // Until the next verdict arrives, the last one stays visible, drawn faintly.
      if (kind !== "waiting" || verdict.className === "unchecked") verdict.textContent = text;
      if (kind === "waiting") verdict.classList.add(kind);
      else verdict.className = kind;
    },
  );
}

/** @param {PageState} state @returns {{kind: "unchecked" | "waiting" | "valid" | "invalid", text: string}} */
function verdictOf({ failure, faults, proof, answer, scene, clear, leg }) {
  if (failure) return { kind: "unchecked", text: "–" };
  if (leg) return { kind: "unchecked", text: "Not checked for a leg. By legs.md, section 3, no other way in and round is sooner at the point." };
  if (clear?.maneuver)
    return { kind: "unchecked", text: `Not checked of an entry round a fence. No clear entry takes less than ${timeText(clear.least_s ?? 0, scene)}.` };
  if (faults.certificate) return { kind: "unchecked", text: faults.certificate };
  if (!proof || !answer) return { kind: "waiting", text: "…" };
  const { certificate } = proof;
  if (!certificate.valid)
    return { kind: "invalid", text: "A condition of the maximum principle fails: see loiter plan --certify." };
  return { kind: "valid", text: validText(certificate, scene) };
}

/** @param {Certificate} certificate @param {Scene} scene */
function validText({ residuals, proved_optimal, runner_up, margin_s }, scene) {
  const count = residuals.filter(({ verdict }) => verdict === "holds").length;
  const meaning = proved_optimal
    ? `In still air it is proved that nothing is faster${scene.orbit.turn === "either" ? "" : " in this direction"}.`
    : scene.slot
      ? "An independent method finds no earlier arrival."
      : "They are necessary conditions, not a proof of optimality.";
  const hasRunnerUp = runner_up !== null && margin_s !== null;
  const margin = hasRunnerUp ? ` Runner-up ${runner_up}, ${timeDifference(margin_s, scene)} later.` : "";
  return `All ${count} conditions hold. ${meaning}${margin}`;
}
