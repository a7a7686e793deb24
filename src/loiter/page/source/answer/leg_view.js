// @ts-check
/**
 * What the page says of a leg: its numbers in place of those of the entry.
 *
 * @import {Store} from "../state/store.js"
 * @import {PageState} from "../state/page_state.js"
 * @import {LegPlan} from "../shared/types.js"
 */
import { byId, fill, part, show } from "../shared/dom.js";
import { DIRECTIONS, wordLabel } from "../shared/maneuver.js";
import { fixed, timeText } from "../shared/units.js";
import { bankText } from "./facts.js";

/** @param {Store} store */
export function legView(store) {
  const list = byId("leg-facts", HTMLElement);
  store.watch(
    ({ leg, scene }) => [leg, scene.leg === null],
    (state) => {
      const { leg, scene } = state;
      show(list, scene.leg !== null);
      show(byId("entry-facts", HTMLElement), scene.leg === null);
      show(byId("entries-note", HTMLElement), scene.leg !== null);
      if (leg) fill(list, factsOf(leg, state));
    },
  );
}

/** @param {LegPlan} leg @param {PageState} state */
function factsOf({ maneuver, duration_s, join_s, held_s, held_deg, exit_s }, { scene }) {
  /** @type {[string, (string | ReturnType<typeof part>)[], string][]} */
  const facts = [
    ["Time at the point", [timeText(duration_s, scene)], ""],
    ["Leave", [timeText(exit_s, scene)], ""],
    ["Hold", [timeText(held_s, scene)], `${fixed(held_deg / 360, 2)} turns`],
    ["Join", [timeText(join_s, scene)], ""],
    ["Word", [wordLabel(maneuver.word)], DIRECTIONS[maneuver.turn]],
    ["Bank to hold", [bankText(maneuver)], ""],
  ];
  return facts.map(([name, value, note]) =>
    part("div", {}, [part("dt", {}, [name]), part("dd", {}, [...value, ...(note ? [part("small", {}, [note])] : [])])]),
  );
}
