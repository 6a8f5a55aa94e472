/** Displays as plain data, for saved layouts and links: only what differs from the defaults. */
import { defaultsOf, type Values } from '../displays/options';
import { partOf } from '../rviz/file';
import { DisplayGroup } from './display_group.svelte';
import type { Entry } from './entry.svelte';

export interface SavedDisplay {
  class: string;
  name: string;
  isEnabled: boolean;
  values: Values;
  /** Number of its group in the list of groups. */
  group?: number;
}

export interface SavedGroup {
  name: string;
  isEnabled: boolean;
  parent?: number;
}

export function savedGroup(
  { name, isEnabled, parent }: DisplayGroup,
  _: number,
  all: readonly DisplayGroup[],
): SavedGroup {
  return { name, isEnabled, ...(parent && { parent: all.indexOf(parent) }) };
}

/** Groups of a saved view; a parent precedes its children. */
export function groupsFrom(saved: readonly SavedGroup[]): DisplayGroup[] {
  const groups: DisplayGroup[] = [];
  for (const { name, isEnabled, parent } of saved) {
    groups.push(new DisplayGroup(name, isEnabled, groups[parent ?? -1]));
  }
  return groups;
}

export function savedDisplay(
  { kind, name, isEnabled, values, group }: Entry,
  groups: readonly DisplayGroup[] = [],
): SavedDisplay {
  const defaults = defaultsOf(kind.options);
  const notes = new Set(kind.options.filter((o) => o.kind === 'note').map((o) => o.path));
  const kept = Object.entries(values).filter(([path, value]) => {
    if (notes.has(path)) return false;
    // Parts are found at runtime and are shown unless disabled.
    if (partOf(path)) return value === false;
    return path in defaults && value !== defaults[path];
  });
  return {
    class: kind.class,
    name,
    isEnabled,
    values: Object.fromEntries(kept),
    ...(group && { group: groups.indexOf(group) }),
  };
}
