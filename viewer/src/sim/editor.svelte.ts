/** Editing of the simulated world: the selection, all edits with undo and redo, the clipboard. */
import { untrack } from 'svelte';
import type { App } from '../app/app.svelte';
import { fromRpy, type Pose, type Vec3 } from '../core/pose';
import { messageOf } from '../core/types';
import { t } from '../texts/language.svelte';
import { aligned, distributed, type Extent, type Side } from './align';
import {
  EditHistory,
  type Change,
  type Edit,
  type EditedWorld,
  type EditKind,
  type ModelSource,
} from './edits';
import { freeName, modelSdf, modelsIn, poseIn, renamed } from './sdf_text';

/** Shortest time between two poses of a dragged model that are sent [ms]. */
const SEND_PERIOD_MS = 60;
/** Time for the published pose of a model to arrive after it was set [ms]. */
const SETTLE_MS = 150;
/** Entity type of models in `ros_gz_interfaces/msg/Entity`. */
const MODEL = 2;

interface Copied {
  name: string;
  sdf: string;
  pose: Pose;
}

export class WorldEditor {
  /** Steps that undo and redo act on. */
  next: { undo?: Edit; redo?: Edit } = $state.raw({});
  /** Increases when a pose may have changed. */
  version = $state(0);
  gridM = $state(0.1);
  isSnapping = $state(true);
  /** Number of copied models. */
  copied = $state(0);
  private clipboard: Copied[] = [];
  /** True if the clipboard of the system has the first copied model. */
  private isOnSystem = false;
  private history = new EditHistory();
  private queue: Promise<unknown> = Promise.resolve();
  /** Models of the last scene. */
  private seen = new Set<string>();
  /** Models that this page inserted and that no scene had yet. */
  private awaited = new Set<string>();
  /** Models that this page deleted and that the last scene still had. */
  private deleted = new Set<string>();
  private worldName = '';
  private dragged?: Dragged;

  constructor(private app: App) {
    $effect.root(() => {
      $effect(() => {
        const { worldName, models } = app;
        untrack(() => this.modelsChanged(worldName, models));
      });
      $effect(() => {
        if (app.resets > 0) untrack(() => this.wasReset());
      });
    });
  }

  private readonly world: EditedWorld = {
    insert: async (model, { sdf, file }, pose) => {
      this.awaited.add(model);
      this.deleted.delete(model);
      const factory = {
        name: model,
        allow_renaming: false,
        sdf,
        sdf_filename: file,
        pose: messageOf(pose),
        relative_to: 'world',
      };
      const isDone = !!(await this.call('create', { entity_factory: factory }));
      if (!isDone) this.awaited.delete(model);
      return isDone;
    },
    delete: async (model) => {
      this.awaited.delete(model);
      this.deleted.add(model);
      const isDone = !!(await this.call('remove', { entity: { name: model, type: MODEL } }));
      if (!isDone) this.deleted.delete(model);
      if (isDone) this.app.selection = this.app.selection.filter((name) => name !== model);
      return isDone;
    },
    move: async (model, pose) => {
      const request = { entity: { name: model, type: MODEL }, pose: messageOf(pose) };
      return !!(await this.call('set_pose', request));
    },
  };

  private call(what: string, request: Record<string, unknown>) {
    return this.app.call(`/world/${this.app.worldName}/${what}`, request as never);
  }

  /** Runs edits one after the other, in the order in which they were requested. */
  private run<T>(work: () => Promise<T>): Promise<T> {
    const result = this.queue.then(work);
    this.queue = result
      .catch((error: unknown) => this.app.notice('error', (error as Error).message))
      .then(() => this.changed());
    return result;
  }

  private changed(): void {
    this.next = this.history.next;
    this.version++;
  }

  // Changes by others.

