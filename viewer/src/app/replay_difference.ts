/** Differences of two recordings: topics, counts and rates; distances of two trajectories. */
import { inverse, multiply, type Pose } from '../core/pose';
import type { Recording } from '../core/protocol';
import { longName } from '../core/schema';

export interface TopicDifference {
  topic: string;
  kind: 'first' | 'second' | 'type' | 'rate' | 'same';
  /** Message counts; `undefined` where the topic is missing. */
  counts: [number | undefined, number | undefined];
  ratesHz: [number | undefined, number | undefined];
}

/** Relative difference below which two rates count as equal. */
const SAME_RATE_RATIO = 0.1;

export const durationS = (one: Recording): number =>
  Number(BigInt(one.endNs) - BigInt(one.startNs)) * 1e-9;

export function topicDifferences(first: Recording, second: Recording): TopicDifference[] {
  const both = [first, second].map(
    (one) => new Map(one.topics.map((topic) => [topic.topic, topic])),
  );
  const names = [...new Set(both.flatMap((topics) => [...topics.keys()]))].sort();
  const spans = [first, second].map((one) => Math.max(1e-3, durationS(one)));
  return names.map((topic) => {
    const [a, b] = both.map((topics) => topics.get(topic));
    const rate = (count: number | undefined, i: number) =>
      count === undefined ? undefined : count / spans[i]!;
    const ratesHz: TopicDifference['ratesHz'] = [rate(a?.count, 0), rate(b?.count, 1)];
    const isSameRate =
      a &&
      b &&
      Math.abs(ratesHz[0]! - ratesHz[1]!) <= SAME_RATE_RATIO * Math.max(...(ratesHz as number[]));
    // The rate of a few messages has no meaning.
    const isRare = a && b && Math.max(a.count, b.count) <= 2;
    const kind = !b
      ? 'first'
      : !a
        ? 'second'
        : longName(a.schemaName) !== longName(b.schemaName)
          ? 'type'
          : isSameRate || (isRare && a.count === b.count)
            ? 'same'
            : 'rate';
    return { topic, kind, counts: [a?.count, b?.count], ratesHz };
  });
}

/** Pose at a position of the timeline. */
export interface PoseAt {
  atNs: number;
  pose: Pose;
}

export interface TrajectoryDifference {
  rmsM: number;
  worstM: number;
  count: number;
}

/** Distances of poses at equal positions; `undefined` without any. `firstFromSecond` ties the frames. */
export function trajectoryDifference(
  first: readonly PoseAt[],
  second: readonly PoseAt[],
  firstFromSecond: Pose,
): TrajectoryDifference | undefined {
  const others = new Map(second.map((one) => [one.atNs, one.pose]));
  let sum = 0;
  let worstM = 0;
  let count = 0;
  for (const { atNs, pose } of first) {
    const other = others.get(atNs);
    if (!other) continue;
    const moved = multiply(firstFromSecond, other).t;
    const distance = Math.hypot(...pose.t.map((v, i) => v - moved[i]!));
    sum += distance * distance;
    worstM = Math.max(worstM, distance);
    count++;
  }
  return count > 0 ? { rmsM: Math.sqrt(sum / count), worstM, count } : undefined;
}

/** Transform that puts one pose onto another. */
export const tieOf = (firstFromRobot: Pose, secondFromRobot: Pose): Pose =>
  multiply(firstFromRobot, inverse(secondFromRobot));
