/** Transform buffer with the rules of tf2: ten seconds of history, no extrapolation. */
import { IDENTITY, interpolate, inverse, multiply, normalize, type Pose } from './pose';
import { seconds, type TransformStamped } from './types';
import { t } from '../texts/language.svelte';

interface Sample {
  timeS: number;
  parent: string;
  parentFromChild: Pose;
}

interface Frame {
  isStatic: boolean;
  /** Sorted by time, newest last. */
  samples: Sample[];
  /** Time of the last message with this frame, by the browser's clock [ms]. */
  receivedMs: number;
}

export type Lookup =
  | { kind: 'found'; pose: Pose }
  /** The transform may arrive later. */
  | { kind: 'later'; why: string }
  | { kind: 'never'; why: string };

/** Time that transforms are kept, as in tf2 [s]. */
export const KEPT_S = 10;
/** A chain of more frames than this is a loop. */
const MOST_LINKS = 200;

/** Removes the leading slash of ROS 1 frame names. */
export function frameName(name: string): string {
  return name.startsWith('/') ? name.slice(1) : name;
}

const newestParent = ({ samples }: Frame): string => samples[samples.length - 1]!.parent;

export class TfBuffer {
  private frames = new Map<string, Frame>();
  /** Number of frames that have a frame as their parent. */
  private children = new Map<string, number>();
  /** Incremented at each change, for users that cache lookups. */
  version = 0;
  /** Incremented when a frame appears or is gone, or gets another parent. */
  treeVersion = 0;
  /** Time that transforms are kept [s]; a recording may show messages that are older. */
  keptS = KEPT_S;

  clear(): void {
    this.frames.clear();
    this.children.clear();
    this.treeVersion++;
    this.version++;
  }

  add(message: TransformStamped, isStatic: boolean, nowMs = 0): void {
    const child = frameName(message.child_frame_id);
    const parent = frameName(message.header.frame_id);
    if (!child || !parent || child === parent) return;
    const { translation: t, rotation: r } = message.transform;
    const sample: Sample = {
      timeS: seconds(message.header.stamp),
      parent,
      parentFromChild: { t: [t.x, t.y, t.z], q: normalize([r.x, r.y, r.z, r.w]) },
    };
    this.version++;
    const frame = this.frames.get(child);
    const before = frame && newestParent(frame);
    if (!frame || isStatic || frame.isStatic !== isStatic) {
      this.frames.set(child, { isStatic, samples: [sample], receivedMs: nowMs });
      this.adopt(before, parent);
      return;
    }
    frame.receivedMs = nowMs;
    this.insert(frame, sample);
    this.adopt(before, newestParent(frame));
  }

  /** Counts a frame at its new parent instead of the one before. */
  private adopt(before: string | undefined, now: string | undefined): void {
    if (before === now) return;
    this.treeVersion++;
    if (now !== undefined) this.children.set(now, (this.children.get(now) ?? 0) + 1);
    if (before === undefined) return;
    const left = this.children.get(before)! - 1;
    if (left > 0) this.children.set(before, left);
    else this.children.delete(before);
  }

  private insert(frame: Frame, sample: Sample): void {
    const { samples } = frame;
    const newest = samples[samples.length - 1]!;
    // Time jumped back: a simulation was reset, or a recording restarted.
    if (sample.timeS < newest.timeS - this.keptS) samples.length = 0;
    let at = samples.length;
    while (at > 0 && samples[at - 1]!.timeS > sample.timeS) at--;
    if (at > 0 && samples[at - 1]!.timeS === sample.timeS) samples[at - 1] = sample;
    else samples.splice(at, 0, sample);
    let drop = 0;
    while (samples[drop]!.timeS < samples[samples.length - 1]!.timeS - this.keptS) drop++;
    if (drop > 64) samples.splice(0, drop);
  }

  /** Drops transforms newer than now, after time jumped back. */
  rewind(nowS: number): void {
    for (const [name, frame] of this.frames) {
      if (frame.isStatic) continue;
      const before = newestParent(frame);
      frame.samples = frame.samples.filter((s) => s.timeS <= nowS);
      if (frame.samples.length === 0) this.frames.delete(name);
      this.adopt(before, frame.samples.length > 0 ? newestParent(frame) : undefined);
    }
    this.version++;
  }

