// Uses the installed package as a user does: its example, its types, its errors.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { Core } from "periplus-core";

const bytes = await readFile(new URL(import.meta.resolve("periplus-core/periplus.wasm")));

const core = await Core.start(bytes);
assert.throws(() => core.stepUntil(1n), Error, "there is no session yet");
core.open({ demo: { headless: true, explore: true, duration_s: 2, out: "/demo" } });
core.stepUntil(2_000_000_000n);
assert.equal(core.timeNs, 2_000_000_000n);
core.closeRecording();
const bag = core.readFile("/demo/demo.mcap");
// The magic of MCAP at both ends: the recording is complete.
const magic = [0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a];
assert.deepEqual([...bag.subarray(0, 8)], magic);
assert.deepEqual([...bag.subarray(-8)], magic);

// Every member of the class has a type.
const types = await readFile(new URL("core.d.mts", import.meta.resolve("periplus-core")), "utf8");
const members = Object.getOwnPropertyNames(Core.prototype).filter((name) => name !== "constructor");
for (const name of [...members, "start"]) {
  assert.match(types, new RegExp(`\\b${name}\\(`), `${name} has no type in core.d.mts`);
}
console.log(`the installed package simulated 2 s: ${bag.length} bytes recorded, ${members.length} members have types`);
