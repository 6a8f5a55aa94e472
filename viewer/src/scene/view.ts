/** Camera: RViz's views with RViz's parameters, moved by mouse, touch and keys. */
import { OrthographicCamera, PerspectiveCamera, Plane, Raycaster, Vector2, Vector3 } from 'three';

export type ViewKind = 'Orbit' | 'TopDownOrtho' | 'ThirdPersonFollower';

export interface ViewState {
  kind: ViewKind;
  /** Distance from the focal point [m]. */
  distance: number;
  focal: [number, number, number];
  /** Elevation above the floor plane [rad]. */
  pitch: number;
  /** Azimuth [rad]. */
  yaw: number;
  /** Pixels per metre of the orthographic view. */
  scale: number;
  /** Rotation of the orthographic view [rad]. */
  angle: number;
  /** Center of the orthographic view [m]. */
  x: number;
  y: number;
  /** Frame that the camera follows. */
  targetFrame: string;
}

export const FIRST_VIEW: ViewState = {
  kind: 'Orbit',
  distance: 10,
  focal: [0, 0, 0],
  pitch: 0.785,
  yaw: 3.9,
  scale: 60,
  angle: 0,
  x: 0,
  y: 0,
  targetFrame: '<Fixed Frame>',
};

const FIELD_OF_VIEW_DEG = 45;
const NEAREST_M = 0.05;
const LONGEST_M = 5000;

