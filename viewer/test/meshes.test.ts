import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import type { Mesh, MeshLambertMaterial } from 'three';
import { copyOf, MeshLibrary } from '../src/scene/meshes';
import { unpackMesh } from '../src/scene/packed_mesh';

/** Bytes that the reader in Rust writes; its own test compares them with this file. */
const PLATE = new Uint8Array(
  Buffer.from(
    readFileSync(
      join(__dirname, '../../crates/foundation/meshes/tests/data/plate.hex'),
      'utf8',
    ).replace(/\s/g, ''),
    'hex',
  ),
);

const libraryOf = (bytes: Uint8Array) =>
  new MeshLibrary({
    asset: () => Promise.reject(new Error('no such file')),
    mesh: () => Promise.resolve(bytes),
  });

describe('unpackMesh', () => {
  test('reads what the server writes, at any offset in a message', () => {
    const shifted = new Uint8Array(PLATE.length + 3);
    shifted.set(PLATE, 3);
    const { parts, isLinear } = unpackMesh(shifted.subarray(3));
    expect(isLinear).toBe(false);
    expect(parts.map(({ name }) => name)).toEqual(['bare', 'plate']);
    const [bare, plate] = parts as [(typeof parts)[0], (typeof parts)[0]];
    expect([bare.normals, bare.uvs, bare.material]).toEqual([undefined, undefined, undefined]);
    expect([...bare.positionsM]).toEqual([0, 1, 0, 2, 0, 0, 0, 0, 0]);
    expect([...plate.indices]).toEqual([0, 1, 2]);
    expect([...plate.normals!]).toEqual([0, 0, 32767, 0, 0, 32767, 0, 0, 32767]);
    expect([...plate.uvs!]).toEqual([0, 0, 1, 0, 0, 1]);
    expect(plate.material).toEqual({
      diffuse: [0.5, 0.25, 1, 0.75],
      emissive: [0, 0.5, 0],
      cutoff: 0,
      isBlended: false,
      isDoubleSided: false,
      texture: { uri: 'package://bot/meshes/steel plate.png' },
    });
  });

  test('every shorter or longer message is refused', () => {
    for (let length = 0; length < PLATE.length; length++) {
      expect(() => unpackMesh(PLATE.subarray(0, length))).toThrow();
    }
    expect(() => unpackMesh(new Uint8Array([...PLATE, 0, 0, 0, 0]))).toThrow();
  });

  test('damaged bytes are refused, or give a mesh that is sound', () => {
    // Linear congruential generator of Numerical Recipes: the same damage in every run.
    let state = 1;
    const random = (below: number) => {
      state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
      return Math.floor((state / 2 ** 32) * below);
    };
    let refused = 0;
    for (let run = 0; run < 20_000; run++) {
      const bytes = PLATE.slice(0, random(8) ? PLATE.length : random(PLATE.length));
      for (let i = random(4); i >= 0 && bytes.length > 0; i--) {
        const at = random(bytes.length);
        if (random(2)) bytes[at] = random(256);
        // Large counts and lengths.
        else bytes.fill(0xff, at, at + 4);
      }
      let parts;
      try {
        ({ parts } = unpackMesh(bytes));
      } catch (error) {
        expect(String(error)).toContain('damaged');
        refused++;
        continue;
      }
      for (const part of parts) {
        const vertices = part.positionsM.length / 3;
        expect(part.indices.every((index) => index < vertices)).toBe(true);
        expect(part.normals?.length ?? 3 * vertices).toBe(3 * vertices);
        expect(part.uvs?.length ?? 2 * vertices).toBe(2 * vertices);
      }
    }
    expect(refused).toBeGreaterThan(5_000);
    expect(refused).toBeLessThan(20_000);
  });

  test('an index beyond the vertices is refused', () => {
    const bytes = PLATE.slice();
    // The last six bytes are three indices, then two bytes of filling.
    bytes[bytes.length - 4] = 3;
    expect(() => unpackMesh(bytes)).toThrow('damaged');
  });
});

describe('MeshLibrary', () => {
  const partsOf = (object: { children: unknown[] }) => object.children as Mesh[];

  test('a part of a file, at its middle', async () => {
    const { object } = await libraryOf(PLATE).load('a.obj#submesh=bare&center=1');
    const [part, ...others] = partsOf(object);
    expect(others).toEqual([]);
    expect(part!.name).toBe('bare');
    expect(part!.position.toArray()).toEqual([-1, -0.5, 0]);
    expect((part!.material as MeshLambertMaterial).flatShading).toBe(true);
  });

  test('an unknown part is an error that names the parts', async () => {
    await expect(libraryOf(PLATE).load('a.obj#submesh=wheel')).rejects.toThrow(
      'no part "wheel"; its parts are: bare, plate',
    );
  });

  test('a mesh is shown without a missing texture, which is reported', async () => {
    const { object, problem } = await libraryOf(PLATE).load('a.obj');
    expect(partsOf(object)).toHaveLength(2);
    expect(problem).toBe('package://bot/meshes/steel plate.png: no such file');
  });

  test('a copy is painted only where the file has no material, unless all is painted', async () => {
    const { object } = await libraryOf(PLATE).load('a.obj');
    const { Color } = await import('three');
    const colors = (copy: { children: unknown[] }) =>
      partsOf(copy).map((part) => (part.material as MeshLambertMaterial).color.getHexString());
    const red = new Color('#ff0000');
    expect(colors(copyOf(object, red))).toEqual(['ff0000', '8040ff']);
    expect(colors(copyOf(object, red, 1, true))).toEqual(['ff0000', 'ff0000']);
  });

  test('opacity multiplies that of the material', async () => {
    const { object } = await libraryOf(PLATE).load('a.obj');
    const opacities = partsOf(copyOf(object, undefined, 0.5)).map(
      (part) => (part.material as MeshLambertMaterial).opacity,
    );
    expect(opacities).toEqual([0.5, 0.375]);
  });

  test('a failed file is loaded again at the next request', async () => {
    let isThere = false;
    const library = new MeshLibrary({
      asset: () => Promise.reject(new Error('no such file')),
      mesh: () => (isThere ? Promise.resolve(PLATE) : Promise.reject(new Error('not yet'))),
    });
    await expect(library.load('a.obj')).rejects.toThrow('not yet');
    isThere = true;
    await expect(library.load('a.obj')).resolves.toBeDefined();
  });
});
