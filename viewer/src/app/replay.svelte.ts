/** Replay of one or more recordings: the playhead and what the timeline shows of them. */
import { IDENTITY, type Pose } from '../core/pose';
import type { Mark, Recording } from '../core/protocol';
import { ReplaySource } from '../core/replay';
import type { Track } from '../core/replay_track';
import { seconds, stampOf, type TransformStamped } from '../core/types';
import type { App } from './app.svelte';
import { bestFrame, prefixIn } from './auto';
import { Comparison } from './replay_compare.svelte';
import type { ReplayControl, Series } from './replay_control';
import { tieOf } from './replay_difference';

/** Parts of the recording for which messages are counted. */
const DENSITY_BINS = 1000;
/** Rate below which new transforms arrive too late to be waited for. */
const MIN_AWAITED_RATE = 0.3;

/** Log messages before the time that is shown. */
const LOG_HISTORY = 50;
const LOG_DELAY_MS = 500;

/** Time after its start at which a recording opens: at most this, and at most this part of it. */
const OPEN_AT_NS = 1e9;
const OPEN_AT_PART = 0.05;

/** Event on the timeline. */
export interface TimelineMark {
  positionNs: number;
  kind: string;
  topic: string;
  text: string;
  /** Prefix of the recording. */
  prefix: string;
}

/** Recording on the timeline. */
export interface TrackRow {
  track: Track;
  beginNs: number;
  marks: TimelineMark[];
  areMarksComplete: boolean;
  /** Message counts by topic id in equal parts of the recording. */
  density: ReadonlyMap<number, number[]>;
  stopMarks?: () => void;
  unsubscribes: (() => void)[];
}

export class Replay implements ReplayControl {
  positionNs = $state(0);
  isPlaying = $state(false);
  rate = $state(1);
  loop: { fromNs: number; toNs: number } | undefined = $state.raw();
  startNs = $state(0);
  endNs = $state(0);
  rows: TrackRow[] = $state.raw([]);
  /** Topic by whose messages the playhead steps; empty for all that are shown. */
  stepTopic = $state('');
  readonly source: ReplaySource;
  readonly comparison: Comparison;
  /** Transform from the map of a further recording to that of the first, by prefix. */
  private ties = new Map<string, Pose>();
  /** Time of `/clock` minus log time [s]. */
  private clockShiftS = 0;
  private frame = 0;
  private isStopped = false;
  /** True once the playhead was moved from where the recording opened. */
  private isMoved = false;
  private logAbort?: AbortController;
  private logTimer?: ReturnType<typeof setTimeout>;
  private unsubscribeClock: () => void;

  constructor(
    private app: App,
    first: Recording,
  ) {
    this.source = new ReplaySource(first, app.client.recordings, {
      time: (timeS) => (app.clock.nowS = timeS + this.clockShiftS),
      jumped: (spanS) => app.jumped(spanS),
      shown: () => this.shown(),
      offersChanged: () => this.offersChanged(),
      failed: (message) => app.notice('error', message),
    });
    this.unsubscribeClock = this.source.subscribe('/clock', (message, _topic, _bytes, timeS) => {
      this.clockShiftS = seconds(message.clock as never) - timeS!;
    });
    this.comparison = new Comparison(app, this);
    this.addRow(this.source.tracks[0]!);
    this.bounds();
    const loop = (nowMs: number) => {
      if (this.isStopped) return;
      this.frame = requestAnimationFrame(loop);
      this.source.tick(nowMs);
      this.comparison.link();
      this.follow();
    };
    this.frame = requestAnimationFrame(loop);
  }

  /** Copies the playhead into the reactive state. */
  private follow(): void {
    const { positionNs, isPlaying, rate } = this.source.playhead;
    if (positionNs !== this.positionNs) this.positionNs = positionNs;
    if (isPlaying !== this.isPlaying) this.isPlaying = isPlaying;
    if (rate !== this.rate) this.rate = rate;
  }

  private bounds(): void {
    this.startNs = this.source.playhead.startNs;
    this.endNs = this.source.playhead.endNs;
    this.follow();
  }

  // Time.

  get timeS(): number {
    return this.source.timeS(this.positionNs);
  }

  get startS(): number {
    return this.source.timeS(this.startNs);
  }

  get endS(): number {
    return this.source.timeS(this.endNs);
  }

  /** Time of the messages' stamps at a position: that of `/clock` where it was recorded. */
  stampS(positionNs: number): number {
    return this.source.timeS(positionNs) + this.clockShiftS;
  }

  /** False while no newer transforms come: messages are then placed by the newest ones. */
  awaitsTransforms(): boolean {
    const { isPlaying, rate } = this.source.playhead;
    return isPlaying && rate >= MIN_AWAITED_RATE;
  }

  /** Log time, the clock of the arrival of messages [ms]. */
  arrivalMs(): number {
    return this.source.timeS() * 1000;
  }

