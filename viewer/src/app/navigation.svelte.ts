/** Goals of Nav2's actions: their progress, and the reason why the robot stands. */
import type { Message } from '../core/cdr';
import {
  ACTIONS,
  goalRequest,
  hexadecimal,
  isActive,
  namespacesOf,
  newestGoal,
  positionText,
  poseText,
  readStatus,
  refusalText,
  resultError,
  TreeLog,
  GOAL,
  type ActionName,
  type Goal,
  type NavigatorStatus,
  type StampedPose,
} from '../core/nav2';
import { yawOf } from '../core/pose';
import { parseSchema } from '../core/schema';
import { poseOf, seconds, type PoseMessage, type Stamp } from '../core/types';
import type { App } from './app.svelte';
import { whyStanding } from './standing';
import { t } from '../texts/language.svelte';

export type Activity =
  'idle' | 'sending' | 'driving' | 'canceling' | 'reached' | 'canceled' | 'failed' | 'refused';

/** Shown numbers of the current or last goal. */
export interface Progress {
  /** Length of the remaining path [m]. */
  distanceM?: number;
  timeS?: number;
  remainingS?: number;
  recoveries?: number;
  /** Index of the current waypoint, from 1, and the number of waypoints if it is known. */
  waypoint?: number;
  waypoints?: number;
}

const FLUSH_MS = 200;
/** Time for the log message that explains a refused goal [ms]. */
const REFUSAL_LOG_MS = 600;
/** Time for other goals to end before a new one is sent [ms]. */
const END_MS = 5000;
const POLL_MS = 50;
/** Motion after which the robot counts as moving [m], [rad]. */
const MOVED_M = 0.02;
const TURNED_RAD = 0.03;
/** Action of the collision monitor that stops the robot. */
const STOP = 1;
/** Nodes whose log messages explain a refused goal. */
const NAVIGATORS = /(^|[./])(bt_navigator|waypoint_follower)$/;
const EVERY_GOAL = { goal_info: { goal_id: { uuid: new Uint8Array(16) } } } as unknown as Message;

export class Navigation {
  /** Namespaces with a navigator. */
  namespaces: string[] = $state.raw([]);
  namespace: string | undefined = $state();
  /** Actions that the navigator serves. */
  actions: ActionName[] = $state.raw([]);
  activity: Activity = $state('idle');
  /** Active action; empty without one. */
  action: ActionName | '' = $state('');
  /** Position of the goal in words; empty if it is unknown. */
  target = $state('');
  progress: Progress = $state.raw({});
  /** Running nodes of the behavior tree. */
  running: string[] = $state.raw([]);
  /** Reason why the robot stands; empty while it drives. */
  reason = $state('');
  /** Increases when the panel should be shown. */
  attention = $state(0);

  private goals = new Map<ActionName, Goal>();
  /** Action whose goal ended last. */
  private ended?: ActionName;
  private feedback: Partial<Record<ActionName, Message>> = {};
  private status?: NavigatorStatus;
  private tree = new TreeLog();
  private failure = '';
  private refusal = '';
  private isSending = false;
  private stoppedBy = '';
  private planEnd = '';
  /** Last goal of this page. */
  private sent?: { id: string; target: string; count: number };
  private hasBeenShown = false;
  private lastLog = { text: '', receivedMs: 0 };
  private moved?: { pose: PoseMessage; timeS: number };
  private leave: (() => void)[] = [];
  private flushing?: ReturnType<typeof setTimeout>;

  constructor(private app: App) {
    app.feed.subscribe('/rosout', (message) => {
      if (!NAVIGATORS.test(String(message.name))) return;
      this.lastLog = { text: String(message.msg), receivedMs: performance.now() };
    });
  }

  /** Follows the graph: call it when topics or services changed. */
  settle(): void {
    const names = [...this.app.topics, ...this.app.services].map((one) => one.name);
    const namespaces = namespacesOf(names);
    if (namespaces.join() !== this.namespaces.join()) this.namespaces = namespaces;
    const { chosen, isMany } = this.app.robots;
    // With several robots the navigator is that of the chosen one, which may have none.
    if (isMany && chosen) this.choose(chosen.navigator);
    const isKnown = isMany || (this.namespace !== undefined && namespaces.includes(this.namespace));
    if (!isKnown) this.choose(namespaces[0]);
    const served = ACTIONS.filter((one) => this.offer(one, 'send_goal'));
    if (served.join() !== this.actions.join()) this.actions = served;
  }

  /** Shows the navigator of a namespace. */
  choose(namespace: string | undefined): void {
    if (namespace === this.namespace) return;
    this.leave.forEach((leave) => leave());
    this.leave = [];
    this.forget();
    this.namespace = namespace;
    if (namespace === undefined) return;
    if (!this.hasBeenShown) this.attention++;
    this.hasBeenShown = true;
    for (const action of ACTIONS) {
      this.subscribe(`${action}/_action/status`, (message) => this.took(action, message));
      this.subscribe(`${action}/_action/feedback`, (message) => this.advanced(action, message));
    }
    this.subscribe('bt_navigator/status_reason', (message) => {
      // The servers are configured: their plugins have declared their parameters.
      if (!this.status) this.app.client.getParameters();
      this.status = readStatus(String(message.data));
    });
    this.subscribe('behavior_tree_log', (message) => this.tree.add(message));
    this.subscribe('plan', (message) => (this.planEnd = endOf(message)));
    this.subscribe('collision_monitor_state', (message) => {
      this.stoppedBy = Number(message.action_type) === STOP ? String(message.polygon_name) : '';
    });
  }

