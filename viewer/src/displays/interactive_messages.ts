/** Interactive markers as messages, and what is filled in where a server leaves it out. */
import { normalize, rotate } from '../core/pose';
import type { Header, Marker, Point, PoseMessage, Quaternion } from '../core/types';

export const MODE = {
  none: 0,
  menu: 1,
  button: 2,
  moveAxis: 3,
  movePlane: 4,
  rotateAxis: 5,
  moveRotate: 6,
  move3d: 7,
  rotate3d: 8,
  moveRotate3d: 9,
} as const;

export const ORIENTATION = { inherit: 0, fixed: 1, viewFacing: 2 } as const;

export const EVENT = {
  keepAlive: 0,
  poseUpdate: 1,
  menuSelect: 2,
  buttonClick: 3,
  mouseDown: 4,
  mouseUp: 5,
} as const;

export interface MenuEntry {
  id: number;
  parent_id: number;
  title: string;
  command: string;
  /** 0: feedback; 1 and 2: a command of a terminal. */
  command_type: number;
}

export interface Control {
  name: string;
  orientation: Quaternion;
  orientation_mode: number;
  interaction_mode: number;
  always_visible: boolean;
  markers: Marker[];
  independent_marker_orientation: boolean;
  description: string;
}

export interface InteractiveMarker {
  header: Header;
  pose: PoseMessage;
  name: string;
  description: string;
  scale: number;
  menu_entries: MenuEntry[];
  controls: Control[];
}

export interface Update {
  server_id: string;
  seq_num: number | bigint;
  type: number;
  markers: InteractiveMarker[];
  poses: { header: Header; pose: PoseMessage; name: string }[];
  erases: string[];
}

const unit = ({ x, y, z, w }: Quaternion): Quaternion => {
  const [a, b, c, d] = normalize([x, y, z, w]);
  return { x: a, y: b, z: c, w: d };
};

/** Steps of the ring around an axis. */
const STEPS = 36;
const RING_INNER = 0.5;
const RING_WIDTH = 0.3;
const ALPHA = 0.5;

/** Colour of a handle by the direction of its axis: x red, y green, z blue. */
export function axisColor(orientation: Quaternion): { r: number; g: number; b: number } {
  const { x, y, z, w } = orientation;
  const [r, g, b] = rotate([x, y, z, w], [1, 0, 0]).map(Math.abs) as [number, number, number];
  const most = Math.max(r, g, b);
  return { r: r / most, g: g / most, b: b / most };
}

function plainMarker(type: number, orientation: Quaternion, alpha: number): Marker {
  return {
    header: { stamp: { sec: 0, nanosec: 0 }, frame_id: '' },
    ns: '',
    id: 0,
    type,
    action: 0,
    pose: { position: { x: 0, y: 0, z: 0 }, orientation },
    scale: { x: 1, y: 1, z: 1 },
    color: { ...axisColor(orientation), a: alpha },
    lifetime: { sec: 0, nanosec: 0 },
    frame_locked: false,
    points: [],
    colors: [],
    text: '',
    mesh_resource: '',
    mesh_use_embedded_materials: false,
  };
}

/** Arrow away from the middle; `side` is 1 or -1. */
function arrow(scale: number, orientation: Quaternion, side: number, alpha: number): Marker {
  return {
    ...plainMarker(0, orientation, alpha),
    // Diameters of shaft and head, length of the head.
    scale: { x: scale * 0.15, y: scale * 0.25, z: scale * 0.2 },
    points: [
      { x: side * scale * 0.5, y: 0, z: 0 },
      { x: side * scale * 0.9, y: 0, z: 0 },
    ],
  };
}

