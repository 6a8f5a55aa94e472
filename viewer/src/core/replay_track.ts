/** One recording on the timeline: its topics, and the messages after the playhead that were fetched ahead. */
import { decoder, type Message } from './cdr';
import type { Channel, Recording, RecordingTopic, StoredMessage } from './protocol';
import type { RecordingRequests, TopicNeed } from './replay_requests';
import { rebaseOf } from './replay_rebase';
import { parseSchema } from './schema';

/** Messages fetched ahead, in seconds of playing. */
const AHEAD_S = 2;
/** Shortest span that is fetched ahead [ns of the recording]. */
const MIN_AHEAD_NS = 2e8;
const MAX_AHEAD_BYTES = 16 << 20;
const FETCH_BYTES = 2 << 20;
/** Bytes per second of playing above which the largest topics are sampled. */
const MAX_BYTES_PER_S = 24 << 20;
/** Size of a message before one was received [bytes]. */
const GUESSES: [RegExp, number][] = [
  [/\/Image$/, 900_000],
  [/\/PointCloud2$/, 800_000],
  [/\/CompressedImage$/, 80_000],
  [/\/OccupancyGrid$/, 200_000],
  [/\/MarkerArray$/, 20_000],
];
const SMALL_BYTES = 500;

const TF = 'tf2_msgs/msg/TFMessage';
/** Types whose state is made of many messages: the server sends those that matter at a time. */
const MARKERS = ['visualization_msgs/msg/Marker', 'visualization_msgs/msg/MarkerArray'];

/** Topic of a recording with the prefix of its track. */
export class StoredTopic {
  readonly name: string;
  readonly isTf: boolean;
  private readonly isMarkers: boolean;
  /** Position of the message that was delivered last [ns]. */
  lastNs = -Infinity;
  /** True while only the newest message is fetched now and then: there are more bytes than can be shown. */
  isSampled = false;
  private bytes = 0;
  private count = 0;
  private decode?: (bytes: Uint8Array) => Message;
  private isBroken = false;

  constructor(
    readonly track: Track,
    readonly info: RecordingTopic,
  ) {
    this.name = track.prefix + info.topic;
    this.isTf = info.schemaName === TF;
    this.isMarkers = MARKERS.includes(info.schemaName);
  }

  /** Topics of which no message is ever skipped. */
  get isComplete(): boolean {
    return this.isTf || this.isMarkers || this.info.isLatched;
  }

  /** Bytes per second of the recording, from the messages so far. */
  bytesPerS(): number {
    const guess = GUESSES.find(([type]) => type.test(this.info.schemaName))?.[1] ?? SMALL_BYTES;
    const size = this.count > 0 ? this.bytes / this.count : guess;
    return (size * this.info.count) / Math.max(1, this.track.durationNs * 1e-9);
  }

  channel(): Channel {
    const { id, encoding, schemaName, schema, schemaEncoding } = this.info;
    return { id, topic: this.name, encoding, schemaName, schema, schemaEncoding };
  }

  /** Decoded message; `undefined` after `failed` was called, once per topic. */
  read(data: Uint8Array, failed: (text: string) => void): Message | undefined {
    this.bytes += data.length;
    this.count++;
    try {
      this.decode ??= this.compile();
      return this.decode(data);
    } catch (error) {
      if (!this.isBroken) failed(`${this.name}: ${(error as Error).message}`);
      this.isBroken = true;
      return undefined;
    }
  }

  private compile(): (bytes: Uint8Array) => Message {
    const { encoding, schemaName, schema: text } = this.info;
    if (encoding !== 'cdr') {
      throw new Error(`the encoding is ${encoding}; this page decodes only CDR`);
    }
    const schema = parseSchema(schemaName, text);
    const decode = decoder(schema);
    const { track } = this;
    if (!track.prefix) return decode;
    const rebase = rebaseOf(schema);
    return (bytes) => {
      const message = decode(bytes);
      rebase?.(message, track.prefix, track.shiftNs);
      return message;
    };
  }
}

/** Message on the timeline. */
export interface Placed {
  topic: StoredTopic;
  atNs: number;
  data: Uint8Array;
}

export class Track {
  readonly topics = new Map<number, StoredTopic>();
  readonly startNs: bigint;
  readonly durationNs: number;
  /** The messages up to this position are fetched [ns]. */
  reachedNs = 0;
  private ahead: Placed[] = [];
  private aheadBytes = 0;
  private fetching?: AbortController;

  constructor(
    readonly recording: Recording,
    /** Prefix of topics and frames: empty for the first recording. */
    readonly prefix: string,
    /** Start of the first recording: position 0. */
    private originNs: bigint,
    /** Position at which this recording starts [ns]. */
    public beginNs: number,
    private requests: RecordingRequests,
  ) {
    this.startNs = BigInt(recording.startNs);
    this.durationNs = Number(BigInt(recording.endNs) - this.startNs);
    for (const info of recording.topics) this.topics.set(info.id, new StoredTopic(this, info));
  }

  get endNs(): number {
    return this.beginNs + this.durationNs;
  }

  /** Difference from the times of this recording to those of the first one. */
  get shiftNs(): bigint {
    return this.originNs + BigInt(Math.round(this.beginNs)) - this.startNs;
  }

