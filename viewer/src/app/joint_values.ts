/** Positions of joints set by hand, as joint_state_publisher_gui does it. */
import type { Joint } from '../displays/joints';

const WHOLE_TURN = Math.PI;

/** Joints that a user moves: neither fixed nor floating, nor followers of others. */
export function movable(joints: readonly Joint[]): Joint[] {
  return joints.filter(
    ({ type, mimic }) => ['revolute', 'continuous', 'prismatic'].includes(type) && !mimic,
  );
}

/** Range of a slider: the limits, or a whole turn. */
export function rangeOf({ type, lower, upper }: Joint): [number, number] {
  if (type === 'continuous' || lower === undefined || upper === undefined) {
    return [-WHOLE_TURN, WHOLE_TURN];
  }
  return [lower, upper];
}

/** Position 0 if it is allowed, otherwise the middle of the range. */
export function centerOf(joint: Joint): number {
  const [lower, upper] = rangeOf(joint);
  return lower <= 0 && upper >= 0 ? 0 : (lower + upper) / 2;
}

/** Positions of all joints, with those that follow others. */
export function allPositions(
  joints: readonly Joint[],
  values: Readonly<Record<string, number>>,
): { name: string[]; position: number[] } {
  const byName = new Map(joints.map((joint) => [joint.name, joint]));
  const positionOf = (joint: Joint, depth = 0): number => {
    const leader = joint.mimic && byName.get(joint.mimic.joint);
    if (!leader || depth > byName.size) return values[joint.name] ?? centerOf(joint);
    return positionOf(leader, depth + 1) * joint.mimic!.multiplier + joint.mimic!.offset;
  };
  const moved = joints.filter(({ type }) => ['revolute', 'continuous', 'prismatic'].includes(type));
  return { name: moved.map(({ name }) => name), position: moved.map((one) => positionOf(one)) };
}
