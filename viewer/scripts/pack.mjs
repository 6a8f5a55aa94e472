// Compresses the built page with brotli at its highest level; the server sends the compressed files unchanged.
import { readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync, constants } from 'node:zlib';

const page = fileURLToPath(new URL('../../crates/transports/web/page', import.meta.url));
const total = { raw: 0, packed: 0, first: 0 };

for (const name of readdirSync(page, { recursive: true }).map(String).sort()) {
  const path = join(page, name);
  if (statSync(path).isDirectory() || name.endsWith('.br')) continue;
  const bytes = readFileSync(path);
  const packed = brotliCompressSync(bytes, {
    params: {
      [constants.BROTLI_PARAM_QUALITY]: 11,
      [constants.BROTLI_PARAM_LGWIN]: 22,
      [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length,
    },
  });
  writeFileSync(`${path}.br`, packed);
  rmSync(path);
  total.raw += bytes.length;
  total.packed += packed.length;
}
console.log(`page: ${total.raw} bytes, ${total.packed} packed with brotli`);
