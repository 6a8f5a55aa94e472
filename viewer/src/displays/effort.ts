/** Effort: torques of joints as rings with an arrow head around the joint axes. */
import { t } from '../texts/language.svelte';
import { Color, Group, Matrix4, Mesh, Quaternion, Vector3 } from 'three';
import type { Message } from '../core/cdr';
import { type Pose } from '../core/pose';
import { seconds, type Header } from '../core/types';
import { arrowGeometry, matrixOf, polyline, surface } from '../scene/shapes';
import { dispose } from '../scene/stage';
import { Display, type Kind } from './display';
import { readJoints, type Joint } from './joints';
import { alpha, number, text, topic, type Option } from './options';
import { history } from './stamped';

interface JointState {
  header: Header;
  name: string[];
  effort: Float64Array;
}

/** Points of a ring, of 32: a part is left open so that the direction is seen. */
const RING_POINTS = 30;
const RING_PARTS = 32;
const RADIUS_M = 0.05;

/** Colour from violet (0) over blue, green and yellow to red (1), as RViz' EffortVisual has it. */
export function effortColor(part: number): Color {
  const h = Math.min(1, Math.max(0, part)) * 5 + 1;
  const i = Math.floor(h);
  const f = i % 2 === 0 ? 1 - (h - i) : h - i;
  const n = 1 - f;
  const [r, g, b] =
    i <= 1
      ? [n, 0, 1]
      : i === 2
        ? [0, n, 1]
        : i === 3
          ? [0, 1, n]
          : i === 4
            ? [n, 1, 0]
            : [1, n, 0];
  return new Color().setRGB(r!, g!, b!, 'srgb');
}

/** Part of the largest effort, as RViz scales it. */
export function effortPart(effort: number, maxEffort: number): number {
  const size = Math.abs(effort);
  return (maxEffort > 0 ? Math.min(size / maxEffort, 1) : size) + 0.05;
}

class EffortDisplay extends Display {
  private joints = new Map<string, Joint>();
  private leaveDescription?: () => void;
  private kept: Group[] = [];
  private latest?: { state: JointState; sinceMs: number };

  override start(): void {
    super.start();
    this.leaveDescription?.();
    const name = this.get<string>('Robot Description');
    this.host.status('URDF', 'warn', t().valueDisplays.noDescription(name));
    this.leaveDescription = this.context.subscribe(name, (message) => {
      try {
        const joints = readJoints(String(message.data)).filter(isDrawn);
        this.joints = new Map(joints.map((joint) => [joint.name, joint]));
        this.host.status('URDF', 'ok', t().valueDisplays.revolute(joints.length));
        for (const joint of joints) this.note(`Joints/${joint.name}`);
      } catch (error) {
        this.host.status('URDF', 'error', (error as Error).message);
      }
    });
  }

  private note(path: string): void {
    if (!(path in this.values)) this.host.note(path, true);
  }

  protected override receive(message: Message): void {
    const state = message as never as JointState;
    if (state.effort.length === 0) {
      this.host.status('Effort', 'warn', t().valueDisplays.noEfforts);
      return;
    }
    if (state.effort.length !== state.name.length) {
      throw new Error(t().valueDisplays.effortCount(state.name.length, state.effort.length));
    }
    this.latest = { state, sinceMs: performance.now() };
  }

  override tick(nowMs: number): void {
    if (!this.latest || this.joints.size === 0) return;
    const { state, sinceMs } = this.latest;
    const group = this.build(state, nowMs - sinceMs > PATIENCE_MS);
    if (!group) return;
    this.latest = undefined;
    this.root.add(group);
    this.kept.push(group);
    const most = Math.max(1, this.get<number>('History Length'));
    while (this.kept.length > most) dispose(this.kept.shift()!);
    this.context.stage.invalidate();
  }

