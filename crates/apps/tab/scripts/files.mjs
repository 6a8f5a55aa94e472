// Runs sessions from files, checks, archives and mapping in WebAssembly, and compares them with the native program.
//
//   node files.mjs MODULE.wasm PERIPLUS ROOT OUT [LOG...]
//
// ROOT is the root of the repository, OUT a folder for results, LOG a CARMEN log to map besides a recording that is made
// here. Ends with 1 at the first difference.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { gzipSync } from "node:zlib";
import { Core } from "./core.mjs";

const [module, periplus, root, out, ...logs] = process.argv.slice(2);
if (!out) {
  console.error("usage: node files.mjs MODULE.wasm PERIPLUS ROOT OUT [LOG...]");
  process.exit(2);
}
const bytes = readFileSync(module);
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });

/** Runs the native program at the root of the repository. */
function native(args, { codes = [0] } = {}) {
  const environment = { ...process.env, NO_COLOR: "1" };
  const run = spawnSync(periplus, args, { cwd: root, env: environment, encoding: "utf8", maxBuffer: 1 << 28 });
  if (!codes.includes(run.status)) throw new Error(`periplus ${args.join(" ")}: ${run.status}\n${run.stderr}`);
  return run;
}

/** Files below a folder of the repository, as paths from its root. */
function filesBelow(folder) {
  return readdirSync(join(root, folder)).flatMap((name) => {
    const path = `${folder}/${name}`;
    return statSync(join(root, path)).isDirectory() ? filesBelow(path) : [path];
  });
}

/** A module with files of the repository at the same paths below `/`. */
async function coreWith(files) {
  const core = await Core.start(bytes);
  for (const file of files) core.writeFile(`/${file}`, readFileSync(join(root, file)));
  return core;
}

function same(name, got, expected) {
  const length = Math.min(got.length, expected.length);
  let at = 0;
  while (at < length && got[at] === expected[at]) at += 1;
  if (at < length || got.length !== expected.length) {
    throw new Error(`${name} differs at byte ${at} (${got.length} and ${expected.length} bytes)`);
  }
}

async function timed(name, work) {
  const start = performance.now();
  const note = await work();
  console.log(`${name}: ${((performance.now() - start) / 1000).toFixed(1)} s${note ? `; ${note}` : ""}`);
}

const all = [...filesBelow("robots"), ...filesBelow("worlds")];

await timed("findings as `periplus check` reports them", async () => {
  const core = await coreWith(all);
  const broken = "<robot name='cart'><link name='a'/><lnk name='b'/><joint name='j' type='fixd'/></robot>\n";
  core.writeFile("/target/broken.urdf", new TextEncoder().encode(broken));
  mkdirSync(join(root, "target"), { recursive: true });
  writeFileSync(join(root, "target/broken.urdf"), broken);
  const files = [
    "target/broken.urdf",
    "robots/sam_bot/urdf/sam_bot.urdf.xacro",
    "robots/sam_bot/config/nav2_params.yaml",
    "robots/kbot/meshes/laser.stl",
    "worlds/house.sdf",
    "worlds/closed_room.world",
  ];
  for (const file of files) {
    // Paths in the answer are those of the root of the repository, which is `/` in memory.
    const plain = (text) => text.replaceAll(`${root}/`, "/");
    const expected = JSON.parse(plain(native(["check", "--json", file], { codes: [0, 1] }).stdout));
    const answer = core.call("check", { files: [file] });
    assert.deepEqual(answer.report, expected, file);
    assert.equal(answer.text, plain(native(["check", file], { codes: [0, 1] }).stdout), file);
  }
  return `${files.length} files`;
});

await timed("packages from archives", async () => {
  const core = await Core.start(bytes);
  const tar = spawnSync("tar", ["-cf", "-", "-C", join(root, "robots"), "kbot"], { maxBuffer: 1 << 28 });
  if (tar.status !== 0) {
    console.log("SKIPPED: no tar to pack a package with");
    return "";
  }
  core.writeFile("/uploads/kbot.tar.gz", gzipSync(tar.stdout));
  const unpacked = core.call("unpack", { archive: "/uploads/kbot.tar.gz", folder: "/files" });
  assert.deepEqual(unpacked.left_out, []);
  assert.ok(unpacked.files.includes("/files/kbot/meshes/laser.stl"));
  const robot = { file: "/files/kbot/urdf/kbot.urdf.xacro", arguments: { laser_mesh: "true" } };
  core.open({ run: { robots: [robot] } });
  core.stepUntil(200_000_000n);
  assert.equal(core.timeNs, 200_000_000n);
  const messages = core.call("messages").text;
  assert.ok(!messages.includes("laser.stl"), messages);
  core.writeFile("/uploads/x.rar", new TextEncoder().encode("Rar!...."));
  assert.throws(() => core.call("unpack", { archive: "/uploads/x.rar", folder: "/files" }), /RAR archive/);
  assert.throws(() => core.open({ run: { robots: [{ file: "/files/none.urdf" }] } }), /none\.urdf/);
  return `${unpacked.files.length} files, ${unpacked.bytes} bytes`;
});

