/** The WebAssembly module: received with progress, and compiled at the same time. */
import { Core } from '../../../crates/apps/tab/scripts/core.mjs';

const TYPE = 'application/wasm';

/** Response with the same bytes, which reports how many have been received. */
function counted(response: Response, progress: (receivedBytes: number) => void): Response {
  let receivedBytes = 0;
  const counter = new TransformStream<Uint8Array, Uint8Array>({
    transform(chunk, out) {
      receivedBytes += chunk.byteLength;
      progress(receivedBytes);
      out.enqueue(chunk);
    },
  });
  // Servers that do not know the type send another one, which would not be compiled while it is received.
  return new Response(response.body!.pipeThrough(counter), { headers: { 'content-type': TYPE } });
}

export async function loadModule(
  url: string,
  progress: (receivedBytes: number) => void,
): Promise<Core> {
  if (typeof WebAssembly !== 'object') throw new Error('this browser has no WebAssembly');
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`.trim());
  const body = counted(response, progress);
  if (typeof WebAssembly.instantiateStreaming === 'function') return Core.start(body);
  return Core.start(await body.arrayBuffer());
}
