/** Client of any action: goals, feedback, states and results, also of goals that other programs sent. */
import type { Message } from '../core/cdr';
import { hexadecimal } from '../core/nav2';
import { definitionOf, parseSchema, type Definition, type Schema } from '../core/schema';
import { seconds, type Stamp } from '../core/types';
import type { App } from './app.svelte';

const SEND_GOAL = '/_action/send_goal';
const FIRST_OVER = 4;
const MAX_GOALS = 20;
/** Time after which the result of a goal that is over counts as missing [ms]. */
const RESULT_TIMEOUT_MS = 5000;

export interface GoalRow {
  id: string;
  uuid: Uint8Array;
  /** State of `action_msgs/msg/GoalStatus`. */
  state: number;
  isOwn: boolean;
  acceptedS: number;
  feedback?: Message;
  result?: Message;
  /** True if the result was asked for and did not arrive. */
  isResultMissing?: boolean;
}

/** Names of all actions that are served, sorted. */
export function actionsOf(services: readonly { name: string }[]): string[] {
  return services
    .filter(({ name }) => name.endsWith(SEND_GOAL))
    .map(({ name }) => name.slice(0, -SEND_GOAL.length))
    .sort();
}

export const isOver = (state: number): boolean => state >= FIRST_OVER;

/** Goals of a status message, merged with what is known of them; the newest first. */
export function mergedGoals(known: readonly GoalRow[], message: Message): GoalRow[] {
  const list = (message.status_list ?? []) as {
    goal_info: { goal_id: { uuid: Uint8Array }; stamp: Stamp };
    status: number;
  }[];
  const rows = new Map(known.map((goal) => [goal.id, goal]));
  for (const { goal_info: info, status } of list) {
    const id = hexadecimal(info.goal_id.uuid);
    const before = rows.get(id);
    rows.set(id, {
      // The bytes are a part of the received message: copied, since they are kept.
      ...(before ?? { id, uuid: Uint8Array.from(info.goal_id.uuid), isOwn: false }),
      state: Number(status),
      acceptedS: seconds(info.stamp),
    });
  }
  return [...rows.values()].sort((a, b) => b.acceptedS - a.acceptedS).slice(0, MAX_GOALS);
}

export class ActionClient {
  goals: GoalRow[] = $state.raw([]);
  isSending = $state(false);
  private leave: (() => void)[];
  private asked = new Set<string>();

  constructor(
    private app: App,
    readonly name: string,
  ) {
    this.leave = [
      app.feed.subscribe(`${name}/_action/status`, (message) => {
        this.goals = mergedGoals(this.goals, message);
        for (const goal of this.goals) if (isOver(goal.state)) void this.askResult(goal);
      }),
      app.feed.subscribe(`${name}/_action/feedback`, (message) => {
        const { uuid } = message.goal_id as { uuid: Uint8Array };
        this.change(hexadecimal(uuid), { feedback: message.feedback as Message });
      }),
    ];
  }

  stop(): void {
    this.leave.forEach((one) => one());
  }

  /** Definition of the goal; throws if the server has not sent it. */
  goalDefinition(): { schema: Schema; definition: Definition } {
    const offer = this.app.client.services.get(`${this.name}${SEND_GOAL}`);
    if (!offer) throw new Error(`${this.name}${SEND_GOAL} is not served`);
    const schema = parseSchema(
      offer.request?.schemaName ?? `${offer.type}_Request`,
      offer.request?.schema ?? offer.requestSchema ?? '',
    );
    const goal = schema.root.fields.find((field) => field.name === 'goal');
    if (!goal) throw new Error(`${schema.root.name} has no field "goal"`);
    return { schema, definition: definitionOf(schema, goal.type) };
  }

  /** Sends a goal. Returns false if the server rejected it; fails if it does not answer. */
  async send(goal: Record<string, unknown>): Promise<boolean> {
    const uuid = crypto.getRandomValues(new Uint8Array(16));
    const id = hexadecimal(uuid);
    this.isSending = true;
    try {
      const answer = await this.app.client.call(`${this.name}${SEND_GOAL}`, {
        goal_id: { uuid },
        goal,
      });
      if (answer.accepted !== true) return false;
      const stamp = answer.stamp as Stamp | undefined;
      const acceptedS = (stamp && seconds(stamp)) || this.app.clock.nowS;
      const known = this.goals.find((one) => one.id === id);
      if (known) this.change(id, { isOwn: true });
      else this.goals = [{ id, uuid, state: 1, isOwn: true, acceptedS }, ...this.goals];
      return true;
    } finally {
      this.isSending = false;
    }
  }

  /** Cancels a goal, or all goals. Returns the server's code, 0 for success; fails if it does not answer. */
  async cancel(goal?: GoalRow): Promise<number> {
    const uuid = goal?.uuid ?? new Uint8Array(16);
    const answer = await this.app.client.call(`${this.name}/_action/cancel_goal`, {
      goal_info: { goal_id: { uuid }, stamp: { sec: 0, nanosec: 0 } },
    });
    return Number(answer.return_code);
  }

  private async askResult({ id, uuid }: GoalRow): Promise<void> {
    if (this.asked.has(id)) return;
    this.asked.add(id);
    const service = `${this.name}/_action/get_result`;
    try {
      const answer = await this.app.client.call(service, { goal_id: { uuid } }, RESULT_TIMEOUT_MS);
      // The server answers with the state 0 for a goal that it has forgotten.
      if (Number(answer.status) === 0) throw new Error('unknown goal');
      this.change(id, { result: (answer.result ?? {}) as Message });
    } catch {
      this.change(id, { isResultMissing: true });
    }
  }

  private change(id: string, more: Partial<GoalRow>): void {
    this.goals = this.goals.map((goal) => (goal.id === id ? { ...goal, ...more } : goal));
  }
}
