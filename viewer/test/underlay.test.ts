import { describe, expect, test } from 'vitest';
import { readMapYaml, readPgm } from '../src/sim/map_file';

const ascii = (text: string) => Uint8Array.from(text, (c) => c.charCodeAt(0));

describe('map files', () => {
  test('resolution and origin', () => {
    const text = 'image: maps/room.pgm\nresolution: 0.05\norigin: [-1.0, 2.0, 0.5]\nnegate: 0\n';
    expect(readMapYaml(text)).toEqual({
      image: 'room.pgm',
      resolutionM: 0.05,
      x: -1,
      y: 2,
      yawRad: 0.5,
    });
  });

  test('other files are refused with what a map needs', () => {
    expect(() => readMapYaml('a: 1')).toThrow('resolution');
    expect(() => readMapYaml('image: a.png\nresolution: 0\norigin: [0, 0, 0]')).toThrow('origin');
    expect(() => readMapYaml('[')).toThrow('not YAML');
  });
});

describe('PGM', () => {
  test('binary and text, with comments', () => {
    const binary = new Uint8Array([...ascii('P5 # by hand\n2 1 255\n'), 7, 254]);
    expect([...readPgm(binary).pixels]).toEqual([7, 254]);
    expect([...readPgm(ascii('P2\n2 1\n15\n0 15')).pixels]).toEqual([0, 255]);
  });

  test('16 bits', () => {
    const bytes = new Uint8Array([...ascii('P5 1 2 65535\n'), 255, 255, 0, 0]);
    expect([...readPgm(bytes).pixels]).toEqual([255, 0]);
  });

  test('damaged images are refused', () => {
    expect(() => readPgm(ascii('P6 1 1 255\n'))).toThrow('no PGM');
    expect(() => readPgm(ascii('P5 99999999 99999999 255\n'))).toThrow('no PGM');
    expect(() => readPgm(ascii('P5 2 2 255\nab'))).toThrow('ends before');
    expect(() => readPgm(ascii('P2 2 1 255\n1'))).toThrow('ends before');
  });
});
