import { describe, expect, test } from 'vitest';
import {
  evaluate,
  expressionUnit,
  ExpressionError,
  fieldsOf,
  parseExpression,
  type FieldRef,
  type Samples,
} from '../src/plots/expression';
import { aligned, csv, statistics, valueAt } from '../src/plots/statistics';
import { unitOf } from '../src/app/fields';
import type { Series } from '../src/app/replay_control';
import { fieldList, validPlots } from '../src/plots/curves';
import { ticks } from '../src/plots/ticks';
import { pointsOnScreen, scalesOf } from '../src/plots/time_chart';
import { RecordedSeries } from '../src/plots/recorded';

const BASE: FieldRef = { topic: '/odom', path: 'twist' };
const DATA: Record<string, Samples> = {
  '/odom:twist.x': { times: [0, 1, 2], values: [3, 6, 3] },
  '/odom:twist.y': { times: [0, 1, 2], values: [4, 8, 4] },
  '/imu:yaw': { times: [0.5, 1.5], values: [Math.PI, Math.PI / 2] },
};
const values = (text: string) => [
  ...evaluate(parseExpression(text, BASE), ({ topic, path }) => DATA[`${topic}:${path}`]!).values,
];

describe('expressions', () => {
  const check = (text: string, expected: number[]) => expect(values(text)).toEqual(expected);
  test('lengths', () => check('sqrt(x^2 + y^2)', [5, 10, 5]));
  test('precedence', () => check('x + y * 2 ^ 2', [19, 38, 19]));
  test('a power binds more strongly than a sign', () => check('-x^2', [-9, -36, -9]));
  test('a power binds to the right', () => check('2^3^2 + 0*x', [512, 512, 512]));
  test('a slash divides after a value', () => check('x/y*4', [3, 3, 3]));
  test('and begins a topic elsewhere', () => check('x + /odom:twist.y', [7, 14, 7]));
  test('division by a topic', () => check('y / /odom.twist.y', [1, 1, 1]));
  test('other topics hold their last value', () => check('0*x + deg(/imu:yaw)', [NaN, 180, 90]));
  test('derivative', () => check('derivative(x)', [NaN, 3, -3]));
  test('integral', () => check('integral(x)', [0, 4.5, 9]));
  test('moving average', () => check('average(x, 2)', [3, 4.5, 4.5]));
  test('conditions', () => check('if(x > 3 && y >= 8, 1, 0)', [0, 1, 0]));
  test('time', () => check('time + 0 * x', [0, 1, 2]));
  test('unwrap', () => {
    const turn = { times: [0, 1, 2], values: [3, -3, 3] };
    const [a, b, c] = evaluate(parseExpression('unwrap(/a:b)'), () => turn).values;
    expect([a, b, c]).toEqual([3, -3 + 2 * Math.PI, 3]);
  });

  const fails = (text: string, at: number, message: RegExp, base?: FieldRef) => {
    try {
      parseExpression(text, base);
    } catch (error) {
      expect(error).toBeInstanceOf(ExpressionError);
      expect((error as ExpressionError).at).toBe(at);
      return expect((error as Error).message).toMatch(message);
    }
    throw new Error(`"${text}" was accepted`);
  };
  test('a missing value', () => fails('x + ', 4, /a value is missing before the end/, BASE));
  test('a missing bracket', () => fails('sqrt(x', 6, /"\)" is missing/, BASE));
  test('an unknown function', () => fails('1 + foo(x)', 4, /no function "foo"/, BASE));
  test('names of JavaScript are no functions', () => fails('toString(1)', 0, /no function/));
  test('a name without a topic', () => fails('yaw', 0, /write \/topic:yaw/));
  test('a topic without a field', () => fails('1 + /odom', 4, /\/topic:field/));
  test('too few values', () => fails('atan2(1)', 0, /takes 2 value\(s\), not 1/));
  test('a strange character', () => fails('1 $ 2', 2, /unexpected "\$"/));
  test('deep nesting', () => fails('('.repeat(100), 60, /nested too deeply/));
  test('many signs', () =>
    expect(parseExpression('-'.repeat(1000) + '1')).toEqual({ kind: 'number', value: 1 }));

  test('fields, each once', () => {
    expect(fieldsOf(parseExpression('x + x + /imu:yaw', BASE)).map((f) => f.path)).toEqual([
      'twist.x',
      'yaw',
    ]);
  });
});

describe('units', () => {
  const check = (text: string, unit: string) =>
    expect(expressionUnit(parseExpression(text), ({ path }) => unitOf(path))).toBe(unit);
  test('of a field', () => check('/odom:twist.twist.linear.x', 'm/s'));
  test('of a length', () => check('sqrt(/a:position.x^2 + /a:position.y^2)', 'm'));
  test('of a square', () => check('/a:position.x * /a:position.y', 'm²'));
  test('of degrees', () => check('deg(/a:orientation.yaw)', '°'));
  test('of a derivative', () => check('derivative(/a:position.x)', 'm/s'));
  test('of the derivative of a speed', () => check('derivative(/a:linear.x)', 'm/s²'));
  test('of an integral', () => check('integral(/a:linear.x)', 'm'));
  test('of a ratio', () => check('/a:position.x / /a:position.y', ''));
  test('of a mixed sum', () => check('/a:position.x + /a:linear.x', ''));
  test('of a sum with a number', () => check('/a:position.x + 1', 'm'));
});

