// The arrangement of panels: docking, several 3D views, layouts, links, foreign files, pictures and videos.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { open, periplus, port, sim, until } from './lib.mjs';
import { PHONE, wrong } from './axe.mjs';

const PORT = port(8861);
const SAM_BOT = 'robots/sam_bot/urdf/sam_bot.urdf.xacro';

const tab = (page, name) => page.getByRole('tab', { name, exact: true });
const isDocked = (page) => until(page, '!!document.querySelector(".dv-dockview")', 'docking');
/** Titles of the tabs of each group, from left to right and top to bottom. */
const groups = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll('.dv-groupview')]
      .filter((group) => group.checkVisibility())
      .map((group) => ({ box: group.getBoundingClientRect(), group }))
      .sort((a, b) => a.box.x - b.box.x || a.box.y - b.box.y)
      .map(({ group }) => [...group.querySelectorAll('[role=tab]')].map((tab) => tab.ariaLabel)),
  );
const groupOf = async (page, title) =>
  (await groups(page)).find((titles) => titles.includes(title));
const menu = async (page, title, command) => {
  await page.getByRole('button', { name: `Menu of ${title}`, exact: true }).click();
  await page.getByRole('button', { name: command, exact: true }).click();
};
const add = async (page, name) => {
  await page.getByRole('button', { name: 'Add panel' }).first().click();
  await page.getByRole('searchbox', { name: 'Search panels' }).fill(name);
  await page.keyboard.press('Enter');
};
const layoutItem = async (page, name) => {
  await page.getByRole('button', { name: 'Layouts' }).click();
  await page
    .getByRole('dialog', { name: 'Layouts' })
    .getByRole('button', { name, exact: true })
    .click();
};
const share = async (page, name) => {
  await page.getByRole('button', { name: 'Share' }).click();
  await page
    .getByRole('dialog', { name: 'Share' })
    .getByRole('button', { name, exact: true })
    .click();
};

/** A tab is dragged to the side of another panel, and another one is split off by its menu. */
async function docks(page) {
  assert.deepEqual((await groups(page)).length, 3, 'displays, view, tabs');
  const view = await page.locator('canvas').first().boundingBox();
  await tab(page, 'Log').hover({ position: { x: 12, y: 10 } });
  await page.mouse.down();
  await page.mouse.move(view.x + view.width / 2, view.y + view.height - 120, { steps: 8 });
  await page.mouse.move(view.x + view.width / 2, view.y + view.height - 30, { steps: 8 });
  await page.waitForTimeout(200);
  await page.mouse.up();
  await until(page, 'document.querySelectorAll(".dv-groupview").length === 4', 'a group below');
  assert.deepEqual(await groupOf(page, 'Log'), ['Log']);
  const log = await page.locator('#panel-log').boundingBox();
  const canvas = await page.locator('canvas').first().boundingBox();
  assert.ok(log.y >= canvas.y + canvas.height - 1, 'the log is below the 3D view');
  await tab(page, 'Topics').click();
  await menu(page, 'Topics', 'Split downwards');
  assert.deepEqual(await groupOf(page, 'Topics'), ['Topics']);
  await menu(page, 'Topics', 'Float');
  await page.locator('.dv-resize-container').waitFor();
  await menu(page, 'Topics', 'Dock');
  assert.equal(await page.locator('.dv-resize-container').count(), 0);
  // One panel fills the page, and returns.
  const before = (await page.locator('canvas').first().boundingBox()).width;
  await page.getByRole('button', { name: 'Maximize 3D view' }).click();
  await page.waitForTimeout(200);
  const wide = (await page.locator('canvas').first().boundingBox()).width;
  assert.ok(wide > before * 1.3, `${before} px, then ${wide} px`);
  await page.getByRole('button', { name: 'Restore 3D view' }).click();
  // The scene is drawn after all these moves.
  await page.waitForTimeout(500);
  assert.ok((await page.evaluate('periplus.framesPerSecond')) > 0, 'the view is drawn');
}

