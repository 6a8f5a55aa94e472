/** Handles of the selected models in the 3D view, and frames around the models. */
import {
  Box3,
  Box3Helper,
  Color,
  ConeGeometry,
  CylinderGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  TorusGeometry,
  Vector3,
  type BufferGeometry,
  type LineBasicMaterial,
  type Raycaster,
} from 'three';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import type { Vec3 } from '../core/pose';
import { dispose } from '../scene/stage';
import { isRing, type Handle } from './drag';

const COLORS: Record<Handle, string> = {
  x: '#e5383b',
  y: '#2fb344',
  z: '#3f7df0',
  xy: '#e6c229',
  turnX: '#e5383b',
  turnY: '#2fb344',
  turnZ: '#3f7df0',
};
const HANDLES = Object.keys(COLORS) as Handle[];
const FRAME_COLOR = new Color('#2fc4b2');
/** Handles are drawn over the scene. */
const RENDER_ORDER = 60;
const IDLE_OPACITY = 0.8;

/** Handle of length one at the origin; a thicker one catches the pointer. */
function geometryOf(handle: Handle, isThick: boolean): BufferGeometry {
  if (handle === 'xy') return new PlaneGeometry(0.24, 0.24).translate(0.32, 0.32, 0);
  if (isRing(handle)) {
    // Rings of different sizes do not cover each other.
    const ring = new TorusGeometry(handle === 'turnZ' ? 0.98 : 0.8, isThick ? 0.07 : 0.014, 8, 64);
    if (handle === 'turnX') ring.rotateY(Math.PI / 2);
    if (handle === 'turnY') ring.rotateX(Math.PI / 2);
    return ring;
  }
  const shaft = new CylinderGeometry(0.016, 0.016, 0.72, 10).translate(0, 0.46, 0);
  const head = new ConeGeometry(0.06, 0.2, 16).translate(0, 0.9, 0);
  const arrow = isThick
    ? new CylinderGeometry(0.09, 0.09, 0.88, 8).translate(0, 0.58, 0)
    : mergeGeometries([shaft, head]);
  if (handle === 'x') arrow.rotateZ(-Math.PI / 2);
  if (handle === 'z') arrow.rotateX(Math.PI / 2);
  return arrow;
}

export class Handles {
  /** In the world frame of the simulation. */
  readonly root = new Group();
  private scaled = new Group();
  private visible = new Map<Handle, Mesh<BufferGeometry, MeshBasicMaterial>>();
  private thick = new Map<Handle, Mesh>();
  private frames: Box3Helper[] = [];
  private framesKey = '';
  private highlit?: Handle;

  constructor() {
    this.root.matrixAutoUpdate = false;
    this.root.add(this.scaled);
    for (const handle of HANDLES) {
      const material = new MeshBasicMaterial({
        color: COLORS[handle],
        depthTest: false,
        transparent: true,
        opacity: IDLE_OPACITY,
        side: DoubleSide,
      });
      const mesh = new Mesh(geometryOf(handle, false), material);
      mesh.renderOrder = RENDER_ORDER;
      const thick = new Mesh(geometryOf(handle, true), material);
      thick.visible = false;
      this.visible.set(handle, mesh);
      this.thick.set(handle, thick);
      this.scaled.add(mesh, thick);
    }
    this.show([]);
  }

  /** Shows these handles. */
  show(handles: readonly Handle[]): void {
    for (const [handle, mesh] of this.visible) mesh.visible = handles.includes(handle);
    this.scaled.visible = handles.length > 0;
  }

  /** Position in the world frame, and length [m]. */
  place(at: Vec3, lengthM: number): void {
    this.scaled.position.set(...at);
    this.scaled.scale.setScalar(lengthM);
  }

  /** Handle that a ray hits, and the point where it does, both in the frame of the scene. */
  hit(caster: Raycaster): { handle: Handle; point: Vector3 } | undefined {
    const shown = [...this.thick].filter(([handle]) => this.visible.get(handle)!.visible);
    this.root.updateMatrixWorld(true);
    const [found] = caster.intersectObjects(
      shown.map(([, mesh]) => mesh),
      false,
    );
    const handle = shown.find(([, mesh]) => mesh === found?.object)?.[0];
    return found && handle ? { handle, point: found.point } : undefined;
  }

  /** Highlights the handle under the pointer. Returns true if another one was. */
  highlight(handle: Handle | undefined): boolean {
    if (handle === this.highlit) return false;
    this.highlit = handle;
    for (const [name, { material }] of this.visible) {
      material.opacity = name === handle ? 1 : IDLE_OPACITY;
      material.color.set(name === handle ? '#ffffff' : COLORS[name]);
    }
    return true;
  }

  /** Draws boxes around the selected models. Returns true if they changed. */
  frame(boxes: readonly { min: Vec3; max: Vec3 }[]): boolean {
    const key = boxes.map(({ min, max }) => [...min, ...max].map((v) => v.toFixed(4))).join(';');
    if (key === this.framesKey) return false;
    this.framesKey = key;
    while (this.frames.length > boxes.length) dispose(this.frames.pop()!);
    while (this.frames.length < boxes.length) {
      const frame = new Box3Helper(new Box3(), FRAME_COLOR);
      (frame.material as LineBasicMaterial).depthTest = false;
      frame.renderOrder = RENDER_ORDER - 1;
      this.root.add(frame);
      this.frames.push(frame);
    }
    boxes.forEach(({ min, max }, i) => {
      this.frames[i]!.box.set(new Vector3(...min), new Vector3(...max));
    });
    return true;
  }
}
