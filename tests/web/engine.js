// Answers of the page's engine to scenes: reads [[scene, formats], ...] as JSON, writes a list of answers.
import { readFileSync } from "node:fs";

const { certificate, file, lap, plan, refusal } = await import(process.argv[2]);

function answer(compute) {
  try {
    return compute();
  } catch (error) {
    return { refusal: refusal(error) };
  }
}
const answers = JSON.parse(readFileSync(0, "utf-8")).map(([scene, formats]) => ({
  plan: answer(() => plan(scene)),
  certificate: answer(() => certificate(scene)),
  lap: answer(() => lap(scene)),
  files: Object.fromEntries(formats.map((format) => [format, answer(() => file(format, scene).content)])),
}));
process.stdout.write(JSON.stringify(answers));