export class View {
  state: ViewState = structuredClone(FIRST_VIEW);
  /** Position and yaw of the target frame. */
  readonly origin = new Vector3();
  originYaw = 0;
  readonly perspective = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, NEAREST_M, LONGEST_M);
  readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
  width = 1;
  height = 1;
  /** True while a tool uses the mouse. */
  isHeld = false;

  constructor(
    private element: HTMLElement,
    private changed: () => void,
  ) {
    this.perspective.up.set(0, 0, 1);
    this.orthographic.up.set(0, 1, 0);
    const pointers = new Map<number, Vector2>();
    let spread = 0;
    element.addEventListener('pointerdown', (event) => {
      if (this.isHeld) return;
      pointers.set(event.pointerId, new Vector2(event.clientX, event.clientY));
      element.setPointerCapture(event.pointerId);
      spread = 0;
    });
    element.addEventListener('pointermove', (event) => {
      const last = pointers.get(event.pointerId);
      if (!last || this.isHeld) return;
      const dx = event.clientX - last.x;
      const dy = event.clientY - last.y;
      last.set(event.clientX, event.clientY);
      if (pointers.size === 2) {
        const [a, b] = [...pointers.values()] as [Vector2, Vector2];
        const now = a.distanceTo(b);
        if (spread > 0 && now > 0) this.zoom(spread / now);
        spread = now;
        this.pan(dx / 2, dy / 2);
      } else if (event.buttons & 2) this.zoom(Math.exp(dy * 0.006));
      else if (event.buttons & 4 || event.shiftKey) this.pan(dx, dy);
      else if (event.buttons & 1) this.turn(dx, dy);
    });
    const end = (event: PointerEvent) => {
      pointers.delete(event.pointerId);
      spread = 0;
    };
    element.addEventListener('pointerup', end);
    element.addEventListener('pointercancel', end);
    element.addEventListener('contextmenu', (event) => event.preventDefault());
    element.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        this.zoom(Math.exp(Math.sign(event.deltaY) * Math.min(0.25, Math.abs(event.deltaY) / 500)));
      },
      { passive: false },
    );
    element.addEventListener('keydown', (event) => this.key(event));
  }

  /** Arrow keys rotate, with shift they pan; + and - zoom. */
  private key(event: KeyboardEvent): void {
    if (this.isHeld || event.ctrlKey || event.metaKey || event.altKey) return;
    const move = event.shiftKey ? this.pan.bind(this) : this.turn.bind(this);
    if (event.key === 'ArrowLeft') move(20, 0);
    else if (event.key === 'ArrowRight') move(-20, 0);
    else if (event.key === 'ArrowUp') move(0, 20);
    else if (event.key === 'ArrowDown') move(0, -20);
    else if (event.key === '+' || event.key === '=') this.zoom(0.85);
    else if (event.key === '-') this.zoom(1.18);
    else return;
    event.preventDefault();
  }

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.state.kind === 'TopDownOrtho' ? this.orthographic : this.perspective;
  }

  set(state: Partial<ViewState>): void {
    this.state = { ...this.state, ...structuredClone(state) };
    this.update();
  }

  turn(dx: number, dy: number): void {
    const { state } = this;
    if (state.kind === 'TopDownOrtho') state.angle -= dx * 0.005;
    else {
      state.yaw -= dx * 0.006;
      const least = state.kind === 'ThirdPersonFollower' ? 0.02 : -1.56;
      state.pitch = Math.min(1.5607, Math.max(least, state.pitch + dy * 0.006));
    }
    this.update();
  }

  zoom(factor: number): void {
    const { state } = this;
    state.distance = Math.min(2000, Math.max(0.05, state.distance * factor));
    if (state.kind === 'TopDownOrtho') {
      state.scale = Math.min(20_000, Math.max(0.5, state.scale / factor));
    }
    this.update();
  }

  pan(dx: number, dy: number): void {
    const { state } = this;
    if (state.kind === 'TopDownOrtho') {
      const [sin, cos] = [Math.sin(state.angle), Math.cos(state.angle)];
      state.x -= (dx * cos + dy * sin) / state.scale;
      state.y -= (dx * sin - dy * cos) / state.scale;
    } else {
      const metres =
        (2 * state.distance * Math.tan((FIELD_OF_VIEW_DEG * Math.PI) / 360)) / this.height;
      const yaw = state.yaw + (state.kind === 'ThirdPersonFollower' ? this.originYaw : 0);
      const right = new Vector3(-Math.sin(yaw), Math.cos(yaw), 0);
      const up = new Vector3(-Math.cos(yaw), -Math.sin(yaw), 0).multiplyScalar(
        Math.sin(state.pitch),
      );
      up.z = Math.cos(state.pitch);
      const by = right.multiplyScalar(-dx * metres).addScaledVector(up, dy * metres);
      state.focal = [state.focal[0] + by.x, state.focal[1] + by.y, state.focal[2] + by.z];
    }
    this.update();
  }

  resize(width: number, height: number): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.update();
  }

  update(): void {
    const { state, perspective, orthographic } = this;
    if (state.kind === 'TopDownOrtho') {
      const [w, h] = [this.width / state.scale / 2, this.height / state.scale / 2];
      Object.assign(orthographic, { left: -w, right: w, top: h, bottom: -h });
      orthographic.position.set(this.origin.x + state.x, this.origin.y + state.y, 500);
      orthographic.quaternion.setFromAxisAngle(new Vector3(0, 0, 1), state.angle);
      orthographic.updateProjectionMatrix();
      orthographic.updateMatrixWorld();
    } else {
      const yaw = state.yaw + (state.kind === 'ThirdPersonFollower' ? this.originYaw : 0);
      const focal = new Vector3(...state.focal).add(this.origin);
      const flat = Math.cos(state.pitch) * state.distance;
      perspective.position.set(
        focal.x + Math.cos(yaw) * flat,
        focal.y + Math.sin(yaw) * flat,
        focal.z + Math.sin(state.pitch) * state.distance,
      );
      perspective.lookAt(focal);
      perspective.aspect = this.width / this.height;
      perspective.near = Math.min(NEAREST_M, state.distance / 20);
      perspective.updateProjectionMatrix();
      perspective.updateMatrixWorld();
    }
    this.changed();
  }

  /** Ray from the camera through a point of the page. */
  ray(clientX: number, clientY: number): Raycaster {
    const box = this.element.getBoundingClientRect();
    const point = new Vector2(
      ((clientX - box.left) / box.width) * 2 - 1,
      1 - ((clientY - box.top) / box.height) * 2,
    );
    const caster = new Raycaster();
    caster.setFromCamera(point, this.camera);
    return caster;
  }

  /** Intersection of the ray through a point of the page with the floor plane; `undefined` above the horizon. */
  ground(clientX: number, clientY: number, z = 0): Vector3 | undefined {
    const { ray } = this.ray(clientX, clientY);
    return ray.intersectPlane(new Plane(new Vector3(0, 0, 1), -z), new Vector3()) ?? undefined;
  }
}
