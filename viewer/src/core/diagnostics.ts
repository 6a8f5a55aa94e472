/** Diagnostics of nodes: the last status of each name, as a tree by the parts of the names. */

export const LEVEL = { ok: 0, warn: 1, error: 2, stale: 3 } as const;

export interface Status {
  name: string;
  level: number;
  message: string;
  hardwareId: string;
  values: { key: string; value: string }[];
  receivedS: number;
}

export interface DiagnosticRow {
  /** Path of the group or name. */
  path: string;
  name: string;
  depth: number;
  /** Worst level of the status and those below it. */
  level: number;
  status?: Status;
  hasChildren: boolean;
}

/** Age after which a status is stale [s]; as rqt_robot_monitor has it. */
export const STALE_S = 5;

interface Node {
  status?: Status;
  children: Map<string, Node>;
}

export class Diagnostics {
  private statuses = new Map<string, Status>();

  clear(): void {
    this.statuses.clear();
  }

  get size(): number {
    return this.statuses.size;
  }

  add(message: Record<string, unknown>, nowS: number): void {
    const list = (message.status ?? []) as {
      name: string;
      level: number;
      message: string;
      hardware_id: string;
      values: { key: string; value: string }[];
    }[];
    for (const { name, level, message: text, hardware_id: hardwareId, values } of list) {
      this.statuses.set(name, {
        name,
        level: Number(level),
        message: text,
        hardwareId,
        values,
        receivedS: nowS,
      });
    }
  }

  /** Level with the age taken into account. Time that jumped back makes nothing stale. */
  levelOf(status: Status, nowS: number): number {
    return nowS - status.receivedS > STALE_S ? LEVEL.stale : status.level;
  }

  /** Number of statuses of each level. */
  counts(nowS: number): number[] {
    const out = [0, 0, 0, 0];
    for (const status of this.statuses.values()) {
      const level = Math.min(LEVEL.stale, this.levelOf(status, nowS));
      out[level]!++;
    }
    return out;
  }

  /** Rows of the tree; groups whose path `isOpen` does not accept hide their content. */
  rows(
    nowS: number,
    options: {
      search: string;
      onlyProblems: boolean;
      isOpen: (path: string) => boolean;
    },
  ): DiagnosticRow[] {
    const search = options.search.trim().toLowerCase();
    const root: Node = { children: new Map() };
    for (const status of this.statuses.values()) {
      if (options.onlyProblems && this.levelOf(status, nowS) === LEVEL.ok) continue;
      if (!`${status.name} ${status.message}`.toLowerCase().includes(search)) continue;
      let node = root;
      for (const part of status.name.split('/').filter(Boolean)) {
        let child = node.children.get(part);
        if (!child) node.children.set(part, (child = { children: new Map() }));
        node = child;
      }
      node.status = status;
    }
    const out: DiagnosticRow[] = [];
    const visit = (node: Node, prefix: string, depth: number): void => {
      const sorted = [...node.children].sort(([a], [b]) => (a < b ? -1 : 1));
      for (const [name, child] of sorted) {
        const path = `${prefix}/${name}`;
        const hasChildren = child.children.size > 0;
        const level = this.worst(child, nowS);
        out.push({ path, name, depth, level, status: child.status, hasChildren });
        // A search shows what it finds.
        if (search || options.isOpen(path)) visit(child, path, depth + 1);
      }
    };
    visit(root, '', 0);
    return out;
  }

  private worst({ status, children }: Node, nowS: number): number {
    const own = status ? this.levelOf(status, nowS) : LEVEL.ok;
    const all = [own, ...[...children.values()].map((child) => this.worst(child, nowS))];
    // An error is worse than a status that is not updated.
    return all.includes(LEVEL.error) ? LEVEL.error : Math.max(...all);
  }
}