  private modelsChanged(worldName: string, models: string[]): void {
    if (worldName !== this.worldName) {
      this.worldName = worldName;
      this.history.clear();
      this.awaited.clear();
      this.deleted.clear();
      this.seen = new Set(models);
      this.app.selection = [];
      this.changed();
      return;
    }
    // A view without a world lists no models.
    if (!this.app.world()) return;
    const now = new Set(models);
    const isOwn = (name: string) => this.awaited.has(name) || this.deleted.has(name);
    const gone = [...this.seen].filter((name) => !now.has(name) && !isOwn(name));
    for (const name of this.deleted) if (!now.has(name)) this.deleted.delete(name);
    for (const name of models) this.awaited.delete(name);
    this.seen = now;
    if (gone.length === 0) return;
    const isSelected = (name: string) => !gone.includes(name);
    this.app.selection = this.app.selection.filter(isSelected);
    this.report(this.history.forget(gone), (count) => t().edit.rebased(gone.join(', '), count));
  }

  private wasReset(): void {
    this.report(this.history.forgetMoves(), t().edit.afterReset);
  }

  private report(dropped: number, text: (count: number) => string): void {
    if (dropped > 0) this.app.notice('warn', text(dropped));
    this.changed();
  }

  // Undo and redo.

  undo(): Promise<void> {
    return this.run(async () => {
      if (!this.history.next.undo) return;
      const edit = await this.history.undo(this.world);
      this.undid(edit, (title) => t().edit.undone(title));
    });
  }

  redo(): Promise<void> {
    return this.run(async () => {
      if (!this.history.next.redo) return;
      const edit = await this.history.redo(this.world);
      this.undid(edit, (title) => t().edit.redone(title));
    });
  }

  private undid(edit: Edit | undefined, text: (title: string) => string): void {
    if (!edit) return;
    this.said(text(titleOf(edit)));
  }

  /** Shows what was done last. */
  private said(text: string): void {
    this.app.notice('info', text, 'edit');
  }

  /** Makes an edit; returns false after a failure, which was reported. */
  private make(kind: EditKind, models: string[], changes: Change[]): Promise<boolean> {
    return this.history.make(this.world, { kind, models, changes });
  }

  // Edits.

  /** Names that are taken: of models with and without shapes. */
  private names(): Set<string> {
    const shown = this.app.world()?.names() ?? [];
    const all = [...shown, ...this.app.models].filter((name) => !this.deleted.has(name));
    return new Set([...all, ...this.awaited]);
  }

  insert(name: string, source: ModelSource, pose: Pose): Promise<boolean> {
    return this.run(async () => {
      const model = freeName(name, this.names());
      const change: Change = { kind: 'insert', model, source, pose };
      const isDone = await this.make('insert', [model], [change]);
      if (isDone) this.said(t().world.inserted(model));
      if (isDone) this.app.selection = [model];
      return isDone;
    });
  }

  remove(models: readonly string[]): Promise<void> {
    return this.run(async () => {
      const found = await this.copies(models);
      const changes = found.map(({ name, sdf, pose }): Change => ({
        kind: 'delete',
        model: name,
        source: { sdf, file: '' },
        pose,
      }));
      if (!(await this.make('delete', [...models], changes))) return;
      this.said(t().world.deleted(models.join(', ')));
    });
  }

  /** Moves models as one step. */
  move(kind: EditKind, poses: ReadonlyMap<string, Pose>): Promise<boolean> {
    return this.run(async () => {
      const changes = this.moves(poses);
      return changes.length > 0 && this.make(kind, [...poses.keys()], changes);
    });
  }

  private moves(
    poses: ReadonlyMap<string, Pose>,
    starts?: ReadonlyMap<string, Pose>,
  ): Extract<Change, { kind: 'move' }>[] {
    return [...poses].flatMap(([model, after]) => {
      const before = starts?.get(model) ?? this.poseOf(model);
      return before && !isSame(before, after) ? [{ kind: 'move', model, before, after }] : [];
    });
  }

  rename(from: string, to: string): Promise<boolean> {
    return this.run(async () => {
      if (!to || from === to) return false;
      if (this.names().has(to)) {
        this.app.notice('error', t().edit.nameTaken(to));
        return false;
      }
      const [found] = await this.copies([from]);
      if (!found) return false;
      const { sdf, pose } = found;
      const changes: Change[] = [
        { kind: 'delete', model: from, source: { sdf, file: '' }, pose },
        { kind: 'insert', model: to, source: { sdf: renamed(sdf, to), file: '' }, pose },
      ];
      const isDone = await this.make('rename', [from], changes);
      if (isDone) this.app.selection = [to];
      return isDone;
    });
  }