  timeOf(positionNs: number): bigint {
    const time = this.startNs + BigInt(Math.floor(positionNs - this.beginNs));
    return time < 0n ? 0n : time;
  }

  positionOf(timeNs: bigint): number {
    return Number(timeNs - this.startNs) + this.beginNs;
  }

  private placed(messages: readonly StoredMessage[]): Placed[] {
    return messages.flatMap(({ topic: id, timeNs, data }) => {
      const topic = this.topics.get(id);
      return topic ? [{ topic, atNs: this.positionOf(timeNs), data }] : [];
    });
  }

  async state(
    positionNs: number,
    needs: readonly TopicNeed[],
    signal: AbortSignal,
  ): Promise<Placed[]> {
    if (needs.length === 0) return [];
    const time = this.timeOf(positionNs);
    return this.placed(await this.requests.state(this.recording.id, time, needs, signal));
  }

  /** Messages after one position, up to another, until they have `maxBytes`. */
  async between(
    afterNs: number,
    untilNs: number,
    topics: readonly StoredTopic[],
    maxBytes: number,
    signal: AbortSignal,
  ): Promise<Placed[]> {
    return (await this.fetch(afterNs, untilNs, topics, maxBytes, signal)).messages;
  }

  /** The same, with the position up to which they were fetched. */
  async fetch(
    afterNs: number,
    untilNs: number,
    topics: readonly StoredTopic[],
    maxBytes: number,
    signal: AbortSignal,
  ): Promise<{ messages: Placed[]; isMore: boolean; reachedNs: number }> {
    const ids = topics.map((topic) => topic.info.id);
    const [from, to] = [this.timeOf(afterNs) + 1n, this.timeOf(untilNs) + 1n];
    if (ids.length === 0 || to <= from) return { messages: [], isMore: false, reachedNs: untilNs };
    const { id } = this.recording;
    const span = await this.requests.messages(id, ids, from, to, maxBytes, signal);
    const { isMore } = span;
    return {
      messages: this.placed(span.messages),
      isMore,
      reachedNs: isMore ? this.positionOf(span.reachedNs) : untilNs,
    };
  }

  // Fetching ahead.

  /** Forgets what was fetched; continues after a position. */
  restart(positionNs: number): void {
    this.fetching?.abort();
    this.fetching = undefined;
    this.ahead = [];
    this.aheadBytes = 0;
    this.reachedNs = positionNs;
  }

  /** Chooses which topics are sampled at this rate; returns true if there is one. */
  sample(topics: readonly StoredTopic[], rate: number): boolean {
    let sum = topics.reduce((all, topic) => all + topic.bytesPerS() * rate, 0);
    const bySize = topics
      .filter((topic) => !topic.isComplete)
      .sort((a, b) => b.bytesPerS() - a.bytesPerS());
    for (const topic of bySize) {
      topic.isSampled = sum > MAX_BYTES_PER_S;
      if (topic.isSampled) sum -= topic.bytesPerS() * rate;
    }
    return bySize.some((topic) => topic.isSampled);
  }

  /** Fetches the next messages, if there is room for them. */
  fill(
    positionNs: number,
    topics: readonly StoredTopic[],
    rate: number,
    failed: (error: Error) => void,
  ): void {
    const aheadNs = Math.max(MIN_AHEAD_NS, rate * AHEAD_S * 1e9);
    const wantedNs = Math.min(positionNs + aheadNs, this.endNs);
    if (this.fetching || this.aheadBytes > MAX_AHEAD_BYTES) return;
    // Less than half is refetched in one request, instead of a little in many.
    if (this.reachedNs >= wantedNs || this.reachedNs > positionNs + aheadNs / 2) return;
    const ids = topics.filter((topic) => !topic.isSampled).map((topic) => topic.info.id);
    const from = this.timeOf(this.reachedNs) + 1n;
    const to = this.timeOf(wantedNs) + 1n;
    if (ids.length === 0 || to <= from) {
      this.reachedNs = wantedNs;
      return;
    }
    const mine = (this.fetching = new AbortController());
    this.requests.messages(this.recording.id, ids, from, to, FETCH_BYTES, mine.signal).then(
      (span) => {
        if (this.fetching !== mine) return;
        this.fetching = undefined;
        for (const one of this.placed(span.messages)) {
          this.ahead.push(one);
          this.aheadBytes += one.data.length;
        }
        this.reachedNs = span.isMore ? this.positionOf(span.reachedNs) : wantedNs;
      },
      (error: Error) => {
        if (this.fetching !== mine) return;
        this.fetching = undefined;
        failed(error);
      },
    );
  }

  /** Position up to which messages can be delivered [ns]. */
  get availableNs(): number {
    return this.reachedNs >= this.endNs ? Infinity : this.reachedNs;
  }

  /** Removes and returns the fetched messages up to a position. */
  take(untilNs: number): Placed[] {
    const end = this.ahead.findIndex((one) => one.atNs > untilNs);
    const out = this.ahead.splice(0, end < 0 ? this.ahead.length : end);
    for (const one of out) this.aheadBytes -= one.data.length;
    return out;
  }

  stop(): void {
    this.restart(0);
  }
}
