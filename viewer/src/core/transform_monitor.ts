/** Observation of transforms as they are published: rates, ages, and faults that a buffer hides. */
import { frameName } from './tf';
import { seconds, type TransformStamped } from './types';
import type { Quat } from './pose';

export type TransformFault =
  | { kind: 'parents'; frame: string; parents: string[] }
  | { kind: 'loop'; frames: string[] }
  | { kind: 'both'; frame: string }
  | { kind: 'self'; frame: string }
  | { kind: 'number'; frame: string }
  | { kind: 'trees'; roots: string[] };

export interface FrameRow {
  name: string;
  depth: number;
  /** Undefined for a root. */
  parent?: string;
  isStatic: boolean;
  /** Messages per second of their time; undefined for static frames and those with fewer than two messages. */
  rateHz?: number;
  /** Age of the newest transform [s]; undefined for static frames. */
  ageS?: number;
}

interface Seen {
  /** Time of the last message by parent [s]. */
  parents: Map<string, number>;
  isStatic: boolean;
  isDynamic: boolean;
  hasBadNumber: boolean;
  stamps: number[];
  /** Time of the newest transform, by the clock of the ages [s]. */
  newestS: number;
}

/** Stamps from which a rate is computed, at most. */
const MAX_STAMPS = 200;
const RATE_S = 5;
/** A frame that had another parent at most this time ago has two parents [s]. */
const PARENTS_S = 3;
const MAX_DEPTH = 200;

export class TransformMonitor {
  private frames = new Map<string, Seen>();
  private selves = new Set<string>();

  clear(): void {
    this.frames.clear();
    this.selves.clear();
  }

  /**
   * `receivedS`: time of reception, where ages are those of messages: in a recording, whose stamps may be of another
   * clock. Without it, ages are those of the stamps.
   */
  add(message: TransformStamped, isStatic: boolean, receivedS?: number): void {
    const child = frameName(message.child_frame_id);
    const parent = frameName(message.header.frame_id);
    if (child === parent) {
      this.selves.add(child);
      return;
    }
    let seen = this.frames.get(child);
    if (!seen) {
      seen = {
        parents: new Map(),
        isStatic: false,
        isDynamic: false,
        hasBadNumber: false,
        stamps: [],
        newestS: 0,
      };
      this.frames.set(child, seen);
    }
    const stampS = seconds(message.header.stamp);
    seen.parents.delete(parent);
    seen.parents.set(parent, stampS);
    if (isStatic) seen.isStatic = true;
    else seen.isDynamic = true;
    const { translation: t, rotation: r } = message.transform;
    const norm = Math.hypot(r.x, r.y, r.z, r.w);
    const isGood = [t.x, t.y, t.z].every(Number.isFinite) && Math.abs(norm - 1) < 0.01;
    seen.hasBadNumber = !isGood;
    const { stamps } = seen;
    // Time jumped back: a simulation was reset, or a recording was rewound.
    if (stamps.length > 0 && stampS < stamps[stamps.length - 1]! - RATE_S) {
      stamps.length = 0;
      seen.parents = new Map([[parent, stampS]]);
    }
    stamps.push(stampS);
    seen.newestS = receivedS ?? stampS;
    if (stamps.length > MAX_STAMPS) stamps.shift();
  }

  /** Frames as a tree: parents before their children. */
  rows(nowS: number): FrameRow[] {
    const children = new Map<string, string[]>();
    for (const child of this.frames.keys()) {
      const parent = this.parentOf(child)!;
      children.set(parent, [...(children.get(parent) ?? []), child]);
    }
    const out: FrameRow[] = [];
    const done = new Set<string>();
    const visit = (name: string, depth: number): void => {
      if (done.has(name) || depth > MAX_DEPTH) return;
      done.add(name);
      out.push(this.row(name, depth, nowS));
      for (const child of (children.get(name) ?? []).sort()) visit(child, depth + 1);
    };
    for (const root of this.roots()) visit(root, 0);
    // Frames of a loop have no root.
    for (const name of [...this.frames.keys()].sort()) visit(name, 0);
    return out;
  }

  private row(name: string, depth: number, nowS: number): FrameRow {
    const seen = this.frames.get(name);
    if (!seen) return { name, depth, isStatic: false };
    const isStatic = seen.isStatic && !seen.isDynamic;
    const row = { name, depth, parent: this.parentOf(name), isStatic };
    if (isStatic) return row;
    return { ...row, ageS: nowS - seen.newestS, rateHz: rateOf(seen.stamps) };
  }

  private parentOf(name: string): string | undefined {
    const parents = this.frames.get(name)?.parents;
    return parents && [...parents.keys()].pop();
  }

  private roots(): string[] {
    const all = new Set<string>();
    for (const child of this.frames.keys()) all.add(this.parentOf(child)!);
    return [...all].filter((name) => !this.frames.has(name)).sort();
  }

  faults(): TransformFault[] {
    const out: TransformFault[] = [...this.selves].map((frame) => ({ kind: 'self', frame }));
    for (const [frame, { parents, isStatic, isDynamic, hasBadNumber }] of this.frames) {
      const newest = Math.max(...parents.values());
      const recent = [...parents].filter(([, timeS]) => isStatic || timeS > newest - PARENTS_S);
      if (recent.length > 1) {
        out.push({ kind: 'parents', frame, parents: recent.map(([name]) => name).sort() });
      }
      if (isStatic && isDynamic) out.push({ kind: 'both', frame });
      if (hasBadNumber) out.push({ kind: 'number', frame });
    }
    out.push(...this.loops());
    const roots = this.roots();
    if (roots.length > 1) out.push({ kind: 'trees', roots });
    return out;
  }

  private loops(): TransformFault[] {
    const found = new Map<string, string[]>();
    for (const start of this.frames.keys()) {
      const chain = [start];
      for (let at = this.parentOf(start); at; at = this.parentOf(at)) {
        const begin = chain.indexOf(at);
        if (begin >= 0) {
          const loop = chain.slice(begin);
          found.set([...loop].sort().join(), loop);
          break;
        }
        chain.push(at);
      }
    }
    return [...found.values()].map((frames) => ({ kind: 'loop', frames }));
  }
}

/** Messages per second of their time, over the last seconds. */
export function rateOf(stamps: readonly number[]): number | undefined {
  const last = stamps[stamps.length - 1];
  if (last === undefined) return undefined;
  const recent = stamps.filter((one) => one > last - RATE_S);
  const spanS = last - Math.min(...recent);
  return spanS > 0 ? (recent.length - 1) / spanS : undefined;
}

/** Rotation as roll, pitch, yaw about fixed axes [rad]. */
export function rpyOf([x, y, z, w]: Quat): [number, number, number] {
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(Math.min(1, Math.max(-1, 2 * (w * y - z * x)))),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}