/** A second 3D view has its own fixed frame and camera; tools and displays act on the active one. */
async function secondView(page) {
  await add(page, '3D');
  await tab(page, '3D view 2').waitFor();
  await until(page, 'periplus.viewports.length === 2 && !!periplus.viewports[1].stage', 'a view');
  await until(page, 'periplus.active === periplus.viewports[1]', 'the new view is active');
  await page.getByRole('combobox', { name: 'Fixed frame of 3D view 2' }).selectOption('base_link');
  assert.deepEqual(await page.evaluate('periplus.viewports.map((v) => v.fixedFrame)'), [
    'odom',
    'base_link',
  ]);
  await page
    .getByRole('region', { name: '3D view 2' })
    .getByRole('button', { name: 'Top' })
    .click();
  assert.deepEqual(await page.evaluate('periplus.viewports.map((v) => v.view.kind)'), [
    'Orbit',
    'TopDownOrtho',
  ]);
  assert.equal(await page.locator('.stage.active').count(), 1, 'one view is marked');
  await until(page, 'periplus.viewports[1].displays.some((d) => d.name === "Robot")', 'its robot');
  // A click makes the other one the active one; the panel Displays follows.
  await page.locator('canvas').first().click();
  await until(page, 'periplus.active === periplus.viewports[0]', 'the first view is active');
  const frame = page.getByRole('combobox', { name: 'Fixed frame', exact: true });
  assert.equal(await frame.inputValue(), 'odom');
}

/** The layout is there again after a reload, also by name and from a file. */
async function saves(page, out) {
  const shown = () =>
    page.evaluate(() => window.periplus.viewports.map((v) => [v.fixedFrame, v.view.kind]));
  const [before, arranged] = [await shown(), await groups(page)];
  await page.getByRole('button', { name: 'Layouts' }).click();
  const dialog = page.getByRole('dialog', { name: 'Layouts' });
  await dialog.getByRole('textbox', { name: 'Name of the layout' }).fill('two views');
  await dialog.getByRole('button', { name: 'Save', exact: true }).click();
  await page.getByText('Layout "two views" saved').waitFor();
  await page.waitForTimeout(2500);
  await page.reload();
  await isDocked(page);
  await until(page, 'periplus.viewports.length === 2', 'both views');
  await until(page, 'periplus.frames.includes("base_link")', 'frames');
  assert.deepEqual(await groups(page), arranged);
  assert.deepEqual(await shown(), before);
  // A file.
  const download = page.waitForEvent('download');
  await layoutItem(page, 'Export the layout');
  const file = join(out, 'own.layout.json');
  await (await download).saveAs(file);
  assert.equal(JSON.parse(readFileSync(file, 'utf8')).version, 1);
  await layoutItem(page, 'Reset to the first layout');
  await until(page, 'periplus.viewports.length === 1', 'one view');
  assert.equal((await groups(page)).length, 3);
  await page.getByTestId('rviz-file').setInputFiles(file);
  await until(page, 'periplus.viewports.length === 2', 'both views from the file');
  assert.deepEqual(await groups(page), arranged);
  assert.deepEqual(await shown(), before);
  // Unknown panels are reported and kept.
  const later = JSON.parse(readFileSync(file, 'utf8'));
  later.panels.new = { kind: 'hologram', state: { depth: 3 } };
  later.root.children[0].tabs.push('new');
  const laterFile = join(out, 'later.layout.json');
  writeFileSync(laterFile, JSON.stringify(later));
  await page.getByTestId('rviz-file').setInputFiles(laterFile);
  await page.getByText('no panels of the kinds hologram').waitFor();
  assert.deepEqual(await page.evaluate('periplus.workbench.save().panels.new.state'), { depth: 3 });
  // By name, renamed, deleted.
  await layoutItem(page, 'Reset to the first layout');
  await page.getByRole('button', { name: 'Layouts' }).click();
  await dialog.getByRole('button', { name: 'Rename two views' }).click();
  await dialog.getByRole('textbox', { name: 'New name of two views' }).fill('pair');
  await page.keyboard.press('Enter');
  await dialog.getByRole('button', { name: 'pair', exact: true }).click();
  await until(page, 'periplus.viewports.length === 2', 'both views by name');
  await page.getByRole('button', { name: 'Layouts' }).click();
  await dialog.getByRole('button', { name: 'Delete pair' }).click();
  assert.equal(await dialog.getByRole('button', { name: 'pair', exact: true }).count(), 0);
  await page.keyboard.press('Escape');
}

