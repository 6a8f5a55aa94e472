/**
 * Point clouds, uploaded from the bytes of a message to the GPU: the shader reads coordinates and colours from
 * each point's words, so that two million points need one upload and no loop.
 */
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  BoxGeometry,
  Color,
  GLSL3,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  IntType,
  Mesh,
  PlaneGeometry,
  Points,
  RawShaderMaterial,
  Sphere,
  Vector2,
  Vector3,
} from 'three';

/** Points as rows of 32-bit words. */
export interface Rows {
  words: Uint32Array;
  /** Words from one point to the next. */
  stride: number;
  count: number;
  /** Offset of x, y, z in the row [words]. */
  xyz: number;
  /** Offset of the float that sets the colour [words]. */
  value?: number;
  /** Offset of the colour 0x00rrggbb [words]. */
  rgb?: number;
  /** True if the words are not shared with a message, so that they need no copy. */
  isOwn?: boolean;
}

/** Every Nth row, so that at most `most` are left: rendering without a GPU stays interactive. */
export function thinned(rows: Rows, most: number): Rows & { every: number } {
  const every = Math.max(1, Math.ceil(rows.count / most));
  if (every === 1) return { ...rows, every };
  const { stride } = rows;
  const count = Math.floor(rows.count / every);
  const words = new Uint32Array(count * stride);
  for (let i = 0; i < count; i++) {
    const from = i * every * stride;
    for (let k = 0; k < stride; k++) words[i * stride + k] = rows.words[from + k]!;
  }
  return { ...rows, words, count, every, isOwn: true };
}

export const STYLES = ['Points', 'Squares', 'Flat Squares', 'Spheres', 'Boxes', 'Tiles'] as const;
export type Style = (typeof STYLES)[number];

export interface Appearance {
  style: Style;
  sizeM: number;
  sizePx: number;
  alpha: number;
  coloring: 'flat' | 'value' | 'axis' | 'rgb';
  color: Color;
  /** Range of values that the colours span. */
  low: number;
  high: number;
  isRainbow: boolean;
  isInverted: boolean;
  lowColor: Color;
  highColor: Color;
  /** Axis that sets the colour; in the fixed frame or in that of the points. */
  axis: Vector3;
  axisOffset: number;
}

const COLORS = /* glsl */ `
uniform int coloring;
uniform vec3 flatColor, lowColor, highColor, axis;
uniform float low, high, axisOffset;
uniform bool isRainbow, isInverted;
// RViz's rainbow: red at 0 through yellow, green, cyan and blue to magenta at 1.
vec3 rainbow(float v) {
  float h = clamp(v, 0.0, 1.0) * 5.0 + 1.0;
  int i = int(floor(h));
  float f = h - float(i);
  if ((i & 1) == 0) f = 1.0 - f;
  float n = 1.0 - f;
  if (i <= 1) return vec3(n, 0.0, 1.0);
  if (i == 2) return vec3(0.0, n, 1.0);
  if (i == 3) return vec3(0.0, 1.0, n);
  if (i == 4) return vec3(n, 1.0, 0.0);
  return vec3(1.0, n, 0.0);
}
vec3 colorOf(vec3 xyz, uint value, uint rgb) {
  if (coloring == 0) return flatColor;
  if (coloring == 3) return vec3((rgb >> 16) & 255u, (rgb >> 8) & 255u, rgb & 255u) / 255.0;
  float number = coloring == 1 ? uintBitsToFloat(value) : dot(axis, xyz) + axisOffset;
  float part = (number - low) / max(high - low, 1e-9);
  if (isRainbow || coloring == 2) return rainbow(isInverted && coloring == 1 ? part : 1.0 - part);
  return mix(lowColor, highColor, clamp(part, 0.0, 1.0));
}
`;

