/** Content of a plot panel: plots, and the curves in each. Plain JSON: it is saved with the layout. */
import type { App } from '../app/app.svelte';
import { unitOf } from '../app/fields';
import {
  evaluate,
  expressionUnit,
  fieldsOf,
  parseExpression,
  type Expression,
  type FieldRef,
  type Samples,
} from './expression';

export interface Curve {
  /** Expression of the value, such as `/odom:twist.twist.linear.x`. */
  y: string;
  /** Expression of the abscissa of an x-y plot. */
  x?: string;
  /** Topic and path that names in the expressions are relative to. */
  base?: FieldRef;
  isHidden?: boolean;
}

export interface Plot {
  kind: 'time' | 'xy';
  curves: Curve[];
}

/** Fields of a saved layout, without what is not one. */
export function fieldList(saved: unknown): FieldRef[] {
  return (Array.isArray(saved) ? (saved as Partial<FieldRef>[]) : []).flatMap((one) =>
    typeof one?.topic === 'string' && typeof one.path === 'string'
      ? [{ topic: one.topic, path: one.path }]
      : [],
  );
}

/** Plots of a saved layout, without what is not one; at least one. */
export function validPlots(saved: readonly unknown[]): Plot[] {
  const isRecord = (one: unknown): one is Record<string, unknown> =>
    typeof one === 'object' && one !== null;
  const isText = (one: unknown) => one === undefined || typeof one === 'string';
  const plots = saved.filter(isRecord).map((one): Plot => {
    const kind = one.kind === 'xy' ? 'xy' : 'time';
    const curves = Array.isArray(one.curves) ? one.curves : [];
    const isCurve = (curve: unknown) =>
      isRecord(curve) && typeof curve.y === 'string' && isText(curve.x);
    return { kind, curves: curves.filter(isCurve) as Curve[] };
  });
  return plots.length > 0 ? plots : [{ kind: 'time', curves: [] }];
}

/** Colours of curves, of at least 3:1 on both backgrounds; Tol's "bright" scheme, adapted. */
const COLORS = {
  dark: ['#2fc4b2', '#e9b44c', '#7aa2f7', '#f26d6d', '#b794f4', '#7ed957', '#f59ad0', '#9fb3c8'],
  light: ['#0a7d70', '#a06a00', '#2457c5', '#c23434', '#7a3fc9', '#3b7a12', '#b3307f', '#566676'],
};

export const colorOfCurve = (index: number, theme: 'dark' | 'light'): string =>
  COLORS[theme][index % COLORS[theme].length]!;

/** Expressions of a curve, parsed. */
export interface ParsedCurve {
  y: Expression;
  x?: Expression;
}

/** Parses a curve; throws an `ExpressionError`. */
export function parseCurve(curve: Curve): ParsedCurve {
  return {
    y: parseExpression(curve.y, curve.base),
    x: curve.x === undefined ? undefined : parseExpression(curve.x, curve.base),
  };
}

/** Parses a curve of a saved layout; `undefined` for one that cannot be read. */
export function tryParse(curve: Curve): ParsedCurve | undefined {
  try {
    return parseCurve(curve);
  } catch {
    return undefined;
  }
}

export const refsOf = ({ x, y }: ParsedCurve): FieldRef[] => [
  ...fieldsOf(y),
  ...(x ? fieldsOf(x) : []),
];

export const unitOfExpression = (expression: Expression): string =>
  expressionUnit(expression, ({ path }) => unitOf(path));

/** Points of an x-y curve: `x` has there its last value before. */
export function pointsOf(
  { x, y }: { x: Expression; y: Expression },
  samplesOf: (ref: FieldRef) => Samples,
): { times: Float64Array; xs: Float64Array; ys: Float64Array } {
  const { times, values: ys } = evaluate(y, samplesOf);
  const over = evaluate(x, samplesOf);
  const xs = new Float64Array(times.length);
  let j = -1;
  for (let i = 0; i < times.length; i++) {
    while (j + 1 < over.times.length && over.times[j + 1]! <= times[i]!) j++;
    xs[i] = j < 0 ? NaN : over.values[j]!;
  }
  return { times, xs, ys };
}

/** Name of a curve in legends: without its topic if all have the same one. */
export function labelOf(curve: Curve): string {
  return curve.x === undefined ? curve.y : `${curve.y} / ${curve.x}`;
}

/** Beginnings of expressions that complete the last word of a text: topics, then fields of a topic. */
export function completions(
  app: App,
  text: string,
  pathsOf: (topic: string) => string[],
  most = 60,
): string[] {
  const word = /\/[\w/~]*(?:[:.][\w.[\]]*)?$/.exec(text)?.[0];
  if (word === undefined) return text ? [] : app.topics.map((t) => `${t.name}:`).slice(0, most);
  const before = text.slice(0, text.length - word.length);
  const split = word.search(/[:.]/);
  const found =
    split < 0
      ? app.topics.filter((t) => t.type && t.name.includes(word)).map((t) => `${t.name}:`)
      : pathsOf(word.slice(0, split))
          .map((path) => `${word.slice(0, split)}:${path}`)
          .filter((full) => full.includes(word.slice(split + 1)));
  return found.slice(0, most).map((one) => before + one);
}
