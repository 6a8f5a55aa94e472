import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { de } from '../src/texts/de';
import { en } from '../src/texts/en';

const SRC = join(__dirname, '../src');
const files = (readdirSync(SRC, { recursive: true }) as string[]).map((name) =>
  name.replaceAll('\\', '/'),
);
const read = (name: string) => readFileSync(join(SRC, name), 'utf8');

/** Names of ROS, Gazebo and RViz, and commands that are typed as they are. */
const NAMES = [
  'Visualize Lidar',
  'Key Publisher',
  '2D Goal Pose',
  'Fixed Frame',
  'periplus sim WORLD --robot FILE --navigation --page',
];

/** Paths of all texts: "section.key", and those below a key. */
function paths(tree: object, prefix = ''): string[] {
  return Object.entries(tree).flatMap(([key, value]) =>
    value !== null && typeof value === 'object'
      ? paths(value as object, `${prefix}${key}.`)
      : [`${prefix}${key}`],
  );
}

describe('texts', () => {
  test('all languages have the same keys', () => {
    expect(paths(de).sort()).toEqual(paths(en).sort());
  });

  test('every text is used', () => {
    const codes = files
      .filter((name) => /\.(ts|svelte)$/.test(name) && !/^texts\/(en|de)\.ts$/.test(name))
      .map(read);
    const code = codes.join('\n');
    const isUsed = (path: string) => {
      const [section = '', key = ''] = path.split('.');
      const named = new RegExp(`\\.${section}\\s*\\.\\s*${key}\\b`);
      if (named.test(code) || new RegExp(`\\.${section}\\s*\\[`).test(code)) return true;
      // A file that takes a whole section reads its texts by another name.
      const whole = new RegExp(`t\\(\\)\\.${section}\\b(?!\\s*[.[])`);
      const short = new RegExp(`\\.${key}\\b|[\\w)]\\[`);
      return codes.some((one) => whole.test(one) && short.test(one));
    };
    expect(paths(en).filter((path) => !isUsed(path))).toEqual([]);
    // Reads all sources for each text: slow beside other programs.
  }, 60_000);
});

/** Literal texts of more than one word in the markup of a component. */
export function literals(component: string): string[] {
  const markup = component
    .replace(/<(script|style)\b[\s\S]*?<\/\1>/g, '')
    .replace(/<!--[\s\S]*?-->/g, '');
  const out: string[] = [];
  const add = (text: string) => {
    const words = text
      .replace(/&\w+;|\b(Ctrl|Shift|Alt|Del)\b/g, ' ')
      .replace(/\s+/g, ' ')
      .trim();
    if (/\p{L}{2,}[,.;:]? \p{L}{2,}/u.test(words)) out.push(words);
  };
  // Text outside of tags and expressions, quoted attributes, and strings in expressions.
  let text = '';
  let depth = 0;
  let isTag = false;
  for (let i = 0; i < markup.length; i++) {
    const c = markup[i]!;
    if (depth === 0 && !isTag && c === '<' && /[a-zA-Z/]/.test(markup[i + 1] ?? '')) {
      add(text);
      text = '';
      isTag = true;
    } else if (isTag && depth === 0 && c === '>') isTag = false;
    else if (isTag && depth === 0 && c === '"') {
      const end = markup.indexOf('"', i + 1);
      const before = /([\w-]+)=$/.exec(markup.slice(0, i))?.[1] ?? '';
      if (/^(aria-label|title|placeholder|alt)$/.test(before)) {
        add(markup.slice(i + 1, end).replace(/\{[^}]*\}/g, ';'));
      }
      i = end;
    } else if (c === '{') {
      if (depth++ === 0) add(text);
      text = '';
    } else if (c === '}' && depth > 0) depth--;
    else if (depth > 0 && (c === "'" || c === '`')) {
      const end = markup.indexOf(c, i + 1);
      const quoted = markup.slice(i + 1, end);
      if (/^\p{Lu}/u.test(quoted)) add(quoted);
      i = end;
    } else if (depth === 0 && !isTag) text += c;
  }
  add(text);
  return out;
}

describe('markup', () => {
  test('literal texts are found in text, attributes and expressions', () => {
    expect(literals('<p>Two words</p>')).toEqual(['Two words']);
    expect(literals('<b title="No such file" onclick={(e) => a > b}>{t().a.b}</b>')).toEqual([
      'No such file',
    ]);
    expect(literals("{x ? 'Nothing here' : t().a.b}")).toEqual(['Nothing here']);
    expect(literals('<script>const a = "two words here"</script><p>One</p>')).toEqual([]);
  });

  test('components have no literal texts', () => {
    const found = files
      .filter((name) => name.endsWith('.svelte'))
      .flatMap((name) => literals(read(name)).map((text) => `${name}: ${text}`))
      .filter((line) => !NAMES.some((name) => line.endsWith(`: ${name}`)));
    expect(found).toEqual([]);
  });
});
