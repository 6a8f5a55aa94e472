/** Displays as plain data, for saved layouts and links: only what differs from the defaults. */
import { defaultsOf, type Values } from '../displays/options';
import { partOf } from '../rviz/file';
import type { Entry } from './entry.svelte';

export interface SavedDisplay {
  class: string;
  name: string;
  isEnabled: boolean;
  values: Values;
}

export function savedDisplay({ kind, name, isEnabled, values }: Entry): SavedDisplay {
  const defaults = defaultsOf(kind.options);
  const notes = new Set(kind.options.filter((o) => o.kind === 'note').map((o) => o.path));
  const kept = Object.entries(values).filter(([path, value]) => {
    if (notes.has(path)) return false;
    // Parts are found at runtime and are shown unless disabled.
    if (partOf(path)) return value === false;
    return path in defaults && value !== defaults[path];
  });
  return { class: kind.class, name, isEnabled, values: Object.fromEntries(kept) };
}