/** A colleague who opens the link sees the same. */
async function links(page, chrome) {
  await page.evaluate(() => {
    const { active } = window.periplus;
    active.setView({ kind: 'Orbit', distance: 3.5, yaw: 1, pitch: 0.3, focal: [1, 0, 0] });
    active.setEnabled(
      active.displays.find((d) => d.name === 'scan'),
      false,
    );
    // Without a permission the page shows the link.
    navigator.clipboard.writeText = () => Promise.reject(new Error('forbidden'));
  });
  await page.getByRole('button', { name: 'Share' }).click();
  await page.getByRole('button', { name: 'Copy link to this view' }).click();
  const link = await page.getByLabel('Copy this link:').inputValue();
  await page.keyboard.press('Escape');
  assert.ok(link.length < 8000, `${link.length} characters`);
  const { page: other } = await open(chrome, link);
  await isDocked(other);
  await until(other, 'periplus.active.displays.some((d) => d.name === "scan")', 'displays');
  const seen = (one) =>
    one.evaluate(() => {
      const views = window.periplus.viewports.map((v) => {
        const { origin: _, ...view } = { ...(v.stage?.view.state ?? v.view) };
        return [v.fixedFrame, view, v.displays.map((d) => [d.kind.class, d.name, d.isEnabled])];
      });
      return { views, root: window.periplus.workbench.arrangement.root };
    });
  await until(
    other,
    `periplus.active.displays.length === ${await page.evaluate('periplus.active.displays.length')}`,
    'all displays',
  );
  const [mine, theirs] = [await seen(page), await seen(other)];
  assert.deepEqual(theirs.views, mine.views);
  const sizes = (place) =>
    place.sizes ? [place.sizes.map((s) => s.toFixed(2)), ...place.children.map(sizes)] : place.tabs;
  assert.deepEqual(sizes(theirs.root), sizes(mine.root));
  await other.close();
  // A link that was cut says so.
  const { page: cut } = await open(chrome, link.slice(0, link.length - 40));
  await cut.getByText('The link holds no layout that can be read').waitFor();
  await cut.close();
}

const FOXGLOVE = {
  configById: {
    '3D!1': {
      followTf: 'odom',
      followMode: 'follow-none',
      cameraState: {
        distance: 6,
        perspective: true,
        phi: 45,
        thetaOffset: 0,
        targetOffset: [0, 0, 0],
      },
      layers: { grid: { layerId: 'foxglove.Grid', visible: true, size: 10, divisions: 10 } },
      topics: { '/scan': { visible: true, pointSize: 6 }, '/never': { visible: true } },
    },
    'Plot!1': { paths: [{ value: '/demo/odom.twist.twist.linear.x' }] },
    'Image!1': { imageMode: { imageTopic: '/depth_camera/image_raw' } },
    'Tab!1': {
      activeTabIdx: 0,
      tabs: [
        { title: 'A', layout: 'RosOut!1' },
        { title: 'B', layout: 'Parameters!1' },
      ],
    },
  },
  layout: {
    direction: 'row',
    splitPercentage: 60,
    first: '3D!1',
    second: {
      direction: 'column',
      first: 'Image!1',
      second: {
        direction: 'column',
        first: 'Tab!1',
        second: { direction: 'row', first: 'Plot!1', second: 'Map!1' },
      },
    },
  },
};

/** A layout of Foxglove is shown as far as it goes; the rest is listed. */
async function foxglove(page, out) {
  const file = join(out, 'foxglove.json');
  writeFileSync(file, JSON.stringify(FOXGLOVE));
  await page.getByTestId('rviz-file').setInputFiles(file);
  const dialog = page.getByRole('dialog', { name: 'Not imported' });
  await dialog.getByText('Panel Map').waitFor();
  await dialog.getByText('/never').waitFor();
  assert.deepEqual(await wrong(page, 'list of what was left out'), []);
  await dialog.getByRole('button', { name: 'Close' }).click();
  assert.deepEqual((await groups(page)).map((titles) => titles.length).sort(), [1, 1, 1, 2]);
  assert.deepEqual(await groupOf(page, 'Log'), ['Log', 'Parameters']);
  await until(
    page,
    'periplus.active.displays.some((d) => d.name === "scan" && d.statuses.Points)',
    'points',
  );
  assert.equal(await page.evaluate('periplus.active.fixedFrame'), 'odom');
  await page.getByRole('img', { name: 'Image of /depth_camera/image_raw' }).waitFor();
  await layoutItem(page, 'Reset to the first layout');
}

