/** How well maps agree with the simulated world, as the server tells it (docs/live.md). */
import type { Message } from '../core/cdr';

export interface MapTruth {
  topic: string;
  /** In words. */
  text: string;
  isGood: boolean;
  /** What is free in both of what is free in either, 0 to 1. */
  freeIou: number;
  wallsIou: number;
  /** From the map's walls to the true ones, on average [m]. */
  wallMeanM: number;
  /** Which part of what can be seen is known, 0 to 1. */
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

/** A part of one as a person reads it. */
export const percent = (part: number) =>
  Number.isFinite(part) ? `${Math.round(part * 100)} %` : '–';
