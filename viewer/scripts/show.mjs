// Takes the screenshots of every display and writes docs/displays.md with them.
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { open, periplus, PROGRAM, ROOT, port } from '../e2e/lib.mjs';
import { DISPLAYS, SHOWROOM, WITHOUT_PICTURE } from './displays.mjs';

const PORT = port(8842);
/** Hides everything that covers the 3D view. */
const BARE =
  'header.bar, .views, .corner, .truth, .pictures, .notices, .hint { display: none !important }';
const SIZE = { width: 440, height: 280 };

/** Poses published by the page: a pose estimate and a goal. */
const PUBLISHED = {
  estimate: () => {
    const covariance = new Float64Array(36);
    [covariance[0], covariance[7], covariance[35]] = [0.09, 0.03, 0.06];
    const at = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
    const app = window.periplus;
    app.publish('/initialpose', 'geometry_msgs/msg/PoseWithCovarianceStamped', {
      header: app.header(),
      pose: { pose: at, covariance },
    });
  },
  goal: () => {
    const app = window.periplus;
    app.publish('/goal_pose', 'geometry_msgs/msg/PoseStamped', {
      header: app.header(),
      pose: { position: { x: 0.6, y: -0.3, z: 0 }, orientation: { x: 0, y: 0, z: 0.38, w: 0.92 } },
    });
  },
};

/** With thousands of coloured points a JPEG takes a third of a PNG. */
const fileOf = (name, shot) => `${name}.${shot.isDense ? 'jpg' : 'png'}`;

async function look(page, shot, file) {
  await page.evaluate((one) => {
    const app = window.periplus;
    if (!one.isEarly || app.displays.length !== one.with.length) {
      app.active.clear();
      app.active.isAutomatic = false;
      for (const [kind, values] of one.with) app.active.add(kind, '', values);
    }
    app.setFixedFrame('map');
    if (one.view) app.setView({ targetFrame: '<Fixed Frame>', ...one.view });
  }, shot);
  await page.waitForTimeout(1600);
  if (shot.waitsFor) {
    const words = ['waits for', shot.waitsFor];
    await page
      .waitForFunction(shot.waitsFor, undefined, { timeout: 40_000 })
      .catch(() => console.log(words.join(' ')));
    await page.waitForTimeout(300);
  }
  for (let i = 0; shot.says && i < 2; i++) {
    await page.evaluate(PUBLISHED[shot.says]);
    await page.waitForTimeout(1000);
  }
  if (shot.isPicture) {
    // At the scale of the browser.
    const data = await page.evaluate((width) => {
      const { canvas } = window.periplus.displays.find((d) => d.canvas);
      const small = document.createElement('canvas');
      [small.width, small.height] = [width, Math.round((width * canvas.height) / canvas.width)];
      small.getContext('2d').drawImage(canvas, 0, 0, small.width, small.height);
      return small.toDataURL();
    }, 374);
    writeFileSync(file, Buffer.from(data.split(',')[1], 'base64'));
  } else {
    const kind = shot.isDense ? { type: 'jpeg', quality: 82 } : {};
    await page.locator('section.stage').screenshot({ path: file, ...kind });
  }
  return aboutLast(page);
}

/** Class, title, types and options of the display that was added last. */
const aboutLast = (page) =>
  page.evaluate(() => {
    const entry = window.periplus.displays.at(-1);
    const all = Object.values(entry.statuses);
    const { kind } = entry;
    return {
      wrong: all.filter((s) => s.level !== 'ok').map((s) => s.text),
      title: kind.title,
      class: kind.class,
      types: kind.types,
      options: kind.options
        .filter((o) => o.kind !== 'note')
        .map(({ path, default: value, choices }) => ({ path, value, choices })),
    };
  });

