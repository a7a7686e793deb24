// @ts-check
/**
 * The list of candidates: the optimal maneuvers, then the others with how much later they join.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/page_state.js").PageState} PageState
 * @typedef {import("../state/actions.js").Actions} Actions
 * @typedef {import("../shared/types.js").Maneuver} Maneuver
 * @typedef {import("../shared/types.js").Scene} Scene
 */
import { byId, html } from "../shared/dom.js";
import { DIRECTIONS, DIRECTION_ARROWS, isAllowed, splitAnswer, wordLabel } from "../shared/maneuver.js";
import { roving } from "../shared/roving.js";
import { signedTimeDifference, timeText } from "../shared/units.js";

/** @param {Store} store @param {Actions} actions */
export function candidatesView(store, actions) {
  const list = byId("candidates", HTMLElement);
  const markStop = roving(list);
  store.watch(
    ({ answer }) => [answer],
    (state) => {
      list.replaceChildren(...rowsOf(state, actions.highlight));
      markStop();
    },
  );
  store.watch(
    ({ highlighted, answer }) => [highlighted, answer],
    ({ highlighted }) =>
      list.querySelectorAll("button").forEach((button, i) => button.classList.toggle("lit", i === highlighted)),
  );
}

/** @param {PageState} state @param {(index: number | null) => void} highlight */
function rowsOf({ answer, scene }, highlight) {
  if (!answer) return [];
  const { best, others } = splitAnswer(answer);
  return [
    ...best.map((maneuver) => {
      const row = html("span", { class: "row" }, cells(maneuver, scene, "optimal"));
      return html("li", { class: "best" }, [row]);
    }),
    ...others.map((other, index) => {
      const later = signedTimeDifference(other.later_s, scene);
      const button = html("button", { type: "button", class: "row" }, cells(other, scene, later));
      for (const event of ["pointerenter", "focus"]) button.addEventListener(event, () => highlight(index));
      for (const event of ["pointerleave", "blur"]) button.addEventListener(event, () => highlight(null));
      return html("li", { class: isAllowed(scene, other) ? "" : "disallowed" }, [button]);
    }),
  ];
}

/** @param {Maneuver} maneuver @param {Scene} scene @param {string} later */
function cells({ word, turn, duration_s }, scene, later) {
  return [
    wordLabel(word),
    html("span", { title: DIRECTIONS[turn] }, [
      html("span", { "aria-hidden": "true" }, [DIRECTION_ARROWS[turn]]),
      html("span", { class: "sr" }, [DIRECTIONS[turn]]),
    ]),
    html("span", { class: "duration" }, [timeText(duration_s, scene)]),
    html("span", { class: "later" }, [later]),
  ];
}