const POINTS_VERTEX = /* glsl */ `
precision highp float; precision highp int;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float sizePx, sizeM, pixelsPerUnit;
uniform bool isOrtho;
in highp uvec3 words; in highp uint value; in highp uint rgb;
out vec3 vColor;
${COLORS}
void main() {
  vec3 xyz = uintBitsToFloat(words);
  bool isThere = !any(isnan(xyz)) && !any(isinf(xyz));
  vec4 seen = modelViewMatrix * vec4(isThere ? xyz : vec3(0.0), 1.0);
  gl_Position = isThere ? projectionMatrix * seen : vec4(0.0, 0.0, 2.0, 1.0);
  float metres = sizeM * pixelsPerUnit / (isOrtho ? 1.0 : max(-seen.z, 1e-4));
  gl_PointSize = sizePx > 0.0 ? sizePx : max(metres, 1.5);
  vColor = colorOf(xyz, value, rgb);
}`;

const SOLID_VERTEX = /* glsl */ `
precision highp float; precision highp int;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
uniform float sizeM;
in vec3 position; in vec3 normal;
in highp uvec3 words; in highp uint value; in highp uint rgb;
out vec3 vColor;
${COLORS}
void main() {
  vec3 xyz = uintBitsToFloat(words);
  bool isThere = !any(isnan(xyz)) && !any(isinf(xyz));
  vec4 at = modelMatrix * vec4(isThere ? xyz : vec3(0.0), 1.0) + vec4(position * sizeM, 0.0);
  gl_Position = isThere ? projectionMatrix * viewMatrix * at : vec4(0.0, 0.0, 2.0, 1.0);
  float light = 0.65 + 0.35 * max(dot(normal, normalize(vec3(0.4, -0.5, 0.8))), 0.0);
  vColor = colorOf(xyz, value, rgb) * light;
}`;

const FRAGMENT = /* glsl */ `
precision highp float;
uniform float alpha; uniform bool isRound;
in vec3 vColor; out vec4 color;
void main() {
  float light = 1.0;
  if (isRound) {
    vec2 at = gl_PointCoord * 2.0 - 1.0;
    float r2 = dot(at, at);
    if (r2 > 1.0) discard;
    light = 0.55 + 0.45 * sqrt(1.0 - r2);
  }
  color = vec4(vColor * light, alpha);
}`;

const COLORINGS = { flat: 0, value: 1, axis: 2, rgb: 3 };

export class Cloud {
  readonly object: Points | Mesh;
  private material: RawShaderMaterial;
  private buffer?: InterleavedBuffer;
  private rows?: Rows;
  private isSolid: boolean;