const RVIZ = `
Panels:
  - {Class: rviz_common/Displays, Name: Displays}
  - {Class: nav2_rviz_plugins/Navigation 2, Name: Navigation 2}
Visualization Manager:
  Displays:
    - {Class: rviz_default_plugins/Grid, Name: Grid, Enabled: true}
    - Class: rviz_common/Group
      Name: Sensors
      Enabled: true
      Displays:
        - {Class: rviz_default_plugins/LaserScan, Name: Scan, Enabled: true, Topic: {Value: /scan}}
  Global Options: {Fixed Frame: odom}
  Views:
    Current: {Class: rviz_default_plugins/Orbit, Distance: 7}
    Saved:
      - {Class: rviz_default_plugins/TopDownOrtho, Name: From above, Scale: 90, Odd: 3}
Window Geometry: {Height: 800}
`;

/** Groups switch their displays, saved views are chosen, and all of it is written back. */
async function rviz(page, out) {
  const file = join(out, 'groups.rviz');
  writeFileSync(file, RVIZ);
  await page.getByTestId('rviz-file').setInputFiles(file);
  await until(page, 'periplus.active.fileName === "groups.rviz"', 'the file');
  assert.equal(await tab(page, 'Navigate').getAttribute('aria-selected'), 'true');
  const scan = 'periplus.active.displays.find((d) => d.name === "Scan")';
  await until(page, `${scan}?.statuses.Points`, 'points');
  await page.getByRole('checkbox', { name: 'Show the group Sensors' }).uncheck();
  assert.equal(await page.evaluate(`!!${scan}.display`), false);
  assert.equal(await page.getByRole('checkbox', { name: 'Show Scan' }).isChecked(), true);
  await page.getByRole('button', { name: 'Saved views' }).click();
  await page.getByRole('button', { name: 'From above', exact: true }).click();
  assert.equal(await page.evaluate('periplus.active.stage.view.state.scale'), 90);
  const download = page.waitForEvent('download');
  await layoutItem(page, 'Save as .rviz');
  const written = join(out, 'written.rviz');
  await (await download).saveAs(written);
  const text = readFileSync(written, 'utf8');
  for (const part of [
    'rviz_common/Group',
    'Odd: 3',
    'Height: 800',
    'nav2_rviz_plugins/Navigation 2',
  ]) {
    assert.ok(text.includes(part), part);
  }
  await page.getByTestId('rviz-file').setInputFiles(written);
  await until(page, 'periplus.active.fileName === "written.rviz"', 'the written file');
  assert.equal(await page.evaluate('periplus.active.groups[0].isEnabled'), false);
  assert.equal(await page.evaluate('periplus.active.savedViews[0].name'), 'From above');
  await layoutItem(page, 'Reset to the first layout');
}

/** A screenshot has the pixels of the scene; a video of two seconds can be played. */
async function pictures(page, out) {
  await until(
    page,
    'periplus.displays.some((d) => d.kind.title === "World" && d.statuses.Scene)',
    'the world',
  );
  await page.waitForTimeout(500);
  const picture = page.waitForEvent('download');
  await share(page, 'Screenshot of the 3D view');
  const png = await picture;
  assert.match(png.suggestedFilename(), /^cube_and_sphere-view-\d{4}-\d\d-\d\d_[\d-]+\.png$/);
  await png.saveAs(join(out, 'view.png'));
  const red = await page.evaluate(
    async (bytes) => {
      const image = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
      const canvas = new OffscreenCanvas(image.width, image.height);
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, image.width, image.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        count += data[i] > 110 && data[i] > 2 * data[i + 1] && data[i] > 2 * data[i + 2];
      }
      return (count * 4) / data.length;
    },
    [...readFileSync(join(out, 'view.png'))],
  );
  assert.ok(red > 0.001, `the red cube fills ${red} of the picture`);
  const video = page.waitForEvent('download');
  await share(page, 'Record a video of the 3D view');
  await page.waitForTimeout(2500);
  await page.getByRole('button', { name: /^Video: \d+ s/ }).click();
  const file = await video;
  await file.saveAs(join(out, 'view.webm'));
  const played = await page.evaluate(
    async (bytes) => {
      const video = document.createElement('video');
      video.muted = true;
      video.src = URL.createObjectURL(new Blob([new Uint8Array(bytes)], { type: 'video/webm' }));
      await new Promise((resolve, reject) => {
        video.onloadedmetadata = resolve;
        video.onerror = () => reject(new Error(video.error.message));
      });
      await video.play();
      await new Promise((resolve) => setTimeout(resolve, 700));
      const { duration, videoWidth, currentTime } = video;
      return { duration, videoWidth, currentTime };
    },
    [...readFileSync(join(out, 'view.webm'))],
  );
  assert.ok(played.duration > 2 && played.duration < 6, JSON.stringify(played));
  assert.ok(played.videoWidth > 300 && played.currentTime > 0, JSON.stringify(played));
}

