/** Mapping of a log in memory, in slices between which the page shows its progress or cancels. */
import type { Host } from './host.svelte';

/** Wall time of a slice [ms]. */
const SLICE_MS = 200;
/** Time between two pictures of the map [ms]. */
const PREVIEW_MS = 2000;

interface Progress {
  phase: 'mapping' | 'finishing' | 'complete';
  fraction: number;
}

/** Part of the host that the job uses; tests replace it. */
export type Caller = Pick<Host, 'call' | 'callBytes'>;

export class MapJob {
  fraction = $state(0);
  /** Picture of the present map, as an address. */
  preview = $state('');
  /** Report of the complete map. */
  text = $state('');
  isRunning = $state(true);
  private isCancelled = false;

  constructor(
    private host: Caller,
    readonly log: string,
    readonly out: string,
  ) {}

  cancel(): void {
    this.isCancelled = true;
  }

  async run(): Promise<void> {
    try {
      await this.host.call('map_open', { log: this.log, out: this.out });
      try {
        if (await this.steps()) await this.finish();
      } finally {
        await this.host.call('map_close');
      }
    } finally {
      this.isRunning = false;
    }
  }

  /** True once the map is complete, false if the job was cancelled. */
  private async steps(): Promise<boolean> {
    let drawnMs = performance.now();
    while (!this.isCancelled) {
      const { phase, fraction } = await this.host.call<Progress>('map_step', {
        budget_ms: SLICE_MS,
      });
      this.fraction = fraction;
      if (phase === 'complete') return true;
      if (performance.now() - drawnMs < PREVIEW_MS) continue;
      await this.draw();
      drawnMs = performance.now();
    }
    return false;
  }

  private async finish(): Promise<void> {
    const { text, failure } = await this.host.call<{ text: string; failure?: string | null }>(
      'map_write',
    );
    this.text = text;
    await this.draw();
    if (failure) throw new Error(failure);
  }

  private async draw(): Promise<void> {
    const png = await this.host.callBytes('map_preview');
    if (this.preview) URL.revokeObjectURL(this.preview);
    this.preview = URL.createObjectURL(new Blob([png], { type: 'image/png' }));
  }
}