  private subscribe(topic: string, handler: (message: Message) => void): void {
    const name = `${this.namespace}/${topic}`;
    const unsubscribe = this.app.feed.subscribe(name, (message) => {
      handler(message);
      this.flushSoon();
    });
    this.leave.push(unsubscribe);
  }

  private forget(): void {
    this.goals.clear();
    this.tree.clear();
    this.feedback = {};
    this.status = this.ended = this.sent = this.moved = undefined;
    this.failure = this.refusal = this.stoppedBy = this.planEnd = this.target = '';
    this.progress = {};
    this.flush();
  }

  // Goals.

  /** True if a goal can be sent to the action of a navigator. */
  can(action: ActionName): boolean {
    return this.actions.includes(action);
  }

  /** Sends a goal, after the goals of other actions were canceled. */
  async send(action: ActionName, poses: StampedPose[]): Promise<void> {
    const name = this.full(action, 'send_goal');
    const offer = this.app.client.services.get(name);
    if (!offer || poses.length === 0) return;
    this.attention++;
    this.refusal = this.failure = '';
    this.isSending = true;
    const uuid = crypto.getRandomValues(new Uint8Array(16));
    const target = poseText(poses[poses.length - 1]!.pose);
    this.sent = { id: hexadecimal(uuid), target, count: poses.length };
    this.flush();
    const sentMs = performance.now();
    try {
      await this.end(ACTIONS.filter((one) => one !== action));
      const schema = parseSchema(
        offer.request?.schemaName ?? `${offer.type}_Request`,
        offer.request?.schema ?? offer.requestSchema ?? '',
      );
      const answer = await this.app.client.call(name, goalRequest(schema, uuid, poses));
      if (answer.accepted !== true) await this.refused(sentMs);
    } catch (error) {
      this.refusal = (error as Error).message;
    }
    this.isSending = false;
    this.flush();
  }

  /** A refusal has no text: the navigator writes the reason to the log. */
  private async refused(sentMs: number): Promise<void> {
    await new Promise((resolve) => setTimeout(resolve, REFUSAL_LOG_MS));
    const { text, receivedMs } = this.lastLog;
    this.refusal = refusalText(receivedMs >= sentMs ? text : '');
  }

  /** Cancels the goals of actions and waits until they are over. */
  private async end(actions: readonly ActionName[]): Promise<void> {
    const active = actions.filter((one) => isActive(this.goals.get(one)));
    if (active.length === 0) return;
    await this.cancelGoal(active[0]!);
    for (let waitedMs = 0; waitedMs < END_MS; waitedMs += POLL_MS) {
      if (!active.some((one) => isActive(this.goals.get(one)))) return;
      await new Promise((resolve) => setTimeout(resolve, POLL_MS));
    }
  }

  /** Cancels the goal of the active action, which cancels the goals that it sent. */
  async cancel(): Promise<void> {
    if (this.action) await this.cancelGoal(this.action);
  }

  private async cancelGoal(action: ActionName): Promise<void> {
    const answer = await this.app.call(this.full(action, 'cancel_goal'), EVERY_GOAL);
    if (answer && Number(answer.return_code) !== 0 && isActive(this.goals.get(action))) {
      this.app.notice('error', t().navigation.notCanceled(action));
    }
  }

  private full(action: ActionName, end: string): string {
    return `${this.namespace ?? ''}/${action}/_action/${end}`;
  }

  private offer(action: ActionName, end: string) {
    return this.namespace === undefined
      ? undefined
      : this.app.client.services.get(this.full(action, end));
  }

  // Messages.

  private took(action: ActionName, message: Message): void {
    const goal = newestGoal(message, this.app.clock.nowS);
    const before = this.goals.get(action);
    if (!goal) return;
    this.goals.set(action, goal);
    const isNew = before?.id !== goal.id;
    if (isNew && isActive(goal)) this.began(action, goal);
    if (isActive(goal) || (!isNew && before?.state === goal.state)) return;
    const other = this.ended && this.goals.get(this.ended);
    // At the start of the page the newest goal counts; afterwards the one that ended last.
    if (before || !other || other.acceptedS <= goal.acceptedS) this.ended = action;
    if (goal.state === GOAL.aborted) void this.askWhy(action, goal);
  }

