// @ts-check
/** The worker that searches for clear entries: each message is a scene, each reply its answer or a sentence. */
import * as engine from "../kernel/engine.js";

addEventListener("message", ({ data }) => {
  try {
    postMessage({ answer: engine.clearEntry(data) });
  } catch (error) {
    postMessage({ sentence: engine.refusal(error).sentence });
  }
});