  play(): void {
    this.source.play();
    this.follow();
  }

  pause(): void {
    this.source.pause();
    this.follow();
  }

  toggle(): void {
    if (this.source.playhead.isPlaying) this.pause();
    else this.play();
  }

  setRate(rate: number): void {
    if (rate > 0) this.source.rate = rate;
    this.follow();
  }

  seek(timeS: number): void {
    void this.show(timeS);
  }

  show(timeS: number): Promise<void> {
    return this.seekNs(this.source.positionOf(timeS));
  }

  seekNs(positionNs: number): Promise<void> {
    this.isMoved = true;
    this.logAbort?.abort();
    const shown = this.source.seek(positionNs);
    this.follow();
    return shown;
  }

  setLoop(loop: { fromNs: number; toNs: number } | undefined): void {
    this.loop = loop;
    this.source.playhead.loop = loop;
  }

  /** Goes to the next or previous message; false at the end. */
  async step(direction: 1 | -1): Promise<boolean> {
    this.pause();
    const found = await this.source
      .neighbour(direction, this.stepTopic || undefined)
      .catch((error: Error) => {
        this.app.notice('error', error.message);
        return undefined;
      });
    if (found === undefined) return false;
    await this.seekNs(found);
    return true;
  }

  /** Goes to the next or previous mark. */
  stepMark(direction: 1 | -1): TimelineMark | undefined {
    const all = this.marks();
    const next =
      direction > 0
        ? all.find((mark) => mark.positionNs > this.positionNs)
        : all.findLast((mark) => mark.positionNs < this.positionNs);
    if (next) void this.seekNs(next.positionNs);
    return next;
  }

  marks(): TimelineMark[] {
    return this.rows.flatMap((row) => row.marks).sort((a, b) => a.positionNs - b.positionNs);
  }

  async series(
    topic: string,
    paths: readonly string[],
    fromS: number,
    toS: number,
    points: number,
  ): Promise<Series> {
    const found = await this.source.series(topic, paths, fromS, toS, points);
    const timesS = found.timesNs.map((time) => this.source.timeS(found.track.positionOf(time)));
    return { timesS, values: found.values, isReduced: found.isReduced };
  }

  // Recordings.

  /** Adds a recording that is compared with the first one. */
  add(recording: Recording): Track {
    const track = this.source.add(recording);
    this.addRow(track);
    this.bounds();
    return track;
  }

  remove(track: Track): void {
    if (this.source.tracks[1] === track) this.comparison.stop();
    const row = this.rows.find((one) => one.track === track);
    row?.stopMarks?.();
    row?.unsubscribes.forEach((unsubscribe) => unsubscribe());
    this.rows = this.rows.filter((one) => one !== row);
    this.ties.delete(track.prefix);
    this.source.remove(track);
    this.bounds();
  }

  /** Moves a recording on the timeline. */
  align(track: Track, beginNs: number): void {
    const movedNs = beginNs - track.beginNs;
    this.source.align(track, beginNs);
    this.rows = this.rows.map((row) =>
      row.track === track
        ? {
            ...row,
            beginNs: track.beginNs,
            marks: row.marks.map((m) => ({ ...m, positionNs: m.positionNs + movedNs })),
          }
        : row,
    );
    this.bounds();
  }

  has(id: number): boolean {
    return this.source.tracks.some((track) => track.recording.id === id);
  }

  private addRow(track: Track): void {
    const { requests } = this;
    const { id } = track.recording;
    // The application subscribes to the transforms of the first recording.
    const unsubscribes = !track.prefix
      ? []
      : ['/tf', '/tf_static'].map((name) =>
          this.source.subscribe(track.prefix + name, (message, _topic, _bytes, timeS) => {
            for (const one of message.transforms as TransformStamped[]) {
              this.app.tf.add(one, name === '/tf_static', timeS! * 1000);
            }
          }),
        );
    const row: TrackRow = {
      track,
      beginNs: track.beginNs,
      marks: [],
      areMarksComplete: false,
      density: new Map(),
      unsubscribes,
    };
    const update = (change: Partial<TrackRow>) => {
      this.rows = this.rows.map((one) => (one.track === track ? { ...one, ...change } : one));
    };
    this.rows = [...this.rows, row];
    const failed = (error: Error) => {
      if (!this.isStopped) this.app.notice('warn', `${track.recording.name}: ${error.message}`);
    };
    requests.density(id, DENSITY_BINS).then((density) => {
      update({ density });
      if (!track.prefix) this.skipSilence(track, density);
    }, failed);
    const placed = (mark: Mark): TimelineMark => ({
      positionNs: track.positionOf(BigInt(mark.timeNs)),
      kind: mark.kind,
      topic: mark.topic,
      text: mark.text,
      prefix: track.prefix,
    });
    const stopMarks = requests.marks(
      id,
      (marks, areMarksComplete) => update({ marks: marks.map(placed), areMarksComplete }),
      failed,
    );
    update({ stopMarks });
  }

