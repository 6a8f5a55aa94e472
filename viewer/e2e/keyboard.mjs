// The page without a mouse: every control is reachable by Tab, visible when focused, and has a name.
import assert from 'node:assert/strict';
import { next, open, periplus, sim, until, port } from './lib.mjs';

const PORT = port(8824);
const SAM_BOT = 'robots/sam_bot/urdf/sam_bot.urdf.xacro';

/** Focusable elements, numbered and with names. Records from now on which gets the focus. Runs in the page. */
function watch() {
  const nameOf = (element) =>
    [
      element.getAttribute('aria-label'),
      [...(element.labels ?? [])].map((l) => l.textContent).join(' '),
      element.textContent,
      element.getAttribute('title'),
      element.getAttribute('placeholder'),
    ].find((text) => text?.trim()) ?? '';
  const selector = 'a[href], button, input, select, textarea, summary, canvas, svg, [tabindex]';
  const isSeen = (e) => e.checkVisibility({ visibilityProperty: true }) && !e.closest('[inert]');
  const all = [...document.querySelectorAll(selector)].filter(
    (e) => e.tabIndex >= 0 && !e.disabled && isSeen(e),
  );
  const texts = all.map((e) => `${e.tagName} ${nameOf(e).trim()}`);
  const gone = () => all.flatMap((e, i) => (e.isConnected && isSeen(e) ? [] : [i]));
  const seen = (window.seen = { reached: [], unseen: [], gone: [] });
  window.leaveWatch?.();
  const note = ({ target }) => {
    const i = all.indexOf(target);
    if (i >= 0 && !seen.reached.includes(i)) seen.reached.push(i);
    seen.gone = gone();
    const isOutlined = [target, target.closest('label.file') ?? target]
      .map((e) => getComputedStyle(e))
      .some((s) => s.outlineStyle !== 'none' && parseFloat(s.outlineWidth) > 0);
    if (!isOutlined) seen.unseen.push(`${target.tagName} ${nameOf(target).trim()}`);
  };
  document.addEventListener('focusin', note);
  window.leaveWatch = () => document.removeEventListener('focusin', note);
  document.activeElement?.blur();
  return { texts, nameless: all.filter((e) => !nameOf(e).trim()).map((e) => e.outerHTML) };
}

/** Goes once through the page by Tab; returns elements that were not reached, not visible or not named. */
async function around(page) {
  const { texts, nameless } = await page.evaluate(watch);
  // The first Tab goes on from where the focus was, so that an element there is reached last. A panel that still loads
  // gets more elements meanwhile: the way around is then longer than the list.
  const isDone = () =>
    page.evaluate(
      (count) => new Set([...window.seen.reached, ...window.seen.gone]).size >= count,
      texts.length,
    );
  for (let i = 0; i < 3 * texts.length + 10; i++) {
    await page.keyboard.press('Tab');
    if (i >= texts.length && (await isDone())) break;
  }
  const { reached, unseen, gone } = await page.evaluate('seen');
  return {
    count: reached.length,
    // Elements removed meanwhile are not reachable.
    unreached: texts.filter((_, i) => !reached.includes(i) && !gone.includes(i)),
    unseen,
    nameless,
  };
}

async function holds(page, where) {
  const { count, unreached, unseen, nameless } = await around(page);
  assert.ok(count > 5, `${where}: only ${count} controls were reached`);
  assert.deepEqual(unreached, [], `${where}: not reached by Tab`);
  assert.deepEqual(unseen, [], `${where}: has the focus, and nobody sees it`);
  assert.deepEqual(nameless, [], `${where}: has no name`);
}

export async function keyboard(chrome, url) {
  const run = await periplus(
    sim(
      'worlds/cube_and_sphere.sdf',
      SAM_BOT,
      '-p',
      'publish_odom_tf:=true',
      `--page=127.0.0.1:${PORT}`,
    ),
    PORT,
  );
  try {
    const { page } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
    await until(page, 'periplus.displays.length > 4', 'displays');
    await until(page, 'periplus.displays.some((d) => d.statuses.Description)', 'a robot');
    // From now on the list of displays does not change.
    await page.evaluate(() => (window.periplus.active.isAutomatic = false));
    // While the simulation is paused the buttons do not change.
    await page.getByRole('button', { name: 'Pause' }).first().click();
    await until(page, 'periplus.isPaused', 'standing still');
    // Arrow keys select each panel.
    await page.getByRole('tab', { name: 'Drive' }).focus();
    const tabs = await page.evaluate(() => {
      const list = document.getElementById('tab-drive').closest('[role=tablist]');
      return [...list.querySelectorAll('[role=tab]')].map((tab) => tab.id.replace('tab-', ''));
    });
    assert.ok(['drive', 'world', 'messages', 'plot', 'log'].every((id) => tabs.includes(id)));
    for (const id of [...tabs.slice(1), tabs[0]]) {
      await page.keyboard.press('ArrowRight');
      await page.locator(`#panel-${id}`).waitFor();
      if (['world', 'plot', 'log', 'drive'].includes(id)) await holds(page, id);
      await page.locator(`#tab-${id}`).focus();
    }
    // A display is expanded and disabled by keys.
    const shown = page.getByRole('checkbox', { name: /^Show (Scan|scan)/ });
    await shown.focus();
    await page.keyboard.press('Space');
    await until(page, 'periplus.displays.some((d) => /scan/i.test(d.name) && !d.isEnabled)', 'off');
    await page.keyboard.press('Space');
    await page.getByRole('button', { name: /^Options of (Scan|scan)/ }).focus();
    await page.keyboard.press('Enter');
    await holds(page, 'the options of a display');
    // A goal: the tool by its letter, position and heading by arrow keys.
    await page.evaluate(
      'periplus.setView({ kind: "TopDownOrtho", x: 0, y: 0, scale: 60, angle: 0 })',
    );
    const aim = async () => {
      await page.locator('canvas').first().focus();
      for (const key of ['g', 'Enter', ...Array(5).fill('ArrowUp'), 'Enter']) {
        await page.keyboard.press(key);
      }
    };
    // The topic of goals does not exist before the first one.
    await aim();
    await until(page, 'periplus.topics.some((t) => t.name === "/goal_pose" && t.type)', 'a goal');
    const goal = next(page, '/goal_pose', 'message.pose');
    await aim();
    const { position, orientation } = await goal;
    assert.ok(Math.hypot(position.x, position.y) < 0.05, 'it is in the middle of the view');
    assert.ok(
      Math.abs(2 * Math.atan2(orientation.z, orientation.w) - Math.PI / 2) < 0.05,
      'it looks up',
    );
    // The editor keeps the focus while it is open, and returns it when it is closed.
    await page.getByRole('button', { name: 'Building Editor' }).focus();
    await page.keyboard.press('Enter');
    await page.getByRole('application').waitFor();
    await holds(page, 'the Building Editor');
    await page.getByRole('button', { name: 'Close the editor' }).focus();
    await page.keyboard.press('Enter');
    await until(
      page,
      'document.activeElement?.ariaLabel === "Building Editor"',
      'the focus came back',
    );
    await page.close();
  } finally {
    await run.stop();
  }
}
