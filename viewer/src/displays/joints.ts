/** Joints of a URDF with their axes and limits. */
import { t } from '../texts/language.svelte';

export interface Mimic {
  joint: string;
  multiplier: number;
  offset: number;
}

export interface Joint {
  name: string;
  type: string;
  parent: string;
  child: string;
  axis: [number, number, number];
  /** Limits of the position [rad] or [m]; `undefined` without any. */
  lower?: number;
  upper?: number;
  /** Largest effort [N m] or [N]; 0 if the file has none. */
  maxEffort: number;
  mimic?: Mimic;
}

const numberOf = (element: Element | undefined, name: string): number | undefined => {
  const text = element?.getAttribute(name);
  const value = text === null || text === undefined || text.trim() === '' ? NaN : Number(text);
  return Number.isFinite(value) ? value : undefined;
};

/** Reads the joints with the browser's XML parser. */
export function readJoints(text: string, parser: DOMParser = new DOMParser()): Joint[] {
  const root = parser.parseFromString(text, 'text/xml').documentElement;
  if (!root || root.localName !== 'robot') {
    throw new Error(t().valueDisplays.noUrdf);
  }
  const children = (element: Element, name: string) =>
    Array.from(element.children).filter((one) => one.localName === name);
  return children(root, 'joint').map((joint): Joint => {
    const child = (name: string) => children(joint, name)[0];
    const limit = child('limit');
    const mimic = child('mimic');
    const axis = (child('axis')?.getAttribute('xyz') ?? '1 0 0').trim().split(/\s+/).map(Number);
    const type = joint.getAttribute('type') ?? '';
    const isBounded = type === 'revolute' || type === 'prismatic';
    return {
      name: joint.getAttribute('name') ?? '',
      type,
      parent: child('parent')?.getAttribute('link') ?? '',
      child: child('child')?.getAttribute('link') ?? '',
      axis:
        axis.length === 3 && axis.every(Number.isFinite)
          ? (axis as [number, number, number])
          : [1, 0, 0],
      lower: isBounded && limit ? (numberOf(limit, 'lower') ?? 0) : undefined,
      upper: isBounded && limit ? (numberOf(limit, 'upper') ?? 0) : undefined,
      maxEffort: numberOf(limit, 'effort') ?? 0,
      mimic: mimic && {
        joint: mimic.getAttribute('joint') ?? '',
        multiplier: numberOf(mimic, 'multiplier') ?? 1,
        offset: numberOf(mimic, 'offset') ?? 0,
      },
    };
  });
}
