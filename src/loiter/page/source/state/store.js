// @ts-check
/**
 * The store holds the state of the page. A change replaces parts of the state; watchers draw what has changed.
 *
 * @import {PageState} from "./page_state.js"
 *
 * @typedef {object} Store
 * @property {() => PageState} get
 * @property {(changes: Partial<PageState>) => void} update
 * @property {(select: (state: PageState) => unknown[], react: (state: PageState) => void) => void} watch  call `react`
 *   now, and after each update that changes a selected value
 */

/** @param {PageState} initial @returns {Store} */
export function createStore(initial) {
  let state = initial;
  /** @type {(() => void)[]} */
  const watchers = [];
  return {
    get: () => state,
    update(changes) {
      state = { ...state, ...changes };
      for (const check of watchers) check();
    },
    watch(select, react) {
      let seen = select(state);
      watchers.push(() => {
        const selected = select(state);
        if (selected.every((value, i) => value === seen[i])) return;
        // First, because `react` may update the store.
        seen = selected;
        react(state);
      });
      react(state);
    },
  };
}