describe('statistics', () => {
  const line = { times: [0, 1, 2, 3], values: [3, 4, NaN, 100] };
  test('of the visible span', () =>
    expect(statistics(line, 0, 2)).toEqual({
      count: 2,
      min: 3,
      max: 4,
      mean: 3.5,
      rms: Math.sqrt(12.5),
    }));
  test('of nothing', () => expect(statistics(line, 5, 6)).toBeUndefined());
  test('value at a time', () => expect(valueAt(line, 1.5)).toBe(4));
  test('value before the first', () => expect(valueAt(line, -1)).toBeUndefined());
  test('series with different times', () =>
    expect(
      aligned(
        [
          { times: [0, 2], values: [1, 2] },
          { times: [1, 2], values: [5, NaN] },
        ],
        0,
        2,
      ),
    ).toEqual({
      times: [0, 1, 2],
      columns: [
        [1, null, 2],
        [null, 5, null],
      ],
    }));
  test('CSV', () => expect(csv([['a "b"', 1, null]])).toBe('"a ""b""",1,\r\n'));
});

describe('series of a recording', () => {
  test('one request per topic at a time, and the newest wish', async () => {
    const asked: string[] = [];
    const answers: ((series: Series) => void)[] = [];
    const replay = {
      series: (topic: string, paths: readonly string[], fromS: number) => {
        asked.push(`${topic} ${paths.join()} ${fromS}`);
        return new Promise<Series>((resolve) => answers.push(resolve));
      },
    };
    const recorded = new RecordedSeries(100, { loaded: () => {}, failed: () => {} });
    const refs = [
      { topic: '/a', path: 'y' },
      { topic: '/a', path: 'x' },
    ];
    for (const fromS of [0, 1, 2]) recorded.load(replay, refs, { fromS, toS: 9 });
    expect(asked).toEqual(['/a x,y 0']);
    answers[0]!({
      timesS: [0, 1],
      values: [
        [1, 2],
        [3, 4],
      ],
      isReduced: true,
    });
    await Promise.resolve();
    await Promise.resolve();
    expect(asked).toEqual(['/a x,y 0', '/a x,y 2']);
    expect(recorded.samples(refs[0]!)).toEqual({ times: [0, 1], values: [3, 4] });
    expect(recorded.isReduced).toBe(true);
  });
});

describe('plots of a layout', () => {
  test('what is no curve is left out', () =>
    expect(validPlots([{ kind: 'xy', curves: [{ y: 1 }, { y: '/a:b', x: '/a:c' }] }, 7])).toEqual([
      { kind: 'xy', curves: [{ y: '/a:b', x: '/a:c' }] },
    ]));
  test('fields', () =>
    expect(fieldList([{ topic: '/a', path: 'b', x: 1 }, null, 3])).toEqual([
      { topic: '/a', path: 'b' },
    ]));
  test('there is at least one', () => expect(validPlots([])).toHaveLength(1));
});

describe('charts', () => {
  const line = (unit: string, values: number[]) => ({
    label: '',
    color: '',
    unit,
    samples: { times: values.map((_, i) => i), values },
  });
  test('round ticks', () => expect(ticks(0.3, 2.2, 4)).toEqual([0.5, 1, 1.5, 2]));
  test('no ticks of nothing', () => expect(ticks(1, 1, 4)).toEqual([]));
  test('a scale per unit', () => {
    const scales = scalesOf([line('m', [0, 100]), line('rad', [5, 5])], { fromS: 0, toS: 1 });
    expect(scales).toEqual([
      { unit: 'm', min: -6, max: 106 },
      { unit: 'rad', min: 4.5, max: 5.5 },
    ]);
  });
  test('a peak among many samples stays', () => {
    const values = Array.from({ length: 9000 }, (_, i) => (i === 4321 ? 7 : 0));
    const { samples } = line('', values);
    const span = { fromS: 0, toS: 9000 };
    const points = pointsOnScreen(
      samples,
      span,
      (x) => x / 90,
      (y) => y,
    );
    expect(points.length).toBeLessThan(300);
    expect(Math.max(...points.map((point) => point?.[1] ?? 0))).toBe(7);
  });
  test('NaN is a gap', () =>
    expect(
      pointsOnScreen(
        line('', [1, NaN, 2]).samples,
        { fromS: 0, toS: 2 },
        (x) => x,
        (y) => y,
      ),
    ).toEqual([[0, 1], undefined, [2, 2]]));
});
