// Replay of recordings: every kind of file, scrubbing, steps, loops, series, comparison, runs of estimators, and a
// recording of the running system.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { PHONE, wrong } from './axe.mjs';
import { open, periplus, port, PROGRAM, ROOT, sim, until } from './lib.mjs';

const PORT = port(8831);
const KBOT = 'robots/kbot/urdf/kbot.urdf.xacro';
const SCAN = '/kbot/sensor_laser/scan';
const CARMEN = join(ROOT, '../shared/datasets/intel/raw.clf');

/** Runs the program to its end. */
function run(...args) {
  const done = spawnSync(PROGRAM, args, { cwd: ROOT, encoding: 'utf8' });
  assert.equal(done.status, 0, `periplus ${args.join(' ')}: ${done.stdout}${done.stderr}`);
}

/** Time of the message that a topic has at the time that is shown, relative to that time [s]. */
const shownAge = (page, topic) =>
  page.evaluate(
    (name) =>
      new Promise((resolve, reject) => {
        const app = window.periplus;
        setTimeout(() => reject(new Error(`no message on ${name}`)), 8000);
        const leave = app.feed.subscribe(name, (_message, _topic, _bytes, timeS) => {
          queueMicrotask(() => leave());
          resolve(timeS - app.replay.timeS);
        });
      }),
    topic,
  );

const show = (page, offsetS) =>
  page.evaluate((s) => window.periplus.replay.show(window.periplus.replay.startS + s), offsetS);
const position = (page) => page.evaluate('periplus.replay.source.playhead.positionNs / 1e9');
const slider = (page) => page.getByRole('slider', { name: 'Time in the recording' });

async function view(chrome, url, files, test) {
  const server = await periplus(
    ['view', ...files, '--no-browser', `--page=127.0.0.1:${PORT}`],
    PORT,
  );
  const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
  try {
    await until(page, 'periplus.replay', 'a replay');
    await until(page, 'periplus.replay.source.playhead.endNs > 1e9', 'a duration');
    await test(page);
    assert.deepEqual(complaints, []);
  } finally {
    await page.close();
    await server.stop();
  }
}

/** The state at some times is that of these times, in every kind of file. */
async function jumps(page, topic, periodS, parts = [0.5, 0.9, 0.3]) {
  const endS = await page.evaluate('periplus.replay.endS - periplus.replay.startS');
  for (const part of parts) {
    await show(page, part * endS);
    const age = await shownAge(page, topic);
    assert.ok(age <= 1e-6 && age > -periodS, `${topic} is ${age} s from the time that is shown`);
  }
}

