// node run.mjs KERNEL FUNCTION WIDTH [REPEAT]: rows of so many doubles on the standard input, JSON lines of answers on the other.
import { readFileSync, writeSync } from "node:fs";
import { pathToFileURL } from "node:url";
import * as answers from "./answers.js";

const [path, name, width, repeat = "0"] = process.argv.slice(2);
const kernel = await import(pathToFileURL(path).href);
const input = readFileSync(0);
const numbers = new Float64Array(input.buffer.slice(input.byteOffset, input.byteOffset + input.byteLength));
const rows = Array.from({ length: numbers.length / +width }, (_, i) => [...numbers.subarray(i * +width, (i + 1) * +width)]);
for (let k = 0; k < +repeat; k++) {
  const begin = process.cpuUsage();
  for (const row of rows) answers[name](kernel, row);
  const { user, system } = process.cpuUsage(begin);
  console.error(`${((user + system) / rows.length).toFixed(2)} us`);
}
for (const row of rows) {
  const before = [...(kernel.calls ?? [])];
  const found = answers[name](kernel, row);
  const counts = (kernel.calls ?? []).map((count, i) => count - before[i]);
  const packed = Float64Array.from([found.length + counts.length, ...found, ...counts]);
  writeSync(1, new Uint8Array(packed.buffer));
}
