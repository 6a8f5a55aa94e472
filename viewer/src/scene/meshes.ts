/** Library of meshes by URI: objects of the scene from the triangles that the server sends. */
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  FrontSide,
  Group,
  LinearSRGBColorSpace,
  type Material,
  Mesh,
  MeshLambertMaterial,
  type Object3D,
  RepeatWrapping,
  SRGBColorSpace,
  Texture,
  Vector3,
} from 'three';
import {
  unpackMesh,
  type PackedMaterial,
  type PackedMesh,
  type PackedPart,
  type PackedTexture,
} from './packed_mesh';
import { t } from '../texts/language.svelte';

/** Server of files and of the triangles in them. */
export interface MeshSource {
  asset(uri: string): Promise<Uint8Array>;
  /** Triangles of a mesh file, for `unpackMesh`. */
  mesh(uri: string): Promise<Uint8Array>;
}

/** Mesh that is shown; textures that are missing are named in `problem`. */
export interface LoadedMesh {
  /** Shared and immutable: clone it before use. */
  object: Object3D;
  problem?: string;
}

/** Colour of a part without a material. */
const PLAIN = new Color('#b9bec6');

export class MeshLibrary {
  private files = new Map<string, Promise<PackedMesh>>();
  private known = new Map<string, Promise<LoadedMesh>>();
  private pictures = new Map<string, Promise<Texture>>();

  constructor(private source: MeshSource) {}

  /** Forgets everything, so that it is loaded again. */
  clear(): void {
    for (const known of [this.files, this.known, this.pictures]) known.clear();
  }

  /** Loads a texture. */
  texture(uri: string): Promise<Texture> {
    return remembered(this.pictures, uri, () => this.source.asset(uri).then(textureOf));
  }

  /** Loads a mesh. `file.dae#submesh=Name&center=1` is a part of a file, as SDF requests it. */
  load(uri: string): Promise<LoadedMesh> {
    return remembered(this.known, uri, () => this.read(uri));
  }

  private async read(uri: string): Promise<LoadedMesh> {
    const [file = '', fragment = ''] = uri.split('#', 2);
    const mesh = await remembered(this.files, file, () => this.source.mesh(file).then(unpackMesh));
    const wanted = new URLSearchParams(fragment);
    const name = wanted.get('submesh');
    const parts = name === null ? mesh.parts : mesh.parts.filter((part) => part.name === name);
    if (parts.length === 0) {
      const names = [...new Set(mesh.parts.map((part) => part.name))].join(', ');
      throw new Error(t().meshes.noSubmesh(name ?? '', names));
    }
    const problems = new Set<string>();
    const textures = await this.textures(parts, problems);
    const object = new Group();
    // Parts with the same material and the same attributes share it.
    const made = new Map<PackedMaterial | undefined, MeshLambertMaterial[]>();
    for (const part of parts) {
      const kinds = made.get(part.material) ?? [];
      made.set(part.material, kinds);
      const kind = (part.normals ? 1 : 0) + (part.uvs ? 2 : 0);
      object.add(meshOf(part, (kinds[kind] ??= materialOf(part, mesh.isLinear, textures))));
    }
    if (wanted.get('center') === '1') {
      const middle = new Box3().setFromObject(object).getCenter(new Vector3());
      for (const part of object.children) part.position.sub(middle);
    }
    return { object, problem: problems.size > 0 ? [...problems].join('; ') : undefined };
  }

  /** Textures of parts; a mesh without its texture is still shown. */
  private async textures(
    parts: readonly PackedPart[],
    problems: Set<string>,
  ): Promise<Map<PackedTexture, Texture>> {
    const wanted = new Set<PackedTexture>();
    for (const { material, uvs } of parts)
      if (material?.texture && uvs) wanted.add(material.texture);
    const found = new Map<PackedTexture, Texture>();
    const load = async (texture: PackedTexture) => {
      try {
        const isFile = 'uri' in texture;
        found.set(
          texture,
          isFile ? await this.texture(texture.uri) : await textureOf(texture.image),
        );
      } catch (error) {
        const name = 'uri' in texture ? `${texture.uri}: ` : '';
        problems.add(name + (error as Error).message);
      }
    };
    await Promise.all([...wanted].map(load));
    return found;
  }
}