  duplicate(models: readonly string[]): Promise<boolean> {
    return this.run(async () => this.insertCopies('duplicate', await this.copies(models), models));
  }

  /** Copies models to the clipboard of the page, and as SDF to that of the system where the browser permits it. */
  copy(models: readonly string[]): Promise<void> {
    return this.run(async () => {
      const found = await this.copies(models);
      if (found.length === 0) return;
      this.clipboard = found;
      this.copied = found.length;
      this.said(t().edit.copied(models.join(', ')));
      const written = navigator.clipboard?.writeText(found[0]!.sdf);
      this.isOnSystem = await (written ?? Promise.reject()).then(
        () => true,
        () => false,
      );
    });
  }

  paste(): Promise<boolean> {
    const models = this.clipboard.map(({ name }) => name);
    return this.run(async () => this.insertCopies('paste', this.clipboard, models));
  }

  /** True for the text that the page put on the clipboard of the system, or that the system did not accept. */
  isOwnText(text: string): boolean {
    return this.copied > 0 && (!this.isOnSystem || text === this.clipboard[0]?.sdf);
  }

  /** Inserts the models of SDF text at the poses that they have there. */
  pasteSdf(text: string): Promise<boolean> {
    return this.run(async () => {
      const found = modelsIn(text);
      if (found.size === 0) {
        this.app.notice('error', t().sdfPaste.noModel);
        return false;
      }
      const taken = this.names();
      const changes: Change[] = [];
      for (const name of found.keys()) {
        const model = freeName(name || 'model', taken);
        taken.add(model);
        const sdf = renamed(modelSdf(text, name)!, model);
        try {
          const [x, y, z, roll, pitch, yaw] = poseIn(found.get(name)!) as [...Vec3, ...Vec3];
          const pose = { t: [x, y, z] as Vec3, q: fromRpy(roll, pitch, yaw) };
          changes.push({ kind: 'insert', model, source: { sdf, file: '' }, pose });
        } catch (error) {
          this.app.notice('error', t().sdfPaste.wrongPose(name, (error as Error).message));
          return false;
        }
      }
      const models = changes.map(({ model }) => model);
      const isDone = await this.make('paste', models, changes);
      if (isDone) {
        this.app.selection = models;
        this.said(t().sdfPaste.pasted(models.join(', ')));
      }
      return isDone;
    });
  }

  /** Inserts copies beside the originals. */
  private async insertCopies(
    kind: EditKind,
    originals: readonly Copied[],
    models: readonly string[],
  ): Promise<boolean> {
    if (originals.length === 0) return false;
    const taken = this.names();
    const extents = this.extents(models);
    const wideM = Math.max(
      0.4,
      Math.max(...extents.map((one) => one.max[0])) - Math.min(...extents.map((one) => one.min[0])),
    );
    const byM = Number.isFinite(wideM) ? wideM + 0.1 : 0.5;
    const changes = originals.map(({ name, sdf, pose }): Change => {
      const model = freeName(name, taken);
      taken.add(model);
      const [x, y, z] = pose.t;
      return {
        kind: 'insert',
        model,
        source: { sdf: renamed(sdf, model), file: '' },
        pose: { t: [x + byM, y, z], q: pose.q },
      };
    });
    const isDone = await this.make(kind, [...models], changes);
    if (isDone) this.app.selection = changes.map(({ model }) => model);
    return isDone;
  }

  /** Models with their full SDF; a model that cannot be read is reported, and none is returned. */
  private async copies(models: readonly string[]): Promise<Copied[]> {
    const answer = await this.call('save', {});
    const text = String(answer?.message ?? '');
    if (!answer) return [];
    const all = modelsIn(text);
    const out: Copied[] = [];
    for (const name of models) {
      const sdf = all.has(name) ? modelSdf(text, name) : undefined;
      const pose = this.poseOf(name);
      if (!sdf || !pose) {
        this.app.notice('error', t().edit.notReadable(name));
        return [];
      }
      out.push({ name, sdf, pose });
    }
    return out;
  }

  // Poses.

  poseOf(model: string): Pose | undefined {
    return this.app.world()?.poseOf(model);
  }

