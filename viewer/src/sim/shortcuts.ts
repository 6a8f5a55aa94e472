/** Keys that edit the world: undo, redo, duplicate, copy, moves; and what is pasted. */
import type { App } from '../app/app.svelte';
import type { WorldEditor } from './editor.svelte';
import { nudge } from './nudge';

function isTyping(target: EventTarget | null): boolean {
  const element = target as HTMLElement | null;
  return !!element?.closest?.(
    'input:not([type=checkbox], [type=range]), select, textarea, [contenteditable], [role=slider]',
  );
}

/** True while a dialog has the keyboard, such as the Building Editor with its own undo. */
const isElsewhere = () => document.querySelector('[aria-modal="true"]') !== null;

/** Returns true for a key that edits the world. */
export function editKey(app: App, editor: WorldEditor, event: KeyboardEvent): boolean {
  if (!(event.ctrlKey || event.metaKey) || event.altKey || !app.worldName) return false;
  if (isTyping(event.target) || isElsewhere()) return false;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const { selection } = app;
  if (key === 'z') void (event.shiftKey ? editor.redo() : editor.undo());
  else if (key === 'y') void editor.redo();
  else if (key === 'd' && selection.length > 0) void editor.duplicate(selection);
  else if (key === 'c' && selection.length > 0) {
    // Text that was marked is copied as everywhere.
    if (getSelection()?.toString()) return false;
    void editor.copy(selection);
  } else return selection.length > 0 && nudge(app, editor, event.key, event.shiftKey);
  return true;
}

/** Pastes the copied models, or the models of SDF text from another program. Returns true if it did. */
export function pasteInto(app: App, editor: WorldEditor, event: ClipboardEvent): boolean {
  if (!app.worldName || isTyping(event.target) || isElsewhere()) return false;
  const text = event.clipboardData?.getData('text/plain') ?? '';
  if (/<model\b/.test(text) && !editor.isOwnText(text)) void editor.pasteSdf(text);
  else if (editor.copied > 0) void editor.paste();
  else return false;
  return true;
}
