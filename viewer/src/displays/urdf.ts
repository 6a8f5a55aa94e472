/** Part of a URDF that is drawn: links with their shapes, and the joints between them. */
import { fromRpy, type Pose } from '../core/pose';
import { t } from '../texts/language.svelte';

export type Shape =
  | { kind: 'box'; size: [number, number, number] }
  | { kind: 'cylinder'; radius: number; length: number }
  | { kind: 'sphere'; radius: number }
  | { kind: 'mesh'; uri: string; scale: [number, number, number] };

export interface Part {
  linkFromPart: Pose;
  shape: Shape;
  /** Red, green, blue, alpha; `undefined` if the file has none. */
  rgba?: [number, number, number, number];
}

export interface Link {
  name: string;
  visuals: Part[];
  collisions: Part[];
  mass: number;
  /** Pose of the center of mass, and the inertia there [kg m²]: ixx, ixy, ixz, iyy, iyz, izz. */
  linkFromMass: Pose;
  inertia: number[];
}

export interface Robot {
  name: string;
  links: Link[];
  joints: { name: string; type: string; parent: string; child: string }[];
}

type Vec = [number, number, number];
const numbers = (text: string | null | undefined): number[] =>
  (text ?? '').trim().split(/\s+/).filter(Boolean).map(Number);
const vec = (text: string | null | undefined, otherwise: Vec): Vec => {
  const all = numbers(text);
  return all.length === 3 && all.every(Number.isFinite) ? (all as Vec) : otherwise;
};
const children = (element: Element, name: string) =>
  [...element.children].filter((child) => child.localName === name);
const child = (element: Element | undefined, name: string) => element && children(element, name)[0];

/** Parses the text with the browser's XML parser. */
export function readUrdf(text: string, parser: DOMParser = new DOMParser()): Robot {
  const document = parser.parseFromString(text, 'text/xml');
  const root = document.documentElement;
  if (!root || root.localName !== 'robot') throw new Error(t().displays.notUrdf);
  const colors = new Map<string, Part['rgba']>();
  for (const material of children(root, 'material')) {
    colors.set(material.getAttribute('name') ?? '', rgbaOf(material));
  }
  const links = children(root, 'link').map((link): Link => {
    const parts = (name: string) =>
      children(link, name).flatMap((part) => readPart(part, colors) ?? []);
    const inertial = child(link, 'inertial');
    const mass = child(inertial, 'mass')?.getAttribute('value');
    const moments = child(inertial, 'inertia');
    return {
      name: link.getAttribute('name') ?? '',
      visuals: parts('visual'),
      collisions: parts('collision'),
      mass: Number(mass ?? 0),
      linkFromMass: originOf(inertial),
      inertia: ['ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz'].map((name) =>
        Number(moments?.getAttribute(name) ?? 0),
      ),
    };
  });
  const joints = children(root, 'joint').map((joint) => ({
    name: joint.getAttribute('name') ?? '',
    type: joint.getAttribute('type') ?? '',
    parent: child(joint, 'parent')?.getAttribute('link') ?? '',
    child: child(joint, 'child')?.getAttribute('link') ?? '',
  }));
  return { name: root.getAttribute('name') ?? '', links, joints };
}

function rgbaOf(material: Element): Part['rgba'] {
  const all = numbers(child(material, 'color')?.getAttribute('rgba'));
  return all.length === 4 ? (all as Part['rgba']) : undefined;
}

function originOf(element: Element | undefined): Pose {
  const origin = child(element, 'origin');
  const [roll, pitch, yaw] = vec(origin?.getAttribute('rpy'), [0, 0, 0]);
  return { t: vec(origin?.getAttribute('xyz'), [0, 0, 0]), q: fromRpy(roll, pitch, yaw) };
}

function readPart(element: Element, colors: Map<string, Part['rgba']>): Part | undefined {
  const linkFromPart = originOf(element);
  const shape = readShape(child(element, 'geometry'));
  if (!shape) return undefined;
  const material = child(element, 'material');
  const rgba = material && (rgbaOf(material) ?? colors.get(material.getAttribute('name') ?? ''));
  return { linkFromPart, shape, rgba };
}

function readShape(geometry: Element | undefined): Shape | undefined {
  const box = child(geometry, 'box');
  if (box) return { kind: 'box', size: vec(box.getAttribute('size'), [1, 1, 1]) };
  const cylinder = child(geometry, 'cylinder');
  if (cylinder) {
    const radius = Number(cylinder.getAttribute('radius') ?? 0);
    return { kind: 'cylinder', radius, length: Number(cylinder.getAttribute('length') ?? 0) };
  }
  const sphere = child(geometry, 'sphere');
  if (sphere) return { kind: 'sphere', radius: Number(sphere.getAttribute('radius') ?? 0) };
  const mesh = child(geometry, 'mesh');
  if (!mesh) return undefined;
  const scale = vec(mesh.getAttribute('scale'), [1, 1, 1]);
  return { kind: 'mesh', uri: mesh.getAttribute('filename') ?? '', scale };
}
