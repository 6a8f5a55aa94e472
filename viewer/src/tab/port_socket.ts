/** Connection of the client to the worker, in place of a WebSocket. */
import type { Socket } from '../core/client';
import { sizeOf, type FromWorker, type SessionOptions, type ToWorker } from './messages';

export type Post = (message: ToWorker, transfer?: Transferable[]) => void;

export class PortSocket implements Socket {
  binaryType = 'arraybuffer';
  readyState = 0;
  bufferedAmount = 0;
  /** After its end the user starts again: an error would only come back. */
  readonly reopens = false;
  onopen: Socket['onopen'] = null;
  onclose: Socket['onclose'] = null;
  onerror: Socket['onerror'] = null;
  onmessage: Socket['onmessage'] = null;

  constructor(
    readonly session: number,
    options: SessionOptions,
    private post: Post,
  ) {
    post({ kind: 'open', session, options });
  }

  send(data: string | Uint8Array<ArrayBuffer>): void {
    if (this.readyState !== 1) return;
    const { session } = this;
    this.bufferedAmount += sizeOf(data);
    if (typeof data === 'string') {
      this.post({ kind: 'data', session, data });
      return;
    }
    // A buffer is moved, not copied; a part of one would move all of it.
    const own = data.byteLength === data.buffer.byteLength ? data : data.slice();
    this.post({ kind: 'data', session, data: own }, [own.buffer]);
  }

  close(): void {
    if (this.readyState === 3) return;
    this.readyState = 3;
    this.post({ kind: 'close', session: this.session });
  }

  /** A message of the worker. */
  receive(message: FromWorker): void {
    if ('session' in message && message.session !== this.session) return;
    if (this.readyState === 3) return;
    switch (message.kind) {
      case 'opened':
        this.readyState = 1;
        this.onopen?.(undefined as never);
        break;
      case 'frames':
        try {
          for (const data of message.frames) this.onmessage?.({ data });
        } finally {
          const { session, bytes } = message;
          this.post({ kind: 'received', session, bytes });
        }
        break;
      case 'sent':
        this.bufferedAmount -= message.bytes;
        break;
      case 'ended':
      case 'failed':
        this.readyState = 3;
        this.onclose?.({ reason: message.why } as never);
        break;
    }
  }
}
