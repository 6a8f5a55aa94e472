/** Library of meshes by URI; a loader is imported when the first file of its kind is requested. */
import {
  Box3,
  BufferGeometry,
  Group,
  Mesh,
  MeshLambertMaterial,
  Object3D,
  RepeatWrapping,
  LoadingManager,
  Color,
  Texture,
  Vector3,
} from 'three';
import { t } from '../texts/language.svelte';

export type Fetch = (uri: string) => Promise<Uint8Array>;

const HIDDEN_LIGHTS = ['AmbientLight', 'DirectionalLight', 'PointLight', 'SpotLight', 'Camera'];

/** Shared and immutable object: clone it before use. */
export class MeshLibrary {
  private known = new Map<string, Promise<Object3D>>();
  private pictures = new Map<string, Promise<Texture>>();

  constructor(private fetch: Fetch) {}

  /** Loads a texture. */
  texture(uri: string): Promise<Texture> {
    let picture = this.pictures.get(uri);
    if (!picture) {
      picture = this.fetch(uri).then(async (bytes) => {
        const bitmap = await createImageBitmap(new Blob([bytes as Uint8Array<ArrayBuffer>]), {
          imageOrientation: 'flipY',
        });
        const texture = new Texture(bitmap as never);
        texture.flipY = false;
        texture.colorSpace = 'srgb';
        texture.wrapS = texture.wrapT = RepeatWrapping;
        texture.needsUpdate = true;
        return texture;
      });
      this.pictures.set(uri, picture);
      picture.catch(() => this.pictures.delete(uri));
    }
    return picture;
  }

  load(uri: string): Promise<Object3D> {
    let mesh = this.known.get(uri);
    if (!mesh) {
      mesh = this.read(uri);
      this.known.set(uri, mesh);
      // A failed load is retried at the next request.
      mesh.catch(() => this.known.delete(uri));
    }
    return mesh;
  }

  /** `file.dae#submesh=Name&center=1` is a part of a file, as SDF requests it. */
  private async read(uri: string): Promise<Object3D> {
    const hash = uri.indexOf('#');
    if (hash < 0) return this.readFile(uri);
    const whole = await this.load(uri.slice(0, hash));
    const wanted = new URLSearchParams(uri.slice(hash + 1));
    return partOf(whole, wanted.get('submesh') ?? '', wanted.get('center') === '1');
  }

