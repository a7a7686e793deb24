// @ts-check
/**
 * The one seam between the page and the library: answers to scenes, computed here, and refusals with one sentence.
 *
 * @import {Altitude, Scene} from "../shared/types.js"
 * @typedef {Parameters<typeof engine.synthesis>[0]} MapQuery
 */
import * as engine from "../kernel/engine.js";

/** A refusal, with the sentence of the library. */
export class Problem extends Error {
  /** @param {ReturnType<typeof engine.refusal>} refusal */
  constructor({ sentence, kind, places, fitted_radius_m }) {
    super(sentence);
    this.kind = kind; // "radius-too-small"
    this.places = places; // the parts of the scene that it refuses: "aircraft/airspeed_m_s"
    this.fittedRadius_m = fitted_radius_m; // the least radius that can be held, if the circle is too small
  }
}

/**
 * An answer of the library; throws a `Problem` where it refuses.
 *
 * @template T
 * @param {() => T} compute
 */
function answer(compute) {
  try {
    return compute();
  } catch (error) {
    throw new Problem(engine.refusal(error));
  }
}

/** The plan of a scene, with every other candidate. @param {Scene} scene */
export const planOf = (scene) => answer(() => engine.plan(scene));

/** The way in, round and out of a scene with a leg. @param {Scene} scene */
export const legOf = (scene) => answer(() => engine.legPlan(scene));

/** A round of the circle after the plan: a track. @param {Scene} scene */
export const lapOf = (scene) => answer(() => engine.lap(scene));

/** The certificate of the plan. @param {Scene} scene */
export const certificateOf = (scene) => answer(() => engine.certificate(scene));

/** The map of the reduced plane, computed in small steps, so that the page stays quick. @param {MapQuery} query */
export const mapOf = (query) => engine.synthesis(query);

/** Where the slot of a scene is at a time. @param {Parameters<typeof engine.slotPose>} question */
export const slotPoseOf = (...question) => engine.slotPose(...question);

/** Whether the plan of a scene stays clear of its fence. @param {Scene} scene */
export const fenceCheckOf = (scene) => answer(() => engine.fenceCheck(scene));

/** A file of the plan. @param {string} format @param {Scene & Altitude} options */
export async function fileOf(format, options) {
  if (format === "png") return pngOf(answer(() => engine.file("svg", options)));
  const { content, type } = answer(() => engine.file(format, options));
  return new Blob([content], { type });
}

const SHARPNESS = 3; // pixels of a picture for each of its drawing

/** A drawing as pixels. @param {{content: string, type: string}} drawing @returns {Promise<Blob>} */
async function pngOf({ content, type }) {
  const picture = new Image();
  picture.src = `data:${type};utf8,${encodeURIComponent(content)}`;
  await picture.decode();
  const { width, height } = picture;
  const canvas = Object.assign(document.createElement("canvas"), { width: SHARPNESS * width, height: SHARPNESS * height });
  canvas.getContext("2d")?.drawImage(picture, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("The browser draws no PNG.")))),
  );
}
