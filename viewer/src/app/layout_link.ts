/** Links that hold a layout: JSON, deflated, in the part of the address that browsers do not send. */
import { readLayout, writeLayout, type Layout } from './layout';

const KEY = 'view';
/** Longest link [characters]: longer ones are cut by mail and chat programs. */
export const MAX_LINK_LENGTH = 16_000;
/** Largest layout in a link, unpacked, against hostile links [bytes]. */
const MAX_BYTES = 1_000_000;

export interface Shared {
  layout: Layout;
  /** Time of a replay that is shown [s]. */
  timeS?: number;
}

async function bytesOf(stream: ReadableStream<Uint8Array>, limit: number): Promise<Uint8Array> {
  const parts: Uint8Array[] = [];
  let length = 0;
  const reader = stream.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > limit) {
      await reader.cancel();
      throw new Error(`The layout in the link is larger than ${limit / 1e6} MB`);
    }
    parts.push(value);
  }
  const all = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

const through = (bytes: Uint8Array, stream: GenericTransformStream) =>
  new Blob([bytes as Uint8Array<ArrayBuffer>])
    .stream()
    .pipeThrough(stream as ReadableWritablePair<Uint8Array, Uint8Array<ArrayBuffer>>);

function toBase64Url(bytes: Uint8Array): string {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

function fromBase64Url(text: string): Uint8Array {
  const plain = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
  return Uint8Array.from(plain, (c) => c.charCodeAt(0));
}

/** Address of the page with the layout in its hash. */
export async function linkOf(page: string, { layout, timeS }: Shared): Promise<string> {
  const text = JSON.stringify(writeLayout(layout));
  const packed = through(new TextEncoder().encode(text), new CompressionStream('deflate-raw'));
  const url = new URL(page);
  url.searchParams.delete('token');
  const time = timeS === undefined ? '' : `&t=${timeS}`;
  url.hash = `${KEY}=${toBase64Url(await bytesOf(packed, MAX_BYTES))}${time}`;
  return url.href;
}

/** Layout in the hash of an address; `undefined` without one. Throws an error with the reason if it is broken. */
export async function sharedIn(hash: string): Promise<Shared | undefined> {
  const parts = new URLSearchParams(hash.replace(/^#/, ''));
  const packed = parts.get(KEY);
  if (packed === null) return undefined;
  const plain = through(fromBase64Url(packed), new DecompressionStream('deflate-raw'));
  const text = new TextDecoder().decode(await bytesOf(plain, MAX_BYTES));
  const time = Number(parts.get('t') ?? NaN);
  const layout = readLayout(JSON.parse(text));
  return { layout, timeS: Number.isFinite(time) ? time : undefined };
}
