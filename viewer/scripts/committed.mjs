// Checks that the committed page equals the present build. Contents are compared, not compressed bytes, which
// differ between versions of brotli.
import { execFileSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliDecompressSync } from 'node:zlib';
import { checkWeight } from './weight.mjs';

const ROOT = fileURLToPath(new URL('../..', import.meta.url));
const PAGE = 'crates/transports/web/page';
const git = (...words) => execFileSync('git', words, { cwd: ROOT, maxBuffer: 1 << 28 });
const content = (name, bytes) => (name.endsWith('.br') ? brotliDecompressSync(bytes) : bytes);

const files = (folder) =>
  readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? files(path) : [relative(ROOT, path)];
  });

const committed = git('ls-tree', '-r', '--name-only', 'HEAD', PAGE)
  .toString()
  .split('\n')
  .filter(Boolean);
const built = files(join(ROOT, PAGE));
const differs = (name) => {
  if (!committed.includes(name) || !existsSync(join(ROOT, name))) return true;
  const before = content(name, git('show', `HEAD:${name}`));
  return !before.equals(content(name, readFileSync(join(ROOT, name))));
};
const different = [...new Set([...committed, ...built])].sort().filter(differs);
if (different.length > 0) {
  console.error(`not as committed:\n  ${different.join('\n  ')}`);
  process.exit(1);
}
checkWeight(join(ROOT, PAGE));
