/** Time of the messages, how fast it goes beside the wall's, and whether it stands still. */

const WINDOW_MS = 1500;
const STILL_MS = 1000;
/** A rate over less than this is noise. */
const MIN_SPAN_MS = 1000;

/** What a simulation says of its own time (`/world/<w>/stats`). */
export interface Stats {
  timeS: number;
  /** Wall time that it ran, without pauses. */
  realS: number;
  isPaused: boolean;
}

export class Clock {
  nowS = 0;
  private heard: { wallMs: number; timeS: number }[] = [];
  private stats: Stats[] = [];

  /** Whether time went back. */
  set(timeS: number, wallMs: number): boolean {
    const isBack = timeS < this.nowS - 1e-6;
    this.nowS = timeS;
    if (isBack) this.heard = [];
    this.heard.push({ wallMs, timeS });
    while (this.heard.length > 2 && this.heard[0]!.wallMs < wallMs - WINDOW_MS) this.heard.shift();
    return isBack;
  }

  setStats(stats: Stats): void {
    const last = this.stats[this.stats.length - 1];
    if (last && (stats.timeS < last.timeS || stats.realS < last.realS)) this.stats = [];
    this.stats.push(stats);
    const from = stats.realS - WINDOW_MS / 1000;
    while (this.stats.length > 2 && this.stats[1]!.realS < from) this.stats.shift();
  }

  /** Nobody says any more how the simulation is: another one is at the other end. */
  forgetStats(): void {
    this.stats = [];
  }

  /** Simulated seconds per second; none while too little is known. */
  factor(): number | undefined {
    const measured = this.stats.map(({ timeS, realS }) => ({ timeS, wallMs: realS * 1000 }));
    const all = this.stats.length > 0 ? measured : this.heard;
    const [first, last] = [all[0], all[all.length - 1]];
    if (!first || !last || last.wallMs - first.wallMs < MIN_SPAN_MS) return undefined;
    return ((last.timeS - first.timeS) * 1000) / (last.wallMs - first.wallMs);
  }

  /**
   * Whether time stands still. A simulation says so itself; of others it is guessed: within a while
   * time changed at most once, by a single step.
   */
  isPaused(wallMs: number): boolean {
    const told = this.stats[this.stats.length - 1];
    if (told) return told.isPaused;
    const recent = this.heard.filter((h) => h.wallMs > wallMs - STILL_MS);
    return new Set(recent.map((h) => h.timeS)).size < 3;
  }
}
