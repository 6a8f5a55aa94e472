/** Comparison of maps with the simulated world, as the server publishes it (docs/live.md). */
import type { Message } from '../core/cdr';

export interface MapTruth {
  topic: string;
  /** Summary as text. */
  text: string;
  isGood: boolean;
  /** Intersection over union of free space, 0 to 1. */
  freeIou: number;
  wallsIou: number;
  /** Mean distance from the walls of the map to the true walls [m]. */
  wallMeanM: number;
  /** Explored fraction of the space that can be seen, 0 to 1. */
  explored: number;
}

interface Status {
  level: number;
  name: string;
  message: string;
  values: { key: string; value: string }[];
}

export function mapTruths(message: Message): MapTruth[] {
  return ((message.status ?? []) as unknown as Status[]).map((status) => {
    const number = (key: string) => Number(status.values.find((v) => v.key === key)?.value ?? NaN);
    return {
      topic: status.name,
      text: status.message,
      isGood: Number(status.level) === 0,
      freeIou: number('free_iou'),
      wallsIou: number('walls_iou'),
      wallMeanM: number('wall_mean_m'),
      explored: number('explored'),
    };
  });
}

/** Fraction formatted as percent. */
export const percent = (part: number) =>
  Number.isFinite(part) ? `${Math.round(part * 100)} %` : '–';