/** Panels are added, reached, moved and closed by keys alone. */
async function keysOnly(page) {
  const focused = () =>
    page.evaluate('document.activeElement?.ariaLabel ?? document.activeElement?.tagName');
  await page.getByRole('button', { name: 'Add panel' }).first().focus();
  await page.keyboard.press('Enter');
  await page.keyboard.type('imag');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await until(page, 'document.activeElement?.id === "tab-image"', 'the focus on the new tab');
  await page.keyboard.press('F6');
  const second = await focused();
  await page.keyboard.press('Shift+F6');
  assert.notEqual(second, await focused(), 'F6 moves the focus');
  assert.equal(await page.evaluate('document.activeElement.id'), 'tab-image');
  const count = (await groups(page)).length;
  await page.keyboard.press('Delete');
  await until(page, '!document.getElementById("tab-image")', 'the panel is closed');
  assert.equal((await groups(page)).length, count - 1);
  assert.equal(await page.evaluate('document.activeElement?.getAttribute("role")'), 'tab');
  // Ctrl, shift and an arrow move a tab among its neighbours.
  await tab(page, 'Drive').focus();
  await page.keyboard.press('Control+Shift+ArrowRight');
  assert.deepEqual((await groupOf(page, 'Drive')).slice(0, 2), ['Navigate', 'Drive']);
  await page.keyboard.press('Control+Shift+ArrowLeft');
}

/** On a phone one panel is seen at a time; the bar shows that it goes on. */
async function phone(page) {
  const width = page.viewportSize().width;
  await page.getByRole('button', { name: 'Panels', exact: true }).tap();
  const bar = page.getByRole('tablist', { name: 'Panels' });
  assert.ok(await bar.evaluate((e) => e.scrollWidth > e.clientWidth), 'the bar scrolls');
  assert.equal(await page.locator('.scroll.right').count(), 1, 'it is seen that it goes on');
  await tab(page, 'Log').tap();
  await page.locator('#panel-log').waitFor();
  await until(page, '!!document.querySelector(".scroll.left")', 'the left end fades');
  const cut = await page.evaluate(
    (limit) =>
      [...document.querySelectorAll('header *, aside *')]
        .filter((e) => e.checkVisibility() && !e.closest('.tabs'))
        .filter((e) => e.getBoundingClientRect().right > limit + 1)
        .map((e) => e.outerHTML.slice(0, 120)),
    width,
  );
  assert.deepEqual(cut, []);
  await page.getByRole('button', { name: 'Add panel' }).last().tap();
  await page
    .getByRole('dialog', { name: 'Add panel' })
    .getByRole('button', { name: /Image/ })
    .tap();
  await page.locator('#panel-image').waitFor();
  await page.getByRole('button', { name: /^Close .*image_raw/ }).tap();
  assert.equal(await page.locator('#tab-image').count(), 0);
  assert.equal(await page.evaluate('document.documentElement.scrollWidth'), width);
}

export async function dock(chrome, url, out, attempt) {
  if (!attempt.isWanted('dock')) return;
  const words = sim('worlds/cube_and_sphere.sdf', SAM_BOT, 'publish_odom_tf:=true');
  const run = await periplus([...words, `--page=127.0.0.1:${PORT}`], PORT);
  const on = (name, test, options = {}) =>
    attempt(`dock ${name}`, async () => {
      const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`, options);
      try {
        await until(page, 'periplus.displays.some((d) => d.kind.title === "World")', 'the world');
        await until(page, 'periplus.fixedFrame === "odom"', 'frames');
        if (!options.isMobile) await isDocked(page);
        await test(page);
        assert.deepEqual(complaints, []);
      } finally {
        await page.close();
      }
    });
  try {
    await on('moves panels', docks);
    await on('layouts', async (page) => {
      await secondView(page);
      await saves(page, out);
    });
    await on('links', async (page) => {
      await secondView(page);
      await links(page, chrome);
    });
    await on('foxglove', (page) => foxglove(page, out));
    await on('rviz', (page) => rviz(page, out));
    await on('pictures', (page) => pictures(page, out));
    await on('keys', keysOnly);
    await on('axe with two views', async (page) => {
      await secondView(page);
      await page.getByRole('button', { name: 'Layouts' }).click();
      assert.deepEqual(await wrong(page, 'two views and the menu of layouts'), []);
    });
    await on('phone', phone, PHONE);
  } finally {
    await run.stop();
  }
}
