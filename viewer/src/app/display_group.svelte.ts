/** Group of displays, as in RViz: switching it off hides all displays in it. */
import type { Tree } from '../rviz/file';
import type { RvizGroup } from '../rviz/groups';
import type { Entry } from './entry.svelte';

let lastId = 0;

export class DisplayGroup implements RvizGroup {
  readonly id = ++lastId;
  name = $state('');
  isEnabled = $state(true);
  isOpen = $state(true);

  constructor(
    name: string,
    isEnabled: boolean,
    readonly parent?: DisplayGroup,
    readonly original?: Tree,
  ) {
    this.name = name;
    this.isEnabled = isEnabled;
  }

  /** Enabled, as all groups around it are. */
  get isShown(): boolean {
    return this.isEnabled && (this.parent?.isShown ?? true);
  }

  /** True if the rows in it are seen. */
  get isUnfolded(): boolean {
    return this.isOpen && (this.parent?.isUnfolded ?? true);
  }

  get depth(): number {
    return this.parent ? this.parent.depth + 1 : 0;
  }

  holds(group: DisplayGroup | undefined): boolean {
    return group === this || (group?.parent ? this.holds(group.parent) : false);
  }
}

/** Row of the list of displays. */
export type DisplayRow =
  | { kind: 'group'; group: DisplayGroup; depth: number }
  | { kind: 'display'; entry: Entry; depth: number };

/** Displays in order, each group before its first display; closed groups hide their rows. */
export function rowsOf(displays: readonly Entry[], groups: readonly DisplayGroup[]): DisplayRow[] {
  const rows: DisplayRow[] = [];
  const seen = new Set<DisplayGroup>();
  const enter = (group: DisplayGroup | undefined): void => {
    if (!group || seen.has(group)) return;
    enter(group.parent);
    seen.add(group);
    if (group.parent?.isUnfolded ?? true) rows.push({ kind: 'group', group, depth: group.depth });
  };
  for (const entry of displays) {
    const { group } = entry;
    enter(group);
    const depth = group ? group.depth + 1 : 0;
    if (group?.isUnfolded ?? true) rows.push({ kind: 'display', entry, depth });
  }
  for (const group of groups) enter(group);
  return rows;
}
