// Size of the page as it is sent: the sum of its compressed files, and its limit.
import { readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';

/** Maximum of all files together [bytes]: three seconds on a robot's Wi-Fi of 1.2 Mbit/s. */
const MAX_PAGE_BYTES = 450_000;

/** Prints the size of a folder; fails above the limit, with the largest files. */
export function checkWeight(page) {
  const files = readdirSync(page, { recursive: true })
    .map((name) => ({ name: String(name), stat: statSync(join(page, String(name))) }))
    .filter(({ stat }) => stat.isFile())
    .map(({ name, stat }) => ({ name, bytes: stat.size }))
    .sort((a, b) => b.bytes - a.bytes);
  const bytes = files.reduce((sum, file) => sum + file.bytes, 0);
  console.log(`page: ${bytes} bytes in ${files.length} files; the limit is ${MAX_PAGE_BYTES}`);
  if (bytes <= MAX_PAGE_BYTES) return;
  const largest = files.slice(0, 8).map((file) => `  ${file.bytes} ${file.name}`);
  console.error(
    `the page is ${bytes - MAX_PAGE_BYTES} bytes too large; its largest files are:\n${largest.join('\n')}\n` +
      'leave something out, or load it from the server: see "Size" in README.md',
  );
  process.exitCode = 1;
}
