/** One display in the list: its options, its status, and whether it is enabled. */
import type { Context, Display, Host, Kind, Level } from '../displays/display';
import { defaultsOf, type Values } from '../displays/options';
import type { Tree } from '../rviz/file';
import type { DisplayGroup } from './display_group.svelte';

export interface Status {
  level: Level;
  text: string;
}

let lastId = 0;

export class Entry {
  readonly id = ++lastId;
  name = $state('');
  isEnabled = $state(true);
  isOpen = $state(false);
  values: Values = $state({});
  statuses: Record<string, Status> = $state({});
  canvas: HTMLCanvasElement | undefined = $state();
  display?: Display;
  group: DisplayGroup | undefined = $state.raw();
  /** Display in the `.rviz` file that it was read from. */
  original?: Tree;
  /** True for a display that was added automatically for its topic. */
  isAutomatic = false;
  private pending = new Map<string, Status | undefined>();

  constructor(
    readonly kind: Kind,
    name: string,
    values: Values = {},
    isEnabled = true,
  ) {
    this.name = name || kind.title;
    this.values = { ...defaultsOf(kind.options), ...values };
    this.isEnabled = isEnabled;
  }

  /** Enabled, as all groups around it are. */
  get isShown(): boolean {
    return this.isEnabled && (this.group?.isShown ?? true);
  }

  level = $derived.by((): Level => {
    const all = Object.values(this.statuses).map((status) => status.level);
    return all.includes('error') ? 'error' : all.includes('warn') ? 'warn' : 'ok';
  });

  start(context: Context): void {
    if (!this.isShown || this.display) return;
    const host: Host = {
      status: (name, level, text) => {
        this.pending.set(name, text === undefined ? undefined : { level, text });
      },
      forget: () => {
        this.pending.clear();
        for (const name of Object.keys(this.statuses)) this.pending.set(name, undefined);
      },
      note: (path, value) => {
        if (this.values[path] !== value) this.values[path] = value;
      },
      picture: (canvas) => (this.canvas = canvas),
    };
    this.display = this.kind.make(context, this.values, host);
    this.display.start();
  }

  stop(): void {
    this.display?.stop();
    this.display = undefined;
    this.canvas = undefined;
    this.statuses = {};
    this.pending.clear();
  }

  /** Shows the status since the last call: messages arrive faster than a user reads. */
  flush(): void {
    for (const [name, status] of this.pending) {
      if (!status) delete this.statuses[name];
      else if (this.statuses[name]?.text !== status.text) this.statuses[name] = status;
      else if (this.statuses[name].level !== status.level) this.statuses[name] = status;
    }
    this.pending.clear();
  }
}
