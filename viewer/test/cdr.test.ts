import { describe, expect, test } from 'vitest';
import { decoder, encoder } from '../src/core/cdr';
import { parseSchema } from '../src/core/schema';

const bytes = (...parts: number[][]) => new Uint8Array(parts.flat());
const LITTLE = [0, 1, 0, 0];

describe('message definitions', () => {
  test('fields, constants, comments, types of the same package', () => {
    const schema = parseSchema(
      'demo/msg/Thing',
      'uint8 ADD=0 # first\nstring MOTTO="a # b"\nPoint[] points\nfloat32[3] three\nstring<=5[<=2] few\n' +
        'int32 level 7\n===\nMSG: demo/Point\nfloat64 x',
    );
    expect(schema.root.constants.map((c) => [c.name, c.value])).toEqual([
      ['ADD', '0'],
      ['MOTTO', 'a # b'],
    ]);
    expect(schema.root.fields).toEqual([
      { name: 'points', type: 'demo/Point', isComplex: true, array: 'sequence' },
      { name: 'three', type: 'float32', isComplex: false, array: 3 },
      { name: 'few', type: 'string', isComplex: false, array: 'sequence' },
      { name: 'level', type: 'int32', isComplex: false, array: undefined, default: '7' },
    ]);
  });

  test('an undefined type is reported by name', () => {
    const schema = parseSchema('demo/Thing', 'geometry_msgs/Point p');
    expect(() => decoder(schema)).toThrow('geometry_msgs/Point');
  });
});

describe('decoding', () => {
  test('numbers are aligned to their size, counted from the end of the header', () => {
    const decode = decoder(parseSchema('demo/A', 'uint8 a\nuint32 b\nuint8 c\nfloat64 d'));
    const d = [...new Uint8Array(new Float64Array([0.5]).buffer)];
    const read = decode(bytes(LITTLE, [1, 0, 0, 0], [2, 0, 0, 0], [3, 0, 0, 0, 0, 0, 0, 0], d));
    expect(read).toEqual({ a: 1, b: 2, c: 3, d: 0.5 });
  });

  test('big endian', () => {
    const decode = decoder(parseSchema('demo/A', 'uint16[] a\nstring s'));
    const read = decode(bytes([0, 0, 0, 0], [0, 0, 0, 2, 1, 0, 0, 7], [0, 0, 0, 3, 104, 105, 0]));
    expect(read).toEqual({ a: new Uint16Array([256, 7]), s: 'hi' });
  });

  test('aligned arrays of numbers are views, unaligned ones are copies', () => {
    const decode = decoder(parseSchema('demo/A', 'float32[] ranges'));
    const message = bytes(LITTLE, [2, 0, 0, 0], [0, 0, 128, 63], [0, 0, 0, 64]);
    const aligned = decode(message).ranges as Float32Array;
    expect([...aligned]).toEqual([1, 2]);
    expect(aligned.buffer).toBe(message.buffer);
    const shifted = new Uint8Array(17);
    shifted.set(message, 1);
    expect([...(decode(shifted.subarray(1)).ranges as Float32Array)]).toEqual([1, 2]);
  });

  test('a length that exceeds the message is refused before memory is allocated', () => {
    const decode = decoder(parseSchema('demo/A', 'float64[] x\nstring[] y'));
    expect(() => decode(bytes(LITTLE, [255, 255, 255, 255]))).toThrow('shorter than that');
    expect(() => decode(bytes(LITTLE, [0, 0, 0, 0], [9, 0, 0, 0]))).toThrow('shorter than that');
    expect(() => decode(bytes([0]))).toThrow('shorter');
  });

  test('an encoded message decodes to the same values', () => {
    const text =
      'std_msgs/Header header\nbool b\nint64 big\nuint8[] data\nfloat64[2] pair\nstring[] names\n' +
      'wstring w\ndemo/Empty nothing\nint8 last\n===\nMSG: std_msgs/Header\n' +
      'builtin_interfaces/Time stamp\nstring frame_id\n===\nMSG: demo/Empty\n';
    const schema = parseSchema('demo/All', text);
    const message = {
      header: { stamp: { sec: -1, nanosec: 5 }, frame_id: 'höher' },
      b: true,
      big: -9_000_000_000,
      data: new Uint8Array([1, 2, 3]),
      pair: new Float64Array([0.1, -2]),
      names: ['a', ''],
      w: 'ß',
      nothing: {},
      last: -7,
    };
    expect(decoder(schema)(encoder(schema)(message))).toEqual(message);
  });

  test('an empty request has one byte after its header', () => {
    expect([...encoder(parseSchema('std_srvs/Empty', ''))({})]).toEqual([...LITTLE, 0]);
    expect(decoder(parseSchema('std_srvs/Empty', ''))(new Uint8Array(LITTLE))).toEqual({});
  });
});