export async function replay(chrome, url, out, attempt) {
  if (!attempt.isWanted('replay')) return;
  const folder = join(out, 'replay');
  mkdirSync(folder, { recursive: true });
  const mcap = join(folder, 'run.mcap');
  run(
    ...['sim', 'worlds/closed_room.world', '--robot', KBOT, '--slam', '--duration', '12'],
    ...['--cmd', 'worlds/drives/circle.yaml', '--ros2', 'off', '--record', mcap],
  );

  const [db3, bag] = [join(folder, 'run_db3.db3'), join(folder, 'run.bag')];
  for (const file of [db3, bag]) run('bag', 'convert', mcap, '--output', file);

  await attempt('replay mcap', () =>
    view(chrome, url, [mcap], async (page) => {
      await jumps(page, SCAN, 0.2);
      await until(
        page,
        'periplus.displays.some((d) => d.kind.title === "LaserScan" && d.statuses.Points)',
        'a scan is drawn',
      );
      // By keyboard: to the end, back, to the start.
      const track = slider(page);
      await track.focus();
      await page.keyboard.press('End');
      await until(page, 'periplus.replay.positionNs === periplus.replay.endNs', 'the end');
      await page.keyboard.press('PageDown');
      await until(page, 'periplus.replay.positionNs < periplus.replay.endNs', 'before the end');
      await page.keyboard.press('Home');
      await until(page, 'periplus.replay.positionNs === periplus.replay.startNs', 'the start');
      // By the pointer: the playhead is where it was released.
      const box = await track.boundingBox();
      await page.mouse.move(box.x + 10, box.y + box.height / 2);
      await page.mouse.down();
      await page.mouse.move(box.x + box.width * 0.75, box.y + box.height / 2, { steps: 20 });
      await page.mouse.up();
      const endS = await page.evaluate('periplus.replay.endNs / 1e9');
      assert.ok(Math.abs((await position(page)) - 0.75 * endS) < 0.02 * endS, 'scrubbed');
      await until(page, '!periplus.replay.source.isJumping', 'the state is shown');
      const age = await shownAge(page, SCAN);
      assert.ok(age <= 0 && age > -0.2, `after scrubbing the scan is ${age} s away`);
      // Step by the messages of a topic.
      await page.getByLabel('Step by the messages of').selectOption(SCAN);
      const before = await position(page);
      await track.focus();
      await page.keyboard.press('.');
      await until(page, `periplus.replay.positionNs / 1e9 > ${before}`, 'a step');
      const after = await position(page);
      assert.ok(after - before < 0.2, `a step of ${after - before} s`);
      assert.ok(Math.abs(await shownAge(page, SCAN)) < 1e-6, 'at a message');
      await page.keyboard.press(',');
      await until(page, `periplus.replay.positionNs / 1e9 < ${after}`, 'a step back');
      // A loop of two seconds, four times as fast: after a while it is still inside.
      await show(page, 4);
      await page.getByRole('button', { name: 'Loop from here' }).click();
      await show(page, 6);
      await page.getByRole('button', { name: 'Loop up to here' }).click();
      await page.getByLabel('Rate of playing').selectOption('5');
      await show(page, 4.1);
      await page.evaluate(() => {
        window.seen = { low: Infinity, high: -Infinity, backs: 0, last: 0 };
        window.timer = setInterval(() => {
          const now = window.periplus.replay.source.playhead.positionNs / 1e9;
          const { seen } = window;
          seen.low = Math.min(seen.low, now);
          seen.high = Math.max(seen.high, now);
          if (now < seen.last) seen.backs++;
          seen.last = now;
        }, 20);
      });
      await track.press(' ');
      await until(page, 'seen.backs >= 2', 'two rounds of the loop');
      const seen = await page.evaluate(() => {
        clearInterval(window.timer);
        return window.seen;
      });
      assert.ok(seen.low >= 3.999 && seen.high <= 6.001, JSON.stringify(seen));
      await track.press(' ');
      await until(page, '!periplus.replay.isPlaying', 'paused');
      // Numbers over the whole recording.
      const series = await page.evaluate(async () => {
        const { replay } = window.periplus;
        const path = 'pose.pose.position.x';
        const name = '/kbot/base_controller/odom';
        return replay.series(name, [path], replay.startS, replay.endS, 200);
      });
      assert.ok(series.timesS.length > 20, `${series.timesS.length} points`);
      assert.equal(series.values[0].length, series.timesS.length);
      assert.ok(Math.max(...series.values[0]) > 0.1, 'the robot moves');
      // Messages per topic.
      await until(
        page,
        '[...(periplus.replay.rows[0].density.values())].some((all) => Math.max(...all) > 0)',
        'counts of messages',
      );
    }),
  );

  for (const [name, file] of [
    ['rosbag2', db3],
    ['ros1', bag],
  ]) {
    await attempt(`replay ${name}`, () =>
      view(chrome, url, [file], (page) => jumps(page, SCAN, 0.2)),
    );
  }
  await attempt('replay carmen', async () => {
    if (!existsSync(CARMEN)) {
      console.log(`SKIPPED: ${CARMEN} does not exist`);
      return;
    }
    await view(chrome, url, [CARMEN], (page) => jumps(page, '/scan', 10));
  });

  await attempt('replay upload', () =>
    view(chrome, url, [mcap], async (page) => {
      await page.getByRole('tab', { name: 'Recordings' }).click();
      // A file that is no recording is refused with the reason.
      const input = page.getByTestId('recording-file');
      const note = { name: 'notes.txt', mimeType: 'text/plain', buffer: Buffer.from('hello') };
      await input.setInputFiles(note);
      await page.getByText('notes.txt is not a recording').waitFor();
      await input.setInputFiles(bag);
      await until(
        page,
        'periplus.replay.source.tracks[0].recording.kind === "ros1"',
        'the uploaded recording is open',
      );
      await jumps(page, SCAN, 0.2);
    }),
  );

  await attempt('replay two', () =>
    view(chrome, url, [mcap, bag], async (page) => {
      await until(page, 'periplus.replay.source.tracks.length === 2', 'two recordings');
      await show(page, 6);
      await until(page, 'periplus.frames.includes("B:base_footprint")', 'frames of the second');
      await until(
        page,
        'periplus.tf.lookup("map", "B:base_footprint").kind === "found"',
        'tied frames',
      );
      // The same drive twice: the robots stand in one another.
      const apart = await page.evaluate(() => {
        const [a, b] = ['base_footprint', 'B:base_footprint'].map(
          (name) => window.periplus.tf.lookup('map', name).pose.t,
        );
        return Math.hypot(a[0] - b[0], a[1] - b[1]);
      });
      assert.ok(apart < 0.02, `the robots are ${apart} m apart`);
      await until(
        page,
        'periplus.displays.some((d) => d.values.Topic === "B:/map" && d.statuses.Topic?.level === "ok")',
        'the map of the second',
      );
      await page.getByRole('tab', { name: 'Comparison' }).click();
      await page.getByRole('button', { name: 'Show both trajectories' }).click();
      await until(
        page,
        'periplus.replay.comparison.trajectories?.state === "ready"',
        'both trajectories',
      );
      const { difference } = await page.evaluate('periplus.replay.comparison.trajectories');
      assert.ok(difference.count > 20 && difference.rmsM < 0.01, JSON.stringify(difference));
      await page.getByRole('button', { name: 'Difference of the maps' }).click();
      await until(
        page,
        'periplus.displays.some((d) => /0 only in the first, 0 only in the second/.test(d.statuses.Cells?.text))',
        'equal maps',
      );
      // A transform between the maps moves one against the other.
      await page.getByLabel('x [m]').fill('1');
      await page.getByLabel('x [m]').press('Enter');
      await until(
        page,
        'Math.abs(periplus.replay.comparison.trajectories.difference.rmsM - 1) < 0.02',
        'a metre apart',
      );
      await page.getByRole('combobox', { name: /^Show/ }).selectOption('sideBySide');
      await until(
        page,
        'periplus.viewports.length === 2 && periplus.viewports[1].fixedFrame === "B:map"',
        'two views',
      );
      await until(
        page,
        'periplus.viewports[1].displays.some((d) => d.values.Topic === "B:/map")',
        'the second recording in the second view',
      );
      const first = await page.evaluate(() =>
        window.periplus.viewports[0].displays.map((d) => d.values.Topic ?? ''),
      );
      const others = first.filter((name) => name.startsWith('B:') && !/trajectory/.test(name));
      assert.deepEqual(others, [], 'only the first recording in the first view');
      // The cameras are linked.
      await page.evaluate('periplus.viewports[0].setView({ distance: 7.5 })');
      await until(page, 'periplus.viewports[1].view.distance === 7.5', 'linked cameras');
    }),
  );

  for (const [name, options] of [
    ['dark', {}],
    ['light', { colorScheme: 'light' }],
    ['phone', PHONE],
  ]) {
    await attempt(`replay axe ${name}`, () =>
      view(
        chrome,
        url,
        [mcap, bag],
        async (page) => {
          await until(page, 'periplus.replay.source.tracks.length === 2', 'two recordings');
          await show(page, 6);
          await page.evaluate(() => window.periplus.replay.setLoop({ fromNs: 2e9, toNs: 8e9 }));
          await page.getByRole('button', { name: 'Messages per topic' }).click();
          const found = await wrong(page, 'timeline');
          if (name !== 'phone') {
            for (const tab of ['Recordings', 'Marks', 'Comparison', 'Run again']) {
              await page.getByRole('tab', { name: tab }).click();
              await page.waitForTimeout(300);
              found.push(...(await wrong(page, tab)));
            }
          } else {
            // Nothing of the timeline is outside of the screen, except in rows that scroll.
            const cut = await page.evaluate(
              () =>
                [...document.querySelectorAll('.timeline .bar > *, .timeline .scale')]
                  .map((part) => part.getBoundingClientRect())
                  .filter((box) => box.right > innerWidth + 1 || box.left < -1).length,
            );
            assert.equal(cut, 0, 'parts of the timeline are cut');
          }
          assert.deepEqual(found, []);
        },
        options,
      ),
    );
  }

  await attempt('replay recorded', async () => {
    const server = await periplus(
      sim(join(ROOT, 'worlds/closed_room.world'), join(ROOT, KBOT), `--page=127.0.0.1:${PORT}`),
      PORT,
      {},
      // The recording is written here.
      folder,
    );
    const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
    try {
      await until(page, 'periplus.recordings.isServed', 'recordings');
      await page.getByRole('tab', { name: 'Recordings' }).click();
      await page.getByRole('button', { name: 'Record', exact: true }).click();
      await until(page, 'periplus.recordings.isRecording', 'recording');
      await page.waitForTimeout(3000);
      await page.getByRole('button', { name: 'Stop recording' }).click();
      await until(page, 'periplus.recordings.list.some((r) => r.state === "ready")', 'a recording');
      await page.getByRole('button', { name: /^Play / }).click();
      await until(page, 'periplus.replay', 'a replay');
      await until(page, '!periplus.replay.source.isJumping', 'its state');
      // It begins where it was started, not at the times of the latched messages.
      await until(page, 'periplus.replay.rows[0].density.size > 0', 'counts of messages');
      await until(page, '!periplus.replay.source.isJumping', 'its state');
      const age = await shownAge(page, SCAN);
      assert.ok(age <= 1e-6 && age > -0.2, `${SCAN} is ${age} s from the time at the opening`);
      await jumps(page, SCAN, 0.2, [0.98, 0.9]);
      // The running system is there again afterwards.
      await page.getByRole('button', { name: 'Back to live' }).first().click();
      await until(page, '!periplus.replay && periplus.worldName', 'the running system');
      const before = await page.evaluate('periplus.clock.nowS');
      await until(page, `periplus.clock.nowS > ${before} + 0.2`, 'its time goes on');
      assert.deepEqual(complaints, []);
    } finally {
      await page.close();
      await server.stop();
    }
  });

  await attempt('replay rerun', () =>
    view(chrome, url, [mcap], async (page) => {
      await page.getByRole('tab', { name: 'Run again' }).click();
      const field = page.getByLabel(/^resolution/);
      await field.fill('0.1');
      await field.press('Tab');
      await page.getByRole('button', { name: 'Run', exact: true }).click();
      await until(page, 'periplus.replay.source.tracks.length === 2', 'the result', 120_000);
      await show(page, 11);
      await until(
        page,
        'periplus.displays.some((d) => d.values.Topic === "B:/map" && d.values.Resolution === 0.1)',
        'a map with the changed resolution',
      );
    }),
  );
}
