/** Marker and MarkerArray: shapes published by nodes. */
import { Group } from 'three';
import type { Message } from '../core/cdr';
import { multiply, type Pose } from '../core/pose';
import { poseOf, seconds, type Marker } from '../core/types';
import { dispose } from '../scene/stage';
import { Display, type Kind } from './display';
import { markerObject } from './marker_shapes';
import { topic } from './options';
import { t } from '../texts/language.svelte';

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
  private entries = new Map<string, Entry>();
  /** Markers received since the last frame; a newer one replaces an older one with the same name. */
  private received = new Map<string, { marker: Marker; receivedS: number }>();
  private fixed = '';

  protected override receive(message: Message): void {
    const all =
      'markers' in message ? (message.markers as Marker[]) : [message as unknown as Marker];
    for (const marker of all) this.take(marker);
    this.context.stage.invalidate();
  }

  private take(marker: Marker): void {
    const key = `${marker.ns}\n${marker.id}`;
    if (marker.action === DELETE_ALL) {
      for (const name of [...this.entries.keys(), ...this.received.keys()]) {
        if (!marker.ns || name.startsWith(`${marker.ns}\n`)) this.drop(name);
      }
    } else if (marker.action === DELETE) this.drop(key);
    else if (marker.action === ADD) {
      this.received.set(key, { marker, receivedS: this.context.nowS() });
    }
  }

  /** Builds the markers received since the last frame. */
  private build(): void {
    const received = [...this.received];
    this.received.clear();
    for (const [key, { marker, receivedS }] of received) this.add(key, marker, receivedS);
    const names = new Set(received.map(([, { marker }]) => marker.ns));
    for (const ns of names) {
      if (!(`Namespaces/${ns}` in this.values)) this.host.note(`Namespaces/${ns}`, true);
    }
    this.host.status('Markers', 'ok', t().displays.markers(this.entries.size));
  }

  private add(key: string, marker: Marker, receivedS: number): void {
    const life = seconds(marker.lifetime);
    const untilS = life > 0 ? receivedS + life : Infinity;
    if (this.context.nowS() > untilS) {
      this.drop(key);
      return;
    }
    const isReplaced = this.entries.has(key);
    this.drop(key);
    const object = new Group();
    object.matrixAutoUpdate = true;
    object.visible = false;
    object.userData.inspect = () => ({
      [t().found.marker]: `${marker.ns || t().found.noNamespace} ${marker.id}`,
      [t().found.frame]: marker.header.frame_id,
      ...(marker.text ? { [t().found.text]: marker.text } : {}),
    });
    const done = (why?: string) => {
      if (why) this.host.status('Meshes', 'error', why);
      this.context.stage.invalidate();
    };
    try {
      object.add(markerObject(marker, this.context.meshes, done));
    } catch (error) {
      this.host.status('Message', 'error', (error as Error).message);
      return;
    }
    this.root.add(object);
    const entry = {
      marker,
      object,
      isPlaced: false,
      sinceMs: performance.now(),
      untilS,
    };
    this.entries.set(key, entry);
    if (isReplaced) this.place(entry, performance.now(), true);
  }

  private drop(key: string): void {
    const entry = this.entries.get(key);
    if (entry) dispose(entry.object);
    this.entries.delete(key);
    this.received.delete(key);
  }

  /**
   * Places a marker by the transform at its time. `isReplaced`: it takes the place of another one, and is shown by
   * the newest transform until that at its time arrives. Otherwise frequent markers would never be visible.
   */
  private place(entry: Entry, nowMs: number, isReplaced = false): void {
    const { marker } = entry;
    const { tf } = this.context;
    const isLate = nowMs - entry.sinceMs > PATIENCE_MS;
    const stamp = seconds(marker.header.stamp);
    const at = marker.frame_locked || isLate || stamp === 0 ? undefined : stamp;
    const found = tf.lookup(this.context.fixedFrame(), marker.header.frame_id, at);
    if (found.kind === 'later') {
      if (isLate) this.host.status('Transform', 'error', found.why);
      const newest = tf.lookup(this.context.fixedFrame(), marker.header.frame_id);
      if (isReplaced && newest.kind === 'found') this.show(entry, newest.pose);
      return;
    }
    if (found.kind === 'never') {
      entry.sinceMs = -Infinity;
      return;
    }
    this.host.status('Transform', 'ok');
    entry.isPlaced = true;
    this.show(entry, found.pose);
  }

  private show(entry: Entry, fixedFromFrame: Pose): void {
    const { marker } = entry;
    const pose = multiply(fixedFromFrame, poseOf(marker.pose));
    entry.object.position.set(...pose.t);
    entry.object.quaternion.set(...pose.q);
    entry.object.visible = this.values[`Namespaces/${marker.ns}`] !== false;
    this.context.stage.invalidate();
  }

  override tick(nowMs: number): void {
    if (this.received.size > 0) this.build();
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
    this.received.clear();
    for (const key of [...this.entries.keys()]) this.drop(key);
  }
}

const MARKER = ['visualization_msgs/msg/Marker'];
const ARRAY = ['visualization_msgs/msg/MarkerArray'];

export const marker: Kind = {
  class: 'rviz_default_plugins/Marker',
  also: ['rviz/Marker'],
  title: 'Marker',
  get help() {
    return t().displayHelp.marker;
  },
  types: MARKER,
  options: topic('Topic', '', MARKER, { isFiltered: true }),
  make: (...all) => new MarkerDisplay(...all),
};

export const markerArray: Kind = {
  class: 'rviz_default_plugins/MarkerArray',
  also: ['rviz/MarkerArray'],
  title: 'MarkerArray',
  get help() {
    return t().displayHelp.markerArray;
  },
  types: ARRAY,
  options: topic('Topic', '', ARRAY),
  make: (...all) => new MarkerDisplay(...all),
};