  constructor(readonly style: Style) {
    this.isSolid = style === 'Boxes' || style === 'Tiles';
    const uniforms: Record<string, { value: unknown }> = {};
    for (const name of ['coloring', 'low', 'high', 'axisOffset', 'sizePx', 'sizeM', 'alpha']) {
      uniforms[name] = { value: 0 };
    }
    for (const name of ['flatColor', 'lowColor', 'highColor', 'axis']) {
      uniforms[name] = { value: new Vector3() };
    }
    for (const name of ['isRainbow', 'isInverted', 'isRound', 'isOrtho']) {
      uniforms[name] = { value: false };
    }
    uniforms.pixelsPerUnit = { value: 1 };
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: this.isSolid ? SOLID_VERTEX : POINTS_VERTEX,
      fragmentShader: FRAGMENT,
      uniforms,
    });
    this.object = this.isSolid
      ? new Mesh(new InstancedBufferGeometry(), this.material)
      : new Points(new BufferGeometry(), this.material);
    this.object.frustumCulled = false;
    const size = new Vector2();
    this.object.onBeforeRender = (renderer, _scene, camera) => {
      const scale = camera.projectionMatrix.elements[5]!;
      uniforms.pixelsPerUnit!.value = (renderer.getDrawingBufferSize(size).y * scale) / 2;
      uniforms.isOrtho!.value = 'isOrthographicCamera' in camera;
      this.material.uniformsNeedUpdate = true;
    };
  }

  show(rows: Rows): void {
    const { words, stride } = rows;
    this.rows = rows;
    const usable = words.subarray(0, rows.count * stride);
    if (this.buffer && this.buffer.stride === stride && this.buffer.array.length >= usable.length) {
      // The GPU buffer is reused: scans arrive often.
      const isWhole = rows.isOwn && this.buffer.array.length === usable.length;
      if (isWhole) this.buffer.array = usable;
      else (this.buffer.array as Uint32Array).set(usable);
      this.buffer.clearUpdateRanges();
      this.buffer.addUpdateRange(0, usable.length);
      this.buffer.needsUpdate = true;
    } else {
      this.allocate(rows.isOwn ? usable : usable.slice(), stride);
    }
    const { geometry } = this.object;
    this.attach('words', 3, rows.xyz);
    this.attach('value', 1, rows.value ?? rows.xyz);
    this.attach('rgb', 1, rows.rgb ?? rows.xyz);
    if (this.isSolid) (geometry as InstancedBufferGeometry).instanceCount = rows.count;
    else geometry.setDrawRange(0, rows.count);
  }

  private allocate(array: Uint32Array, stride: number): void {
    this.object.geometry.dispose();
    if (this.isSolid) {
      this.buffer = new InstancedInterleavedBuffer(array, stride);
      const geometry = new InstancedBufferGeometry();
      const shape = this.style === 'Boxes' ? new BoxGeometry(1, 1, 1) : new PlaneGeometry(1, 1);
      geometry.setIndex(shape.index);
      geometry.setAttribute('position', shape.getAttribute('position'));
      geometry.setAttribute('normal', shape.getAttribute('normal'));
      this.object.geometry = geometry;
    } else {
      this.buffer = new InterleavedBuffer(array, stride);
      this.object.geometry = new BufferGeometry();
    }
    // The words are no coordinates, so three.js must not compute bounds from them.
    this.object.geometry.boundingSphere = new Sphere(new Vector3(), Infinity);
    this.object.geometry.boundingBox = new Box3();
  }

  private attach(name: string, size: number, offset: number): void {
    const { geometry } = this.object;
    const old = geometry.getAttribute(name) as InterleavedBufferAttribute | undefined;
    if (old?.data === this.buffer && old?.offset === offset) return;
    const attribute = new InterleavedBufferAttribute(this.buffer!, size, offset);
    // The shader reads the words as integers.
    (attribute as unknown as BufferAttribute).gpuType = IntType;
    geometry.setAttribute(name, attribute);
  }

  setAppearance(appearance: Appearance): void {
    const { uniforms } = this.material;
    const isPixels = appearance.style === 'Points';
    const set = (name: string, value: unknown) => (uniforms[name]!.value = value);
    const linear = (color: Color) => {
      const { r, g, b } = color.clone().convertLinearToSRGB();
      return new Vector3(r, g, b);
    };
    set('coloring', COLORINGS[appearance.coloring]);
    set('flatColor', linear(appearance.color));
    set('lowColor', linear(appearance.lowColor));
    set('highColor', linear(appearance.highColor));
    set('low', appearance.low);
    set('high', appearance.high);
    set('isRainbow', appearance.isRainbow);
    set('isInverted', appearance.isInverted);
    set('axis', appearance.axis);
    set('axisOffset', appearance.axisOffset);
    set('sizePx', isPixels ? appearance.sizePx : 0);
    set('sizeM', appearance.sizeM);
    set('alpha', appearance.alpha);
    set('isRound', appearance.style === 'Spheres');
    this.material.transparent = appearance.alpha < 0.999;
    this.material.depthWrite = appearance.alpha >= 0.999;
  }

  /** Coordinates and value of a point, in the frame of the cloud. */
  at(index: number): { xyz: Vector3; value?: number } | undefined {
    const { rows } = this;
    if (!rows || index >= rows.count) return undefined;
    const floats = new Float32Array(
      (this.buffer!.array as Uint32Array).buffer,
      (this.buffer!.array as Uint32Array).byteOffset,
    );
    const row = index * rows.stride;
    const xyz = new Vector3().fromArray(floats, row + rows.xyz);
    return { xyz, value: rows.value === undefined ? undefined : floats[row + rows.value] };
  }

  get count(): number {
    return this.rows?.count ?? 0;
  }
}
