// @ts-check
/**
 * What the user does, as changes of the state.
 *
 * @import {Store} from "./store.js"
 * @import {PageState} from "./page_state.js"
 * @import {Scene} from "../shared/types.js"
 * @import {Requests} from "../requests/requests.js"
 * @import {Latency} from "../requests/progress.js"
 * @typedef {ReturnType<typeof createActions>} Actions
 */
import { lapOf } from "../requests/answers.js";
import { NO_MESSAGE, durationOf, endOf } from "./page_state.js";
import { createStepper } from "./steps.js";

/** @param {Store} store @param {Requests} requests @param {Latency} latency */
export function createActions(store, requests, latency) {
  /** @param {Partial<PageState["playback"]>} changes */
  const setPlayback = (changes) => store.update({ playback: { ...store.get().playback, ...changes } });

  const continues = createStepper();
  /** The changes of the state that begin a step, unless an event continues the last one. @param {Event} [event] */
  function stepOf(event) {
    const { step, lastStep } = store.get();
    return continues(event) ? { step, lastStep } : { step: step + 1, lastStep: step + 1 };
  }

  return {
    /**
     * Change the scene, and request its plan.
     *
     * @param {Scene} scene
     * @param {Event} [event] that changed it
     * @param {Partial<PageState>} [more] that changes with it
     */
    changeScene(scene, event, more = {}) {
      if (event instanceof PointerEvent) latency.moved(event);
      requests.askPlan({ ...more, ...stepOf(event), scene, message: NO_MESSAGE });
    },

    /**
     * Open a scene from a link or a preset: show all of it, with the time at its start.
     *
     * @param {Partial<PageState> & {scene: Scene}} changes
     * @param {number[] | null} [span] the view in the link
     */
    openScene(changes, span = null) {
      const { revision, playback } = store.get();
      requests.askPlan({
        ...stepOf(),
        ...changes,
        ...{ answer: null, leg: null }, // of another scene
        message: NO_MESSAGE,
        opening: { revision: revision + 1, span },
        playback: { ...playback, playing: false, time_s: 0 },
      });
    },

    /**
     * Show the state before a step, or after it.
     *
     * @param {Partial<PageState> & {scene: Scene, step: number}} changes
     */
    returnTo(changes) {
      const { playback, camera, lastStep, revision } = store.get();
      const { width, height } = camera.view;
      const { view, moved } = changes.camera ?? camera;
      const isResized = view.width !== width || view.height !== height;
      requests.askPlan({
        ...changes,
        camera: { view: { ...view, width, height }, moved },
        lastStep: Math.max(lastStep, changes.step),
        message: NO_MESSAGE,
        opening: !moved && isResized ? { revision: revision + 1, span: null } : null,
        playback: { ...playback, playing: false, time_s: 0 },
      });
    },

    /** Change the units, also those of the sentences that say why there is no plan. @param {PageState["units"]} units */
    changeUnits: (units) => (store.get().failure ? requests.askPlan({ units }) : store.update({ units })),

    /** Change the altitude of missions. @param {PageState["altitude"]} altitude @param {Event} [event] */
    changeAltitude: (altitude, event) => store.update({ ...stepOf(event), altitude }),

    /** @param {boolean} playing */
    play(playing) {
      const { time_s } = store.get().playback;
      const { scene, lap, clear } = store.get();
      if (playing && !lap && !scene.leg) store.update({ lap: clear?.maneuver ? clear.lap : lapOf(scene) });
      setPlayback({ playing, time_s: playing && time_s >= endOf(store.get()) ? 0 : time_s });
    },
    /** @param {number} time_s */
    seek: (time_s) => setPlayback({ time_s: Math.min(durationOf(store.get()), Math.max(0, time_s)) }),
    /** @param {number} speed times real time */
    setSpeed: (speed) => setPlayback({ speed }),
    /** @param {number | null} highlighted */
    highlight: (highlighted) => store.update({ highlighted }),
    /** @param {string} text @param {boolean} [bad] */
    say: (text, bad = false) => store.update({ message: { text, bad } }),
  };
}
