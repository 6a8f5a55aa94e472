/** Playhead of a replay: position, rate and loop. Positions are nanoseconds after the start of the first recording. */

export const MIN_RATE = 0.01;
export const MAX_RATE = 100;
/** Longest time between two frames that is played [s]: after a pause of the page the replay goes on where it was. */
const MAX_FRAME_S = 1;

export interface Loop {
  fromNs: number;
  toNs: number;
}

export type Advance =
  | { kind: 'still' }
  /** Plays on to this position, as far as messages are there. */
  | { kind: 'to'; positionNs: number; isEnd: boolean }
  /** Goes back to the start of the loop. */
  | { kind: 'loop'; positionNs: number };

export class Playhead {
  positionNs = 0;
  isPlaying = false;
  loop?: Loop;
  private rateNow = 1;
  private lastMs?: number;

  constructor(
    public startNs: number,
    public endNs: number,
  ) {
    this.positionNs = startNs;
  }

  get rate(): number {
    return this.rateNow;
  }

  set rate(rate: number) {
    this.rateNow = Math.min(MAX_RATE, Math.max(MIN_RATE, rate));
  }

  clamped(positionNs: number): number {
    return Math.min(this.endNs, Math.max(this.startNs, positionNs));
  }

  /** Forgets the time of the last frame: nothing was played since. */
  hold(): void {
    this.lastMs = undefined;
  }

  /** Next position; `availableNs` is the position up to which messages were fetched. */
  advance(nowMs: number, availableNs: number): Advance {
    const last = this.lastMs;
    this.lastMs = nowMs;
    if (!this.isPlaying || last === undefined) return { kind: 'still' };
    const stepNs = Math.min(MAX_FRAME_S, Math.max(0, (nowMs - last) / 1000)) * this.rate * 1e9;
    const { loop } = this;
    const isInLoop = loop !== undefined && this.positionNs <= loop.toNs;
    const end = isInLoop ? Math.min(loop.toNs, this.endNs) : this.endNs;
    const wanted = Math.min(this.positionNs + stepNs, end);
    const positionNs = Math.min(wanted, Math.max(this.positionNs, availableNs));
    if (isInLoop && this.positionNs >= end) {
      return { kind: 'loop', positionNs: this.clamped(loop.fromNs) };
    }
    if (positionNs <= this.positionNs && !(this.positionNs >= end)) return { kind: 'still' };
    return { kind: 'to', positionNs, isEnd: !isInLoop && positionNs >= this.endNs };
  }
}
