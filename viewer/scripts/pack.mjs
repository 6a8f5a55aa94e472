// Compresses the built page with brotli at its highest level; the server sends the compressed files unchanged.
import { readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync, constants } from 'node:zlib';
import { checkWeight } from './weight.mjs';

const page = fileURLToPath(new URL('../../crates/transports/web/page', import.meta.url));

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
}
checkWeight(page);
