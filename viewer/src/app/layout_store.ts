/** Layouts kept in the browser by name, and the one that was used last. */
import { readLayout, writeLayout, type Layout } from './layout';

const LAST_KEY = 'layout last';
const NAMED_KEY = 'layouts';

/** Part of `Storage` that is used. */
export interface Store {
  getItem(key: string): string | null;
  setItem(key: string, value: string): void;
  removeItem(key: string): void;
}

export class LayoutStore {
  constructor(private store: Store | undefined) {}

  /** The layout that was used last; throws an error with the reason if it cannot be read. */
  last(): Layout | undefined {
    const text = this.store?.getItem(LAST_KEY);
    return text ? readLayout(JSON.parse(text)) : undefined;
  }

  /** Returns false if the browser does not keep it. */
  keepLast(layout: Layout): boolean {
    return this.write(LAST_KEY, JSON.stringify(writeLayout(layout)));
  }

  forgetLast(): void {
    this.store?.removeItem(LAST_KEY);
  }

  private named(): Record<string, unknown> {
    try {
      const all: unknown = JSON.parse(this.store?.getItem(NAMED_KEY) ?? '{}');
      return typeof all === 'object' && all !== null ? (all as Record<string, unknown>) : {};
    } catch {
      return {};
    }
  }

  names(): string[] {
    return Object.keys(this.named()).sort((a, b) => a.localeCompare(b));
  }

  get(name: string): Layout {
    return readLayout(this.named()[name]);
  }

  set(name: string, layout: Layout): boolean {
    return this.write(NAMED_KEY, JSON.stringify({ ...this.named(), [name]: writeLayout(layout) }));
  }

  /** Returns false if the new name is taken. */
  rename(from: string, to: string): boolean {
    const all = this.named();
    if (from === to) return true;
    if (to in all || !(from in all)) return false;
    const { [from]: moved, ...rest } = all;
    return this.write(NAMED_KEY, JSON.stringify({ ...rest, [to]: moved }));
  }

  delete(name: string): void {
    const { [name]: _, ...rest } = this.named();
    this.write(NAMED_KEY, JSON.stringify(rest));
  }

  private write(key: string, text: string): boolean {
    try {
      if (!this.store) return false;
      this.store.setItem(key, text);
      return true;
    } catch {
      // The storage is full or forbidden; the caller reports it.
      return false;
    }
  }
}
