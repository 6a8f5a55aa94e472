/**
 * Recordings as a source of messages. The playhead delivers messages in the order of time; a jump fetches the state
 * at the new time and delivers all of it at once.
 */
import type { Message } from './cdr';
import type { Handler } from './client';
import type { Need, Source } from './feed';
import type { Channel, Ends, Mismatch, Recording, ServiceOffer } from './protocol';
import { Playhead } from './replay_playhead';
import type { RecordingRequests, StoredSeries } from './replay_requests';
import { Track, type Placed, type StoredTopic } from './replay_track';

export interface ReplayEvents {
  /** Time of the message that follows [s]. */
  time(timeS: number): void;
  /**
   * Time jumped: everything shown is forgotten, and the messages of the new time follow. `spanS`: the time that they
   * reach back.
   */
  jumped(spanS: number): void;
  /** All messages of the present time were delivered. */
  shown(): void;
  /** Topics changed. */
  offersChanged(): void;
  failed(message: string): void;
}

interface Subscription {
  topic: string;
  handler: Handler;
  need: Need;
  /** False until it got the messages of the present time. */
  hasState: boolean;
}

/** Messages of one topic between two animation frames; of more than these bytes the newest are delivered. */
const MAX_STEP_BYTES = 256 * 1024;
/** Transforms before the oldest message that is shown [s]. */
const TF_MARGIN_S = 1;
/** Longest time of transforms in a state [s]. */
const MAX_TF_S = 120;
/** Longest time of transforms for messages that are needed by their number [s]. */
const MAX_COUNTED_S = 10;

const MAX_LETTER = 25;
/** Prefix of the topics and frames of the second recording and of further ones. */
export const prefixOf = (index: number): string =>
  index === 0 ? '' : `${String.fromCharCode(65 + Math.min(index, MAX_LETTER))}:`;

interface Jump {
  positionNs: number;
  done: (() => void)[];
}

export class ReplaySource implements Source {
  readonly services: ReadonlyMap<string, ServiceOffer> = new Map();
  readonly ends: Ends = { publishedTopics: [], subscribedTopics: [], advertisedServices: [] };
  readonly mismatches: readonly Mismatch[] = [];
  readonly playhead: Playhead;
  channels: ReadonlyMap<string, Channel> = new Map();
  tracks: Track[] = [];
  private topics = new Map<string, StoredTopic>();
  /** Messages that the page computes from the recordings, by topic. */
  private provided = new Map<string, { channel: Channel; message: Message }>();
  private subscriptions = new Set<Subscription>();
  private jump?: Jump;
  private isFetching = false;
  private isSettling = false;
  private isStopped = false;
  private abort = new AbortController();
  private sampling = false;
  private hasSamples = false;

  constructor(
    first: Recording,
    private requests: RecordingRequests,
    private events: ReplayEvents,
  ) {
    this.playhead = new Playhead(0, 0);
    this.addTrack(first);
  }

  // Recordings on the timeline.

  /** Time of position 0. */
  get originNs(): bigint {
    return this.tracks[0]!.startNs;
  }

  timeS(positionNs = this.playhead.positionNs): number {
    return Number(this.originNs) * 1e-9 + positionNs * 1e-9;
  }

  positionOf(timeS: number): number {
    return (timeS - Number(this.originNs) * 1e-9) * 1e9;
  }

  /**
   * Adds a recording. It is aligned by its times if these overlap with those of the first one, otherwise by its start.
   */
  add(recording: Recording): Track {
    const track = this.addTrack(recording);
    this.changedTracks();
    return track;
  }

  private addTrack(recording: Recording): Track {
    const [first] = this.tracks;
    const originNs = first ? first.startNs : BigInt(recording.startNs);
    const beginNs = Number(BigInt(recording.startNs) - originNs);
    const durationNs = Number(BigInt(recording.endNs) - BigInt(recording.startNs));
    const isOverlapping = first && beginNs < first.durationNs && -beginNs < durationNs;
    const prefix = this.freePrefix();
    const begin = isOverlapping ? beginNs : 0;
    const track = new Track(recording, prefix, originNs, begin, this.requests);
    this.tracks = [...this.tracks, track];
    this.collect();
    return track;
  }

  private freePrefix(): string {
    let index = 0;
    while (this.tracks.some((track) => track.prefix === prefixOf(index))) index++;
    return prefixOf(index);
  }

  remove(track: Track): void {
    if (track === this.tracks[0]) throw new Error('the first recording cannot be removed');
    track.stop();
    this.tracks = this.tracks.filter((one) => one !== track);
    this.changedTracks();
  }

