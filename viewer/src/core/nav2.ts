/**
 * Messages of Nav2's actions and of its navigator. Requests are built from the definitions that the server sends,
 * since the fields differ between releases.
 */
import type { Message } from './cdr';
import { definitionOf, type Schema } from './schema';
import { seconds, type PoseMessage, type Stamp } from './types';
import { t } from '../texts/language.svelte';

/** Actions that drive the robot. Each sends goals to the ones after it. */
export const ACTIONS = ['follow_waypoints', 'navigate_through_poses', 'navigate_to_pose'] as const;
export type ActionName = (typeof ACTIONS)[number];

/** States of `action_msgs/msg/GoalStatus`. */
export const GOAL = { canceling: 3, succeeded: 4, canceled: 5, aborted: 6 } as const;

export interface StampedPose {
  frame: string;
  pose: PoseMessage;
}

/** Goal of an action, in one of the states of `GOAL`; 1 is accepted. */
export interface Goal {
  /** UUID as hexadecimal digits. */
  id: string;
  uuid: Uint8Array;
  state: number;
  acceptedS: number;
}

/** Largest difference between the clocks of a server and of the page [s]. */
const CLOCK_SKEW_S = 1;

/** Namespaces that have one of the actions, sorted: "" for the root, "/robot1". */
export function namespacesOf(names: readonly string[]): string[] {
  const found = names.map((name) => ACTION_PART.exec(name)?.[1]);
  return [...new Set(found.filter((one) => one !== undefined))].sort();
}

const ACTION_PART = new RegExp(`^(.*)/(?:${ACTIONS.join('|')})/_action/(?:send_goal|status)$`);

/** True while a goal is accepted, executed or being canceled. */
export function isActive(goal: Goal | undefined): boolean {
  return !!goal && goal.state >= 1 && goal.state <= GOAL.canceling;
}

/**
 * Current goal of a status message: the newest of those that are not over, otherwise the newest. Goals that were
 * accepted after the present time, before a reset of the simulation, count only if there are no others.
 */
export function newestGoal(message: Message, nowS: number): Goal | undefined {
  const list = (message.status_list ?? []) as unknown as {
    goal_info: { goal_id: { uuid: Uint8Array }; stamp: Stamp };
    status: number;
  }[];
  const goals = list.map(({ goal_info: info, status }): Goal => {
    // The bytes are a part of the received message: copied, since they are kept.
    const uuid = Uint8Array.from(info.goal_id.uuid);
    const id = hexadecimal(uuid);
    return { id, uuid, state: Number(status), acceptedS: seconds(info.stamp) };
  });
  const rank = (goal: Goal) => (isActive(goal) ? 2 : goal.acceptedS <= nowS + CLOCK_SKEW_S ? 1 : 0);
  return goals.sort((a, b) => rank(a) - rank(b) || a.acceptedS - b.acceptedS).pop();
}

export function hexadecimal(bytes: ArrayLike<number>): string {
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
}

/** Request of an action's `send_goal`: one pose, a list of poses, or (since 2025) `nav_msgs/Goals`. */
export function goalRequest(schema: Schema, uuid: Uint8Array, poses: StampedPose[]): Message {
  const goal = schema.root.fields.find((field) => field.name === 'goal');
  const fields = goal ? definitionOf(schema, goal.type).fields : [];
  const stamp = { sec: 0, nanosec: 0 };
  const stamped = poses.map(({ frame, pose }) => ({ header: { stamp, frame_id: frame }, pose }));
  const list = fields.find((field) => field.name === 'poses');
  const goals = { header: { stamp, frame_id: poses[0]?.frame ?? '' }, goals: stamped };
  const content = !list
    ? { pose: stamped[0] }
    : { poses: list.array === undefined ? goals : stamped };
  return { goal_id: { uuid }, goal: content } as unknown as Message;
}

/** Position and heading of a pose in words: "1.20, -0.50 m, 90°". */
export function poseText({ position: { x, y }, orientation: { z, w } }: PoseMessage): string {
  const yawDeg = (2 * Math.atan2(z, w) * 180) / Math.PI;
  const around = yawDeg - 360 * Math.round(yawDeg / 360);
  return `${fixed(x, 2)}, ${fixed(y, 2)} m, ${fixed(around, 0)}°`;
}

/** Position of a pose in words: "1.20, -0.50 m". */
export function positionText({ position: { x, y } }: PoseMessage): string {
  return `${fixed(x, 2)}, ${fixed(y, 2)} m`;
}

/** Number with some decimals, without the sign of a zero. */
function fixed(value: number, decimals: number): string {
  return value.toFixed(decimals).replace(/^-(0(\.0+)?)$/, '$1');
}

/** Content of the sentence on `bt_navigator/status_reason`. */
export interface NavigatorStatus {
  /** Action that is executed; empty without a goal. */
  action: string;
  /** Running tree nodes, in the order of the tree. */
  running: string[];
  recoveries: number;
  /** Error that a server answered last. */
  lastError: string;
  /** Outcome of the last goal. */
  outcome: string;
}

const LAST_ERROR = '; last error: ';
const NO_GOAL = 'no goal';

/** Reads a sentence such as `navigate_to_pose: Spin (2 recoveries); last error: ...`. */
export function readStatus(text: string): NavigatorStatus {
  const at = text.indexOf(LAST_ERROR);
  const lastError = at < 0 ? '' : text.slice(at + LAST_ERROR.length);
  const head = at < 0 ? text : text.slice(0, at);
  const status = { action: '', running: [] as string[], recoveries: 0, lastError, outcome: '' };
  if (head.startsWith(NO_GOAL)) {
    return { ...status, outcome: head.slice(NO_GOAL.length).replace(/^; /, '') };
  }
  const [, action = '', nodes = ''] = /^(\w+): (.*)$/s.exec(head) ?? [];
  const count = / \((\d+) recover(?:y|ies)\)$/.exec(nodes);
  const names = count ? nodes.slice(0, count.index) : nodes;
  return {
    ...status,
    action,
    running: names === 'between two steps' || !names ? [] : names.split(', '),
    recoveries: Number(count?.[1] ?? 0),
  };
}

/** Reason of a refused goal, from the log message that reports it, which may be empty. */
export function refusalText(logged: string): string {
  const reason = logged.replace(/^rejected a goal of `\w+`: /, '');
  return t().navigation.refused(reason || t().navigation.noReason);
}

/** Error of a finished goal in words; empty without one. */
export function resultError(response: Message): string {
  const result = (response.result ?? {}) as Message;
  const code = Number(result.error_code ?? 0);
  const text = String(result.error_msg ?? '');
  if (code === 0) return text;
  const named = t().navigation.errorCode(code);
  return text ? `${text} (${named})` : named;
}

/** Running nodes of the tree, from the changes on `behavior_tree_log`. */
export class TreeLog {
  private running = new Map<string, string>();

  add(message: Message): void {
    const events = (message.event_log ?? []) as unknown as {
      node_name: string;
      uid?: number;
      current_status: string;
    }[];
    for (const { node_name: name, uid, current_status: status } of events) {
      const key = `${name} ${uid ?? ''}`;
      if (status === 'RUNNING') this.running.set(key, name);
      else this.running.delete(key);
    }
  }

  names(): string[] {
    return [...this.running.values()];
  }

  clear(): void {
    this.running.clear();
  }
}
