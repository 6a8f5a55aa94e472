/** LaserScan, PointCloud2 and DepthCloud: points that are kept for the decay time. */
import type { Message } from '../core/cdr';
import type { Need } from '../core/feed';
import type { Pose } from '../core/pose';
import {
  seconds,
  type CameraInfo,
  type Header,
  type ImageMessage,
  type LaserScan,
  type PointCloud2,
} from '../core/types';
import { Cloud, thinned, type Rows, type Style } from '../scene/cloud';
import { dispose } from '../scene/stage';
import { cloudOptions, appearanceOf } from './cloud_appearance';
import { rowsOfCloud, rowsOfScan } from './cloud_rows';
import { depthRows } from './depth';
import { FramedDisplay, type Kind } from './display';
import { alpha, number, topic, type Values } from './options';
import { t } from '../texts/language.svelte';

/** Maximum number of points drawn without a GPU. */
const MOST_WITHOUT_GPU = 60_000;

interface Shown {
  cloud: Cloud;
  stampS: number;
}

export abstract class PointsDisplay<M extends { header: Header }> extends FramedDisplay<M> {
  private shown: Shown[] = [];

  protected abstract rows(message: M): Rows;

  protected override need(): Need {
    return { historyS: this.get<number>('Decay Time') };
  }

  protected override show(message: M, fixedFromFrame: Pose): void {
    const all = this.rows(message);
    const rows = thinned(all, this.context.stage.isSoftware ? MOST_WITHOUT_GPU : Infinity);
    const stampS = seconds(message.header.stamp);
    const style = this.get<Style>('Style');
    const decayS = this.get<number>('Decay Time');
    this.expire(decayS);
    const reusable = this.shown[this.shown.length - 1];
    let entry = decayS > 0 || reusable?.cloud.style !== style ? undefined : reusable;
    if (!entry) {
      if (!(decayS > 0)) this.clear();
      entry = { cloud: new Cloud(style), stampS };
      this.shown.push(entry);
      this.root.add(entry.cloud.object);
      entry.cloud.object.userData.inspect = (index: number) => this.inspect(entry!.cloud, index);
    }
    entry.stampS = stampS;
    entry.cloud.show(rows);
    entry.cloud.setAppearance(appearanceOf(this.values, rows, fixedFromFrame));
    entry.cloud.object.userData.isMark = !this.get('Selectable');
    this.put(entry.cloud.object, fixedFromFrame);
    this.host.status('Points', 'ok', t().displays.points(all.count, rows.every));
  }

  private inspect(cloud: Cloud, index: number): Record<string, string> {
    const point = cloud.at(index);
    if (!point) return {};
    const { x, y, z } = point.xyz;
    const out: Record<string, string> = {
      [t().found.display]: String(this.values.Topic ?? ''),
      [t().found.inFrame]: `${x.toFixed(3)}, ${y.toFixed(3)}, ${z.toFixed(3)} m`,
      [t().found.range]: t().found.rangeAt(
        Math.hypot(x, y, z).toFixed(3),
        ((Math.atan2(y, x) * 180) / Math.PI).toFixed(2),
      ),
    };
    if (point.value !== undefined) out[t().found.value] = point.value.toFixed(3);
    return out;
  }

  /** Kept for the inspection of the point under the mouse. */
  clouds(): Cloud[] {
    return this.shown.map((s) => s.cloud);
  }

  private expire(decayS: number): void {
    if (!(decayS > 0)) return;
    const nowS = this.context.nowS();
    while (this.shown.length > 0 && nowS - this.shown[0]!.stampS > decayS) {
      dispose(this.shown.shift()!.cloud.object);
    }
  }

  override clear(): void {
    this.shown = [];
    super.clear();
  }
}

class LaserScanDisplay extends PointsDisplay<LaserScan> {
  protected override rows(message: LaserScan): Rows {
    return rowsOfScan(message);
  }
}

class PointCloud2Display extends PointsDisplay<PointCloud2> {
  protected override rows(message: PointCloud2): Rows {
    const isFloats = this.get('Color Transformer') === 'RGBF32';
    return rowsOfCloud(message, this.get('Channel Name'), isFloats);
  }
}

class DepthCloudDisplay extends PointsDisplay<ImageMessage> {
  private info?: CameraInfo;
  private color?: ImageMessage;
  private others: (() => void)[] = [];

  override start(): void {
    for (const unsubscribe of this.others) unsubscribe();
    this.others = [];
    const depth = this.get<string>('Depth Map Topic');
    this.values.Topic = depth;
    super.start();
    if (!depth) return;
    const base = depth.slice(0, depth.lastIndexOf('/'));
    const subscribe = (name: string, handler: (message: Message) => void) => {
      if (name) this.others.push(this.context.subscribe(name, handler));
    };
    // ROS publishes it next to the image; for Gazebo Classic's depth cameras it has the same name in the namespace `depth`.
    subscribe(`${base}/camera_info`, (message) => (this.info = message as never));
    subscribe(this.get('Color Image Topic'), (message) => (this.color = message as never));
  }

  override changed(path: string): void {
    if (path.endsWith('Topic')) {
      this.clear();
      this.start();
    }
    super.changed(path);
  }

  protected override rows(message: ImageMessage): Rows {
    if (!this.info) {
      throw new Error(t().displays.noCameraInfo);
    }
    return depthRows(message, this.info, this.color);
  }

  override stop(): void {
    for (const unsubscribe of this.others) unsubscribe();
    super.stop();
  }
}

const SCAN = ['sensor_msgs/msg/LaserScan'];
const CLOUD = ['sensor_msgs/msg/PointCloud2'];
const IMAGE = ['sensor_msgs/msg/Image'];

export const laserScan: Kind = {
  class: 'rviz_default_plugins/LaserScan',
  also: ['rviz/LaserScan'],
  title: 'LaserScan',
  get help() {
    return t().displayHelp.laserScan;
  },
  types: SCAN,
  options: [...topic('Topic', '', SCAN, { isFiltered: true }), ...cloudOptions('Intensity')],
  make: (...all) => new LaserScanDisplay(...all),
};

export const pointCloud2: Kind = {
  class: 'rviz_default_plugins/PointCloud2',
  also: ['rviz/PointCloud2'],
  title: 'PointCloud2',
  get help() {
    return t().displayHelp.pointCloud2;
  },
  types: CLOUD,
  options: [...topic('Topic', '', CLOUD, { isFiltered: true }), ...cloudOptions('Intensity')],
  make: (...all) => new PointCloud2Display(...all),
};

const depthOptions = cloudOptions('RGB8').filter((option) => option.path !== 'Decay Time');
export const depthCloud: Kind = {
  class: 'rviz_default_plugins/DepthCloud',
  also: ['rviz/DepthCloud'],
  title: 'DepthCloud',
  get help() {
    return t().displayHelp.depthCloud;
  },
  types: IMAGE,
  options: [
    { path: 'Depth Map Topic', kind: 'topic', default: '', types: IMAGE },
    { path: 'Color Image Topic', kind: 'topic', default: '', types: IMAGE },
    ...depthOptions.map((option) => (option.path === 'Alpha' ? alpha('Alpha', 1) : option)),
    number('Decay Time', 0, { min: 0 }),
  ],
  make: (context, values: Values, host) => new DepthCloudDisplay(context, values, host),
};
