// Compresses the static page without a server with Brotli, beside its plain files: servers of static files choose
// between both. Prints what a browser receives before the first picture.
import { readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { brotliCompress, constants } from 'node:zlib';

const page = fileURLToPath(new URL('../../target/tab/page', import.meta.url));
/** Maximum size of the module [bytes]. */
const MAX_MODULE_BYTES = 6_000_000;
const compress = promisify(brotliCompress);

async function pack(name) {
  const bytes = readFileSync(join(page, name));
  const packed = await compress(bytes, {
    params: {
      [constants.BROTLI_PARAM_QUALITY]: 11,
      [constants.BROTLI_PARAM_LGWIN]: 24,
      [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length,
    },
  });
  writeFileSync(join(page, `${name}.br`), packed);
  return { name, plainBytes: bytes.length, bytes: packed.length };
}

const names = readdirSync(page, { recursive: true })
  .map(String)
  .filter((name) => statSync(join(page, name)).isFile() && !name.endsWith('.br'))
  .sort();
const packed = await Promise.all(names.map(pack));
const sum = (files) => files.reduce((bytes, file) => bytes + file.bytes, 0);
const modules = packed.filter(({ name }) => name.endsWith('.wasm'));
const others = packed.filter((file) => !modules.includes(file));
console.log(
  `module: ${sum(modules)} bytes with Brotli; page: ${sum(others)} bytes in ${others.length} files`,
);
if (sum(modules) > MAX_MODULE_BYTES) {
  console.error(`the module is larger than ${MAX_MODULE_BYTES} bytes`);
  process.exitCode = 1;
}
