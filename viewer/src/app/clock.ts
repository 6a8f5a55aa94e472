/** Time of the messages, and how fast it goes beside the wall's. */

const WINDOW_MS = 1500;

export class Clock {
  nowS = 0;
  /** Simulated seconds per second; none while too little is known. */
  factor?: number;
  private heard: { wallMs: number; timeS: number }[] = [];

  /** Whether time went back. */
  set(timeS: number, wallMs: number): boolean {
    const isBack = timeS < this.nowS - 1e-6;
    this.nowS = timeS;
    if (isBack) this.heard = [];
    this.heard.push({ wallMs, timeS });
    while (this.heard.length > 2 && this.heard[0]!.wallMs < wallMs - WINDOW_MS) this.heard.shift();
    const first = this.heard[0]!;
    const span = wallMs - first.wallMs;
    if (span > 300) this.factor = ((timeS - first.timeS) * 1000) / span;
    return isBack;
  }

  /** Whether time stands still: nothing was heard for a while, or always the same. */
  isStill(wallMs: number): boolean {
    const last = this.heard[this.heard.length - 1];
    if (!last) return true;
    const moved = this.heard.find((h) => h.timeS === last.timeS) ?? last;
    return wallMs - moved.wallMs > 600;
  }
}