async function run(chrome, url, words, wanted, folder, early) {
  const found = new Map();
  const program = await periplus([...words, `--page=127.0.0.1:${PORT}`], PORT);
  try {
    const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`, {
      viewport: SIZE,
    });
    await page.addStyleTag({ content: BARE });
    await page.waitForFunction(
      'periplus.displays.length > 3 && periplus.tf.has("map")',
      undefined,
      { timeout: 60_000 },
    );
    await early?.(page);
    for (const { kind, shots } of wanted) {
      for (const [name, shot] of Object.entries(shots)) {
        const about = await look(page, shot, join(folder, fileOf(name, shot)));
        for (const text of about.wrong) console.log(`${name}: ${text}`);
        found.set(kind, about);
      }
      if (Object.keys(shots).length > 0) continue;
      await page.evaluate((one) => void window.periplus.active.add(one), kind);
      found.set(kind, await aboutLast(page));
    }
    for (const text of complaints) console.log(text);
    await page.close();
  } finally {
    await program.stop();
  }
  return found;
}

/** Options in one line, without RViz's QoS options, which are described once for all displays. */
function optionsOf({ options }) {
  const isQos = /\/(Depth|History Policy|Reliability Policy|Durability Policy|Filter size)$/;
  return options
    .filter(({ path }) => !isQos.test(path))
    .map(({ path, value, choices }) => {
      const name = path.replaceAll('/', ' › ');
      if (choices)
        return `**${name}** ${choices.map((c) => (c === value ? `\`${c}\`` : c)).join(' / ')}`;
      return `**${name}**${value === '' ? '' : ` \`${value}\``}`;
    })
    .join(', ');
}

function page(about) {
  const parts = [...DISPLAYS, ...WITHOUT_PICTURE].map(({ kind, text, shots }) => {
    const { title, types, class: name } = about.get(kind);
    const images = Object.entries(shots).map(
      ([name, shot]) =>
        `<img src="pictures/displays/${fileOf(name, shot)}" width="32%" alt="${title}: ${name.replaceAll('_', ' ')}">`,
    );
    const shown = types.length > 0 ? ` shows \`${types.join('`, `')}\`.` : '';
    const shownAs = images.length > 0 ? `${images.join('\n')}\n\n` : '';
    return `## ${title}\n\n${shownAs}${text}\n\n\`${name}\`${shown} Options: ${optionsOf(about.get(kind))}.\n`;
  });
  return `# Displays

All pictures show running examples, in a browser without a GPU. \`npm run pictures\` in \`viewer/\` takes the pictures
and writes this page.

Displays appear when their topics do, and can be added by topic or by type. Names, options and defaults are those of
RViz: \`.rviz\` files of ROS 1 and ROS 2 can be opened here, and saved files can be opened in RViz; entries that the page
does not know are kept. Each topic has RViz's QoS options. They are kept for files only: subscriptions of the page
always get a compatible QoS, and the last message of a latched topic is always delivered.

${parts.join('\n')}`;
}

/** Writes docs/displays.md and its pictures. */
export async function displays(chrome, url, out) {
  const folder = join(out, 'displays');
  mkdirSync(folder, { recursive: true });
  const scratch = mkdtempSync(join(tmpdir(), 'periplus-show-'));
  try {
    const words = ['demo', '--headless', '--duration', '90', '--out', scratch];
    execFileSync(PROGRAM, words, { cwd: ROOT, stdio: 'ignore' });
    const isDemo = (one) => one.run === 'demo';
    const rest = [...DISPLAYS.filter((one) => !isDemo(one)), ...WITHOUT_PICTURE];
    const show = SHOWROOM(join(scratch, 'map.yaml'));
    const about = await run(chrome, url, show, rest, folder);
    const early = DISPLAYS.flatMap(({ shots }) => Object.values(shots)).find((s) => s.isEarly);
    const order = DISPLAYS.filter(isDemo).sort(
      (a, b) =>
        Number(!!Object.values(b.shots)[0].isEarly) - Number(!!Object.values(a.shots)[0].isEarly),
    );
    const demo = ['demo', '--no-browser', '--explore'];
    const more = await run(chrome, url, demo, order, folder, async (tab) => {
      await tab.evaluate((shot) => {
        const app = window.periplus;
        app.active.clear();
        app.active.isAutomatic = false;
        for (const [kind, values] of shot.with) app.active.add(kind, '', values);
      }, early);
      await tab.waitForTimeout(Number(process.env.DEMO_MS ?? 20_000));
    });
    for (const [kind, found] of more) about.set(kind, found);
    writeFileSync(join(ROOT, 'docs/displays.md'), page(about));
  } finally {
    rmSync(scratch, { recursive: true });
  }
}
