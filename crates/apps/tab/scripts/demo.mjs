// Runs the demo in WebAssembly, as `periplus demo --headless --bag-compression none` does, and writes its bag.
//
//   node demo.mjs MODULE.wasm SECONDS OUT.mcap [EXPECTED.mcap]
//
// Ends with 1 if the bag differs from the expected one.
import { readFileSync, writeFileSync } from "node:fs";
import { Core } from "./core.mjs";

const [module, seconds, out, expected] = process.argv.slice(2);
if (!out) {
  console.error("usage: node demo.mjs MODULE.wasm SECONDS OUT.mcap [EXPECTED.mcap]");
  process.exit(2);
}
const durationS = Number(seconds);
const core = await Core.start(readFileSync(module));
core.open({ demo: { headless: true, explore: true, duration_s: durationS, out: "/demo" } });
const start = performance.now();
core.stepUntil(BigInt(Math.round(durationS * 1e9)));
const wallS = (performance.now() - start) / 1000;
core.closeRecording();
const bag = core.readFile("/demo/demo.mcap");
writeFileSync(out, bag);
console.log(
  `${durationS} s simulated in ${wallS.toFixed(2)} s, ${(durationS / wallS).toFixed(1)} x real time, ` +
    `${(core.memoryBytes / 2 ** 20).toFixed(0)} MiB of memory; bag of ${bag.length} bytes`,
);
if (expected) {
  const other = readFileSync(expected);
  const length = Math.min(bag.length, other.length);
  let at = 0;
  while (at < length && bag[at] === other[at]) at += 1;
  if (at < length || bag.length !== other.length) {
    console.error(`the bags differ at byte ${at} (${bag.length} and ${other.length} bytes)`);
    process.exit(1);
  }
  console.log("the bag equals that of the native program byte for byte");
}