  /**
   * Latched messages have the times at which they were published, which may be long before all others: a recording opens
   * where it begins to move, unless the user went elsewhere.
   */
  private skipSilence(track: Track, density: ReadonlyMap<number, number[]>): void {
    if (this.isMoved || this.isPlaying || this.isStopped) return;
    const firstBins = [...density].flatMap(([id, counts]) => {
      const first = counts.findIndex((count) => count > 0);
      return track.topics.get(id)?.info.isLatched !== false || first < 0 ? [] : [first];
    });
    if (firstBins.length === 0) return;
    const beginNs = track.beginNs + (Math.min(...firstBins) / DENSITY_BINS) * track.durationNs;
    if (beginNs > this.positionNs) this.opened(beginNs);
  }

  /** Shows the recording shortly after a position: at the start itself nearly nothing was published yet. */
  opened(fromNs: number): void {
    const atNs = fromNs + Math.min(OPEN_AT_NS, OPEN_AT_PART * (this.endNs - fromNs));
    void this.seekNs(atNs);
    this.isMoved = false;
  }

  private get requests() {
    return this.app.client.recordings;
  }

  // Frames.

  /** Pose of the map of a further recording in that of the first one. */
  tie(prefix: string): Pose {
    return this.ties.get(prefix) ?? IDENTITY;
  }

  setTie(prefix: string, firstFromOther: Pose): void {
    this.ties.set(prefix, firstFromOther);
    this.addTies();
    this.comparison.compareTrajectories();
    for (const viewport of this.app.viewports) viewport.rewound();
  }

  /** Root frame of the recording with this prefix. */
  rootFrame(prefix: string): string | undefined {
    const { tf } = this.app;
    const own = tf.names().filter((name) => prefixIn(name) === prefix);
    if (own.length === 0) return undefined;
    const bare = own.map((name) => name.slice(prefix.length));
    return prefix + bestFrame(bare, (name) => tf.root(prefix + name).slice(prefix.length));
  }

  /** Ties the frames of further recordings to those of the first one. */
  private addTies(): void {
    const others = this.source.tracks.filter((track) => track.prefix);
    const first = this.rootFrame('');
    for (const { prefix } of others) {
      const other = this.rootFrame(prefix);
      if (!first || !other) continue;
      const parent = this.app.tf.parentOf(other);
      if (parent && prefixIn(parent) === prefix) continue;
      const { t, q } = this.tie(prefix);
      this.app.tf.add(
        {
          header: { stamp: stampOf(0), frame_id: first },
          child_frame_id: other,
          transform: {
            translation: { x: t[0], y: t[1], z: t[2] },
            rotation: { x: q[0], y: q[1], z: q[2], w: q[3] },
          },
        },
        true,
        this.arrivalMs(),
      );
    }
  }

  /** Transform that puts the robot of a further recording onto that of the first one, at the present time. */
  tieAtRobots(prefix: string, frame: string): Pose | undefined {
    const { tf } = this.app;
    const [first, other] = [this.rootFrame(''), this.rootFrame(prefix)];
    if (!first || !other) return undefined;
    const firstFromRobot = tf.lookup(first, frame);
    const otherFromRobot = tf.lookup(other, prefix + frame);
    if (firstFromRobot.kind !== 'found' || otherFromRobot.kind !== 'found') return undefined;
    return tieOf(firstFromRobot.pose, otherFromRobot.pose);
  }

  private shown(): void {
    this.addTies();
    this.follow();
    this.fetchLog();
  }

  /**
   * The log before the present time, once the playhead rests: its messages are spread over the recording, so that a
   * server reads much of it.
   */
  private fetchLog(): void {
    this.logAbort?.abort();
    clearTimeout(this.logTimer);
    this.logTimer = setTimeout(() => {
      if (this.isPlaying || this.source.isJumping) return;
      const mine = (this.logAbort = new AbortController());
      this.source.last('/rosout', LOG_HISTORY, mine.signal).then(
        (all) => {
          const isPresent = !mine.signal.aborted && !this.isStopped && all.length > 0;
          if (isPresent && !this.isPlaying) this.app.showLog(all.map((one) => one.message));
        },
        // Cancelled by the next jump; without a connection that is reported already.
        () => undefined,
      );
    }, LOG_DELAY_MS);
  }

  private offersChanged(): void {
    this.app.graphChanged();
    for (const viewport of this.app.viewports) viewport.dropMissing();
  }

  /** Shows the state again, after a reconnection. */
  renew(): void {
    void this.seekNs(this.positionNs);
  }

  stop(): void {
    this.isStopped = true;
    this.logAbort?.abort();
    clearTimeout(this.logTimer);
    this.comparison.stop();
    cancelAnimationFrame(this.frame);
    for (const row of this.rows) row.stopMarks?.();
    this.unsubscribeClock();
    this.source.stop();
  }
}