  private began(action: ActionName, goal: Goal): void {
    const isInner = ACTIONS.some(
      (one) => ACTIONS.indexOf(one) < ACTIONS.indexOf(action) && isActive(this.goals.get(one)),
    );
    delete this.feedback[action];
    this.moved = undefined;
    if (isInner) return;
    this.refusal = this.failure = this.planEnd = '';
    this.tree.clear();
    // A goal of another client.
    if (goal.id !== this.sent?.id) this.sent = undefined;
  }

  private advanced(action: ActionName, message: Message): void {
    this.feedback[action] = (message.feedback ?? {}) as Message;
    const pose = (this.feedback[action].current_pose as { pose?: PoseMessage } | undefined)?.pose;
    if (!pose) return;
    if (!this.moved || isApart(this.moved.pose, pose)) {
      this.moved = { pose, timeS: this.app.clock.nowS };
    }
  }

  /** Result of a failed goal, also of one of another client. */
  private async askWhy(action: ActionName, goal: Goal): Promise<void> {
    const name = this.full(action, 'get_result');
    if (!this.app.client.services.has(name)) return;
    const request = { goal_id: { uuid: goal.uuid } } as unknown as Message;
    const result = await this.app.client.call(name, request).catch(() => undefined);
    if (!result || this.goals.get(action)?.id !== goal.id || this.ended !== action) return;
    this.failure = resultError(result);
    this.flush();
  }

  // Shown values.

  private flushSoon(): void {
    this.flushing ??= setTimeout(() => this.flush(), FLUSH_MS);
  }

  /** Updates the shown values. */
  flush(): void {
    clearTimeout(this.flushing);
    this.flushing = undefined;
    this.action = ACTIONS.find((one) => isActive(this.goals.get(one))) ?? '';
    this.activity = this.activityNow();
    const hasGoal = this.action !== '';
    if (hasGoal) this.progress = this.progressNow();
    if (hasGoal || this.isSending) this.target = this.targetNow();
    const leaves = this.status?.running ?? this.tree.names();
    const running = hasGoal ? leaves : [];
    if (running.join() !== this.running.join()) this.running = running;
    this.reason = this.reasonNow(hasGoal);
    // The time without motion grows also without messages.
    if (hasGoal || this.isSending) this.flushSoon();
  }

  private activityNow(): Activity {
    if (this.isSending) return 'sending';
    if (this.action) {
      return this.goals.get(this.action)?.state === GOAL.canceling ? 'canceling' : 'driving';
    }
    if (this.refusal) return 'refused';
    const last = this.ended && this.goals.get(this.ended)?.state;
    if (last === GOAL.succeeded) return 'reached';
    if (last === GOAL.aborted) return 'failed';
    return last === GOAL.canceled ? 'canceled' : 'idle';
  }

  private progressNow(): Progress {
    const follow = this.feedback.follow_waypoints;
    const own = this.feedback.navigate_to_pose;
    const through = this.feedback.navigate_through_poses;
    const now = this.action === 'navigate_through_poses' ? through : own;
    const count = this.sent?.count;
    const left = through && Number(through.number_of_poses_remaining);
    const waypoint =
      this.action === 'follow_waypoints'
        ? follow && Number(follow.current_waypoint) + 1
        : this.action === 'navigate_through_poses' && count !== undefined && left !== undefined
          ? Math.min(count, count - left + 1)
          : undefined;
    return {
      // Without a path the distance is 0.
      distanceM: Number(now?.distance_remaining) || undefined,
      timeS: now && seconds(now.navigation_time as unknown as Stamp),
      remainingS: now && seconds(now.estimated_time_remaining as unknown as Stamp),
      recoveries: now && Number(now.number_of_recoveries),
      waypoint,
      waypoints: waypoint === undefined ? undefined : count,
    };
  }

  private targetNow(): string {
    if (this.action === 'follow_waypoints' || !this.sent) return this.planEnd;
    return this.sent.target;
  }

  private reasonNow(hasGoal: boolean): string {
    const { clock, worldName } = this.app;
    const isPaused = worldName !== '' && clock.isPaused(performance.now());
    const hasFailed = this.activity === 'failed';
    return whyStanding({
      hasGoal: hasGoal || this.isSending,
      isPaused,
      stillS: this.moved ? clock.nowS - this.moved.timeS : 0,
      refusal: this.refusal,
      failure: hasFailed ? this.failure || this.status?.outcome || '' : '',
      lastError: this.status?.lastError ?? '',
      stoppedBy: this.stoppedBy,
      running: this.running,
    });
  }
}

function isApart(a: PoseMessage, b: PoseMessage): boolean {
  const distanceM = Math.hypot(a.position.x - b.position.x, a.position.y - b.position.y);
  const turnRad = yawOf(poseOf(a).q) - yawOf(poseOf(b).q);
  const aroundRad = Math.abs(Math.atan2(Math.sin(turnRad), Math.cos(turnRad)));
  return distanceM > MOVED_M || aroundRad > TURNED_RAD;
}

/** Position of the last pose of a path in words. */
function endOf(message: Message): string {
  const poses = (message.poses ?? []) as unknown as { pose: PoseMessage }[];
  const last = poses[poses.length - 1];
  return last ? positionText(last.pose) : '';
}
