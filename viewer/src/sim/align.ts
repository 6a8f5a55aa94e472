/** Alignment of models by their bounding boxes in the world frame. */
import type { Pose, Vec3 } from '../core/pose';

export interface Extent {
  model: string;
  pose: Pose;
  /** Corners of the bounding box in the world frame [m]. */
  min: Vec3;
  max: Vec3;
}

/** In the top view x points to the right and y to the back. */
export type Side = 'left' | 'right' | 'centerX' | 'front' | 'back' | 'centerY' | 'bottom' | 'top';

const SIDES: Record<Side, { axis: 0 | 1 | 2; of: 'min' | 'max' | 'middle' }> = {
  left: { axis: 0, of: 'min' },
  right: { axis: 0, of: 'max' },
  centerX: { axis: 0, of: 'middle' },
  front: { axis: 1, of: 'min' },
  back: { axis: 1, of: 'max' },
  centerY: { axis: 1, of: 'middle' },
  bottom: { axis: 2, of: 'min' },
  top: { axis: 2, of: 'max' },
};

function moved(pose: Pose, axis: 0 | 1 | 2, by: number): Pose {
  const t: Vec3 = [...pose.t];
  t[axis] += by;
  return { t, q: pose.q };
}

/** Poses with which one side of all boxes is where that of the outermost is. */
export function aligned(models: readonly Extent[], side: Side): Map<string, Pose> {
  const { axis, of } = SIDES[side];
  const low = Math.min(...models.map((one) => one.min[axis]));
  const high = Math.max(...models.map((one) => one.max[axis]));
  return new Map(
    models.map(({ model, pose, min, max }) => {
      const by =
        of === 'min'
          ? low - min[axis]
          : of === 'max'
            ? high - max[axis]
            : (low + high) / 2 - (min[axis] + max[axis]) / 2;
      return [model, moved(pose, axis, by)];
    }),
  );
}

/** Poses with equal distances between the centers of the boxes; the outer two stay. */
export function distributed(models: readonly Extent[], axis: 0 | 1): Map<string, Pose> {
  const center = (one: Extent) => (one.min[axis] + one.max[axis]) / 2;
  const sorted = [...models].sort((a, b) => center(a) - center(b));
  const first = center(sorted[0]!);
  const step = (center(sorted[sorted.length - 1]!) - first) / Math.max(1, sorted.length - 1);
  return new Map(
    sorted.map((one, i) => [one.model, moved(one.pose, axis, first + i * step - center(one))]),
  );
}
