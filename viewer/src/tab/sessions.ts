/** Ready sessions of the static page: `files/sessions.json`, and the files that they need beside it. */
import { t } from '../texts/language.svelte';
import type { SessionOptions } from './messages';

export interface ReadySession {
  name: string;
  title: Record<string, string>;
  /** Paths below `files`, which are also their paths in memory. */
  files: string[];
  options: SessionOptions;
}

export class Sessions {
  private constructor(
    private root: URL,
    readonly list: readonly ReadySession[],
  ) {}

  /** Reads the list; a page that was built without sessions has an empty one. */
  static async load(root: URL): Promise<Sessions> {
    const response = await fetch(new URL('files/sessions.json', root));
    if (response.status === 404) return new Sessions(root, []);
    if (!response.ok) throw new Error(t().tab.noFile('files/sessions.json', response.status));
    const { sessions } = (await response.json()) as { sessions: ReadySession[] };
    return new Sessions(root, sessions);
  }

  named(name: string): ReadySession {
    const found = this.list.find((one) => one.name === name);
    if (found) return found;
    throw new Error(t().tab.noSession(name, this.list.map((one) => one.name).join(', ')));
  }

  /** Files of the sessions that have these files. */
  around(paths: readonly string[]): string[] {
    const all = new Set<string>();
    for (const path of paths) {
      const having = this.list.filter((one) => one.files.includes(path));
      if (having.length === 0) throw new Error(t().tab.notServed(path));
      for (const { files } of having) for (const file of files) all.add(file);
    }
    return [...all];
  }

  async fetch(path: string): Promise<Uint8Array<ArrayBuffer>> {
    const response = await fetch(new URL(`files/${path}`, this.root));
    if (!response.ok) throw new Error(t().tab.noFile(path, response.status));
    return new Uint8Array(await response.arrayBuffer());
  }
}
