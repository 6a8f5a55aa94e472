/** Options that clouds and scans share. */
import { Vector3 } from 'three';
import type { Pose } from '../core/pose';
import { inverse, rotate } from '../core/pose';
import { STYLES, type Appearance, type Rows, type Style } from '../scene/cloud';
import { colorOf } from '../scene/shapes';
import { alpha, bool, choice, color, int, number, text, type Option, type Values } from './options';

const TRANSFORMERS = ['Intensity', 'AxisColor', 'FlatColor', 'RGB8', 'RGBF32'];
const by = (name: string) => (v: Values) => v['Color Transformer'] === name;
const isSet = (path: string, value: unknown) => (v: Values) => v[path] === value;
const both =
  (...all: ((v: Values) => boolean)[]) =>
  (v: Values) =>
    all.every((one) => one(v));

export function cloudOptions(transformer: string): Option[] {
  const intensity = by('Intensity');
  const axis = by('AxisColor');
  return [
    bool('Selectable', true),
    choice('Style', 'Flat Squares', STYLES),
    number('Size (m)', 0.01, { min: 0.001, step: 0.005, when: (v) => v.Style !== 'Points' }),
    int('Size (Pixels)', 3, { min: 1, when: (v) => v.Style === 'Points' }),
    alpha('Alpha', 1),
    number('Decay Time', 0, { min: 0, step: 0.5 }),
    choice('Position Transformer', 'XYZ', ['XYZ']),
    choice('Color Transformer', transformer, TRANSFORMERS),
    text('Channel Name', 'intensity', { when: intensity }),
    bool('Use rainbow', true, { when: intensity }),
    bool('Invert Rainbow', false, { when: both(intensity, isSet('Use rainbow', true)) }),
    color('Min Color', '0; 0; 0', { when: both(intensity, isSet('Use rainbow', false)) }),
    color('Max Color', '255; 255; 255', { when: both(intensity, isSet('Use rainbow', false)) }),
    bool('Autocompute Intensity Bounds', true, { when: intensity }),
    number('Min Intensity', 0, { when: intensity }),
    number('Max Intensity', 4096, { when: intensity }),
    choice('Axis', 'Z', ['X', 'Y', 'Z'], { when: axis }),
    bool('Autocompute Value Bounds', true, { when: axis }),
    number('Autocompute Value Bounds/Min Value', -10, { when: axis }),
    number('Autocompute Value Bounds/Max Value', 10, { when: axis }),
    bool('Use Fixed Frame', true, { when: axis }),
    color('Color', '255; 255; 255', { when: by('FlatColor') }),
  ];
}

/** Style of a cloud by these options. */
export function appearanceOf(values: Values, rows: Rows, fixedFromCloud: Pose): Appearance {
  const get = <T>(path: string) => values[path] as T;
  const transformer = get<string>('Color Transformer');
  const appearance: Appearance = {
    style: get<Style>('Style'),
    sizeM: get('Size (m)'),
    sizePx: get('Size (Pixels)'),
    alpha: get('Alpha'),
    coloring: 'flat',
    color: colorOf(get('Color')),
    low: get('Min Intensity'),
    high: get('Max Intensity'),
    isRainbow: get('Use rainbow'),
    isInverted: get('Invert Rainbow'),
    lowColor: colorOf(get('Min Color')),
    highColor: colorOf(get('Max Color')),
    axis: new Vector3(0, 0, 1),
    axisOffset: 0,
  };
  if (/^RGB/.test(transformer) && rows.rgb !== undefined) appearance.coloring = 'rgb';
  if (transformer === 'Intensity' && rows.value !== undefined) {
    appearance.coloring = 'value';
    if (get('Autocompute Intensity Bounds'))
      [appearance.low, appearance.high] = bounds(rows, 'value', appearance);
  }
  if (transformer === 'AxisColor') {
    appearance.coloring = 'axis';
    const i = 'XYZ'.indexOf(get('Axis'));
    appearance.axis.set(+(i === 0), +(i === 1), +(i === 2));
    if (get('Use Fixed Frame')) {
      const cloudFromFixed = inverse(fixedFromCloud);
      appearance.axis.set(...rotate(cloudFromFixed.q, appearance.axis.toArray()));
      appearance.axisOffset = fixedFromCloud.t[i]!;
    }
    appearance.low = get('Autocompute Value Bounds/Min Value');
    appearance.high = get('Autocompute Value Bounds/Max Value');
    if (get('Autocompute Value Bounds'))
      [appearance.low, appearance.high] = bounds(rows, 'axis', appearance);
  }
  return appearance;
}

/** Minimum and maximum of the values or of the coordinates along the axis. */
function bounds(rows: Rows, of: 'value' | 'axis', appearance: Appearance): [number, number] {
  const { words, stride, count, xyz, value } = rows;
  const floats = new Float32Array(words.buffer, words.byteOffset, words.length);
  let low = Infinity;
  let high = -Infinity;
  const { x, y, z } = appearance.axis;
  for (let i = 0, at = 0; i < count; i++, at += stride) {
    const p = at + xyz;
    const number =
      of === 'value'
        ? floats[at + value!]!
        : floats[p]! * x + floats[p + 1]! * y + floats[p + 2]! * z + appearance.axisOffset;
    if (number < low && number > -Infinity) low = number;
    if (number > high && number < Infinity) high = number;
  }
  if (!(low <= high)) return [0, 1];
  return high > low ? [low, high] : [low, low + 1];
}
