/** Edits of the simulated world: commands with an inverse, undone and redone step by step. */
import type { Pose } from '../core/pose';

/** Description of a model: SDF or URDF, or a file that the server reads. */
export interface ModelSource {
  sdf: string;
  file: string;
}

export type Change =
  | { kind: 'insert' | 'delete'; model: string; source: ModelSource; pose: Pose }
  | { kind: 'move'; model: string; before: Pose; after: Pose };

export type EditKind =
  | 'insert'
  | 'delete'
  | 'move'
  | 'rotate'
  | 'rename'
  | 'duplicate'
  | 'paste'
  | 'align'
  | 'distribute'
  | 'snap';

/** One step: all its changes are made and undone together. */
export interface Edit {
  kind: EditKind;
  /** Models named in the title of the step. */
  models: string[];
  changes: Change[];
}

/** The world that is edited. Each function returns false after a failure, which it has reported. */
export interface EditedWorld {
  insert(model: string, source: ModelSource, pose: Pose): Promise<boolean>;
  delete(model: string): Promise<boolean>;
  move(model: string, pose: Pose): Promise<boolean>;
}

/** Number of steps that are kept. */
export const MOST_STEPS = 500;

export function inverse(change: Change): Change {
  if (change.kind === 'move') return { ...change, before: change.after, after: change.before };
  return { ...change, kind: change.kind === 'insert' ? 'delete' : 'insert' };
}

const inverses = (changes: readonly Change[]) => [...changes].reverse().map(inverse);

function make(world: EditedWorld, change: Change): Promise<boolean> {
  const { model } = change;
  if (change.kind === 'move') return world.move(model, change.after);
  if (change.kind === 'insert') return world.insert(model, change.source, change.pose);
  return world.delete(model);
}

/** Makes all changes; after a failure those made before it are taken back. */
export async function makeAll(world: EditedWorld, changes: readonly Change[]): Promise<boolean> {
  for (let i = 0; i < changes.length; i++) {
    if (await make(world, changes[i]!)) continue;
    for (const back of inverses(changes.slice(0, i))) await make(world, back);
    return false;
  }
  return true;
}

const touches = (edit: Edit, names: ReadonlySet<string>) =>
  edit.changes.some(({ model }) => names.has(model));

export class EditHistory {
  private done: Edit[] = [];
  private undone: Edit[] = [];

  /** Makes an edit and keeps it. */
  async make(world: EditedWorld, edit: Edit): Promise<boolean> {
    if (edit.changes.length === 0 || !(await makeAll(world, edit.changes))) return false;
    this.keep(edit);
    return true;
  }

  /** Keeps an edit that was made already. */
  keep(edit: Edit): void {
    this.done.push(edit);
    if (this.done.length > MOST_STEPS) this.done.shift();
    this.undone = [];
  }

  get next(): { undo?: Edit; redo?: Edit } {
    return { undo: this.done[this.done.length - 1], redo: this.undone[this.undone.length - 1] };
  }

  /** Undoes the last step and returns it; `undefined` without one, or after a failure. */
  async undo(world: EditedWorld): Promise<Edit | undefined> {
    const edit = this.done[this.done.length - 1];
    if (!edit || !(await makeAll(world, inverses(edit.changes)))) return undefined;
    // The history may have been rebased meanwhile.
    const at = this.done.lastIndexOf(edit);
    if (at >= 0) this.undone.push(...this.done.splice(at, 1));
    return edit;
  }

  async redo(world: EditedWorld): Promise<Edit | undefined> {
    const edit = this.undone[this.undone.length - 1];
    if (!edit || !(await makeAll(world, edit.changes))) return undefined;
    const at = this.undone.lastIndexOf(edit);
    if (at >= 0) this.done.push(...this.undone.splice(at, 1));
    return edit;
  }

  /**
   * Rebases the history after another client deleted models: steps with them cannot be undone or redone any more.
   * Returns the number of steps that were dropped.
   */
  forget(models: readonly string[]): number {
    const before = this.done.length + this.undone.length;
    this.done = without(this.done, new Set(models));
    this.undone = without(this.undone, new Set(models));
    return before - this.done.length - this.undone.length;
  }

  /** Rebases the history after a reset, which took back all moves. Returns the number of dropped steps. */
  forgetMoves(): number {
    const before = this.done.length + this.undone.length;
    const isKept = (edit: Edit) => edit.changes.some(({ kind }) => kind !== 'move');
    this.done = this.done.filter(isKept);
    this.undone = this.undone.filter(isKept);
    return before - this.done.length - this.undone.length;
  }

  clear(): number {
    const dropped = this.done.length + this.undone.length;
    this.done = [];
    this.undone = [];
    return dropped;
  }
}

/** Steps that do not need the models; the list of models grows by those of dropped renames. */
function without(edits: readonly Edit[], gone: Set<string>): Edit[] {
  const out: Edit[] = [];
  for (const edit of [...edits].reverse()) {
    if (!touches(edit, gone)) {
      out.unshift(edit);
      continue;
    }
    // Moves of other models in the same step are independent of it.
    const moves = edit.changes.filter(({ kind, model }) => kind === 'move' && !gone.has(model));
    if (edit.changes.every(({ kind }) => kind === 'move')) {
      if (moves.length > 0) out.unshift({ ...edit, changes: moves });
    } else for (const { model } of edit.changes) gone.add(model);
  }
  return out;
}
