/**
 * Triangles of a mesh file as the server sends them (`docs/live.md`, "Meshes"). Arrays are views into the bytes; no
 * number of the bytes is trusted: counts, lengths and indices are checked before they are used.
 */
import { t } from '../texts/language.svelte';

export type PackedTexture = { uri: string } | { image: Uint8Array };

export interface PackedMaterial {
  /** Red, green, blue, alpha. */
  diffuse: readonly number[];
  emissive: readonly number[];
  /** Points of the texture with a smaller alpha than this are not drawn; 0 for all. */
  cutoff: number;
  /** True if the surface is as transparent as its texture. */
  isBlended: boolean;
  isDoubleSided: boolean;
  texture?: PackedTexture;
}

export interface PackedPart {
  name: string;
  material?: PackedMaterial;
  positionsM: Float32Array;
  /** Components of unit vectors, times 32767; none in a mesh of flat triangles. */
  normals?: Int16Array;
  uvs?: Float32Array;
  indices: Uint16Array | Uint32Array;
}

export interface PackedMesh {
  /** True if colours are linear; otherwise they are sRGB. */
  isLinear: boolean;
  parts: PackedPart[];
}

const MAGIC = 0x48534d50;
const VERSION = 1;
/** Smallest sizes of a texture, a material and a part [bytes]. */
const TEXTURE_BYTES = 8;
const MATERIAL_BYTES = 40;
const PART_BYTES = 20;

const fail = (): never => {
  throw new Error(t().meshes.damaged);
};

class Reader {
  private at = 0;
  private view: DataView;

  constructor(private bytes: Uint8Array<ArrayBuffer>) {
    this.view = new DataView(bytes.buffer);
  }

  private advance(count: number): number {
    const { at } = this;
    if (count > this.bytes.length - at) fail();
    this.at = at + count;
    return at;
  }

  /** Rest of a group of four bytes. */
  align(): void {
    this.advance((4 - (this.at % 4)) % 4);
  }

  u32(): number {
    return this.view.getUint32(this.advance(4), true);
  }

  floats(count: number): Float32Array {
    return new Float32Array(this.bytes.buffer, this.advance(4 * count), count);
  }

  shorts<T>(count: number, kind: new (buffer: ArrayBuffer, at: number, count: number) => T): T {
    const out = new kind(this.bytes.buffer, this.advance(2 * count), count);
    this.align();
    return out;
  }

  longs(count: number): Uint32Array {
    return new Uint32Array(this.bytes.buffer, this.advance(4 * count), count);
  }

  block(): Uint8Array {
    const length = this.u32();
    const at = this.advance(length);
    this.align();
    return this.bytes.subarray(at, at + length);
  }

  text(): string {
    return new TextDecoder().decode(this.block());
  }

  /** Entry of a list, by its number from 1; none for 0. */
  entry<T>(list: readonly T[]): T | undefined {
    const number = this.u32();
    return number > list.length ? fail() : list[number - 1];
  }

  end(): void {
    if (this.at !== this.bytes.length) fail();
  }
}

/** Decodes a mesh; fails if the bytes are not exactly one. */
export function unpackMesh(bytes: Uint8Array): PackedMesh {
  // Arrays of numbers begin at multiples of four, which a part of a message does not.
  const reader = new Reader(bytes.slice() as Uint8Array<ArrayBuffer>);
  if (reader.u32() !== MAGIC || reader.u32() !== VERSION) fail();
  const isLinear = (reader.u32() & 1) !== 0;
  const [textureCount, materialCount, partCount] = [reader.u32(), reader.u32(), reader.u32()];
  const list = <T>(count: number, bytesEach: number, read: () => T): T[] => {
    if (count * bytesEach > bytes.length) fail();
    return Array.from({ length: count }, read);
  };
  const textures = list<PackedTexture>(textureCount, TEXTURE_BYTES, () =>
    reader.u32() === 0 ? { uri: reader.text() } : { image: reader.block() },
  );
  const materials = list(materialCount, MATERIAL_BYTES, () => materialOf(reader, textures));
  const parts = list(partCount, PART_BYTES, () => partOf(reader, materials));
  reader.end();
  return { isLinear, parts };
}

function materialOf(reader: Reader, textures: readonly PackedTexture[]): PackedMaterial {
  const diffuse = [...reader.floats(4)];
  const emissive = [...reader.floats(3)];
  const [cutoff] = reader.floats(1) as unknown as [number];
  const flags = reader.u32();
  return {
    diffuse,
    emissive,
    cutoff: flags & 4 ? cutoff : 0,
    isBlended: (flags & 2) !== 0,
    isDoubleSided: (flags & 1) !== 0,
    texture: reader.entry(textures),
  };
}

function partOf(reader: Reader, materials: readonly PackedMaterial[]): PackedPart {
  const name = reader.text();
  const material = reader.entry(materials);
  const flags = reader.u32();
  const [vertices, triangles] = [reader.u32(), reader.u32()];
  const positionsM = reader.floats(3 * vertices);
  const normals = flags & 1 ? reader.shorts(3 * vertices, Int16Array) : undefined;
  const uvs = flags & 2 ? reader.floats(2 * vertices) : undefined;
  const indices =
    flags & 4 ? reader.longs(3 * triangles) : reader.shorts(3 * triangles, Uint16Array);
  for (const index of indices) if (index >= vertices) fail();
  return { name, material, positionsM, normals, uvs, indices };
}
