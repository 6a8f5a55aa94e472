/** Reason why the robot stands. */
import { t } from '../texts/language.svelte';

/** Time without motion after which a robot with a goal counts as still [s]. */
export const STANDING_AFTER_S = 3;

export interface Standing {
  hasGoal: boolean;
  isPaused: boolean;
  /** Time since the robot last moved [s]. */
  stillS: number;
  /** Reason why the last goal was not accepted. */
  refusal: string;
  /** Error of the last goal, if it failed. */
  failure: string;
  /** Error that a server answered last while it drives. */
  lastError: string;
  /** Polygon by which the collision monitor stops the robot. */
  stoppedBy: string;
  running: readonly string[];
}

/** Reason in one or two sentences; empty while the robot drives, and if it has nothing to do. */
export function whyStanding(now: Standing): string {
  if (!now.hasGoal) {
    return now.refusal || now.failure;
  }
  if (now.isPaused) return t().navigation.paused;
  if (now.stoppedBy) {
    return t().navigation.stoppedBy(now.stoppedBy);
  }
  // The error stays until the same server succeeds: it is no reason while the robot follows a new path.
  const follows = now.running.some((node) => /^FollowPath\b/.test(node));
  const isStill = now.stillS >= STANDING_AFTER_S;
  if (now.lastError && (isStill || !follows)) return now.lastError;
  if (!isStill) return '';
  const nodes = now.running.join(', ');
  // Without the time: a text that changes every second would be read aloud every second.
  return nodes ? t().navigation.stillRunning(nodes) : t().navigation.still;
}
