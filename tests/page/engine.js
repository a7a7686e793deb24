// Answers of the page's engine to scenes: reads [[scene, formats, fence], ...] as JSON, writes a list of answers.
// With `scene.leg` the leg is answered too, with its files. With a fence its check is answered too and, where the plan is not clear and `fence.search` is true, the clear entry.
import { readFileSync } from "node:fs";

const { certificate, clearEntry, fenceCheck, file, lap, legPlan, plan, refusal, slotPose } = await import(process.argv[2]);

function answer(compute) {
  try {
    return compute();
  } catch (error) {
    return { refusal: refusal(error) };
  }
}
/** Where the slot of a scene is when its plan ends. */
function atJoin(scene) {
  const { turn, duration_s } = plan(scene);
  return slotPose(scene, turn, duration_s);
}
function ofFence(scene, isSearched) {
  const check = answer(() => fenceCheck(scene));
  return isSearched && check.clear === false ? { check, clear: answer(() => clearEntry(scene)) } : { check };
}
const LEG_FORMATS = ["kml", "plan", "waypoints"];
const ofLeg = (scene) => ({
  leg: answer(() => legPlan(scene)),
  legFiles: Object.fromEntries(LEG_FORMATS.map((format) => [format, answer(() => file(format, scene).content)])),
});
const answers = JSON.parse(readFileSync(0, "utf-8")).map(([scene, formats, fence]) => ({
  ...(fence ? ofFence({ ...scene, fence }, fence.search) : {}),
  ...(scene.leg ? ofLeg(scene) : {}),
  plan: answer(() => plan(scene)),
  ...(scene.slot ? { slotPose: answer(() => atJoin(scene)) } : {}),
  certificate: scene.uncertified ? null : answer(() => certificate(scene)),
  lap: answer(() => lap(scene)),
  files: Object.fromEntries(formats.map((format) => [format, answer(() => file(format, scene).content)])),
}));
process.stdout.write(JSON.stringify(answers));
