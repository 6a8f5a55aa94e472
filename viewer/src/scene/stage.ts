/** The 3D view: a scene with z up, rendered when something has changed. */
import {
  AmbientLight,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  type Object3D,
  Object3D as AnyObject,
  PCFShadowMap,
  Scene,
  SRGBColorSpace,
  WebGLRenderer,
} from 'three';
import { View } from './view';
import { t } from '../texts/language.svelte';

AnyObject.DEFAULT_UP.set(0, 0, 1);

export class Stage {
  readonly scene = new Scene();
  /** Displays, in the fixed frame. */
  readonly content = new Group();
  readonly renderer: WebGLRenderer;
  readonly view: View;
  /** True without a GPU: fewer pixels, no shadows. */
  readonly isSoftware: boolean;
  framesPerSecond = 0;
  /** Called before each check for changes. */
  ticks = new Set<(nowMs: number) => void>();
  private isDirty = true;
  private frames = 0;
  private sinceMs = performance.now();
  private sun = new DirectionalLight(0xffffff, 2.1);
  private stopped = false;
  /** False while the view is behind another panel: nothing is drawn. */
  isVisible = true;
  private readonly observer: ResizeObserver;

  constructor(private canvas: HTMLCanvasElement) {
    const context = canvas.getContext('webgl2', {
      antialias: true,
      alpha: false,
      preserveDrawingBuffer: false,
      powerPreference: 'high-performance',
    });
    if (!context) {
      throw new Error(t().notices.noWebGl);
    }
    const info = context.getExtension('WEBGL_debug_renderer_info');
    const name = info ? String(context.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
    this.isSoftware = /swiftshader|llvmpipe|software/i.test(name);
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.setPixelRatio(this.isSoftware ? 1 : Math.min(devicePixelRatio, 2));
    this.view = new View(canvas, () => this.invalidate());
    this.scene.add(this.content);
    this.scene.add(new AmbientLight(0xffffff, 0.55));
    const sky = new HemisphereLight(0xffffff, 0x556070, 1.1);
    sky.position.set(0, 0, 1);
    this.scene.add(sky);
    this.sun.position.set(6, -9, 18);
    this.scene.add(this.sun, this.sun.target);
    if (!this.isSoftware) this.castShadows();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(canvas.parentElement!);
    this.resize();
    const loop = (nowMs: number) => {
      if (this.stopped) return;
      requestAnimationFrame(loop);
      for (const tick of this.ticks) tick(nowMs);
      if (this.isDirty && this.isVisible) this.draw(nowMs);
    };
    requestAnimationFrame(loop);
  }

  private castShadows(): void {
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    const { sun } = this;
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.bias = -0.0005;
    sun.shadow.normalBias = 0.03;
    Object.assign(sun.shadow.camera, { left: -15, right: 15, top: 15, bottom: -15, far: 60 });
  }

  setBackground(css: string): void {
    this.scene.background = new Color(css);
    this.invalidate();
  }

  invalidate(): void {
    this.isDirty = true;
  }

  add(object: Object3D): void {
    this.content.add(object);
    this.invalidate();
  }

  remove(object: Object3D): void {
    object.removeFromParent();
    this.invalidate();
  }

  private resize(): void {
    const box = this.canvas.parentElement!.getBoundingClientRect();
    // A hidden view keeps its size, so that it has a picture at once when it is shown.
    if (box.width === 0 || box.height === 0) return;
    this.renderer.setSize(box.width, box.height, false);
    this.view.resize(box.width, box.height);
    this.invalidate();
  }

  /** Draws the present state now, for a picture; the canvas is to be read in the same task. */
  render(): HTMLCanvasElement {
    const nowMs = performance.now();
    for (const tick of this.ticks) tick(nowMs);
    this.draw(nowMs);
    return this.canvas;
  }

  draw(nowMs = performance.now()): void {
    this.isDirty = false;
    const [x, y] = this.view.state.focal;
    // The light follows the focal point, where shadows get the highest resolution.
    this.sun.target.position.set(x + this.view.origin.x, y + this.view.origin.y, 0);
    this.sun.position.copy(this.sun.target.position).add({ x: 6, y: -9, z: 18 } as never);
    this.renderer.render(this.scene, this.view.camera);
    this.frames++;
    if (nowMs - this.sinceMs > 1000) {
      this.framesPerSecond = (this.frames * 1000) / (nowMs - this.sinceMs);
      this.frames = 0;
      this.sinceMs = nowMs;
    }
  }

  stop(): void {
    this.stopped = true;
    this.observer.disconnect();
    this.renderer.dispose();
    // A browser has few contexts; the garbage collector frees them late.
    this.renderer.forceContextLoss();
  }
}

/** Frees the GPU resources of an object. */
export function dispose(object: Object3D): void {
  object.removeFromParent();
  object.traverse((part) => {
    const { geometry, material } = part as {
      geometry?: { dispose(): void; userData: { isShared?: boolean } };
      material?: { dispose(): void } | { dispose(): void }[];
    };
    if (!geometry?.userData.isShared) geometry?.dispose();
    for (const one of material ? [material].flat() : []) one.dispose();
    (part as { dispose?: () => void }).dispose?.();
  });
}
