/** Kinds of marks: their shape, their colour and their importance. */
import { t } from '../texts/language.svelte';

export type Tone = 'error' | 'warn' | 'ok' | 'accent';

interface MarkKind {
  /** Path in a box of 10 by 10. */
  shape: string;
  tone: Tone;
  isFilled: boolean;
}

/** Most important first: a group of marks is drawn as its most important one. */
const KINDS: Record<string, MarkKind> = {
  collision: {
    shape: 'M5 0l1.500 3.500L10 5 6.500 6.500 5 10 3.500 6.500 0 5l3.500-1.500z',
    tone: 'error',
    isFilled: true,
  },
  error: { shape: 'M5 .5l4.800 9H.2z', tone: 'error', isFilled: true },
  goalAborted: { shape: 'M1 1l8 8M9 1L1 9', tone: 'error', isFilled: false },
  localizationLost: {
    shape: 'M5 1a4 4 0 100 8 4 4 0 000-8zM2 8l6-6',
    tone: 'error',
    isFilled: false,
  },
  warning: { shape: 'M5 1l4.300 8H.7z', tone: 'warn', isFilled: false },
  qosMismatch: { shape: 'M1 3h5M4 1l2 2-2 2M9 7H4M6 5L4 7l2 2', tone: 'warn', isFilled: false },
  goalCanceled: { shape: 'M1.500 5h7', tone: 'warn', isFilled: false },
  goalReached: { shape: 'M1 5l3 3 5-6', tone: 'ok', isFilled: false },
  goal: { shape: 'M2 10V.5h6.500L7 3l1.500 2.500H2', tone: 'accent', isFilled: true },
  localizationFound: {
    shape: 'M5 1a4 4 0 100 8 4 4 0 000-8zM5 4a1 1 0 100 2 1 1 0 000-2z',
    tone: 'ok',
    isFilled: false,
  },
};
const OTHER: MarkKind = { shape: 'M5 1l4 4-4 4-4-4z', tone: 'accent', isFilled: true };
const ORDER = Object.keys(KINDS);

export const markKind = (kind: string): MarkKind => KINDS[kind] ?? OTHER;

/** Name of a kind; a kind that a later server adds is shown as it is. */
export function markTitle(kind: string): string {
  const titles = t().marks as Record<string, unknown>;
  const title = kind in KINDS ? titles[kind] : undefined;
  return typeof title === 'string' ? title : kind;
}

export function mostImportant(kinds: readonly string[]): string {
  const known = ORDER.find((kind) => kinds.includes(kind));
  return known ?? kinds[0] ?? '';
}
