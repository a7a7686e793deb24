// @ts-check
/**
 * A plan that is awaited for longer than a moment: the page says so, and shows the previous plan faintly, so that an old
 * path is not taken for that of the scene.
 *
 * @typedef {import("../state/store.js").Store} Store
 * @typedef {import("../state/page_state.js").PageState} PageState
 */
import { byId, show } from "../shared/dom.js";

const MOMENT_MS = 120; // a shorter wait is not seen as one

/** Keep `isLate` up to date. @param {Store} store */
export function watchDelay(store) {
  let timer = 0;
  let answered = 0;
  store.watch(
    ({ revision, answeredRevision }) => [revision, answeredRevision],
    ({ revision, answeredRevision, isLate }) => {
      // During a drag answers arrive all the time, each for a move a moment ago.
      if (answeredRevision !== answered || answeredRevision === revision) {
        clearTimeout(timer);
        timer = 0;
        answered = answeredRevision;
        if (isLate) store.update({ isLate: false });
      }
      if (answeredRevision === revision || timer !== 0) return;
      timer = window.setTimeout(() => store.update({ isLate: true }), MOMENT_MS);
    },
  );
}

/** @param {Store} store */
export function lateView(store) {
  const note = byId("late", HTMLElement);
  store.watch(
    ({ isLate, answer }) => [isLate, answer === null],
    ({ isLate, answer, failure }) => {
      byId("main", HTMLElement).classList.toggle("late", isLate);
      show(note, isLate && failure === null);
      const reason = "Waiting for the service.";
      note.textContent = answer ? `${reason} This is the previous plan.` : reason;
    },
  );
}