  /** Moves the start of a recording on the timeline. */
  align(track: Track, beginNs: number): void {
    track.beginNs = Math.round(beginNs);
    this.changedTracks();
  }

  private changedTracks(): void {
    this.collect();
    this.events.offersChanged();
    void this.seek(this.playhead.positionNs);
  }

  private collect(): void {
    this.topics = new Map();
    const channels = new Map<string, Channel>();
    for (const track of this.tracks) {
      for (const topic of track.topics.values()) {
        this.topics.set(topic.name, topic);
        channels.set(topic.name, topic.channel());
      }
    }
    for (const [name, { channel }] of this.provided) channels.set(name, channel);
    this.channels = channels;
    this.playhead.startNs = Math.min(...this.tracks.map((track) => track.beginNs));
    this.playhead.endNs = Math.max(...this.tracks.map((track) => track.endNs));
    this.playhead.positionNs = this.playhead.clamped(this.playhead.positionNs);
  }

  /** Adds a topic with one latched message, which the page computed. */
  provide(topic: string, schemaName: string, message: Message): void {
    const channel = { id: -1 - this.provided.size, topic, encoding: 'cdr', schemaName, schema: '' };
    this.provided.set(topic, { channel, message });
    this.collect();
    this.events.offersChanged();
    for (const one of this.subscriptions) if (one.topic === topic) one.handler(message, topic, 0);
  }

  topic(name: string): StoredTopic | undefined {
    return this.topics.get(name);
  }

  // Subscriptions.

  subscribe(topic: string, handler: Handler, need: Need = {}): () => void {
    const one: Subscription = { topic, handler, need, hasState: false };
    this.subscriptions.add(one);
    this.settle();
    return () => this.subscriptions.delete(one);
  }

  /** Fetches the state for new subscriptions, all that come in one task together. */
  private settle(): void {
    if (this.isSettling || this.isStopped) return;
    this.isSettling = true;
    queueMicrotask(() => {
      this.isSettling = false;
      void this.work();
    });
  }

  private subscribed(track?: Track): StoredTopic[] {
    const names = new Set([...this.subscriptions].map((one) => one.topic));
    return [...names].flatMap((name) => {
      const topic = this.topics.get(name);
      return topic && (!track || topic.track === track) ? [topic] : [];
    });
  }

  // Jumps.

  /** Shows the state at a position; resolves when it or a newer one is shown. */
  seek(positionNs: number): Promise<void> {
    const target = this.playhead.clamped(positionNs);
    this.playhead.positionNs = target;
    this.playhead.hold();
    return new Promise((resolve) => {
      // One request at a time, and the newest target is the next.
      if (this.jump) this.jump.positionNs = target;
      else this.jump = { positionNs: target, done: [] };
      this.jump.done.push(resolve);
      void this.work();
    });
  }

  get isJumping(): boolean {
    return this.jump !== undefined || this.isFetching;
  }

  private async work(): Promise<void> {
    if (this.isFetching || this.isStopped) return;
    this.isFetching = true;
    try {
      for (;;) {
        const { jump } = this;
        this.jump = undefined;
        const fresh = [...this.subscriptions].filter((one) => !one.hasState);
        if (jump) {
          await this.show(jump.positionNs, [...this.subscriptions], true);
          jump.done.forEach((resolve) => resolve());
        } else if (fresh.length > 0) {
          await this.show(this.playhead.positionNs, fresh, false);
        } else {
          break;
        }
        if (this.isStopped) break;
      }
    } finally {
      this.isFetching = false;
      this.playhead.hold();
    }
  }

  /** Seconds before the present that a subscription needs messages of. */
  private spanS(topic: StoredTopic, need: Need): number {
    const perS = topic.info.count / Math.max(1e-3, topic.track.durationNs * 1e-9);
    const counted = (need.count ?? 1) > 1 ? need.count! / Math.max(1e-3, perS) : 0;
    return Math.max(need.historyS ?? 0, Math.min(counted, MAX_COUNTED_S));
  }

