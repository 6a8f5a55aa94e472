/** Runs a session in the worker: steps in real time, takes messages from the page, and sends it frames. */
import type { Core } from '../../../crates/apps/tab/scripts/core.mjs';
import { sizeOf, type Data, type FromWorker } from './messages';

/** Wall time of steps before messages of the page are read [ms]. */
const BUDGET_MS = 8;
/**
 * Frames wait in the module while the page has not processed this much [bytes]. There the newest messages of a topic
 * replace older ones.
 */
export const MAX_IN_FLIGHT_BYTES = 2 << 20;
/** Frames of one message to the page. */
const BATCH_BYTES = 256 << 10;
const MEMORY_PERIOD_MS = 1000;

export interface Outside {
  post(message: FromWorker, transfer?: Transferable[]): void;
  /** Calls a function after this time [ms]; 0: after the messages that wait. */
  later(run: () => void, waitMs: number): void;
  nowMs(): number;
}

export type Runner = Pick<
  Core,
  'runPaced' | 'send' | 'take' | 'isBroken' | 'memoryBytes' | 'close'
>;

export class SessionLoop {
  private inFlightBytes = 0;
  private isOver = false;
  private memoryMs = -Infinity;

  constructor(
    readonly session: number,
    private core: Runner,
    private outside: Outside,
  ) {}

  start(): void {
    this.outside.post({ kind: 'opened', session: this.session });
    this.run();
  }

  stop(): void {
    if (this.isOver) return;
    this.isOver = true;
    if (!this.core.isBroken) this.core.close();
  }

  /** A message of the page to the session. */
  data(data: Data): void {
    this.guard(() => {
      this.core.send(data);
      this.outside.post({ kind: 'sent', session: this.session, bytes: sizeOf(data) });
      this.flush();
    });
  }

  /** The page has processed some of the frames. */
  received(bytes: number): void {
    this.inFlightBytes -= bytes;
    this.guard(() => this.flush());
  }

  private run(): void {
    this.guard(() => {
      const waitMs = this.core.runPaced(BUDGET_MS);
      this.flush();
      this.tellMemory();
      this.outside.later(() => this.run(), waitMs);
    });
  }

  private flush(): void {
    for (;;) {
      const frames: (string | ArrayBuffer)[] = [];
      const transfer: ArrayBuffer[] = [];
      let bytes = 0;
      let isEmpty = false;
      while (bytes < BATCH_BYTES && this.inFlightBytes + bytes < MAX_IN_FLIGHT_BYTES) {
        const frame = this.core.take();
        isEmpty = frame === null;
        if (frame === null) break;
        bytes += sizeOf(frame);
        if (typeof frame === 'string') frames.push(frame);
        else {
          frames.push(frame.buffer);
          transfer.push(frame.buffer);
        }
      }
      if (frames.length === 0) return;
      this.inFlightBytes += bytes;
      this.outside.post({ kind: 'frames', session: this.session, frames, bytes }, transfer);
      if (isEmpty) return;
    }
  }

  private tellMemory(): void {
    const nowMs = this.outside.nowMs();
    if (nowMs - this.memoryMs < MEMORY_PERIOD_MS) return;
    this.memoryMs = nowMs;
    this.outside.post({ kind: 'memory', bytes: this.core.memoryBytes });
  }

  /** An error ends the session. */
  private guard(work: () => void): void {
    if (this.isOver) return;
    try {
      work();
    } catch (error) {
      const why = (error as Error).message;
      const { isBroken } = this.core;
      this.stop();
      if (isBroken) this.outside.post({ kind: 'failed', why });
      else this.outside.post({ kind: 'ended', session: this.session, why });
    }
  }
}