  extents(models: readonly string[]): Extent[] {
    return models.flatMap((model) => {
      const pose = this.poseOf(model);
      const box = this.app.world()?.extentOf(model);
      return pose && box ? [{ model, pose, ...box }] : [];
    });
  }

  align(side: Side): Promise<boolean> {
    return this.move('align', aligned(this.extents(this.app.selection), side));
  }

  distribute(axis: 0 | 1): Promise<boolean> {
    return this.move('distribute', distributed(this.extents(this.app.selection), axis));
  }

  /** Puts the positions of models on the grid. */
  snap(): Promise<boolean> {
    const { gridM } = this;
    const on = (value: number) => +(Math.round(value / gridM) * gridM).toFixed(6);
    const poses = this.app.selection.flatMap((model): [string, Pose][] => {
      const pose = this.poseOf(model);
      return pose ? [[model, { t: [on(pose.t[0]), on(pose.t[1]), pose.t[2]], q: pose.q }]] : [];
    });
    return this.move('snap', new Map(poses));
  }

  // Drags: the models are shown at their new poses at once, and sent at a bounded rate.

  beginDrag(): ReadonlyMap<string, Pose> {
    const starts = new Map<string, Pose>();
    for (const model of this.app.selection) {
      const pose = this.poseOf(model);
      if (pose && !this.app.world()?.isGround(model)) starts.set(model, pose);
    }
    this.dragged = { starts, poses: starts, sentMs: 0, isSending: false };
    return starts;
  }

  drag(poses: ReadonlyMap<string, Pose>): void {
    const { dragged } = this;
    if (!dragged) return;
    dragged.poses = poses;
    this.hold(poses);
    this.version++;
    const now = performance.now();
    if (dragged.isSending || now - dragged.sentMs < SEND_PERIOD_MS) return;
    dragged.sentMs = now;
    dragged.isSending = true;
    void this.send(poses).finally(() => (dragged.isSending = false));
  }

  private hold(poses: ReadonlyMap<string, Pose>): void {
    for (const viewport of this.app.viewports) {
      const world = viewport.world();
      for (const [model, pose] of poses) world?.hold(model, pose);
    }
  }

  private send(poses: ReadonlyMap<string, Pose>): Promise<unknown> {
    return Promise.all([...poses].map(([model, pose]) => this.world.move(model, pose)));
  }

  /** Ends a drag as one step; a canceled one puts the models back. */
  endDrag(kind: 'move' | 'rotate', isCanceled = false): Promise<void> {
    const { dragged } = this;
    this.dragged = undefined;
    if (!dragged) return Promise.resolve();
    const { starts } = dragged;
    const poses = isCanceled ? starts : dragged.poses;
    this.hold(poses);
    return this.run(async () => {
      const changes = this.moves(poses, starts);
      if (changes.length > 0) await this.make(kind, [...starts.keys()], changes);
      else if (dragged.sentMs > 0) await this.send(starts);
      setTimeout(() => {
        for (const viewport of this.app.viewports) viewport.world()?.release([...starts.keys()]);
        this.version++;
      }, SETTLE_MS);
    });
  }

  get isDragging(): boolean {
    return this.dragged !== undefined;
  }

  /** Removes what is selected from the selection, or adds it. */
  toggle(model: string): void {
    const { app } = this;
    app.selection = app.selection.includes(model)
      ? app.selection.filter((name) => name !== model)
      : [...app.selection, model];
  }
}

interface Dragged {
  starts: ReadonlyMap<string, Pose>;
  poses: ReadonlyMap<string, Pose>;
  sentMs: number;
  isSending: boolean;
}

export function titleOf(edit: Edit): string {
  const [first = ''] = edit.models;
  const what = edit.models.length > 1 ? t().edit.models(edit.models.length) : first;
  return t().editTitles[edit.kind](what);
}

const CLOSE = 1e-9;
function isSame(a: Pose, b: Pose): boolean {
  // A quaternion and its negative are one rotation.
  const sign = a.q.reduce((sum, v, i) => sum + v * b.q[i]!, 0) < 0 ? -1 : 1;
  const isNear = (v: number, w: number) => Math.abs(v - w) < CLOSE;
  return a.t.every((v, i) => isNear(v, b.t[i]!)) && a.q.every((v, i) => isNear(v, sign * b.q[i]!));
}
