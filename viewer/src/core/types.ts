/** Messages that the viewer reads, as the decoder returns them. */
import type { Pose } from './pose';
import { normalize } from './pose';

export interface Stamp {
  sec: number;
  nanosec: number;
}
export interface Header {
  stamp: Stamp;
  frame_id: string;
}
export interface Point {
  x: number;
  y: number;
  z: number;
}
export interface Quaternion extends Point {
  w: number;
}
export interface PoseMessage {
  position: Point;
  orientation: Quaternion;
}
export interface TransformStamped {
  header: Header;
  child_frame_id: string;
  transform: { translation: Point; rotation: Quaternion };
}
export interface LaserScan {
  header: Header;
  angle_min: number;
  angle_max: number;
  angle_increment: number;
  time_increment: number;
  scan_time: number;
  range_min: number;
  range_max: number;
  ranges: Float32Array;
  intensities: Float32Array;
}
export interface PointField {
  name: string;
  offset: number;
  datatype: number;
  count: number;
}
export interface PointCloud2 {
  header: Header;
  height: number;
  width: number;
  fields: PointField[];
  is_bigendian: boolean;
  point_step: number;
  row_step: number;
  data: Uint8Array;
}
export interface OccupancyGrid {
  header: Header;
  info: { resolution: number; width: number; height: number; origin: PoseMessage };
  data: Int8Array;
}
export interface OccupancyGridUpdate {
  header: Header;
  x: number;
  y: number;
  width: number;
  height: number;
  data: Int8Array;
}
export interface Color {
  r: number;
  g: number;
  b: number;
  a: number;
}
export interface Marker {
  header: Header;
  ns: string;
  id: number;
  type: number;
  action: number;
  pose: PoseMessage;
  scale: Point;
  color: Color;
  lifetime: Stamp;
  frame_locked: boolean;
  points: Point[];
  colors: Color[];
  text: string;
  texture_resource?: string;
  mesh_resource: string;
  mesh_use_embedded_materials: boolean;
}
export interface ImageMessage {
  header: Header;
  height: number;
  width: number;
  encoding: string;
  is_bigendian: number;
  step: number;
  data: Uint8Array;
}
export interface CameraInfo {
  header: Header;
  height: number;
  width: number;
  k: Float64Array;
  p: Float64Array;
}
export interface Odometry {
  header: Header;
  child_frame_id: string;
  pose: { pose: PoseMessage; covariance: Float64Array };
  twist: { twist: { linear: Point; angular: Point } };
}
export interface Path {
  header: Header;
  poses: { header: Header; pose: PoseMessage }[];
}

/** Time stamp in seconds. Equal stamps give equal numbers. */
export function seconds(stamp: Stamp): number {
  return stamp.sec + stamp.nanosec * 1e-9;
}

export function stampOf(seconds: number): Stamp {
  const sec = Math.floor(seconds);
  return { sec, nanosec: Math.min(999_999_999, Math.round((seconds - sec) * 1e9)) };
}

export function poseOf(m: PoseMessage): Pose {
  const { position: p, orientation: o } = m;
  return { t: [p.x, p.y, p.z], q: normalize([o.x, o.y, o.z, o.w]) };
}

export function messageOf(p: Pose): PoseMessage {
  return {
    position: { x: p.t[0], y: p.t[1], z: p.t[2] },
    orientation: { x: p.q[0], y: p.q[1], z: p.q[2], w: p.q[3] },
  };
}
