/** Comparison of two recordings: beside each other or one over the other, their maps and trajectories. */
import type { Track } from '../core/replay_track';
import { TfBuffer } from '../core/tf';
import { messageOf, stampOf, type TransformStamped } from '../core/types';
import type { App } from './app.svelte';
import { prefixIn } from './auto';
import type { Replay } from './replay.svelte';
import { trajectoryDifference, type PoseAt, type TrajectoryDifference } from './replay_difference';
import type { Viewport } from './viewport.svelte';

/** Period of the poses of a trajectory [s]. */
const POSE_PERIOD_S = 0.1;
const MAX_POSES = 5000;
/** Transforms that are read for a trajectory [bytes]. */
const MAX_TF_BYTES = 64 << 20;
const FETCH_BYTES = 4 << 20;

const PATH_TYPE = 'nav_msgs/msg/Path';
const MAP_TYPE = 'nav_msgs/msg/OccupancyGrid';
export const TRAJECTORY_TOPIC = '/compare/trajectory';
const DIFFERENCE_CLASS = 'periplus/MapDifference';
const ROBOT_FRAMES = ['base_footprint', 'base_link'];

export type CompareMode = 'overlay' | 'sideBySide';

export interface Trajectories {
  state: 'reading' | 'ready' | 'failed';
  difference?: TrajectoryDifference;
  /** Name of the recording without the transform of the robot. */
  missing?: string;
}

export class Comparison {
  mode: CompareMode = $state('overlay');
  trajectories: Trajectories | undefined = $state.raw();
  private second?: Viewport;
  private poses: [PoseAt[], PoseAt[]] = [[], []];
  private lastView = '';

  constructor(
    private app: App,
    private replay: Replay,
  ) {}

  // Two views.

  setMode(mode: CompareMode): void {
    if (mode === this.mode) return;
    this.mode = mode;
    const { app, replay } = this;
    const prefix = replay.source.tracks[1]?.prefix;
    if (mode === 'sideBySide' && prefix) {
      const first = app.active;
      first.track = '';
      first.dropMissing();
      this.second = app.addViewport();
      this.second.track = prefix;
      this.second.setView(JSON.parse(JSON.stringify(first.view)));
      this.second.offersChanged();
    } else {
      for (const viewport of app.viewports) viewport.track = undefined;
      if (this.second && app.viewports.includes(this.second)) app.removeViewport(this.second);
      this.second = undefined;
      for (const viewport of app.viewports) viewport.offersChanged();
    }
  }

  /** Moves both cameras together: the one that the user moved last leads. */
  link(): void {
    const { second } = this;
    const first = this.app.viewports.find((one) => one !== second && one.track === '');
    if (!second?.stage || !first?.stage) return;
    const [a, b] = [first, second].map((one) => JSON.stringify(one.stage!.view.state));
    if (a === b) return;
    const isSecondMoved = a === this.lastView;
    const leader = isSecondMoved ? second : first;
    const other = isSecondMoved ? first : second;
    const { targetFrame, ...state } = structuredClone(leader.stage!.view.state);
    const bare = targetFrame.slice(prefixIn(targetFrame).length);
    const isFrame = bare !== '' && !bare.startsWith('<');
    other.setView({ ...state, targetFrame: isFrame ? (other.track ?? '') + bare : bare });
    this.lastView = JSON.stringify(first.stage!.view.state);
  }

  // Maps.

  /** Topics of maps of a recording. */
  maps(track: Track): string[] {
    const all = [...track.topics.values()].filter((topic) => topic.info.schemaName === MAP_TYPE);
    const names = all.map((topic) => topic.name);
    const rank = (name: string) => (/\/map$/.test(name) ? 0 : /cost/.test(name) ? 2 : 1);
    return names.sort((a, b) => rank(a) - rank(b) || (a < b ? -1 : 1));
  }

  showMapDifference(first: string, second: string): void {
    const { active } = this.app;
    const known = active.displays.find((entry) => entry.kind.class === DIFFERENCE_CLASS);
    if (known) {
      active.setOption(known, 'Topic', first);
      active.setOption(known, 'Second Topic', second);
      active.setEnabled(known, true);
    } else {
      active.add(DIFFERENCE_CLASS, '', { Topic: first, 'Second Topic': second }, true, true);
    }
  }

