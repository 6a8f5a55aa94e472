/** Time of the messages, and how fast it goes beside the wall's. */

const WINDOW_MS = 1500;
const STILL_MS = 1000;

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

  /** Whether time stands still: within a while it changed at most once, by a single step. */
  isStill(wallMs: number): boolean {
    const recent = this.heard.filter((h) => h.wallMs > wallMs - STILL_MS);
    return new Set(recent.map((h) => h.timeS)).size < 3;
  }
}
