/** Teleoperation by keys and joystick, and Gazebo's Key Publisher. */
import type { App } from './app.svelte';
import { faster, FIRST_SPEEDS, MOVES, qtCode, SPEEDS, twist } from './teleop';

/** Period at which the command of a held key is published again [ms]: robots have a command timeout. */
const REPEAT_MS = 100;

export class Driver {
  isOn = $state(true);
  topic = $state('/cmd_vel');
  isStamped = $state(false);
  /** Stops on release, as users of a page expect; teleop_twist_keyboard continues until `k`. */
  stopsOnRelease = $state(true);
  speeds = $state({ ...FIRST_SPEEDS });
  move: readonly number[] = $state([0, 0, 0, 0]);
  sendsKeys = $state(false);
  keyTopic = $state('/keyboard/keypress');
  lastKey = $state('');
  private isChosen = false;
  /** Namespace of the robot for which the topic was selected. */
  private robot?: string;
  private held: string[] = [];
  private timer?: ReturnType<typeof setInterval>;

  constructor(private app: App) {}

  /** Topics of velocity commands that have a subscriber. */
  topics(): string[] {
    const { chosen, isMany } = this.app.robots;
    const found = this.app.topics
      .filter((t) => !isMany || !chosen || t.name.startsWith(`${chosen.namespace}/`))
      .filter((t) => /(^|\/)cmd_vel\w*$/.test(t.name) || /Twist(Stamped)?$/.test(t.type))
      .map((t) => t.name);
    return [...new Set([this.topic, ...found])].sort();
  }

  /** Selects the topic that a robot subscribes to, unless the user chose one. */
  settle(): void {
    const { chosen, isMany } = this.app.robots;
    if (isMany && chosen && chosen.namespace !== this.robot) {
      const topic = chosen.commandTopics[0] ?? `${chosen.namespace}/cmd_vel`;
      // The robot before must not go on.
      if (this.isDriven()) this.go([0, 0, 0, 0]);
      this.isChosen = chosen.commandTopics.length > 0;
      this.robot = this.isChosen ? chosen.namespace : undefined;
      this.topic = topic;
      const row = this.app.topics.find((one) => one.name === topic);
      if (row?.type) this.isStamped = row.type.endsWith('/TwistStamped');
      return;
    }
    const listened = this.app.topics.filter((t) => t.subscribers.length > 0).map((t) => t.name);
    if (this.isChosen || listened.includes(this.topic)) return;
    const found = listened.find((name) => /(^|\/)cmd_vel$/.test(name));
    if (found) this.topic = found;
  }

  choose(topic: string): void {
    this.isChosen = true;
    this.topic = topic;
  }

  isDriven(): boolean {
    return this.move.some((part) => part !== 0);
  }

  /** Returns true if the key is one of the teleoperation keys. */
  keyDown(event: KeyboardEvent): boolean {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    if (this.sendsKeys) this.passOn(event.key);
    if (!this.isOn) return this.sendsKeys && event.key.startsWith('Arrow');
    const { key } = event;
    if (SPEEDS[key]) {
      this.speeds = faster(key, this.speeds);
      return true;
    }
    if (key === 'k') {
      this.held = [];
      this.go([0, 0, 0, 0]);
      return true;
    }
    const move = MOVES[key];
    if (!move) return false;
    if (event.repeat) return true;
    this.held = [...this.held.filter((k) => k !== key), key];
    this.go(move);
    return true;
  }

  keyUp(event: KeyboardEvent): void {
    const wasHeld = this.held.length > 0;
    const key = event.key.toLowerCase();
    this.held = this.held.filter((k) => k.toLowerCase() !== key);
    if (!wasHeld || !this.stopsOnRelease) return;
    const last = this.held[this.held.length - 1];
    this.go(last ? MOVES[last]! : [0, 0, 0, 0]);
  }

  /** Releases all keys: a page without the focus receives no key events. */
  release(): void {
    if (this.held.length > 0) {
      this.held = [];
      if (this.stopsOnRelease) this.go([0, 0, 0, 0]);
    }
  }

  private passOn(key: string): void {
    const code = qtCode(key);
    if (code === undefined) return;
    this.lastKey = `${key === ' ' ? 'Space' : key} = ${code}`;
    this.app.publish(this.keyTopic, 'std_msgs/msg/Int32', { data: code });
  }

  /** Fractions of the maximum speeds: forward, left, up, yaw to the left. */
  go(move: readonly number[]): void {
    this.move = move;
    this.send();
    clearInterval(this.timer);
    if (this.isDriven()) this.timer = setInterval(() => this.send(), REPEAT_MS);
  }

  private send(): void {
    const now = twist(this.move, this.speeds);
    if (this.isStamped) {
      const { chosen } = this.app.robots;
      const frame = `${chosen && !chosen.hasOwnTf ? chosen.framePrefix : ''}base_link`;
      const message = { header: this.app.header(frame), twist: now };
      this.app.publish(this.topic, 'geometry_msgs/msg/TwistStamped', message);
    } else this.app.publish(this.topic, 'geometry_msgs/msg/Twist', now as never);
  }
}