  // Trajectories.

  async showTrajectories(): Promise<void> {
    const [first, second] = this.replay.source.tracks;
    if (!first || !second) return;
    this.trajectories = { state: 'reading' };
    try {
      const all = await Promise.all([this.posesOf(first), this.posesOf(second)]);
      const missing = [first, second].find((_, i) => all[i]!.poses.length === 0);
      if (missing) {
        this.trajectories = { state: 'failed', missing: missing.recording.name };
        return;
      }
      this.poses = [all[0].poses, all[1].poses];
      for (const { frame, poses, track } of [
        { ...all[0], track: first },
        { ...all[1], track: second },
      ]) {
        const name = track.prefix + TRAJECTORY_TOPIC;
        this.replay.source.provide(name, PATH_TYPE, pathOf(track.prefix + frame, poses));
        this.showPath(name, track.prefix !== '');
      }
      this.compareTrajectories();
    } catch (error) {
      this.trajectories = { state: 'failed' };
      this.app.notice('error', (error as Error).message);
    }
  }

  /** Distances of the trajectories with the present tie of the frames. */
  compareTrajectories(): void {
    const second = this.replay.source.tracks[1];
    if (this.poses[0].length === 0 || !second) return;
    const difference = trajectoryDifference(...this.poses, this.replay.tie(second.prefix));
    this.trajectories = { state: 'ready', difference };
  }

  private showPath(topic: string, isSecond: boolean): void {
    const { active } = this.app;
    if (active.displays.some((entry) => entry.values.Topic === topic)) return;
    const values = {
      Topic: topic,
      Color: isSecond ? '255; 170; 0' : '47; 196; 178',
      'Line Style': 'Billboards',
      'Line Width': 0.05,
      'Offset/Z': isSecond ? 0.06 : 0.05,
    };
    active.add('rviz_default_plugins/Path', topic, values, true, true);
  }

  /** Poses of the robot in the root frame of its recording, from all of its transforms. */
  private async posesOf(track: Track): Promise<{ frame: string; poses: PoseAt[] }> {
    const tf = await this.transformsOf(track);
    const names = tf.names();
    const robot = ROBOT_FRAMES.find((name) => names.includes(name));
    if (!robot) return { frame: '', poses: [] };
    const frame = tf.root(robot);
    const poses: PoseAt[] = [];
    // Equal positions of all recordings: multiples of the period.
    const periodNs = Math.max(
      POSE_PERIOD_S * 1e9,
      Math.ceil(track.durationNs / MAX_POSES / 1e8) * 1e8,
    );
    for (
      let at = Math.ceil(track.beginNs / periodNs) * periodNs;
      at <= track.endNs;
      at += periodNs
    ) {
      const found = tf.lookup(frame, robot, this.replay.stampS(at));
      if (found.kind === 'found') poses.push({ atNs: at, pose: found.pose });
    }
    return { frame, poses };
  }

  private async transformsOf(track: Track): Promise<TfBuffer> {
    const tf = new TfBuffer();
    tf.keptS = Infinity;
    const topics = [...track.topics.values()].filter((topic) => topic.isTf);
    const abort = new AbortController();
    let bytes = 0;
    for (let from = track.beginNs - 1; from < track.endNs && bytes < MAX_TF_BYTES;) {
      const span = await track.fetch(from, track.endNs, topics, FETCH_BYTES, abort.signal);
      for (const { topic, data } of span.messages) {
        bytes += data.length;
        const message = topic.read(data, (text) => this.app.notice('error', text));
        const isStatic = topic.name.endsWith('tf_static');
        for (const one of (message?.transforms ?? []) as TransformStamped[]) {
          // Without the prefix: each recording has its own buffer.
          const bare = (name: string) => name.slice(prefixIn(name).length);
          one.header.frame_id = bare(one.header.frame_id);
          one.child_frame_id = bare(one.child_frame_id);
          tf.add(one, isStatic);
        }
      }
      if (!span.isMore) break;
      from = span.reachedNs;
    }
    return tf;
  }

  stop(): void {
    this.setMode('overlay');
  }
}

function pathOf(frame: string, poses: readonly PoseAt[]) {
  const header = { stamp: stampOf(0), frame_id: frame };
  return { header, poses: poses.map(({ pose }) => ({ header, pose: messageOf(pose) })) };
}
