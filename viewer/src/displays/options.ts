/** Options of displays: RViz's names and defaults, declared once for the panels and for `.rviz` files. */

export type Value = boolean | number | string;
export type Values = Record<string, Value>;

export interface Option {
  /** Names from the outermost to the innermost: "Shape/Axes Length". */
  path: string;
  kind: 'bool' | 'number' | 'int' | 'color' | 'choice' | 'text' | 'topic' | 'frame' | 'note';
  default: Value;
  choices?: readonly string[];
  /** Message types of a topic option. */
  types?: readonly string[];
  min?: number;
  max?: number;
  step?: number;
  /** Condition under which the option is shown. */
  when?: (values: Values) => boolean;
}

type Extra = Partial<Option>;

export const bool = (path: string, value: boolean, extra: Extra = {}): Option => ({
  path,
  kind: 'bool',
  default: value,
  ...extra,
});
export const number = (path: string, value: number, extra: Extra = {}): Option => ({
  path,
  kind: 'number',
  default: value,
  ...extra,
});
export const int = (path: string, value: number, extra: Extra = {}): Option => ({
  path,
  kind: 'int',
  default: value,
  ...extra,
});
export const color = (path: string, value: string, extra: Extra = {}): Option => ({
  path,
  kind: 'color',
  default: value,
  ...extra,
});
export const text = (path: string, value: string, extra: Extra = {}): Option => ({
  path,
  kind: 'text',
  default: value,
  ...extra,
});
export const frame = (path: string, value: string): Option => ({
  path,
  kind: 'frame',
  default: value,
});
export const note = (path: string): Option => ({ path, kind: 'note', default: '' });
export const choice = (
  path: string,
  value: string,
  choices: readonly string[],
  extra: Extra = {},
): Option => ({ path, kind: 'choice', default: value, choices, ...extra });

/** Opacity between 0 and 1. */
export const alpha = (path: string, value: number): Option =>
  number(path, value, { min: 0, max: 1, step: 0.05 });

/** Vector as three numbers, as in RViz. */
export const vector = (path: string, value: [number, number, number]): Option[] => [
  number(`${path}/X`, value[0], { step: 0.1 }),
  number(`${path}/Y`, value[1], { step: 0.1 }),
  number(`${path}/Z`, value[2], { step: 0.1 }),
];

/** Topic with the QoS options of RViz. */
export function topic(
  path: string,
  value: string,
  types: readonly string[],
  qos: { reliability?: string; durability?: string; isFiltered?: boolean } = {},
): Option[] {
  return [
    { path, kind: 'topic', default: value, types },
    int(`${path}/Depth`, 5, { min: 1 }),
    choice(`${path}/History Policy`, 'Keep Last', ['Keep Last', 'Keep All', 'System Default']),
    choice(`${path}/Reliability Policy`, qos.reliability ?? 'Reliable', [
      'Reliable',
      'Best Effort',
      'System Default',
    ]),
    choice(`${path}/Durability Policy`, qos.durability ?? 'Volatile', [
      'Volatile',
      'Transient Local',
      'System Default',
    ]),
    ...(qos.isFiltered ? [int(`${path}/Filter size`, 10, { min: 1 })] : []),
  ];
}

export function defaultsOf(options: readonly Option[]): Values {
  return Object.fromEntries(options.map((option) => [option.path, option.default]));
}
