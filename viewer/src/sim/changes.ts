/** Changes of the simulated world against its file, as `/world/<w>/changes` answers. */

export interface WorldChanges {
  /** File of the world on the server; null without one. */
  file: string | null;
  /** Text of the file with the changes. */
  text: string;
  /** Unified diff of both texts; empty without changes. */
  diff: string;
  changes: { kind: string; model: string }[];
}

export function readChanges(text: string): WorldChanges {
  const all = JSON.parse(text) as Partial<WorldChanges>;
  const isWhole =
    typeof all.text === 'string' && typeof all.diff === 'string' && Array.isArray(all.changes);
  if (!isWhole) throw new Error('no text, diff or changes');
  return { file: all.file ?? null, text: all.text!, diff: all.diff!, changes: all.changes! };
}
