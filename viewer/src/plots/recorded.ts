/** Values of fields over time, fetched from a recording. */
import type { ReplayControl, Series } from '../app/replay_control';
import { type FieldRef, type Samples } from './expression';
import type { Span } from './time_chart';

interface Loaded {
  /** What was asked for. */
  key: string;
  paths: string[];
  series?: Series;
}

interface Wish {
  key: string;
  paths: string[];
  span: Span;
}

const EMPTY: Samples = { times: [], values: [] };

/** Series of the topics of a recording. Of each topic one request is pending, and the newest wish follows it. */
export class RecordedSeries {
  private topics = new Map<string, Loaded>();
  private busy = new Set<string>();
  private wishes = new Map<string, Wish>();

  constructor(
    private points: number,
    private events: { loaded(): void; failed(topic: string, why: string): void },
  ) {}

  /** Loads fields for a span of time; what was loaded before stays until then. */
  load(replay: Pick<ReplayControl, 'series'>, refs: readonly FieldRef[], span: Span): void {
    const byTopic = new Map<string, Set<string>>();
    for (const { topic, path } of refs) {
      const paths = byTopic.get(topic) ?? new Set();
      byTopic.set(topic, paths.add(path));
    }
    for (const topic of this.topics.keys()) if (!byTopic.has(topic)) this.topics.delete(topic);
    for (const [topic, set] of byTopic) {
      const paths = [...set].sort();
      const key = JSON.stringify([paths, span.fromS, span.toS]);
      if (this.topics.get(topic)?.key === key) continue;
      this.wishes.set(topic, { key, paths, span });
      if (!this.busy.has(topic)) void this.fetch(replay, topic);
    }
  }

  private async fetch(replay: Pick<ReplayControl, 'series'>, topic: string): Promise<void> {
    this.busy.add(topic);
    for (let wish = this.wish(topic); wish; wish = this.wish(topic)) {
      const { key, paths, span } = wish;
      const before = this.topics.get(topic);
      // Noted before the answer: the same wish is not sent twice, also if it fails.
      this.topics.set(topic, { key, paths: before?.paths ?? paths, series: before?.series });
      try {
        const series = await replay.series(topic, paths, span.fromS, span.toS, this.points);
        this.topics.set(topic, { key, paths, series });
        this.events.loaded();
      } catch (error) {
        this.events.failed(topic, (error as Error).message);
      }
    }
    this.busy.delete(topic);
  }

  private wish(topic: string): Wish | undefined {
    const wish = this.wishes.get(topic);
    this.wishes.delete(topic);
    return wish;
  }

  samples({ topic, path }: FieldRef): Samples {
    const loaded = this.topics.get(topic);
    const values = loaded?.series?.values[loaded.paths.indexOf(path)];
    return values ? { times: loaded!.series!.timesS, values } : EMPTY;
  }

  /** True if a series has fewer points than the recording. */
  get isReduced(): boolean {
    return [...this.topics.values()].some(({ series }) => series?.isReduced);
  }

  clear(): void {
    this.topics.clear();
    this.wishes.clear();
  }
}
