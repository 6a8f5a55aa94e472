/** State of a panel that is saved with the layout. */

/** Part of a panel of the layout that its component uses. */
export interface PanelHandle {
  state: Record<string, unknown>;
}

/**
 * State of a panel: starts as it was saved, with defaults for what is missing, and is saved whenever it changes.
 * Call it while the component is set up.
 */
export function kept<T extends object>(panel: PanelHandle, defaults: T): T {
  const saved = structuredClone($state.snapshot(panel.state)) as Partial<T>;
  const state: T = $state({ ...defaults, ...saved });
  $effect(() => {
    panel.state = $state.snapshot(state) as Record<string, unknown>;
  });
  return state;
}
