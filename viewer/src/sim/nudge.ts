/** Moves of the selected models by keys: the arrows move along the axis nearest to their direction on the screen. */
import { Vector3 } from 'three';
import type { App } from '../app/app.svelte';
import type { Pose, Vec3 } from '../core/pose';
import { inverse, rotate } from '../core/pose';
import type { Stage } from '../scene/stage';
import { ANGLE_STEP_RAD, movedPoses, type Motion } from './drag';
import type { WorldEditor } from './editor.svelte';

const DIRECTIONS: Record<string, [number, number]> = {
  ArrowRight: [1, 0],
  ArrowLeft: [-1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/**
 * Motion of an arrow key in the world frame: in the plane, with shift up, down, and about z.
 * `worldFromScreen` are the directions of the screen's x and y axes.
 */
export function keyMotion(
  key: string,
  isShifted: boolean,
  gridM: number,
  worldFromScreen: { right: Vec3; up: Vec3 },
): Motion | undefined {
  const direction = DIRECTIONS[key];
  if (!direction) return undefined;
  const [right, up] = direction;
  if (isShifted) {
    if (up) return { kind: 'translation', by: [0, 0, up * gridM] };
    return { kind: 'rotation', axis: [0, 0, 1], angleRad: -right * ANGLE_STEP_RAD };
  }
  const [x, y] = right ? worldFromScreen.right : worldFromScreen.up;
  const sign = right || up;
  const isAlongX = Math.abs(x) >= Math.abs(y);
  const by = sign * gridM * Math.sign(isAlongX ? x : y);
  return { kind: 'translation', by: isAlongX ? [by, 0, 0] : [0, by, 0] };
}

/** Directions of the screen on the floor, in the world frame. */
function screenAxes(stage: Stage, fixedFromWorld: Pose): { right: Vec3; up: Vec3 } {
  const right = new Vector3().setFromMatrixColumn(stage.view.camera.matrixWorld, 0);
  const up = new Vector3(-right.y, right.x, 0);
  const { q } = inverse(fixedFromWorld);
  return { right: rotate(q, right.toArray()), up: rotate(q, up.toArray()) };
}

/** Moves the selected models by a key. Returns false for other keys. */
export function nudge(app: App, editor: WorldEditor, key: string, isShifted: boolean): boolean {
  const world = app.world();
  if (!app.stage || !world) return false;
  const motion = keyMotion(
    key,
    isShifted,
    editor.gridM,
    screenAxes(app.stage, world.fixedFromWorld),
  );
  if (!motion) return false;
  const starts = new Map(
    app.selection.flatMap((model): [string, Pose][] => {
      const pose = editor.poseOf(model);
      return pose ? [[model, pose]] : [];
    }),
  );
  const all = [...starts.values()];
  if (all.length === 0) return true;
  const middle = (i: 0 | 1 | 2) => all.reduce((sum, { t }) => sum + t[i], 0) / all.length;
  const poses = movedPoses(motion, [middle(0), middle(1), middle(2)], starts);
  void editor.move(motion.kind === 'rotation' ? 'rotate' : 'move', poses);
  return true;
}
