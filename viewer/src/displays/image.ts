/** Image and Camera: images beside the scene; Camera overlays the scene, rendered from the camera's pose. */
import { Matrix4, PerspectiveCamera, WebGLRenderTarget } from 'three';
import type { Message } from '../core/cdr';
import { seconds, type CameraInfo, type ImageMessage } from '../core/types';
import { matrixOf } from '../scene/shapes';
import { Display, type Kind } from './display';
import { alpha, bool, choice, int, number, topic } from './options';
import { extentOf, isDepth, toPixels, type Extent } from './pixels';
import { t } from '../texts/language.svelte';

const NONE: Extent = { min: 0, max: 1 };

class ImageDisplay extends Display {
  readonly canvas = document.createElement('canvas');
  protected image?: ImageMessage;
  private screen?: ImageData;
  private extents: Extent[] = [];
  /** True after a jump in a recording, until an image of the new time arrived. */
  private isStale = false;
  private received = 0;
  /** Number of the image that is shown. */
  private shownNumber = 0;

  override start(): void {
    super.start();
    this.host.picture?.(this.canvas);
  }

  override reset(): void {
    this.isStale = true;
    super.reset();
  }

  override tick(_nowMs: number): void {
    if (!this.isStale) return;
    this.isStale = false;
    this.shownNumber = ++this.received;
    this.image = undefined;
    const { width, height } = this.canvas;
    this.canvas.getContext('2d')!.clearRect(0, 0, width, height);
  }

  protected override receive(message: Message): void {
    this.isStale = false;
    this.received++;
    if ('format' in message) {
      void this.compressed(message as never);
      return;
    }
    const image = message as unknown as ImageMessage;
    const { width, height } = image;
    if (!(width > 0 && height > 0)) throw new Error(t().displays.noPixels);
    if (this.screen?.width !== width || this.screen.height !== height) {
      this.screen = new ImageData(width, height);
      this.extents = [];
    }
    const pixels = this.screen;
    toPixels(image, pixels.data, this.range(image));
    this.image = image;
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    this.canvas.getContext('2d')!.putImageData(pixels, 0, 0);
    this.painted();
    this.host.status('Image', 'ok', `${width} x ${height}, ${image.encoding}`);
  }

  /** Depths shown as black and white: the options, or the median over the last images. */
  private range(image: ImageMessage): Extent {
    if (!isDepth(image.encoding)) return NONE;
    if (!this.get('Normalize Range')) {
      return { min: this.get('Min Value'), max: this.get('Max Value') };
    }
    const found = extentOf(image);
    if (found.min <= found.max) this.extents.push(found);
    const most = Math.max(1, this.get<number>('Median window'));
    while (this.extents.length > most) this.extents.shift();
    return { min: this.median('min'), max: this.median('max') };
  }

  private median(of: keyof Extent): number {
    const all = this.extents.map((extent) => extent[of]).sort((a, b) => a - b);
    return all[all.length >> 1] ?? 0;
  }

  private async compressed(message: {
    format: string;
    data: Uint8Array<ArrayBuffer>;
  }): Promise<void> {
    const mine = this.received;
    try {
      const bitmap = await createImageBitmap(new Blob([message.data]));
      // A newer image was decoded meanwhile.
      if (mine < this.shownNumber) return;
      this.shownNumber = mine;
      this.canvas.width = bitmap.width;
      this.canvas.height = bitmap.height;
      this.canvas.getContext('2d')!.drawImage(bitmap, 0, 0);
      this.host.status('Image', 'ok', `${bitmap.width} x ${bitmap.height}, ${message.format}`);
    } catch {
      this.host.status('Image', 'error', t().displays.imageFormat(message.format));
    }
  }

  protected painted(): void {}
}

/** Lookup table from linear light to sRGB. */
const SRGB = Uint8Array.from({ length: 256 }, (_, i) => {
  const v = i / 255;
  return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * Math.pow(v, 1 / 2.4) - 0.055));
});

/** Minimum period at which the scene is rendered from the camera's pose [ms]. */
const MIN_PERIOD_MS = 150;

class CameraDisplay extends ImageDisplay {
  private info?: CameraInfo;
  private unsubscribeInfo?: () => void;
  private target?: WebGLRenderTarget;
  private camera = new PerspectiveCamera();
  private drawnMs = 0;
  private pixels?: ImageData;
  private bytes = new Uint8Array(0);
  private layer = document.createElement('canvas');

  override start(): void {
    super.start();
    this.unsubscribeInfo?.();
    const topic = this.get<string>('Topic');
    if (!topic) return;
    const info = `${topic.slice(0, topic.lastIndexOf('/'))}/camera_info`;
    this.unsubscribeInfo = this.context.subscribe(info, (m) => (this.info = m as never));
  }

  protected override painted(): void {
    const { info, image } = this;
    const now = performance.now();
    if (!image) return;
    if (now - this.drawnMs < MIN_PERIOD_MS) {
      this.compose();
      return;
    }
    if (!info) {
      this.host.status('Camera', 'warn', t().displays.noCameraInfo);
      return;
    }
    const { stage, tf } = this.context;
    const found = tf.lookup(
      this.context.fixedFrame(),
      image.header.frame_id,
      seconds(image.header.stamp),
    );
    const newest =
      found.kind === 'found' ? found : tf.lookup(this.context.fixedFrame(), image.header.frame_id);
    if (newest.kind !== 'found') {
      this.host.status('Camera', 'error', newest.why);
      return;
    }
    this.drawnMs = now;
    this.host.status('Camera', 'ok');
    const [w, h] = [
      Math.min(640, image.width),
      Math.round((Math.min(640, image.width) * image.height) / image.width),
    ];
    this.aim(info, matrixOf(newest.pose));
    this.target ??= new WebGLRenderTarget(w, h, { samples: 2 });
    this.target.setSize(w, h);
    const { renderer, scene } = stage;
    const { background } = scene;
    // Transparent background.
    scene.background = null;
    renderer.setClearColor(0x000000, 0);
    renderer.setRenderTarget(this.target);
    renderer.render(scene, this.camera);
    if (this.pixels?.width !== w || this.pixels.height !== h) {
      this.pixels = new ImageData(w, h);
      this.bytes = new Uint8Array(w * h * 4);
    }
    renderer.readRenderTargetPixels(this.target, 0, 0, w, h, this.bytes);
    renderer.setRenderTarget(null);
    scene.background = background;
    this.overlay(this.pixels, w, h);
  }

