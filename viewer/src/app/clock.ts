/** Time of the messages, real time factor, and pause state. */

const WINDOW_MS = 1500;
const STILL_MS = 1000;
/** Shortest wall time over which a rate is computed [ms]. */
const MIN_SPAN_MS = 1000;

/** Time and pause state of a simulation (`/world/<w>/stats`). */
export interface Stats {
  timeS: number;
  /** Wall time that the simulation ran, without pauses. */
  realS: number;
  isPaused: boolean;
}

export class Clock {
  nowS = 0;
  private samples: { wallMs: number; timeS: number }[] = [];
  private stats: Stats[] = [];

  /** Returns true if time jumped back. */
  set(timeS: number, wallMs: number): boolean {
    const isBack = timeS < this.nowS - 1e-6;
    this.nowS = timeS;
    if (isBack) this.samples = [];
    this.samples.push({ wallMs, timeS });
    while (this.samples.length > 2 && this.samples[0]!.wallMs < wallMs - WINDOW_MS)
      this.samples.shift();
    return isBack;
  }

  setStats(stats: Stats): void {
    const last = this.stats[this.stats.length - 1];
    if (last && (stats.timeS < last.timeS || stats.realS < last.realS)) this.stats = [];
    this.stats.push(stats);
    const from = stats.realS - WINDOW_MS / 1000;
    while (this.stats.length > 2 && this.stats[1]!.realS < from) this.stats.shift();
  }

  /** Drops the simulation's statistics, after a reconnection. */
  forgetStats(): void {
    this.stats = [];
  }

  /** Real time factor: simulated seconds per second; `undefined` while the samples span too little time. */
  factor(): number | undefined {
    const measured = this.stats.map(({ timeS, realS }) => ({ timeS, wallMs: realS * 1000 }));
    const all = this.stats.length > 0 ? measured : this.samples;
    const [first, last] = [all[0], all[all.length - 1]];
    if (!first || !last || last.wallMs - first.wallMs < MIN_SPAN_MS) return undefined;
    return ((last.timeS - first.timeS) * 1000) / (last.wallMs - first.wallMs);
  }

  /**
   * True while time is paused. A simulation publishes its pause state; otherwise time counts as paused if it
   * changed at most once, by a single step, within the window.
   */
  isPaused(wallMs: number): boolean {
    const latest = this.stats[this.stats.length - 1];
    if (latest) return latest.isPaused;
    const recent = this.samples.filter((h) => h.wallMs > wallMs - STILL_MS);
    return new Set(recent.map((h) => h.timeS)).size < 3;
  }
}
