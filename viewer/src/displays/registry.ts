/** All displays, and the default display of each message type. */
import { depthCloud, laserScan, pointCloud2 } from './clouds';
import type { Kind } from './display';
import { effort } from './effort';
import { axes, grid, tf } from './frames';
import { camera, image } from './image';
import { interactiveMarkers } from './interactive';
import { visualizeLidar } from './lidar';
import { map } from './map';
import { mapDifference } from './map_difference';
import { marker, markerArray } from './markers';
import {
  odometry,
  particleCloud,
  path,
  polygon,
  pose,
  poseArray,
  poseWithCovariance,
  range,
} from './poses';
import { robotModel } from './robot';
import { fluidPressure, illuminance, relativeHumidity, temperature } from './scalars';
import { accelStamped, gridCells, pointStamped, twistStamped, wrench } from './stamped';
import { voxelGrid } from './voxels';
import { world } from './world';

export const KINDS: readonly Kind[] = [
  accelStamped,
  axes,
  camera,
  depthCloud,
  effort,
  fluidPressure,
  grid,
  gridCells,
  illuminance,
  image,
  interactiveMarkers,
  laserScan,
  map,
  mapDifference,
  marker,
  markerArray,
  odometry,
  particleCloud,
  path,
  pointCloud2,
  pointStamped,
  polygon,
  pose,
  poseArray,
  poseWithCovariance,
  range,
  relativeHumidity,
  robotModel,
  temperature,
  tf,
  twistStamped,
  visualizeLidar,
  voxelGrid,
  world,
  wrench,
];

/** Display with this class name in an `.rviz` file, of any RViz version. */
export function kindOf(name: string): Kind | undefined {
  return KINDS.find((kind) => kind.class === name || kind.also?.includes(name));
}

/** Default display of a message type. */
export function kindForType(type: string): Kind | undefined {
  return KINDS.find((kind) => kind.types.includes(type) && kind !== camera && kind !== depthCloud);
}
