/** Undo and redo by whole states, since a plan is small. */

const MOST = 300;

export class History<T> {
  private past: string[] = [];
  private future: string[] = [];

  constructor(private now: string) {}

  static of<T>(state: T): History<T> {
    return new History<T>(JSON.stringify(state));
  }

  /** Records a new state, unless it equals the last one. */
  note(state: T): void {
    const text = JSON.stringify(state);
    if (text === this.now) return;
    this.past.push(this.now);
    if (this.past.length > MOST) this.past.shift();
    this.now = text;
    this.future = [];
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  undo(): T | undefined {
    const before = this.past.pop();
    if (before === undefined) return undefined;
    this.future.push(this.now);
    this.now = before;
    return JSON.parse(before) as T;
  }

  redo(): T | undefined {
    const after = this.future.pop();
    if (after === undefined) return undefined;
    this.past.push(this.now);
    this.now = after;
    return JSON.parse(after) as T;
  }
}