  /** Rings of a message; `undefined` while transforms at its time are missing. */
  private build(state: JointState, isLate: boolean): Group | undefined {
    const group = new Group();
    const prefix = this.get<string>('TF Prefix');
    let count = 0;
    for (let i = 0; i < state.name.length; i++) {
      const joint = this.joints.get(state.name[i]!);
      const effort = state.effort[i]!;
      if (!joint || !Number.isFinite(effort)) continue;
      if (this.values[`Joints/${joint.name}`] === false) continue;
      const frame = prefix ? `${prefix}/${joint.child}` : joint.child;
      const fixed = this.context.fixedFrame();
      const at = isLate ? undefined : seconds(state.header.stamp);
      const found = this.context.tf.lookup(fixed, frame, at);
      if (found.kind === 'later' && !isLate) return undefined;
      if (found.kind !== 'found') {
        this.host.status('Transform', 'error', found.why);
        continue;
      }
      this.host.status('Transform', 'ok');
      group.add(this.ring(joint, effort, found.pose));
      count++;
    }
    this.host.status('Effort', 'ok', t().valueDisplays.joints(count));
    return group;
  }

  private ring(joint: Joint, effort: number, fixedFromChild: Pose): Group {
    const part = effortPart(effort, joint.maxEffort);
    const radius = RADIUS_M + part * this.get<number>('Scale') * 0.5;
    const width = this.get<number>('Width');
    const paint = effortColor(part);
    const sign = effort < 0 ? -1 : 1;
    const points: number[] = [];
    for (let i = 0; i < RING_POINTS; i++) {
      const angle = (i * 2 * Math.PI) / RING_PARTS;
      points.push(sign * radius * Math.sin(angle), radius * Math.cos(angle), 0);
    }
    const out = new Group();
    const opacity = this.get<number>('Alpha');
    out.add(polyline(points, paint, opacity, width));
    const head = new Mesh(arrowGeometry(1e-6, 1e-6, width * 2, width * 2), surface(paint, opacity));
    const back = new Quaternion().setFromUnitVectors(
      new Vector3(1, 0, 0),
      new Vector3(-sign, 0, 0),
    );
    head.applyMatrix4(new Matrix4().compose(new Vector3(0, radius, 0), back, new Vector3(1, 1, 1)));
    out.add(head);
    const turn = new Quaternion().setFromUnitVectors(
      new Vector3(0, 0, 1),
      new Vector3(...joint.axis).normalize(),
    );
    out.matrixAutoUpdate = false;
    out.matrix
      .copy(matrixOf(fixedFromChild))
      .multiply(new Matrix4().makeRotationFromQuaternion(turn));
    out.userData.inspect = () => ({
      Joint: joint.name,
      Effort: `${effort.toPrecision(4)} N·m`,
      'Max Effort': `${joint.maxEffort} N·m`,
    });
    return out;
  }

  override changed(path: string): void {
    if (path === 'Robot Description') this.start();
    super.changed(path);
  }

  override moved(): void {
    this.clear();
  }

  override clear(): void {
    this.kept = [];
    this.latest = undefined;
    this.empty();
  }

  override stop(): void {
    this.leaveDescription?.();
    super.stop();
  }
}

const PATIENCE_MS = 700;
const isDrawn = ({ type }: Joint) => type === 'revolute' || type === 'continuous';

const JOINT_STATE = ['sensor_msgs/msg/JointState'];
const options: Option[] = [
  ...topic('Topic', '', JOINT_STATE, { isFiltered: true }),
  alpha('Alpha', 1),
  number('Width', 0.02, { min: 0.001, step: 0.005 }),
  number('Scale', 1, { min: 0, step: 0.1 }),
  history,
  text('Robot Description', '/robot_description'),
  text('TF Prefix', ''),
];

export const effort: Kind = {
  class: 'rviz_default_plugins/Effort',
  also: ['rviz/Effort'],
  title: 'Effort',
  get help() {
    return t().valueDisplays.effort;
  },
  types: JOINT_STATE,
  options,
  make: (...all) => new EffortDisplay(...all),
};