  private zoom(factor: number): void {
    if (factor === 1) return;
    const { width: w, height: h } = this.canvas;
    const [dx, dy] = [(w * (1 - factor)) / 2, (h * (1 - factor)) / 2];
    this.canvas.getContext('2d')!.drawImage(this.canvas, dx, dy, w * factor, h * factor);
  }

  /** ROS's optical frames have z forward and y down; three.js has -z forward and y up. */
  private aim(info: CameraInfo, fixedFromOptical: ReturnType<typeof matrixOf>): void {
    const { camera } = this;
    const [fx, cx, fy, cy] = [info.k[0]!, info.k[2]!, info.k[4]!, info.k[5]!];
    const [near, far] = [0.01, 500];
    const { width: w, height: h } = info;
    camera.projectionMatrix.set(
      ...([(2 * fx) / w, 0, 1 - (2 * cx) / w, 0] as const),
      ...([0, (2 * fy) / h, (2 * cy) / h - 1, 0] as const),
      ...([0, 0, -(far + near) / (far - near), (-2 * far * near) / (far - near)] as const),
      ...([0, 0, -1, 0] as const),
    );
    const zoom = this.get<number>('Zoom Factor');
    camera.projectionMatrix.premultiply(new Matrix4().makeScale(zoom, zoom, 1));
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    camera.matrixAutoUpdate = false;
    camera.matrix.copy(fixedFromOptical);
    const e = camera.matrix.elements;
    for (const i of [4, 5, 6, 8, 9, 10]) e[i] = -e[i]!;
    camera.updateMatrixWorld(true);
  }

  /** Reads back the rendered pixels. */
  private overlay(pixels: ImageData, w: number, h: number): void {
    const { bytes } = this;
    for (let v = 0; v < h; v++) {
      for (let u = 0; u < w; u++) {
        const from = ((h - 1 - v) * w + u) * 4;
        const to = (v * w + u) * 4;
        const alpha = bytes[from + 3]!;
        pixels.data[to + 3] = alpha;
        // A render target has linear light with premultiplied alpha; the canvas needs sRGB.
        for (let k = 0; alpha > 0 && k < 3; k++) {
          const linear = Math.round((bytes[from + k]! * 255) / alpha);
          pixels.data[to + k] = SRGB[Math.min(255, linear)]!;
        }
      }
    }
    const { layer } = this;
    if (layer.width !== w || layer.height !== h) [layer.width, layer.height] = [w, h];
    const ink = layer.getContext('2d')!;
    ink.putImageData(pixels, 0, 0);
    const rendering = this.get<string>('Image Rendering');
    if (rendering === 'overlay') {
      ink.globalCompositeOperation = 'destination-over';
      ink.fillStyle = '#303030';
      ink.fillRect(0, 0, w, h);
      ink.globalCompositeOperation = 'source-over';
    }
    this.compose();
  }

  /** Composes scene and image as RViz does: the image behind the scene, over it, or both. */
  private compose(): void {
    this.zoom(this.get('Zoom Factor'));
    const context = this.canvas.getContext('2d')!;
    const { width, height } = this.canvas;
    const rendering = this.get<string>('Image Rendering');
    // The image over the scene, with the opacity `Overlay Alpha`.
    const overlay = rendering === 'background' ? 0 : this.get<number>('Overlay Alpha');
    context.globalAlpha = 1 - overlay;
    if (this.drawnMs > 0) context.drawImage(this.layer, 0, 0, width, height);
    context.globalAlpha = 1;
  }

  override stop(): void {
    this.unsubscribeInfo?.();
    this.target?.dispose();
    super.stop();
  }
}

const IMAGE = ['sensor_msgs/msg/Image', 'sensor_msgs/msg/CompressedImage'];
const range = [
  bool('Normalize Range', true),
  number('Min Value', 0, { when: (v) => v['Normalize Range'] === false }),
  number('Max Value', 1, { when: (v) => v['Normalize Range'] === false }),
  int('Median window', 5, { min: 1 }),
];

export const image: Kind = {
  class: 'rviz_default_plugins/Image',
  also: ['rviz/Image'],
  title: 'Image',
  get help() {
    return t().displayHelp.image;
  },
  types: IMAGE,
  hasPicture: true,
  options: [...topic('Topic', '', IMAGE), ...range],
  make: (...all) => new ImageDisplay(...all),
};

export const camera: Kind = {
  class: 'rviz_default_plugins/Camera',
  also: ['rviz/Camera'],
  title: 'Camera',
  get help() {
    return t().displayHelp.camera;
  },
  types: IMAGE,
  hasPicture: true,
  options: [
    ...topic('Topic', '', IMAGE),
    choice('Image Rendering', 'background and overlay', [
      'background and overlay',
      'background',
      'overlay',
    ]),
    alpha('Overlay Alpha', 0.5),
    number('Zoom Factor', 1, { min: 0.1 }),
    ...range,
  ],
  make: (...all) => new CameraDisplay(...all),
};
