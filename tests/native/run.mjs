// node run.mjs KERNEL FUNCTION WIDTH: rows of so many doubles on the standard input; for each row the number of its
// answers, and these, as doubles on the standard output. Where the kernel counts calls, the counts follow the answers.
import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import * as answers from "./answers.js";

const [path, name, width] = process.argv.slice(2);
const kernel = await import(pathToFileURL(path).href);
const input = readFileSync(0);
const numbers = new Float64Array(input.buffer.slice(input.byteOffset, input.byteOffset + input.byteLength));
const said = [];
for (let i = 0; i < numbers.length; i += +width) {
  const before = [...(kernel.calls ?? [])];
  const found = answers[name](kernel, [...numbers.subarray(i, i + +width)]);
  const counts = before.map((count, k) => kernel.calls[k] - count);
  said.push(found.length + counts.length, ...found, ...counts);
}
writeFileSync(1, new Uint8Array(Float64Array.from(said).buffer));
