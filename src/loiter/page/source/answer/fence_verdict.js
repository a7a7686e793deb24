// @ts-check
/**
 * What the page says about the fence: whether the plan stays clear, where it enters and how deep, and the fastest clear
 * entry.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 */
import { zonesOf } from "../scene/fence.js";
import { byId, setText, show } from "../shared/dom.js";
import { sentenceIn, timeDifference } from "../shared/units.js";

/** @param {Store} store */
export function fenceVerdict(store) {
  const line = byId("fence-verdict", HTMLElement);
  store.watch(
    ({ scene, fence, clear, requests, failure, units }) => [scene.fence, fence, clear, requests.clear, failure, units],
    (state) => {
      show(line, zonesOf(state.scene).length > 0 && !state.failure);
      setText(line, fenceText(state));
      line.className = state.fence?.check?.clear ? "clear" : state.clear?.maneuver ? "round" : "blocked";
    },
  );
}

/** @param {PageState} state */
export function fenceText({ fence, clear, leg, requests, units, scene }) {
  if (!fence) return "";
  if (!fence.check) return fence.refusal;
  const checked = sentenceIn(fence.check.sentence, units);
  if (fence.check.clear) return checked;
  if (leg) return `${checked} Another way round is not searched for a leg.`;
  if (fence.refusal) return `${checked} ${fence.refusal}`;
  if (scene.slot) return `${checked} No clear entry is looked for into a slot.`;
  if (!clear) return `${checked}${requests.clear === "idle" ? "" : " Looking for a clear entry …"}`;
  if (!clear.maneuver) return `${checked} ${clear.sentence}`;
  const later = `joins ${timeDifference(clear.later_s ?? 0, scene)} later`;
  return `${checked} The fastest clear entry found, drawn here, ${later}.`;
}
