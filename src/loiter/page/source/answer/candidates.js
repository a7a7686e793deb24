// @ts-check
/**
 * The list of candidates: the optimal maneuvers, then the others with how much later they join.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {Actions} from "../state/actions.js"
 * @import {Maneuver, Scene} from "../shared/types.js"
 */
import { byId, fill, part, watchPointed } from "../shared/dom.js";
import { DIRECTIONS, DIRECTION_ARROWS, isAllowed, splitAnswer, wordLabel } from "../shared/maneuver.js";
import { roving } from "../shared/roving.js";
import { signedTimeDifference, timeText } from "../shared/units.js";

/** @param {Store} store @param {Actions} actions */
export function candidatesView(store, actions) {
  const list = byId("candidates", HTMLElement);
  const markStop = roving(list);
  watchPointed(list, "button", actions.highlight);
  store.watch(
    ({ answer }) => [answer],
    (state) => {
      fill(list, rowsOf(state));
      markStop();
    },
  );
  store.watch(
    ({ highlighted, answer }) => [highlighted, answer],
    ({ highlighted }) =>
      list.querySelectorAll("button").forEach((button, i) => button.classList.toggle("lit", i === highlighted)),
  );
}

/** @param {PageState} state */
function rowsOf({ answer, scene }) {
  if (!answer || scene.leg) return [];
  const { best, others } = splitAnswer(answer);
  return [
    ...best.map((maneuver) => {
      const row = part("span", { class: "row" }, cells(maneuver, scene, "optimal"));
      return part("li", { class: "best" }, [row]);
    }),
    ...others.map((other) => {
      const later = signedTimeDifference(other.later_s, scene);
      const button = part("button", { type: "button", class: "row", tabindex: -1 }, cells(other, scene, later));
      return part("li", { class: isAllowed(scene, other) ? "" : "disallowed" }, [button]);
    }),
  ];
}

/** @param {Maneuver} maneuver @param {Scene} scene @param {string} later */
function cells({ word, turn, duration_s }, scene, later) {
  return [
    wordLabel(word),
    part("span", { title: DIRECTIONS[turn] }, [
      part("span", { "aria-hidden": "true" }, [DIRECTION_ARROWS[turn]]),
      part("span", { class: "sr" }, [DIRECTIONS[turn]]),
    ]),
    part("span", { class: "duration" }, [timeText(duration_s, scene)]),
    part("span", { class: "later" }, [later]),
  ];
}
