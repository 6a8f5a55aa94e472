/** Picture below the scene, in the world frame: a floor plan, or a map with its own scale and origin. */
import {
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  PlaneGeometry,
  SRGBColorSpace,
  Texture,
  TextureLoader,
} from 'three';
import type { App } from '../app/app.svelte';
import type { FloorPlan } from '../building/plan';
import { fromYaw, IDENTITY, multiply, type Vec3 } from '../core/pose';
import { matrixOf } from '../scene/shapes';
import { dispose, type Stage } from '../scene/stage';
import { t } from '../texts/language.svelte';
import { baseName, readMapYaml, readPgm, type MapFile } from './map_file';

export interface Picture {
  name: string;
  /** Blob URL of an image that the browser can show. */
  url: string;
  widthPx: number;
  heightPx: number;
}

/** Scale of a picture until another is set [m]. */
const FIRST_M_PER_PX = 0.01;
/** Height above the floor plane, below lines and maps on it [m]. */
const HEIGHT_M = 0.003;
const IMAGE = /\.(png|jpe?g|webp|bmp|gif|pgm)$/i;
const YAML = /\.ya?ml$/i;

export const isUnderlayFile = (name: string) => IMAGE.test(name) || YAML.test(name);

export class Underlay {
  picture: Picture | undefined = $state.raw();
  isShown = $state(true);
  /** Side of a pixel [m]. */
  mPerPx = $state(FIRST_M_PER_PX);
  /** Pose of the lower left corner in the world frame. */
  x = $state(0);
  y = $state(0);
  yawRad = $state(0);
  opacity = $state(0.6);
  /** Map file whose image was not opened yet. */
  awaited: MapFile | undefined = $state.raw();
  private lastMap?: MapFile;
  private drawn = new Map<Stage, { mesh: Mesh<PlaneGeometry, MeshBasicMaterial>; key: string }>();
  private texture?: { url: string; texture: Texture };

  constructor(private app: App) {}

  /** Opens pictures and map files, together or one after the other. Returns true if a picture was opened. */
  async open(files: readonly File[]): Promise<boolean> {
    let isOpened = false;
    // Map files first: they name their image.
    const sorted = [...files].sort((a, b) => +YAML.test(b.name) - +YAML.test(a.name));
    for (const file of sorted) {
      try {
        if (YAML.test(file.name)) this.useMap(readMapYaml(await file.text()));
        else if (IMAGE.test(file.name)) {
          await this.usePicture(file);
          isOpened = true;
        } else throw new Error(t().underlay.notPicture);
      } catch (error) {
        this.app.notice('error', `${file.name}: ${(error as Error).message}`);
      }
    }
    if (this.awaited) this.app.notice('info', t().underlay.openImage(this.awaited.image));
    return isOpened;
  }

  private useMap(map: MapFile): void {
    if (this.picture && isNamed(this.picture.name, map.image)) this.place(map);
    else this.awaited = map;
  }

  private place(map: MapFile): void {
    this.awaited = undefined;
    this.lastMap = map;
    this.mPerPx = map.resolutionM;
    [this.x, this.y, this.yawRad] = [map.x, map.y, map.yawRad];
  }

  private async usePicture(file: File): Promise<void> {
    const picture = await pictureOf(file);
    this.picture = picture;
    this.isShown = true;
    const { awaited } = this;
    this.lastMap = undefined;
    if (awaited && isNamed(file.name, awaited.image)) this.place(awaited);
    else {
      this.mPerPx = FIRST_M_PER_PX;
      [this.x, this.y, this.yawRad] = [0, 0, 0];
    }
  }

  /** True if the scale comes from a map file. */
  get hasMap(): boolean {
    return this.lastMap !== undefined;
  }

  remove(): void {
    this.picture = undefined;
    this.awaited = undefined;
  }

  /** Sets the scale by a measured line of known length; its first point keeps its position. */
  scale(from: Vec3, measuredM: number, trueM: number): void {
    if (!(measuredM > 1e-6 && trueM > 0)) return;
    const factor = trueM / measuredM;
    this.mPerPx *= factor;
    this.x = from[0] + (this.x - from[0]) * factor;
    this.y = from[1] + (this.y - from[1]) * factor;
  }

  // The Building Editor shows the same picture.

  plan(): FloorPlan | undefined {
    const { picture, mPerPx, yawRad, opacity } = this;
    if (!picture) return undefined;
    const { t: at } = multiply(fromYaw(yawRad, [this.x, this.y, 0]), {
      ...IDENTITY,
      t: [(picture.widthPx * mPerPx) / 2, (picture.heightPx * mPerPx) / 2, 0],
    });
    return {
      ...picture,
      pixelsPerM: 1 / mPerPx,
      at: { x: at[0], y: at[1] },
      yawRad,
      opacity,
    };
  }