  private async show(
    positionNs: number,
    subscriptions: readonly Subscription[],
    isJump: boolean,
  ): Promise<void> {
    for (const one of subscriptions) one.hasState = true;
    const byTopic = new Map<StoredTopic, Subscription[]>();
    let spanS = 0;
    for (const one of subscriptions) {
      const topic = this.topics.get(one.topic);
      if (!topic) continue;
      byTopic.set(topic, [...(byTopic.get(topic) ?? []), one]);
      if (!topic.isTf) spanS = Math.max(spanS, this.spanS(topic, one.need));
    }
    const isProvided = subscriptions.some((one) => this.provided.has(one.topic));
    if (!isJump && byTopic.size === 0 && !isProvided) return;
    // Transforms reach back as far as the messages that are placed by them.
    const tfS = Math.min(MAX_TF_S, spanS + TF_MARGIN_S);
    const { signal } = this.abort;
    const fetched = await Promise.all(
      this.tracks.map(async (track) => {
        const wanted = [...byTopic].filter(([topic]) => topic.track === track);
        const needs = wanted.map(([topic, all]) => ({
          id: topic.info.id,
          count: Math.max(1, ...all.map(({ need }) => need.count ?? 1)),
          historyNs: String(
            Math.round(
              Math.max(topic.isTf ? tfS : 0, ...all.map(({ need }) => need.historyS ?? 0)) * 1e9,
            ),
          ),
        }));
        return track.state(positionNs, needs, signal);
      }),
    ).catch((error: Error) => {
      if (!signal.aborted) this.events.failed(error.message);
      return undefined;
    });
    if (!fetched || this.isStopped) return;
    if (isJump) {
      this.events.jumped(tfS);
      for (const topic of this.topics.values()) topic.lastNs = -Infinity;
    }
    this.deliverState(fetched.flat(), byTopic, positionNs);
    for (const { topic, handler } of subscriptions) {
      const provided = this.provided.get(topic);
      if (provided) handler(provided.message, topic, 0, this.timeS(positionNs));
    }
    for (const track of this.tracks) track.restart(positionNs);
    this.sampling = false;
    this.events.time(this.timeS(positionNs));
    this.events.shown();
  }

  private deliverState(
    all: readonly Placed[],
    byTopic: ReadonlyMap<StoredTopic, readonly Subscription[]>,
    positionNs: number,
  ): void {
    // Transforms first: messages are placed by them.
    const sorted = [...all].sort(
      (a, b) => Number(b.topic.isTf) - Number(a.topic.isTf) || a.atNs - b.atNs,
    );
    const counts = new Map<StoredTopic, number>();
    for (const { topic } of sorted) counts.set(topic, (counts.get(topic) ?? 0) + 1);
    const wanted = ({ need }: Subscription, { topic, atNs }: Placed, following: number) =>
      topic.isComplete ||
      need.isUpdates ||
      following < (need.count ?? 1) ||
      atNs > positionNs - (need.historyS ?? 0) * 1e9;
    for (const one of sorted) {
      const following = counts.get(one.topic)! - 1;
      counts.set(one.topic, following);
      const takers = (byTopic.get(one.topic) ?? []).filter((taker) =>
        wanted(taker, one, following),
      );
      this.deliver(one, takers);
    }
  }

  private deliver({ topic, atNs, data }: Placed, takers: readonly Subscription[]): void {
    topic.lastNs = Math.max(topic.lastNs, atNs);
    if (takers.length === 0) return;
    const message: Message | undefined = topic.read(data, (text) => this.events.failed(text));
    if (!message) return;
    const timeS = this.timeS(atNs);
    this.events.time(timeS);
    for (const { handler } of takers) handler(message, topic.name, data.byteLength, timeS);
  }

  // Playing.

  play(): void {
    const { playhead } = this;
    if (playhead.isPlaying) return;
    playhead.isPlaying = true;
    playhead.hold();
    if (playhead.positionNs >= playhead.endNs) void this.seek(playhead.startNs);
  }

  pause(): void {
    this.playhead.isPlaying = false;
    this.playhead.hold();
  }

  set rate(rate: number) {
    this.playhead.rate = rate;
    const { positionNs } = this.playhead;
    // Which topics are sampled depends on the rate.
    for (const track of this.tracks) track.restart(positionNs);
  }

  /** Delivers the messages since the last animation frame. */
  tick(nowMs: number): void {
    const { playhead } = this;
    if (!playhead.isPlaying || this.isJumping) {
      playhead.hold();
      return;
    }
    this.fill();
    const availableNs = Math.min(...this.tracks.map((track) => track.availableNs));
    const next = playhead.advance(nowMs, availableNs);
    if (next.kind === 'still') return;
    if (next.kind === 'loop') {
      void this.seek(next.positionNs);
      return;
    }
    playhead.positionNs = next.positionNs;
    if (next.isEnd) this.pause();
    this.deliverStep(this.tracks.flatMap((track) => track.take(next.positionNs)));
    this.events.time(this.timeS());
    this.sampleNext();
  }