/** Runs the same session here and in the native program, and compares the bags. */
async function sameRun(name, seconds, args, options, topics) {
  const bag = join(out, `${name}.mcap`);
  const words = ["sim", ...args, "--duration", String(seconds)];
  native([...words, "--record", bag, "--bag-compression", "none", "--quiet"]);
  const core = await coreWith(all);
  // As the program records it: options that do not change the result are left out.
  const kept = words.filter((word, index) => word !== "--slam-out" && words[index - 1] !== "--slam-out");
  const command = ["periplus", ...kept].map((word) => (/[^\w./,:=-]/.test(word) ? `'${word}'` : word)).join(" ");
  core.open({ run: { ...options, headless: true, record: { file: `/${name}.mcap`, command, topics } } });
  const start = performance.now();
  core.stepUntil(BigInt(Math.round(seconds * 1e9)));
  const factor = seconds / ((performance.now() - start) / 1000);
  core.closeRecording();
  same(`the bag of ${name}`, core.readFile(`/${name}.mcap`), readFileSync(bag));
  return { core, note: `${statSync(bag).size} bytes, ${factor.toFixed(1)} x real time` };
}

await timed("pong: the bag of the native program", async () => (await sameRun("pong", 3, ["worlds/pong.sdf"], { world: "pong" })).note);

await timed("sam_bot in a room with SLAM and costmaps: the bag of the native program", async () => {
  const robot = "robots/sam_bot/urdf/sam_bot.urdf.xacro";
  const args = ["worlds/demo_room.sdf", "--robot", robot, "--pose", "0,0,0", "--cmd", "worlds/drives/circle.yaml"];
  // Without images and clouds, which are most of the bytes.
  const topics = ["/scan", "/map", "/tf", "/tf_static", "/demo/odom", "/local_costmap/costmap"];
  const nodes = ["--stack", "--slam-out", join(out, "sam_bot-map"), "--topics", `^(${topics.join("|")})$`];
  const options = {
    world: "worlds/demo_room.sdf",
    robots: [{ file: robot, pose: [0, 0, 0] }],
    cmd: "worlds/drives/circle.yaml",
    stack: true,
    slam: { out: "/results" },
  };
  const { core, note } = await sameRun("sam_bot", 6, [...args, ...nodes], options, topics);
  assert.equal(core.call("write_results").folder, "/results");
  for (const file of ["map.pgm", "map.yaml"]) {
    same(file, core.readFile(`/results/${file}`), readFileSync(join(out, "sam_bot-map", file)));
  }
  return note;
});

await timed("ready sessions", async () => {
  const { sessions } = JSON.parse(readFileSync(join(root, "crates/apps/tab/sessions/sessions.json"), "utf8"));
  for (const { name, files, options } of sessions) {
    const core = await coreWith(files);
    core.open(options);
    core.stepUntil(300_000_000n);
    assert.equal(core.timeNs, 300_000_000n, name);
  }
  return sessions.map((session) => session.name).join(", ");
});

const results = ["map.pgm", "map.yaml", "trajectory.txt", "trajectory.png", "map.session", "map.g2o"];

/** Maps a log here and in the native program, and compares the results. */
async function sameMap(log) {
  const name = basename(log);
  const folder = join(out, `${name}-map`);
  mkdirSync(folder, { recursive: true });
  const files = ["--save-session", join(folder, "map.session"), "--g2o", join(folder, "map.g2o")];
  const startNative = performance.now();
  native(["slam", log, "--out", folder, ...files, "--quiet"]);
  const nativeS = (performance.now() - startNative) / 1000;
  const core = await Core.start(bytes);
  core.writeFile(`/uploads/${name}`, readFileSync(log));
  const start = performance.now();
  const options = { session_out: "/map/map.session", g2o_out: "/map/map.g2o" };
  core.call("map_open", { log: `/uploads/${name}`, out: "/map", ...options });
  let progress = { fraction: 0 };
  let slices = 0;
  let previews = 0;
  do {
    const before = progress.fraction;
    progress = core.call("map_step", { budget_ms: 200 });
    assert.ok(progress.fraction >= before || progress.is_rebuilt, "progress does not go back");
    slices += 1;
    if (slices === 2) previews += core.callBytes("map_preview").length;
  } while (progress.phase !== "complete");
  const written = core.call("map_write");
  assert.equal(written.failure, null);
  const tabS = (performance.now() - start) / 1000;
  for (const file of results) same(`${file} of ${name}`, core.readFile(`/map/${file}`), readFileSync(join(folder, file)));
  const size = (statSync(log).size / 1e6).toFixed(1);
  return (
    `${size} MB in ${tabS.toFixed(2)} s, native ${nativeS.toFixed(2)} s: ${(tabS / nativeS).toFixed(2)} x; ` +
    `${slices} slices, preview of ${previews} bytes, ${(core.memoryBytes / 2 ** 20).toFixed(0)} MiB of memory`
  );
}

await timed("maps of a recording, equal to those of `periplus slam`", async () => {
  const bag = join(out, "sam_bot.mcap");
  const old = join(out, "sam_bot.bag");
  native(["bag", "convert", bag, "--output", old]);
  return `${await sameMap(bag)}\n  ROS 1: ${await sameMap(old)}`;
});

for (const log of logs) await timed(`the map of ${basename(log)}`, () => sameMap(log));

await timed("logs that are refused or cancelled", async () => {
  const core = await Core.start(bytes);
  core.writeFile("/uploads/a.db3", new TextEncoder().encode("SQLite format 3\0"));
  assert.throws(() => core.call("map_open", { log: "/uploads/a.db3", out: "/map" }), /databases of SQLite .* convert/s);
  assert.throws(() => core.call("map_open", { log: "/uploads/none.bag", out: "/map" }), /none\.bag/);
  core.writeFile("/uploads/a.mcap", readFileSync(join(out, "sam_bot.mcap")));
  core.call("map_open", { log: "/uploads/a.mcap", out: "/map" });
  core.call("map_step", { budget_ms: 0 });
  core.call("map_close");
  assert.throws(() => core.call("map_step", { budget_ms: 0 }), /no log is mapped/);
});