  private async readFile(uri: string): Promise<Object3D> {
    const bytes = await this.fetch(uri);
    const ending = /\.([a-z0-9]+)(\?|#|$)/i.exec(uri)?.[1]?.toLowerCase();
    const buffer = bytes.slice().buffer as ArrayBuffer;
    const folder = uri.slice(0, uri.lastIndexOf('/') + 1);
    switch (ending) {
      case 'stl': {
        const { STLLoader } = await import('three/examples/jsm/loaders/STLLoader.js');
        return plain(new STLLoader().parse(buffer));
      }
      case 'dae': {
        const { ColladaLoader } = await import('three/examples/jsm/loaders/ColladaLoader.js');
        const text = new TextDecoder().decode(bytes);
        const manager = await this.textures(folder, text.matchAll(/<init_from>\s*([^<]+?)\s*</g));
        const read = new ColladaLoader(manager).parse(text, '');
        if (!read) throw new Error(t().displays.notCollada(uri));
        const { scene } = read;
        // The loader rotates Y_UP files to three.js; in a scene with z up, files with Z_UP are right without it.
        if (/<up_axis>\s*Z_UP/.test(text)) scene.rotation.set(0, 0, 0);
        else scene.rotation.set(Math.PI / 2, 0, 0);
        return tidy(scene);
      }
      case 'obj': {
        const { OBJLoader } = await import('three/examples/jsm/loaders/OBJLoader.js');
        const text = new TextDecoder().decode(bytes);
        const loader = new OBJLoader();
        const library = /^mtllib\s+(.+)$/m.exec(text)?.[1]?.trim();
        if (library) await this.materials(loader, folder, library);
        return tidy(loader.parse(text));
      }
      case 'glb':
      case 'gltf': {
        const { GLTFLoader } = await import('three/examples/jsm/loaders/GLTFLoader.js');
        const read = await new GLTFLoader().parseAsync(buffer, '');
        // glTF has y up.
        read.scene.rotation.set(Math.PI / 2, 0, 0);
        return tidy(read.scene);
      }
      default:
        throw new Error(t().displays.meshFormat(ending ?? uri));
    }
  }

  private async materials(
    loader: { setMaterials(m: never): unknown },
    folder: string,
    library: string,
  ): Promise<void> {
    try {
      const { MTLLoader } = await import('three/examples/jsm/loaders/MTLLoader.js');
      const text = new TextDecoder().decode(await this.fetch(folder + library));
      const manager = await this.textures(folder, text.matchAll(/^map_\w+\s+(.+?)\s*$/gm));
      const read = new MTLLoader(manager).parse(text, '');
      read.preload();
      loader.setMaterials(read as never);
    } catch {
      // A mesh without its textures is still shown.
    }
  }

  /** Fetches the textures that a mesh names, and maps their names to the fetched ones. */
  private async textures(
    folder: string,
    names: Iterable<RegExpMatchArray>,
  ): Promise<LoadingManager> {
    const urls = new Map<string, string>();
    for (const [, name] of names) {
      if (!name || urls.has(name) || !/\.(png|jpe?g|bmp|webp|gif)$/i.test(name)) continue;
      try {
        const uri = name.includes('://') ? name : folder + name.replace(/^\.\//, '');
        const bytes = await this.fetch(uri);
        urls.set(name, URL.createObjectURL(new Blob([bytes as Uint8Array<ArrayBuffer>])));
      } catch {
        // Shown without its texture.
      }
    }
    const manager = new LoadingManager();
    manager.setURLModifier((url) => {
      for (const [name, here] of urls) if (url.endsWith(name)) return here;
      return url.startsWith('blob:') || url.startsWith('data:') ? url : 'data:,';
    });
    return manager;
  }
}

/** Object of this name in a file; the whole file if there is none. */
function partOf(whole: Object3D, name: string, isCentered: boolean): Object3D {
  const copy = whole.clone(true);
  const isWanted = (o: Object3D) => o.name === name || (o as Mesh).geometry?.name === name;
  const found: Object3D[] = [];
  copy.traverse((o) => {
    if (isWanted(o) && !found.some((f) => f === o.parent)) found.push(o);
  });
  if (found.length === 0) return copy;
  copy.updateMatrixWorld(true);
  const out = new Group();
  for (const part of found) {
    part.matrix.copy(part.matrixWorld);
    part.matrix.decompose(part.position, part.quaternion, part.scale);
    out.add(part);
  }
  if (isCentered) {
    const middle = new Box3().setFromObject(out).getCenter(new Vector3());
    for (const part of out.children) part.position.sub(middle);
  }
  return out;
}

function plain(geometry: BufferGeometry): Object3D {
  if (!geometry.getAttribute('normal')) geometry.computeVertexNormals();
  const group = new Group();
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ color: new Color('#b9bec6') }));
  mesh.userData.isPlain = true;
  group.add(mesh);
  return tidy(group);
}

/** Removes the lights of a file and unifies its materials. */
function tidy(object: Object3D): Object3D {
  const out = new Group();
  out.add(object);
  for (const part of collect(object)) {
    if (HIDDEN_LIGHTS.includes(part.type)) part.removeFromParent();
    const mesh = part as Mesh;
    if (!mesh.isMesh) continue;
    mesh.geometry.userData.isShared = true;
    mesh.castShadow = mesh.receiveShadow = true;
    const list = Array.isArray(mesh.material) ? mesh.material : [mesh.material];
    const lambert = list.map((old) => {
      const { color, map, transparent, opacity, side } = old as MeshLambertMaterial;
      return new MeshLambertMaterial({ color, map: map ?? null, transparent, opacity, side });
    });
    mesh.material = Array.isArray(mesh.material) ? lambert : lambert[0]!;
  }
  return out;
}

function collect(object: Object3D): Object3D[] {
  const all: Object3D[] = [];
  object.traverse((part) => all.push(part));
  return all;
}

/** Copy with its own materials, in the colour if one is given. */
export function copyOf(object: Object3D, color?: Color, alpha = 1, paintAll = false): Object3D {
  const copy = object.clone(true);
  copy.traverse((part) => {
    const mesh = part as Mesh;
    if (!mesh.isMesh) return;
    const paint = (old: MeshLambertMaterial) => {
      const own = old.clone();
      if (color && (paintAll || mesh.userData.isPlain)) {
        own.color = color;
        own.map = null;
      }
      if (alpha < 0.999)
        Object.assign(own, { transparent: true, opacity: alpha, depthWrite: false });
      return own;
    };
    mesh.material = Array.isArray(mesh.material)
      ? mesh.material.map((m) => paint(m as MeshLambertMaterial))
      : paint(mesh.material as MeshLambertMaterial);
  });
  return copy;
}