  private fill(): void {
    const { positionNs, rate } = this.playhead;
    this.hasSamples = false;
    for (const track of this.tracks) {
      const topics = this.subscribed(track);
      if (track.sample(topics, rate)) this.hasSamples = true;
      track.fill(positionNs, topics, rate, (error) => {
        this.pause();
        this.events.failed(error.message);
      });
    }
  }

  private takers(topic: StoredTopic): Subscription[] {
    return [...this.subscriptions].filter((one) => one.topic === topic.name && one.hasState);
  }

  private deliverStep(step: Placed[]): void {
    if (step.length === 0) return;
    step.sort((a, b) => a.atNs - b.atNs);
    const bytes = new Map<StoredTopic, number>();
    const isSkipped = new Array<boolean>(step.length).fill(false);
    for (let i = step.length - 1; i >= 0; i--) {
      const { topic, data } = step[i]!;
      if (topic.isComplete) continue;
      const later = bytes.get(topic);
      isSkipped[i] = later !== undefined && later + data.length > MAX_STEP_BYTES;
      if (!isSkipped[i]) bytes.set(topic, (later ?? 0) + data.length);
    }
    const takers = new Map<StoredTopic, Subscription[]>();
    step.forEach((one, i) => {
      if (isSkipped[i]) return;
      let all = takers.get(one.topic);
      if (!all) takers.set(one.topic, (all = this.takers(one.topic)));
      this.deliver(one, all);
    });
  }

  /** Fetches the newest messages of the topics that are too large to be fetched completely. */
  private sampleNext(): void {
    if (!this.hasSamples || this.sampling) return;
    this.sampling = true;
    const { positionNs } = this.playhead;
    for (const track of this.tracks) {
      const needs = this.subscribed(track)
        .filter((topic) => topic.isSampled)
        .map(({ info: { id } }) => ({ id, count: 1, historyNs: '0' }));
      if (needs.length === 0) continue;
      track.state(positionNs, needs, this.abort.signal).then(
        (all) => {
          if (!this.sampling || this.isJumping) return;
          this.sampling = false;
          for (const one of all) {
            if (one.atNs > one.topic.lastNs) this.deliver(one, this.takers(one.topic));
          }
        },
        () => (this.sampling = false),
      );
    }
  }

  // Single messages.

  /** Position of the next or previous message of a topic, or of all that are shown. */
  async neighbour(direction: 1 | -1, topicName?: string): Promise<number | undefined> {
    const { positionNs, endNs } = this.playhead;
    const { signal } = this.abort;
    const named = topicName ? this.topics.get(topicName) : undefined;
    const found = await Promise.all(
      this.tracks.map(async (track) => {
        const topics = named ? [named].filter((t) => t.track === track) : this.subscribed(track);
        if (direction > 0) return track.between(positionNs, endNs, topics, 1, signal);
        const needs = topics.map(({ info: { id } }) => ({ id, count: 1, historyNs: '0' }));
        return track.state(positionNs - 1, needs, signal);
      }),
    );
    const times = found.flat().map((one) => one.atNs);
    if (times.length === 0) return undefined;
    return direction > 0 ? Math.min(...times) : Math.max(...times);
  }

  /** The last messages of a topic before the playhead, decoded. */
  async last(
    topicName: string,
    count: number,
    signal: AbortSignal,
  ): Promise<{ message: Message; timeS: number }[]> {
    const topic = this.topics.get(topicName);
    if (!topic) return [];
    const needs = [{ id: topic.info.id, count, historyNs: '0' }];
    const all = await topic.track.state(this.playhead.positionNs, needs, signal);
    // Of some topics the server sends more than asked for.
    return all.slice(-count).flatMap(({ data, atNs }) => {
      const message = topic.read(data, (text) => this.events.failed(text));
      return message ? [{ message, timeS: this.timeS(atNs) }] : [];
    });
  }

  async series(
    topicName: string,
    paths: readonly string[],
    fromS: number,
    toS: number,
    points: number,
  ): Promise<StoredSeries & { track: Track }> {
    const topic = this.topics.get(topicName);
    if (!topic) throw new Error(`no recording has the topic ${topicName}`);
    const { track, info } = topic;
    const from = track.timeOf(this.positionOf(fromS));
    const to = track.timeOf(this.positionOf(toS)) + 1n;
    const { id } = track.recording;
    const series = await this.requests.series(id, info.id, paths, from, to, points);
    return { ...series, track };
  }

  /** Ends all requests. */
  stop(): void {
    this.isStopped = true;
    this.abort.abort();
    for (const track of this.tracks) track.stop();
    this.jump?.done.forEach((resolve) => resolve());
    this.jump = undefined;
  }
}
