/** State of a panel that is saved with the layout. */
import { untrack } from 'svelte';
import type { Panel } from '../app/panel.svelte';

const kindOf = (value: unknown) => (Array.isArray(value) ? 'array' : typeof value);

/**
 * State of a panel, with defaults for what was not saved or has another type, as in a file of another version.
 * Changes are saved with the layout.
 */
export function kept<T extends object>(panel: Pick<Panel, 'state'>, defaults: T): T {
  return untrack(() => {
    const state = panel.state as Record<string, unknown>;
    for (const [key, value] of Object.entries(defaults)) {
      if (kindOf(state[key]) !== kindOf(value)) state[key] = value;
    }
    return state as T;
  });
}
