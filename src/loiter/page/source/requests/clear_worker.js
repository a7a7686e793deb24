// @ts-check
/** The worker for what takes long: each message is a scene and what is asked of it, each reply the answer or a sentence. */
import * as engine from "../kernel/engine.js";

/** @type {Record<string, (scene: any) => unknown>} */
const ANSWERS = { clear: engine.clearEntry, certificate: engine.certificate };

addEventListener("message", ({ data: { asked, scene } }) => {
  try {
    postMessage({ answer: ANSWERS[asked](scene) });
  } catch (error) {
    postMessage({ sentence: engine.refusal(error).sentence });
  }
});