/** Ring in the plane across the axis. */
function ring(
  scale: number,
  { orientation, interaction_mode: mode }: Control,
  alpha: number,
): Marker {
  const marker = plainMarker(11, orientation, alpha);
  const at = (i: number, radius: number): Point => {
    const angle = (i / STEPS) * 2 * Math.PI;
    return { x: 0, y: radius * Math.cos(angle), z: radius * Math.sin(angle) };
  };
  const outer = RING_INNER * (1 + RING_WIDTH);
  const { r, g, b } = marker.color;
  for (let i = 0; i < STEPS; i++) {
    const [a, c] = [at(i, RING_INNER), at(i + 1, RING_INNER)];
    const [p, q] = [at(i, outer), at(i + 1, outer)];
    marker.points.push(a, p, c, p, q, c);
    // A ring that rotates is striped, so that its turning is seen.
    const isTurned = mode === MODE.rotateAxis || mode === MODE.moveRotate;
    const shade = isTurned && i % 2 === 0 ? 0.6 : 1;
    const color = { r: r * shade, g: g * shade, b: b * shade, a: alpha };
    for (let k = 0; k < 6; k++) marker.colors.push(color);
  }
  marker.scale = { x: scale, y: scale, z: scale };
  return marker;
}

/** Text that faces the viewer. */
function caption(text: string, heightM: number, zM: number): Marker {
  return {
    ...plainMarker(9, { x: 0, y: 0, z: 0, w: 1 }, 1),
    pose: { position: { x: 0, y: 0, z: zM }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
    scale: { x: heightM, y: heightM, z: heightM },
    color: { r: 1, g: 1, b: 1, a: 1 },
    text,
  };
}

/**
 * Marker with what servers leave out: sizes, rotations, names, and handles of controls without markers. The rules are
 * those of the package interactive_markers (`autoComplete`).
 */
export function completed(marker: InteractiveMarker, isTransparent = true): InteractiveMarker {
  const scale = marker.scale || 1;
  const alpha = isTransparent ? ALPHA : 1;
  const names = new Set<string>();
  const controls = marker.controls.map((given): Control => {
    let { name } = given;
    for (let i = 0; names.has(name); i++) name = `${given.name}_u${i}`;
    names.add(name);
    const control = { ...given, name, orientation: unit(given.orientation) };
    const own = given.markers.length > 0 ? given.markers : handles(control, scale, alpha);
    return { ...control, markers: own.map(completedMarker) };
  });
  const orientation = unit(marker.pose.orientation);
  return { ...marker, scale, pose: { ...marker.pose, orientation }, controls };
}

function handles(control: Control, scale: number, alpha: number): Marker[] {
  switch (control.interaction_mode) {
    case MODE.moveAxis:
      return [1, -1].map((side) => arrow(scale, control.orientation, side, alpha));
    case MODE.movePlane:
    case MODE.rotateAxis:
    case MODE.moveRotate:
      return [ring(scale, control, alpha)];
    case MODE.menu:
      return [caption(control.description || '☰', 0.25 * scale, 1.2 * scale)];
    default:
      return [];
  }
}

const completedMarker = (marker: Marker): Marker => ({
  ...marker,
  scale: {
    x: marker.scale.x || 1,
    y: marker.scale.y || 1,
    z: marker.scale.z || 1,
  },
  pose: { ...marker.pose, orientation: unit(marker.pose.orientation) },
});

/** Title of a marker, as another marker. */
export const titleOf = ({ description, scale }: InteractiveMarker): Marker =>
  caption(description, scale * 0.15, scale * 1.4);

export interface MenuNode {
  entry: MenuEntry;
  children: MenuNode[];
}

/**
 * Entries as a tree. Entries whose parent does not exist, or that are their own ancestors, are left out, and the id 0,
 * which stands for no parent.
 */
export function menuTree(
  entries: readonly MenuEntry[],
  parent = 0,
  seen = new Set<number>([0]),
): MenuNode[] {
  return entries
    .filter((entry) => entry.parent_id === parent && !seen.has(entry.id))
    .map((entry) => ({
      entry,
      children: menuTree(entries, entry.id, new Set([...seen, entry.id])),
    }));
}
