/** RobotModel: the links of a URDF at the poses given by TF. */
import { Color, Group, Mesh, type Object3D } from 'three';
import type { Message } from '../core/cdr';
import { copyOf } from '../scene/meshes';
import { matrixOf, surface, UNIT_BOX, UNIT_CYLINDER, UNIT_SPHERE } from '../scene/shapes';
import { dispose } from '../scene/stage';
import { Display, type Kind } from './display';
import { boxOf, leadRadius, principal } from './inertia';
import { alpha, bool, choice, number, text, topic } from './options';
import { readUrdf, type Link, type Part, type Robot } from './urdf';
import { t } from '../texts/language.svelte';

const PLAIN = '#9fb3c8';
const MASS = new Color('#e5383b');
const INERTIA = new Color('#2fb344');

class RobotModelDisplay extends Display {
  private robot?: Robot;
  private description = '';
  private links = new Map<string, Group>();
  private version = -1;
  private lookedMs = 0;
  private missing = new Set<string>();

  override start(): void {
    // RViz has its own option names for the file and the topic.
    this.values.Topic = this.values['Description Topic'] ?? '';
    super.start();
    if (this.get('Description Source') === 'File') void this.fromFile();
  }

  private async fromFile(): Promise<void> {
    const file = this.get<string>('Description File');
    if (!file) return;
    try {
      const bytes = await this.context.asset(file.includes('://') ? file : `file://${file}`);
      this.build(new TextDecoder().decode(bytes));
    } catch (error) {
      this.host.status('Description', 'error', `${file}: ${(error as Error).message}`);
    }
  }

  protected override receive(message: Message): void {
    if (this.get('Description Source') === 'File') return;
    this.build(String(message.data ?? ''));
  }

  private build(description: string): void {
    // A jump in a recording gives the same text again.
    if (this.robot && description === this.description) return;
    this.description = description;
    this.robot = readUrdf(description);
    // A click on the robot chooses it.
    this.root.userData.robotTopic = this.values.Topic;
    this.host.status(
      'Description',
      'ok',
      t().displays.links(this.robot.name, this.robot.links.length),
    );
    this.rebuild();
  }

  private rebuild(): void {
    this.empty();
    this.links.clear();
    this.missing.clear();
    this.host.status('Meshes', 'ok');
    this.host.status('Textures', 'ok');
    this.host.status('Inertia', 'ok');
    for (const link of this.robot?.links ?? []) {
      const group = new Group();
      group.matrixAutoUpdate = false;
      group.visible = false;
      group.userData.inspect = () => ({
        [t().found.link]: link.name,
        [t().found.mass]: `${link.mass} kg`,
        [t().found.robot]: this.robot!.name,
      });
      this.links.set(link.name, group);
      this.root.add(group);
      this.fill(group, link);
    }
    this.version = -1;
    this.context.stage.invalidate();
  }

  private fill(group: Group, link: Link): void {
    if (!(`Links/${link.name}` in this.values)) this.host.note(`Links/${link.name}`, true);
    if (this.values[`Links/${link.name}`] === false) return;
    if (this.get('Visual Enabled')) for (const part of link.visuals) this.part(group, part, false);
    if (this.get('Collision Enabled')) for (const p of link.collisions) this.part(group, p, true);
    if (link.mass > 0) this.masses(group, link);
  }

  /** Mass as a red ball of lead, inertia as the green box of equal inertia, as in RViz. */
  private masses(group: Group, link: Link): void {
    const middle = matrixOf(link.linkFromMass);
    const put = (mesh: Mesh) => {
      const holder = new Group();
      holder.matrixAutoUpdate = false;
      holder.matrix.copy(middle);
      group.add(holder.add(mesh));
    };
    if (this.get('Mass Properties/Mass')) {
      const ball = new Mesh(UNIT_SPHERE, surface(MASS));
      ball.scale.setScalar(2 * leadRadius(link.mass));
      put(ball);
    }
    if (!this.get('Mass Properties/Inertia')) return;
    const { moments, turn } = principal(link.inertia);
    const size = boxOf(link.mass, moments);
    if (!size) {
      this.host.status('Inertia', 'warn', t().displays.impossibleInertia(link.name));
      return;
    }
    const box = new Mesh(UNIT_BOX, surface(INERTIA, 0.5));
    box.scale.copy(size);
    box.quaternion.copy(turn);
    put(box);
  }