/** Value of a key, made at the first request; a failure is retried at the next one. */
function remembered<T>(
  known: Map<string, Promise<T>>,
  key: string,
  make: () => Promise<T>,
): Promise<T> {
  let value = known.get(key);
  if (!value) {
    known.set(key, (value = make()));
    const made = value;
    made.catch(() => known.get(key) === made && known.delete(key));
  }
  return value;
}

async function textureOf(image: Uint8Array): Promise<Texture> {
  const bitmap = await createImageBitmap(new Blob([image as Uint8Array<ArrayBuffer>]), {
    imageOrientation: 'flipY',
  });
  const texture = new Texture(bitmap as never);
  texture.flipY = false;
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.needsUpdate = true;
  return texture;
}

function meshOf(part: PackedPart, material: MeshLambertMaterial): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(part.positionsM, 3));
  if (part.normals) geometry.setAttribute('normal', new BufferAttribute(part.normals, 3, true));
  if (part.uvs) geometry.setAttribute('uv', new BufferAttribute(part.uvs, 2));
  geometry.setIndex(new BufferAttribute(part.indices, 1));
  // Flat triangles are lit without normals, but their shadows are shifted along them.
  if (!part.normals) geometry.computeVertexNormals();
  geometry.userData.isShared = true;
  const mesh = new Mesh(geometry, material);
  mesh.name = part.name;
  mesh.castShadow = mesh.receiveShadow = true;
  mesh.userData.isPlain = !part.material;
  return mesh;
}

function materialOf(
  part: PackedPart,
  isLinear: boolean,
  textures: Map<PackedTexture, Texture>,
): MeshLambertMaterial {
  // Triangles without normals are flat, as in STL.
  const flatShading = !part.normals;
  const { material } = part;
  if (!material) return new MeshLambertMaterial({ color: PLAIN, flatShading });
  const { texture, isDoubleSided, isBlended, cutoff } = material;
  const space = isLinear ? LinearSRGBColorSpace : SRGBColorSpace;
  const color = ([r = 0, g = 0, b = 0]: readonly number[]) => new Color().setRGB(r, g, b, space);
  const opacity = material.diffuse[3] ?? 1;
  const made = new MeshLambertMaterial({
    color: color(material.diffuse),
    emissive: color(material.emissive),
    map: (part.uvs && texture && textures.get(texture)) ?? null,
    opacity,
    transparent: opacity < 1 || isBlended,
    alphaTest: cutoff,
    side: isDoubleSided ? DoubleSide : FrontSide,
    flatShading,
  });
  // Displays multiply their own opacity with it.
  made.userData = { opacity, isBlended };
  return made;
}

/** Copy with its own materials, in the colour if one is given. */
export function copyOf(object: Object3D, color?: Color, alpha = 1, paintAll = false): Object3D {
  const copy = object.clone(true);
  copy.traverse((part) => {
    const mesh = part as Mesh;
    if (!mesh.isMesh) return;
    const own = (mesh.material as MeshLambertMaterial).clone();
    if (color && (paintAll || mesh.userData.isPlain)) {
      own.color = color;
      own.map = null;
      own.emissive.set(0);
      own.opacity = 1;
      own.transparent = false;
      own.userData = {};
    }
    fade(own, alpha);
    mesh.material = own;
  });
  return copy;
}

/** Sets the opacity of a material that may be transparent itself. */
export function fade(material: Material, alpha: number): void {
  const opacity = alpha * ((material.userData.opacity as number | undefined) ?? 1);
  const transparent = opacity < 0.999 || !!material.userData.isBlended;
  if (material.transparent !== transparent) material.needsUpdate = true;
  Object.assign(material, { transparent, opacity, depthWrite: opacity >= 0.999 });
}
