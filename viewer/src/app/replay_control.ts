/** Replay as panels see it. All properties are reactive; times are log times in seconds. */

/** Numbers of a topic over time, for plots. */
export interface Series {
  timesS: number[];
  /** A list per path; NaN where a message has no number. */
  values: number[][];
  /** True if only the smallest and largest values of equal spans are there. */
  isReduced: boolean;
}

export interface ReplayControl {
  /** Time that is shown. */
  readonly timeS: number;
  readonly startS: number;
  readonly endS: number;
  readonly isPlaying: boolean;
  play(): void;
  pause(): void;
  /** Shows the state at this time. */
  seek(timeS: number): void;
  /** Resolves when the state at this time is shown: for pictures, one after the other. */
  show(timeS: number): Promise<void>;
  /**
   * Numbers at paths (`pose.position.x`, `ranges[3]`, `orientation.yaw`) of a topic between two times. More than
   * `points` messages are reduced to the smallest and largest values of equal spans.
   */
  series(
    topic: string,
    paths: readonly string[],
    fromS: number,
    toS: number,
    points: number,
  ): Promise<Series>;
}
