/** Groups of displays in `.rviz` files: nested lists there, a flat list with references here. */
import type { Tree } from './file';

export interface RvizGroup {
  name: string;
  isEnabled: boolean;
  parent?: RvizGroup;
  /** Original entry of the file; its unknown parts are written back. */
  original?: Tree;
}

export const isGroup = (tree: Tree): boolean => String(tree.Class ?? '').endsWith('/Group');

/** Nests displays in their groups, in the order of the displays. Empty groups come last. */
export function nestDisplays(
  displays: { tree: Tree; group?: RvizGroup }[],
  groups: readonly RvizGroup[],
): Tree[] {
  const root: Tree[] = [];
  const lists = new Map<RvizGroup, Tree[]>();
  const listOf = (group: RvizGroup | undefined): Tree[] => {
    if (!group) return root;
    const found = lists.get(group);
    if (found) return found;
    const list: Tree[] = [];
    lists.set(group, list);
    listOf(group.parent).push({
      Class: 'rviz_common/Group',
      ...group.original,
      Displays: list,
      Name: group.name,
      Enabled: group.isEnabled,
      Value: group.isEnabled,
    });
    return list;
  };
  for (const { tree, group } of displays) listOf(group).push(tree);
  for (const group of groups) listOf(group);
  return root;
}
