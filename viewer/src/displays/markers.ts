/** Marker and MarkerArray: shapes published by nodes. */
import { Group } from 'three';
import type { Message } from '../core/cdr';
import { multiply } from '../core/pose';
import { poseOf, seconds, type Marker } from '../core/types';
import { MeshLibrary } from '../scene/meshes';
import { dispose } from '../scene/stage';
import { Display, type Kind } from './display';
import { markerObject } from './marker_shapes';
import { topic } from './options';

interface Entry {
  marker: Marker;
  object: Group;
  isPlaced: boolean;
  sinceMs: number;
  /** Time at which the marker expires, in the time of the messages [s]. */
  untilS: number;
}

const PATIENCE_MS = 700;
const ADD = 0;
const DELETE = 2;
const DELETE_ALL = 3;

export class MarkerDisplay extends Display {
  protected entries = new Map<string, Entry>();
  private library = new MeshLibrary((uri) => this.context.asset(uri));
  private fixed = '';

  protected override receive(message: Message): void {
    const all =
      'markers' in message ? (message.markers as Marker[]) : [message as unknown as Marker];
    for (const marker of all) this.update(marker);
    const names = [...new Set([...this.entries.values()].map((e) => e.marker.ns))];
    for (const ns of names) {
      if (!(`Namespaces/${ns}` in this.values)) this.host.note(`Namespaces/${ns}`, true);
    }
    this.host.status('Markers', 'ok', `${this.entries.size} markers`);
    this.context.stage.invalidate();
  }

  private update(marker: Marker): void {
    const key = `${marker.ns}\n${marker.id}`;
    if (marker.action === DELETE_ALL) {
      for (const name of [...this.entries.keys()]) {
        if (!marker.ns || name.startsWith(`${marker.ns}\n`)) this.drop(name);
      }
    } else if (marker.action === DELETE) this.drop(key);
    else if (marker.action === ADD) {
      const wasVisible = this.entries.get(key)?.isPlaced;
      this.drop(key);
      const object = new Group();
      object.matrixAutoUpdate = true;
      object.visible = false;
      object.userData.inspect = () => ({
        Marker: `${marker.ns || '(no namespace)'} ${marker.id}`,
        Frame: marker.header.frame_id,
        ...(marker.text ? { Text: marker.text } : {}),
      });
      object.add(
        markerObject(marker, this.library, (why) => {
          if (why) this.host.status('Meshes', 'error', why);
          this.context.stage.invalidate();
        }),
      );
      this.root.add(object);
      const life = seconds(marker.lifetime);
      this.entries.set(key, {
        marker,
        object,
        isPlaced: false,
        sinceMs: performance.now(),
        untilS: life > 0 ? this.context.nowS() + life : Infinity,
      });
      if (wasVisible) this.place(this.entries.get(key)!, performance.now());
    }
  }

  private drop(key: string): void {
    const entry = this.entries.get(key);
    if (entry) dispose(entry.object);
    this.entries.delete(key);
  }

  private place(entry: Entry, nowMs: number): void {
    const { marker } = entry;
    const { tf } = this.context;
    const isLate = nowMs - entry.sinceMs > PATIENCE_MS;
    const stamp = seconds(marker.header.stamp);
    const at = marker.frame_locked || isLate || stamp === 0 ? undefined : stamp;
    const found = tf.lookup(this.context.fixedFrame(), marker.header.frame_id, at);
    if (found.kind === 'later') {
      if (isLate) this.host.status('Transform', 'error', found.why);
      return;
    }
    if (found.kind === 'never') {
      entry.sinceMs = -Infinity;
      return;
    }
    this.host.status('Transform', 'ok');
    entry.isPlaced = true;
    const pose = multiply(found.pose, poseOf(marker.pose));
    entry.object.position.set(...pose.t);
    entry.object.quaternion.set(...pose.q);
    entry.object.visible = this.values[`Namespaces/${marker.ns}`] !== false;
    this.context.stage.invalidate();
  }

  override tick(nowMs: number): void {
    const fixed = this.context.fixedFrame();
    const isMoved = fixed !== this.fixed;
    this.fixed = fixed;
    const nowS = this.context.nowS();
    for (const [key, entry] of this.entries) {
      if (nowS > entry.untilS) {
        this.drop(key);
        this.context.stage.invalidate();
      } else if (!entry.isPlaced || entry.marker.frame_locked || isMoved) {
        if (isMoved) entry.sinceMs = nowMs;
        this.place(entry, nowMs);
      }
    }
  }

  override changed(path: string): void {
    super.changed(path);
    for (const { marker, object, isPlaced } of this.entries.values()) {
      object.visible = isPlaced && this.values[`Namespaces/${marker.ns}`] !== false;
    }
  }

  override clear(): void {
    for (const key of [...this.entries.keys()]) this.drop(key);
  }
}

const MARKER = ['visualization_msgs/msg/Marker'];
const ARRAY = ['visualization_msgs/msg/MarkerArray'];

export const marker: Kind = {
  class: 'rviz_default_plugins/Marker',
  also: ['rviz/Marker'],
  title: 'Marker',
  help: 'A shape published by a node',
  types: MARKER,
  options: topic('Topic', '', MARKER, { isFiltered: true }),
  make: (...all) => new MarkerDisplay(...all),
};

export const markerArray: Kind = {
  class: 'rviz_default_plugins/MarkerArray',
  also: ['rviz/MarkerArray'],
  title: 'MarkerArray',
  help: 'Shapes published by a node',
  types: ARRAY,
  options: topic('Topic', '', ARRAY),
  make: (...all) => new MarkerDisplay(...all),
};
