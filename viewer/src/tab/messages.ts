/** Messages between the page and the worker with the simulator. */
import type { MemoryFile, SessionOptions } from '../../../crates/apps/tab/scripts/core.mjs';

export type { MemoryFile, SessionOptions };

/** Message of the session's client, as on a WebSocket. */
export type Data = string | Uint8Array<ArrayBuffer>;

/** Work on the files in the memory of the module, and its functions. */
export type Request =
  | { op: 'call'; name: string; args: object }
  | { op: 'list'; folder: string }
  | { op: 'read'; path: string }
  | { op: 'write'; path: string; content: Uint8Array<ArrayBuffer> }
  | { op: 'remove'; path: string };

/** From the page. `session` counts the sessions: messages of an earlier one have no effect. */
export type ToWorker =
  | { kind: 'load'; url: string }
  | { kind: 'open'; session: number; options: SessionOptions }
  | { kind: 'close'; session: number }
  | { kind: 'data'; session: number; data: Data }
  /** The page has processed this many bytes. */
  | { kind: 'received'; session: number; bytes: number }
  | { kind: 'request'; id: number; request: Request };

/** From the worker. */
export type FromWorker =
  | { kind: 'progress'; receivedBytes: number }
  | { kind: 'loaded' }
  | { kind: 'opened'; session: number }
  | { kind: 'frames'; session: number; frames: (string | ArrayBuffer)[]; bytes: number }
  /** The module has processed this many bytes of the page. */
  | { kind: 'sent'; session: number; bytes: number }
  | { kind: 'ended'; session: number; why: string }
  /** The module cannot be used: it was not loaded, or it has panicked. */
  | { kind: 'failed'; why: string }
  | { kind: 'memory'; bytes: number }
  | { kind: 'answer'; id: number; result: MemoryFile[] | Uint8Array<ArrayBuffer> | undefined }
  | { kind: 'refusal'; id: number; why: string };

/** Size of a message as both sides count it. */
export const sizeOf = (data: string | { byteLength: number }): number =>
  typeof data === 'string' ? data.length : data.byteLength;
