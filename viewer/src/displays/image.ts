/** Image and Camera: pictures beside the scene; through a camera's eyes the scene lies over them. */
import { PerspectiveCamera, WebGLRenderTarget } from 'three';
import type { Message } from '../core/cdr';
import { seconds, type CameraInfo, type ImageMessage } from '../core/types';
import { matrixOf } from '../scene/shapes';
import { Display, type Kind } from './display';
import { alpha, bool, choice, int, number, topic } from './options';
import { toPixels } from './pixels';

class ImageDisplay extends Display {
  readonly canvas = document.createElement('canvas');
  protected image?: ImageMessage;

  override start(): void {
    super.start();
    this.host.picture?.(this.canvas);
  }

  protected override receive(message: Message): void {
    if ('format' in message) {
      void this.compressed(message as never);
      return;
    }
    const image = message as unknown as ImageMessage;
    const { width, height } = image;
    if (!(width > 0 && height > 0)) throw new Error('The picture has no pixels');
    const pixels = new ImageData(width, height);
    toPixels(image, pixels.data, {
      isNormalized: this.get('Normalize Range'),
      min: this.get('Min Value'),
      max: this.get('Max Value'),
    });
    this.image = image;
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    this.canvas.getContext('2d')!.putImageData(pixels, 0, 0);
    this.painted();
    this.host.status('Image', 'ok', `${width} x ${height}, ${image.encoding}`);
  }

  private async compressed(message: {
    format: string;
    data: Uint8Array<ArrayBuffer>;
  }): Promise<void> {
    try {
      const bitmap = await createImageBitmap(new Blob([message.data]));
      this.canvas.width = bitmap.width;
      this.canvas.height = bitmap.height;
      this.canvas.getContext('2d')!.drawImage(bitmap, 0, 0);
      this.host.status('Image', 'ok', `${bitmap.width} x ${bitmap.height}, ${message.format}`);
    } catch {
      this.host.status('Image', 'error', `The browser cannot read pictures of "${message.format}"`);
    }
  }

  protected painted(): void {}
}

/** At most so often the scene is drawn through a camera's eyes [ms]. */
const LEAST_MS = 150;

class CameraDisplay extends ImageDisplay {
  private info?: CameraInfo;
  private leaveInfo?: () => void;
  private target?: WebGLRenderTarget;
  private camera = new PerspectiveCamera();
  private drawnMs = 0;

  override start(): void {
    super.start();
    this.leaveInfo?.();
    const topic = this.get<string>('Topic');
    if (!topic) return;
    const info = `${topic.slice(0, topic.lastIndexOf('/'))}/camera_info`;
    this.leaveInfo = this.context.subscribe(info, (m) => (this.info = m as never));
  }

  protected override painted(): void {
    const { info, image } = this;
    const rendering = this.get<string>('Image Rendering');
    const now = performance.now();
    if (!image || rendering === 'background' || now - this.drawnMs < LEAST_MS) return;
    if (!info) {
      this.host.status('Camera', 'warn', 'No camera_info came beside the picture yet');
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
    const { renderer } = stage;
    renderer.setRenderTarget(this.target);
    renderer.render(stage.scene, this.camera);
    const bytes = new Uint8Array(w * h * 4);
    renderer.readRenderTargetPixels(this.target, 0, 0, w, h, bytes);
    renderer.setRenderTarget(null);
    this.overlay(bytes, w, h);
  }

  /** ROS's optical frames look along z with y down; three.js looks along -z with y up. */
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
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    camera.matrixAutoUpdate = false;
    camera.matrix.copy(fixedFromOptical);
    const e = camera.matrix.elements;
    for (const i of [4, 5, 6, 8, 9, 10]) e[i] = -e[i]!;
    camera.updateMatrixWorld(true);
  }

  private overlay(bytes: Uint8Array, w: number, h: number): void {
    const rows = new ImageData(w, h);
    for (let v = 0; v < h; v++) {
      rows.data.set(bytes.subarray((h - 1 - v) * w * 4, (h - v) * w * 4), v * w * 4);
    }
    // A render target holds linear light; the screen wants sRGB.
    for (let i = 0; i < rows.data.length; i++) {
      if ((i & 3) !== 3) rows.data[i] = 255 * Math.pow(rows.data[i]! / 255, 1 / 2.2);
    }
    const layer = document.createElement('canvas');
    layer.width = w;
    layer.height = h;
    layer.getContext('2d')!.putImageData(rows, 0, 0);
    const context = this.canvas.getContext('2d')!;
    context.globalAlpha = this.get('Overlay Alpha');
    context.drawImage(layer, 0, 0, this.canvas.width, this.canvas.height);
    context.globalAlpha = 1;
  }

  override stop(): void {
    this.leaveInfo?.();
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
  help: 'Pictures, also of depth',
  types: IMAGE,
  hasPicture: true,
  options: [...topic('Topic', '', IMAGE), ...range],
  make: (...all) => new ImageDisplay(...all),
};

export const camera: Kind = {
  class: 'rviz_default_plugins/Camera',
  also: ['rviz/Camera'],
  title: 'Camera',
  help: "A camera's picture with the scene over it, through the camera's eyes",
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