  private part(group: Group, part: Part, isCollision: boolean): void {
    const opacity = this.get<number>('Alpha') * (part.rgba?.[3] ?? 1) * (isCollision ? 0.5 : 1);
    const [r, g, b] = part.rgba ?? [];
    const given = r === undefined ? undefined : new Color().setRGB(r, g!, b!, 'srgb');
    const color = isCollision ? new Color('#e0763c') : (given ?? new Color(PLAIN));
    const holder = new Group();
    holder.matrixAutoUpdate = false;
    holder.matrix.copy(matrixOf(part.linkFromPart));
    group.add(holder);
    const { shape } = part;
    if (shape.kind === 'mesh') {
      void this.mesh(holder, shape.uri, shape.scale, isCollision ? color : given, opacity);
      return;
    }
    const geometry =
      shape.kind === 'box' ? UNIT_BOX : shape.kind === 'sphere' ? UNIT_SPHERE : UNIT_CYLINDER;
    const mesh = new Mesh(geometry, surface(color, opacity));
    mesh.castShadow = mesh.receiveShadow = true;
    if (shape.kind === 'box') mesh.scale.set(...shape.size);
    else if (shape.kind === 'sphere') mesh.scale.setScalar(shape.radius * 2);
    else mesh.scale.set(shape.radius * 2, shape.radius * 2, shape.length);
    holder.add(mesh);
  }

  private async mesh(
    holder: Object3D,
    uri: string,
    scale: [number, number, number],
    color: Color | undefined,
    opacity: number,
  ): Promise<void> {
    try {
      const { object, problem } = await this.context.meshes.load(uri);
      if (problem) this.host.status('Textures', 'warn', problem);
      const copy = copyOf(object, color, opacity, !!color);
      copy.scale.set(...scale);
      holder.add(copy);
      this.context.stage.invalidate();
    } catch (error) {
      this.missing.add(uri);
      const first = [...this.missing][0]!;
      const more = this.missing.size > 1 ? t().displays.andMore(this.missing.size - 1) : '';
      this.host.status('Meshes', 'error', `${first}${more}: ${(error as Error).message}`);
    }
  }

  override changed(path: string): void {
    if (path === 'Links/All Links Enabled') this.toggleAll('Links/', path);
    if (path.startsWith('Description')) this.start();
    else if (path !== 'TF Prefix' && path !== 'Update Interval') this.rebuild();
    this.version = -1;
    super.changed(path);
  }

  override moved(): void {
    this.version = -1;
  }

  /** The model stays: its meshes take long to load, and few recordings change it. */
  override reset(): void {
    this.version = -1;
  }

  override tick(nowMs: number): void {
    const { tf } = this.context;
    if (tf.version === this.version) return;
    if (nowMs - this.lookedMs < this.get<number>('Update Interval') * 1000) return;
    this.version = tf.version;
    this.lookedMs = nowMs;
    const prefix = this.get<string>('TF Prefix');
    const lost: string[] = [];
    for (const [name, group] of this.links) {
      const frame = framePrefix(prefix) + name;
      const found = tf.lookup(this.context.fixedFrame(), frame);
      group.visible = found.kind === 'found';
      if (found.kind === 'found') {
        group.matrix.copy(matrixOf(found.pose));
        group.matrixWorldNeedsUpdate = true;
      } else lost.push(name);
    }
    const many = lost.length > 3 ? t().displays.andMore(lost.length - 3) : '';
    this.host.status(
      'Transform',
      lost.length > 0 ? 'error' : 'ok',
      lost.length > 0
        ? t().displays.noTransformTo(
            `${lost.slice(0, 3).join(', ')}${many}`,
            this.context.fixedFrame(),
          )
        : undefined,
    );
    this.context.stage.invalidate();
  }

  override clear(): void {
    this.robot = undefined;
    for (const group of this.links.values()) dispose(group);
    this.links.clear();
  }
}

/** RViz's prefix is a namespace; that of a second recording ends with a colon. */
const framePrefix = (prefix: string) =>
  !prefix || prefix.endsWith(':') ? prefix : `${prefix.replace(/\/$/, '')}/`;

const TEXT = ['std_msgs/msg/String'];

export const robotModel: Kind = {
  class: 'rviz_default_plugins/RobotModel',
  also: ['rviz/RobotModel'],
  title: 'RobotModel',
  get help() {
    return t().displayHelp.robotModel;
  },
  types: [],
  options: [
    bool('Visual Enabled', true),
    bool('Collision Enabled', false),
    number('Update Interval', 0, { min: 0, step: 0.1 }),
    alpha('Alpha', 1),
    choice('Description Source', 'Topic', ['Topic', 'File']),
    text('Description File', '', { when: (v) => v['Description Source'] === 'File' }),
    ...topic('Description Topic', '/robot_description', TEXT, { durability: 'Transient Local' }),
    text('TF Prefix', ''),
    bool('Links/All Links Enabled', true),
    bool('Mass Properties/Inertia', false),
    bool('Mass Properties/Mass', false),
  ],
  make: (...all) => new RobotModelDisplay(...all),
};
