// Input that other tests leave out: dropped files and folders, two fingers, handles of models and of interactive
// markers by pointer and by keys; and what displays and estimators show after a jump in a recording.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { wrong } from './axe.mjs';
import { open, periplus, port, PROGRAM, ROOT, sim, until } from './lib.mjs';

const PORT = port(8851);
const KBOT = 'robots/kbot/urdf/kbot.urdf.xacro';
const SAM_BOT = 'robots/sam_bot/urdf/sam_bot.urdf.xacro';

function run(...args) {
  const done = spawnSync(PROGRAM, args, { cwd: ROOT, encoding: 'utf8' });
  assert.equal(done.status, 0, `periplus ${args.join(' ')}: ${done.stdout}${done.stderr}`);
}

const show = (page, part) =>
  page.evaluate((p) => {
    const { replay } = window.periplus;
    return replay.show(replay.startS + p * (replay.endS - replay.startS));
  }, part);
const settled = (page) => until(page, '!periplus.replay.source.isJumping', 'the state is shown');

async function withServer(chrome, url, args, options, test) {
  const server = await periplus([...args, `--page=127.0.0.1:${PORT}`], PORT);
  const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`, options);
  try {
    await test(page);
    assert.deepEqual(complaints, []);
  } finally {
    await page.close();
    await server.stop();
  }
}
const view = (chrome, url, file, test, options = {}) =>
  withServer(chrome, url, ['view', file, '--no-browser'], options, async (page) => {
    await until(page, 'periplus.replay?.source.playhead.endNs > 1e9', 'a replay');
    await test(page);
  });

/** Drops files or folders of this machine on the page, as a file manager does. */
async function dropOn(page, ...files) {
  const session = await page.context().newCDPSession(page);
  const data = { items: [], files, dragOperationsMask: 1 };
  for (const type of ['dragEnter', 'dragOver', 'drop']) {
    await session.send('Input.dispatchDragEvent', { type, x: 500, y: 300, data });
  }
}

/** Moves fingers from one place to another. */
async function touch(page, from, to) {
  const session = await page.context().newCDPSession(page);
  const points = (part) =>
    from.map(([x, y], id) => ({
      x: x + (to[id][0] - x) * part,
      y: y + (to[id][1] - y) * part,
      id,
    }));
  const send = (type, touchPoints) =>
    session.send('Input.dispatchTouchEvent', { type, touchPoints });
  await send('touchStart', points(0));
  for (let i = 1; i <= 10; i++) {
    await send('touchMove', points(i / 10));
    await page.waitForTimeout(30);
  }
  await send('touchEnd', []);
  await page.waitForTimeout(100);
}

async function drag(page, from, to) {
  await page.mouse.move(...from);
  await page.mouse.down();
  for (let i = 1; i <= 8; i++) {
    const at = [0, 1].map((axis) => from[axis] + ((to[axis] - from[axis]) * i) / 8);
    await page.mouse.move(...at);
    await page.waitForTimeout(40);
  }
  await page.mouse.up();
  await page.waitForTimeout(300);
}

/** Position on the page of a point in the fixed frame. */
const pixel = (page, point) =>
  page.evaluate(([x, y, z]) => {
    const { view, renderer } = window.periplus.stage;
    const at = view.camera.position.clone().set(x, y, z).project(view.camera);
    const box = renderer.domElement.getBoundingClientRect();
    return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
  }, point);

/** Length of the handles of the selected model [m]. */
const handleLength = (page) =>
  page.evaluate(() => {
    let length = 0;
    window.periplus.stage.scene.traverse((one) => {
      if (one.geometry?.type === 'TorusGeometry')
        length = one.getWorldScale(one.position.clone()).x;
    });
    return length;
  });

/** A node's interactive marker with an arrow, a ring and a menu, published by the page itself. */
const offerMarker = (page) =>
  page.evaluate(() => {
    const zero = { x: 0, y: 0, z: 0 };
    const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: 'odom' };
    const control = (name, interaction_mode, orientation) => ({
      name,
      orientation,
      orientation_mode: 0,
      interaction_mode,
      always_visible: true,
      markers: [],
      independent_marker_orientation: false,
      description: name,
    });
    const marker = {
      header,
      pose: { position: { x: 2, y: 1, z: 0.5 }, orientation: { ...zero, w: 1 } },
      name: 'target',
      description: 'Target of the arm',
      scale: 1,
      menu_entries: [{ id: 7, parent_id: 0, title: 'Grasp', command: '', command_type: 0 }],
      controls: [
        control('move_x', 3, { ...zero, w: 1 }),
        control('rotate_z', 5, { x: 0, y: 1, z: 0, w: 1 }),
      ],
    };
    const type = 'visualization_msgs/msg/InteractiveMarkerUpdate';
    window.periplus.publish('/handles/update', type, {
      server_id: 'test',
      seq_num: 1,
      type: 1,
      markers: [marker],
      poses: [],
      erases: [],
    });
  });

const feedback = (page) => page.evaluate('window.received');
const markerPose = (page) =>
  page.evaluate(() => {
    const entry = window.periplus.displays.find((d) => d.name === 'handles');
    const { t, q } = entry.display.poseOf('target').pose;
    return { x: t[0], y: t[1], yaw: 2 * Math.atan2(q[2], q[3]) };
  });

export async function proof(chrome, url, out, attempt) {
  if (!attempt.isWanted('proof')) return;
  const folder = join(out, 'proof');
  mkdirSync(folder, { recursive: true });

  if (attempt.isWanted('proof')) {
    await attempt('proof: two fingers', () =>
      withServer(
        chrome,
        url,
        sim('worlds/cube_and_sphere.sdf', KBOT),
        { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true },
        async (page) => {
          await until(page, 'periplus.worldName && periplus.stage', 'a world');
          await page.evaluate(() =>
            window.periplus.setView({
              kind: 'Orbit',
              distance: 10,
              yaw: 0.5,
              pitch: 0.6,
              focal: [0, 0, 0],
            }),
          );
          const state = () =>
            page.evaluate(() => structuredClone(window.periplus.stage.view.state));
          const box = await page.locator('canvas').first().boundingBox();
          const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
          const before = await state();
          // Fingers move apart: nearer.
          await touch(page, [[x - 30, y], [x + 30, y]], [[x - 90, y], [x + 90, y]]); // prettier-ignore
          const near = await state();
          const ratio = before.distance / near.distance;
          assert.ok(ratio > 2.5 && ratio < 3.5, `three times as far apart, ${ratio} times nearer`);
          // Both in one direction: the scene moves, its size stays.
          await touch(page, [[x - 40, y], [x + 40, y]], [[x - 40, y + 60], [x + 40, y + 60]]); // prettier-ignore
          const moved = await state();
          assert.ok(Math.abs(moved.distance / near.distance - 1) < 0.05, 'the distance stays');
          assert.notDeepEqual(moved.focal, near.focal, 'the focal point moves');
          assert.ok(Math.abs(moved.yaw - near.yaw) < 1e-6, 'the view does not rotate');
          // One finger rotates.
          await touch(page, [[x, y]], [[x + 60, y]]);
          assert.ok(Math.abs((await state()).yaw - moved.yaw) > 0.1, 'the view rotates');
        },
      ),
    );

    await attempt('proof: handles of models', () =>
      withServer(chrome, url, sim('worlds/cube_and_sphere.sdf', KBOT), {}, async (page) => {
        await until(page, 'periplus.world()?.poseOf("cube")', 'a cube');
        await page.getByRole('tab', { name: 'World' }).click();
        await page.getByRole('option', { name: 'cube', exact: true }).click();
        const pose = () => page.evaluate(() => window.periplus.world().poseOf('cube'));
        const { t: at } = await pose();
        await page.evaluate(([px, py]) => {
          window.periplus.setView({ kind: 'TopDownOrtho', x: px, y: py, scale: 60, angle: 0 });
        }, at);
        await page.waitForTimeout(500);
        const length = await handleLength(page);
        assert.ok(length > 0, 'handles');
        const point = (dx, dy) => pixel(page, [at[0] + dx * length, at[1] + dy * length, at[2]]);
        // Along x, by the arrow: y stays, although the pointer leaves the axis.
        const to = [at[0] + 0.8 * length + 1, at[1] + 0.3, at[2]];
        await drag(page, await point(0.8, 0), await pixel(page, to));
        await until(
          page,
          `Math.abs(periplus.world().poseOf('cube').t[0] - ${at[0]} - 1) < 0.15`,
          'x',
        );
        const moved = await pose();
        assert.ok(Math.abs(moved.t[1] - at[1]) < 1e-3, `y was ${at[1]}, is ${moved.t[1]}`);
        // A quarter about z, by the ring.
        at[0] = moved.t[0];
        const c = 0.98 * Math.SQRT1_2;
        await drag(page, await point(c, c), await point(-c, c));
        await until(
          page,
          `(({ q }) => Math.abs(Math.abs(2 * Math.atan2(q[2], q[3])) - Math.PI / 2) < 0.2)(periplus.world().poseOf('cube'))`,
          'a quarter turn',
        );
        // Each is one step of undo.
        await page.locator('canvas').first().focus();
        for (let i = 0; i < 2; i++) await page.keyboard.press('Control+z');
        await until(
          page,
          `Math.abs(periplus.world().poseOf('cube').t[0] - ${moved.t[0] - 1}) < 0.2`,
          'undo',
        );
      }),
    );

    await attempt('proof: SDF of the clipboard', () =>
      withServer(chrome, url, sim('worlds/cube_and_sphere.sdf', KBOT), {}, async (page) => {
        await until(page, 'periplus.world()?.poseOf("cube")', 'a cube');
        await page.getByRole('tab', { name: 'World' }).click();
        const paste = (text) =>
          page.evaluate((sdf) => {
            const clipboardData = new DataTransfer();
            clipboardData.setData('text/plain', sdf);
            const event = { clipboardData, bubbles: true, cancelable: true };
            document.body.dispatchEvent(new ClipboardEvent('paste', event));
          }, text);
        const shape = '<geometry><box><size>1 1 1</size></box></geometry>';
        await paste(
          `<model name="cube"><pose>3 2 0.5 0 0 0</pose><static>1</static><link name="l"><collision name="c">${shape}</collision><visual name="v">${shape}</visual></link></model>`,
        );
        await until(page, 'periplus.world().poseOf("cube_0")', 'the pasted model');
        const { t: at } = await page.evaluate('periplus.world().poseOf("cube_0")');
        assert.deepEqual(
          at.map((value) => +value.toFixed(3)),
          [3, 2, 0.5],
        );
        await paste('<model name="half">');
        await page.getByText('no complete <model>').first().waitFor();
        await page.locator('canvas').first().focus();
        await page.keyboard.press('Control+z');
        await until(page, '!periplus.world().poseOf("cube_0")', 'undo');
      }),
    );

    await attempt('proof: handles of interactive markers', () =>
      withServer(
        chrome,
        url, // With slam_toolbox the types of interactive markers are known to the page.
        sim('worlds/cube_and_sphere.sdf', KBOT, '--slam'),
        {},
        async (page) => {
          await until(page, 'periplus.frames.includes("odom")', 'frames');
          await page.evaluate(() => {
            window.received = [];
            window.periplus.setFixedFrame?.('odom', true);
            window.periplus.active.add('rviz_default_plugins/InteractiveMarkers', 'handles', {
              'Interactive Markers Namespace': '/handles',
            });
            window.periplus.feed.subscribe('/handles/feedback', (message) =>
              window.received.push({
                control: message.control_name,
                event: message.event_type,
                entry: message.menu_entry_id,
                x: message.pose.position.x,
              }),
            );
          });
          await page.waitForTimeout(500);
          // The first message makes the topic, and is lost to the display.
          for (let i = 0; i < 20; i++) {
            await offerMarker(page);
            await page.waitForTimeout(300);
            const names = await page.evaluate(
              () =>
                window.periplus.displays.find((d) => d.name === 'handles').display.names().length,
            );
            if (names > 0) break;
          }
          await until(
            page,
            `/^1 interactive/.test(periplus.displays.find((d) => d.name === 'handles').statuses.Markers?.text)`,
            'the marker',
          );
          await page.evaluate(() =>
            window.periplus.setView({ kind: 'TopDownOrtho', x: 2, y: 1, scale: 150, angle: 0 }),
          );
          await page.waitForTimeout(500);
          const start = await markerPose(page);
          // The tip of the arrow.
          const fixed = await page.evaluate(() => window.periplus.fixedFrame);
          assert.equal(fixed, 'odom');
          await drag(page, await pixel(page, [2.8, 1, 0.5]), await pixel(page, [3.3, 1.2, 0.5]));
          const moved = await markerPose(page);
          assert.ok(Math.abs(moved.x - start.x - 0.5) < 0.1, JSON.stringify(moved));
          assert.ok(Math.abs(moved.y - start.y) < 1e-6, JSON.stringify(moved));
          // The ring: a quarter turn.
          const ring = (angle) =>
            pixel(page, [moved.x + 0.57 * Math.cos(angle), 1 + 0.57 * Math.sin(angle), 0.5]);
          await drag(page, await ring(Math.PI / 4), await ring((3 * Math.PI) / 4));
          const turned = await markerPose(page);
          assert.ok(Math.abs(Math.abs(turned.yaw) - Math.PI / 2) < 0.25, JSON.stringify(turned));
          await page.waitForTimeout(300);
          const events = (await feedback(page)).map((one) => `${one.control} ${one.event}`);
          for (const name of ['move_x', 'rotate_z']) {
            for (const event of [1, 5]) assert.ok(events.includes(`${name} ${event}`), `${events}`);
          }
          // By keys: the axis is that of the turned marker, y.
          await page.evaluate(() => void window.periplus.workbench.open('handles'));
          await page.getByRole('combobox', { name: 'Marker', exact: true }).waitFor();
          await page
            .getByRole('combobox', { name: 'Control', exact: true })
            .selectOption({ label: 'move_x: move along an axis' });
          const pad = page.getByRole('application', { name: 'Move target' });
          await pad.focus();
          const from = await markerPose(page);
          await page.keyboard.press('ArrowRight');
          await page.keyboard.press('Shift+ArrowRight');
          const after = await markerPose(page);
          const distance = Math.hypot(after.x - from.x, after.y - from.y);
          assert.ok(Math.abs(distance - 0.11) < 1e-3, `moved by ${distance} m`);
          await page
            .getByRole('status')
            .filter({ hasText: /odom: x/ })
            .first()
            .waitFor({ state: 'attached' });
          await page.keyboard.press('PageUp');
          await page
            .getByRole('status')
            .filter({ hasText: 'does not move in this direction' })
            .first()
            .waitFor({ state: 'attached' });
          await page
            .getByRole('combobox', { name: 'Control', exact: true })
            .selectOption({ label: 'rotate_z: rotate about an axis' });
          await pad.focus();
          await page.keyboard.press('ArrowUp');
          const rotated = (await markerPose(page)).yaw - after.yaw;
          assert.ok(Math.abs(Math.abs(rotated) - Math.PI / 18) < 1e-3, `${rotated}`);
          await page.keyboard.press('Enter');
          await page.getByRole('menuitem', { name: 'Grasp' }).waitFor();
          await page.keyboard.press('Enter');
          await until(
            page,
            'received.some((one) => one.event === 2 && one.entry === 7)',
            'the menu',
          );
          assert.deepEqual(await wrong(page, 'handles'), []);
        },
      ),
    );

    const bag = join(folder, 'run');
    run(
      ...['sim', 'worlds/house.sdf', '--robot', SAM_BOT, '--slam', '--duration', '8'],
      ...['-p', 'publish_odom_tf:=true'],
      ...['--cmd', 'worlds/drives/circle.yaml', '--ros2', 'off', '--record', bag],
    );

    await attempt('proof: drop', () =>
      withServer(chrome, url, sim('worlds/closed_room.world', KBOT), {}, async (page) => {
        await until(page, 'periplus.recordings.isServed', 'recordings');
        const note = join(folder, 'notes.txt');
        writeFileSync(note, 'hello');
        await dropOn(page, note);
        await page
          .getByText(/notes.txt/)
          .first()
          .waitFor();
        // Tabs of recordings are there while one is open.
        const tabs = () =>
          page.getByRole('tab', { name: /^(Marks|Comparison|Run again)$/ }).count();
        assert.equal(await tabs(), 0, 'tabs of recordings on a live page');
        await dropOn(page, bag);
        await until(page, 'periplus.replay?.source.playhead.endNs > 5e9', 'the folder', 60_000);
        const kind = await page.evaluate('periplus.replay.source.tracks[0].recording.kind');
        assert.ok(kind === 'rosbag2' || kind === 'mcap', kind);
        assert.equal(await tabs(), 3, 'tabs of recordings');
        await page.getByRole('button', { name: 'Back to live' }).first().click();
        await until(page, '!periplus.replay && periplus.worldName', 'the running system');
        assert.equal(await tabs(), 0, 'tabs of recordings after the replay');
        await dropOn(page, join(bag, 'run_0.mcap'));
        await until(page, 'periplus.replay?.source.playhead.endNs > 5e9', 'the file', 60_000);
      }),
    );

    await attempt('proof: plot of a recording', () =>
      view(chrome, url, bag, async (page) => {
        const odometry = await page.evaluate(
          () => window.periplus.topics.find(({ type }) => /Odometry$/.test(type))?.name,
        );
        await page.evaluate(() => void window.periplus.workbench.open('plot', {}));
        const field = page.getByRole('combobox', { name: 'Expression' }).first();
        await field.fill(`${odometry}:pose.pose.position.x`);
        await field.press('Enter');
        await page.getByTitle(`${odometry}:pose.pose.position.x`).first().waitFor();
        /** Times of the curve [s], from the exported table, once it covers the recording. */
        const times = async () => {
          const [file] = await Promise.all([
            page.waitForEvent('download'),
            page.getByRole('button', { name: 'CSV' }).click(),
          ]);
          const rows = readFileSync(await file.path(), 'utf8')
            .trim()
            .split('\r\n')
            .slice(1);
          return rows.map((row) => Number(row.split(',')[0]));
        };
        await show(page, 0.1);
        await settled(page);
        await page.waitForTimeout(1500);
        const whole = await times();
        const span = await page.evaluate(() => {
          const { startS, endS } = window.periplus.replay;
          return endS - startS;
        });
        // The curve is that of the whole recording, wherever the playhead is.
        assert.ok(
          whole.at(-1) - whole[0] > 0.9 * span,
          `${whole[0]} to ${whole.at(-1)} of ${span}`,
        );
        await show(page, 0.8);
        await settled(page);
        assert.deepEqual(await times(), whole);
      }),
    );

    await attempt('proof: displays after a jump', () =>
      view(chrome, url, bag, async (page) => {
        await show(page, 0.9);
        await settled(page);
        const topics = await page.evaluate(() =>
          window.periplus.topics.map(({ name, type }) => [type.split('/').pop(), name]),
        );
        const of = (type) => topics.find(([one]) => one === type)?.[1];
        const [image, cloud] = [of('Image'), of('PointCloud2')];
        assert.ok(image && cloud, JSON.stringify(topics));
        await page.evaluate(
          ([i, c]) => {
            const { active } = window.periplus;
            active.add('rviz_default_plugins/Image', 'picture', { Topic: i });
            active.add('rviz_default_plugins/PointCloud2', 'cloud', { Topic: c });
            active.add('rviz_default_plugins/MarkerArray', 'graph', {
              Topic: '/slam_toolbox/graph_visualization',
            });
          },
          [image, cloud],
        );
        const status = (name, of) =>
          `periplus.displays.find((d) => d.name === '${name}').statuses.${of}?.text`;
        await until(page, status('picture', 'Image'), 'an image');
        await until(page, `/points/.test(${status('cloud', 'Points')})`, 'a cloud');
        // Both are those of the time, also after another jump, while the replay is paused.
        for (const part of [0.5, 0.8]) {
          await show(page, part);
          await settled(page);
          await until(page, `/points/.test(${status('cloud', 'Points')})`, 'a cloud again');
          await until(page, status('picture', 'Image'), 'an image again');
        }
        await until(page, `/[1-9]/.test(${status('graph', 'Markers')})`, 'markers');
        // Before the first message nothing is left of later times.
        await show(page, 0);
        await settled(page);
        await until(
          page,
          `!${status('cloud', 'Points')} && /at this time/.test(${status('cloud', 'Topic')})`,
          'no cloud at the start',
        );
      }),
    );

    for (const [kind, parameter, value] of [
      ['costmap', /inflation_radius/, '0.9'],
      ['amcl', /^max_particles/, '900'],
    ]) {
      await attempt(`proof: rerun of ${kind}`, () =>
        view(chrome, url, bag, async (page) => {
          await page.getByRole('tab', { name: 'Run again' }).click();
          await page.getByLabel('Estimator').selectOption(kind);
          await page
            .getByLabel('Search parameters')
            .waitFor()
            .catch(() => undefined);
          const input = page.getByLabel(parameter).first();
          await input.fill(value);
          await input.press('Tab');
          await page.getByRole('button', { name: 'Run', exact: true }).click();
          await until(page, 'periplus.replay.source.tracks.length === 2', 'the result', 120_000);
          const { origin, topics } = await page.evaluate(() => {
            const { recording } = window.periplus.replay.source.tracks[1];
            const names = recording.topics.filter((t) => t.count > 0).map((t) => t.topic);
            return { origin: recording.origin, topics: names };
          });
          assert.equal(origin.kind, kind);
          assert.deepEqual(Object.values(origin.parameters).map(Number), [Number(value)]);
          const expected = kind === 'amcl' ? /amcl_pose/ : /costmap/;
          assert.ok(
            topics.some((name) => expected.test(name)),
            `${topics}`,
          );
        }),
      );
    }
  }
}