  usePlan(plan: FloorPlan | undefined): void {
    if (!plan) return this.remove();
    const { name, url, widthPx, heightPx } = plan;
    if (this.picture?.url !== url) this.picture = { name, url, widthPx, heightPx };
    this.mPerPx = 1 / plan.pixelsPerM;
    this.yawRad = plan.yawRad;
    this.opacity = plan.opacity;
    const { t: at } = multiply(fromYaw(plan.yawRad, [plan.at.x, plan.at.y, 0]), {
      ...IDENTITY,
      t: [(-widthPx * this.mPerPx) / 2, (-heightPx * this.mPerPx) / 2, 0],
    });
    [this.x, this.y] = [at[0], at[1]];
  }

  // The scene.

  /** Draws the picture in a 3D view; called once per frame of the view. */
  tick(stage: Stage): void {
    const { picture } = this;
    const drawn = this.drawn.get(stage);
    if (!picture || !this.isShown) {
      if (!drawn) return;
      dispose(drawn.mesh);
      this.drawn.delete(stage);
      return stage.invalidate();
    }
    const viewport = this.app.viewports.find((one) => one.stage === stage);
    const fixedFromWorld = viewport?.world()?.fixedFromWorld ?? IDENTITY;
    const { mPerPx, opacity } = this;
    const [w, h] = [picture.widthPx * mPerPx, picture.heightPx * mPerPx];
    const corner = multiply(fixedFromWorld, fromYaw(this.yawRad, [this.x, this.y, HEIGHT_M]));
    const middle = multiply(corner, { ...IDENTITY, t: [w / 2, h / 2, 0] });
    const key = [picture.url, w, h, opacity, ...middle.t, ...middle.q].join();
    if (drawn?.key === key) return;
    const mesh = drawn?.mesh ?? newMesh();
    const texture = this.textureOf(picture.url);
    if (mesh.material.map !== texture) {
      mesh.material.map = texture;
      mesh.material.needsUpdate = true;
    }
    mesh.material.opacity = opacity;
    mesh.matrix.copy(matrixOf(middle, [w, h, 1]));
    mesh.matrixWorldNeedsUpdate = true;
    if (!drawn) stage.scene.add(mesh);
    this.drawn.set(stage, { mesh, key });
    stage.invalidate();
  }

  private textureOf(url: string): Texture {
    if (this.texture?.url === url) return this.texture.texture;
    this.texture?.texture.dispose();
    const texture = new TextureLoader().load(url, () => {
      for (const stage of this.drawn.keys()) stage.invalidate();
    });
    texture.colorSpace = SRGBColorSpace;
    // Cells of a map keep their edges.
    if (this.hasMap) texture.magFilter = NearestFilter;
    this.texture = { url, texture };
    return texture;
  }
}

function newMesh(): Mesh<PlaneGeometry, MeshBasicMaterial> {
  const material = new MeshBasicMaterial({ transparent: true, depthWrite: false });
  const mesh = new Mesh(new PlaneGeometry(1, 1), material);
  mesh.matrixAutoUpdate = false;
  // Before other transparent things on the floor.
  mesh.renderOrder = -1;
  return mesh;
}

const isNamed = (name: string, image: string) =>
  baseName(name).toLowerCase() === image.toLowerCase();

async function pictureOf(file: File): Promise<Picture> {
  if (/\.pgm$/i.test(file.name)) {
    const { widthPx, heightPx, pixels } = readPgm(new Uint8Array(await file.arrayBuffer()));
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [widthPx, heightPx];
    const rgba = new Uint8ClampedArray(pixels.length * 4);
    pixels.forEach((value, i) => rgba.set([value, value, value, 255], i * 4));
    canvas.getContext('2d')!.putImageData(new ImageData(rgba, widthPx, heightPx), 0, 0);
    const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve));
    if (!blob) throw new Error(t().underlay.notPicture);
    return { name: file.name, url: URL.createObjectURL(blob), widthPx, heightPx };
  }
  const bitmap = await createImageBitmap(file).catch(() => undefined);
  if (!bitmap) throw new Error(t().underlay.notPicture);
  const { width: widthPx, height: heightPx } = bitmap;
  bitmap.close();
  return { name: file.name, url: URL.createObjectURL(file), widthPx, heightPx };
}