  /** Sorted names of all frames. */
  names(): string[] {
    return [...new Set([...this.frames.keys(), ...this.children.keys()])].sort();
  }

  has(name: string): boolean {
    const wanted = frameName(name);
    return this.frames.has(wanted) || this.children.has(wanted);
  }

  parentOf(name: string): string | undefined {
    const samples = this.frames.get(name)?.samples;
    return samples?.[samples.length - 1]?.parent;
  }

  /** Age of the last message with this frame [ms]; a static frame has the age 0. */
  ageMs(name: string, nowMs: number): number {
    const frame = this.frames.get(name);
    return !frame || frame.isStatic ? 0 : nowMs - frame.receivedMs;
  }

  root(name: string): string {
    let at = name;
    for (let i = 0; i < MOST_LINKS; i++) {
      const parent = this.parentOf(at);
      if (!parent) return at;
      at = parent;
    }
    return at;
  }

  /** Transform `targetFromSource` at a time; by default at the newest time that all transforms in the chain have. */
  lookup(target: string, source: string, timeS?: number): Lookup {
    const to = frameName(target);
    const from = frameName(source);
    if (to === from) return { kind: 'found', pose: IDENTITY };
    for (const name of [to, from]) {
      if (!this.has(name)) return { kind: 'later', why: t().transforms.noFrame(name) };
    }
    const up = this.chain(from);
    const down = this.chain(to);
    const common = up.find((name) => down.includes(name));
    if (common === undefined) {
      return { kind: 'later', why: t().transforms.apart(to, from) };
    }
    const used = [...up.slice(0, up.indexOf(common)), ...down.slice(0, down.indexOf(common))];
    const at = timeS ?? this.newestCommon(used);
    const commonFromSource = this.compose(up, common, at);
    if (!('t' in commonFromSource)) return commonFromSource;
    const commonFromTarget = this.compose(down, common, at);
    if (!('t' in commonFromTarget)) return commonFromTarget;
    return { kind: 'found', pose: multiply(inverse(commonFromTarget), commonFromSource) };
  }

  private chain(name: string): string[] {
    const out = [name];
    for (let at = this.parentOf(name); at && out.length < MOST_LINKS; at = this.parentOf(at)) {
      if (out.includes(at)) break;
      out.push(at);
    }
    return out;
  }

  private newestCommon(names: string[]): number {
    let newest = Infinity;
    for (const name of names) {
      const frame = this.frames.get(name)!;
      if (!frame.isStatic)
        newest = Math.min(newest, frame.samples[frame.samples.length - 1]!.timeS);
    }
    return newest;
  }

  private compose(chain: string[], end: string, timeS: number): Pose | Lookup {
    let ancestorFromStart = IDENTITY;
    for (const name of chain) {
      if (name === end) break;
      const found = this.at(name, timeS);
      if (!('t' in found)) return found;
      ancestorFromStart = multiply(found, ancestorFromStart);
    }
    return ancestorFromStart;
  }

  private at(name: string, timeS: number): Pose | Lookup {
    const { isStatic, samples } = this.frames.get(name)!;
    const newest = samples[samples.length - 1]!;
    if (isStatic || timeS === newest.timeS) return newest.parentFromChild;
    if (timeS > newest.timeS) {
      // As in tf2 there is no extrapolation: the next message may have the time requested.
      if (timeS === Infinity) return newest.parentFromChild;
      return {
        kind: 'later',
        why: t().transforms.newest(name, newest.timeS.toFixed(3)),
      };
    }
    if (timeS < samples[0]!.timeS) {
      return {
        kind: 'never',
        why: t().transforms.oldest(name, samples[0]!.timeS.toFixed(3)),
      };
    }
    let low = 0;
    let high = samples.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (samples[middle]!.timeS <= timeS) low = middle;
      else high = middle;
    }
    const [a, b] = [samples[low]!, samples[high]!];
    const u = (timeS - a.timeS) / (b.timeS - a.timeS);
    return interpolate(a.parentFromChild, b.parentFromChild, u);
  }
}
