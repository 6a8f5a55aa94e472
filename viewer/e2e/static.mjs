// A server of static files, for the page without a server and the documentation site.
import { createReadStream, existsSync, readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { gzipSync } from 'node:zlib';

const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
  '.json': 'application/json',
  '.wasm': 'application/wasm',
  '.png': 'image/png',
  '.woff2': 'font/woff2',
};

/**
 * Serves a folder on a free port. `isIsolated`: with the headers of a page that may use threads; `types`: other types of
 * files; `answer(path, response)`: true if it has answered a request itself; `sent(type, bytes)`: texts are compressed with
 * gzip, and this is told the size of each file as it is sent.
 */
export async function serveFolder(folder, { isIsolated = false, types = {}, answer, sent } = {}) {
  const kinds = { ...TYPES, ...types };
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname));
    if (answer?.(path, response)) return;
    const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
    if (!file.startsWith(folder) || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end();
      return;
    }
    const type = kinds[extname(file)] ?? 'application/octet-stream';
    if (sent) {
      const isText = /text|json|javascript|svg/.test(type);
      const body = isText ? gzipSync(readFileSync(file)) : readFileSync(file);
      sent(type, body.length);
      const encoding = isText ? { 'content-encoding': 'gzip' } : {};
      response.writeHead(200, { 'content-type': type, ...encoding }).end(body);
      return;
    }
    response.writeHead(200, {
      'content-type': type,
      'content-length': statSync(file).size,
      'cache-control': 'no-cache',
      ...(isIsolated && {
        'cross-origin-opener-policy': 'same-origin',
        'cross-origin-embedder-policy': 'require-corp',
      }),
    });
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, stop: () => server.close() };
}
