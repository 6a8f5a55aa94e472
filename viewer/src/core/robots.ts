/**
 * Robots of a system, found by what is on the wire: descriptions, transforms, velocity commands, navigators. Works for
 * running systems and recordings. No DOM.
 */
import { namespacesOf } from './nav2';

export interface Robot {
  /** Namespace of its topics: empty for none, otherwise `/robot1`. It identifies the robot. */
  namespace: string;
  /** Prefix of its frames on this page: empty for none, otherwise `robot1/`. */
  framePrefix: string;
  /** True if its transforms are on separate topics, `/robot1/tf`: the prefix is then added by the page. */
  hasOwnTf: boolean;
  /** Topic of its URDF. */
  description?: string;
  /** Topics of velocity commands, the usual one first. */
  commandTopics: string[];
  /** Namespace of its navigator. */
  navigator?: string;
}

export interface Endpoints {
  name: string;
  type: string;
  publishers: readonly string[];
  subscribers: readonly string[];
}

export interface Wire {
  topics: readonly Endpoints[];
  services: readonly { name: string }[];
  /** Frames on topics that all robots share. */
  frames: readonly string[];
}

/** Frames that robots with separate transforms share: Nav2 gives each of them the same map. */
const SHARED_FRAMES: readonly string[] = ['map', 'world', 'earth'];
/** Gazebo's own topic of a model's transforms, which no ROS program reads unless a bridge renames it. */
const OF_GAZEBO = /^\/model\/[^/]+\/tf$/;
/** Node name under which all pages appear. */
const OWN_NODE = '/viewers';
export const BASE_FRAMES: readonly string[] = ['base_footprint', 'base_link'];

const namespaceOf = (name: string): string => name.slice(0, Math.max(0, name.lastIndexOf('/')));
const isWithin = (name: string, namespace: string): boolean =>
  namespace === '' || name === namespace || name.startsWith(`${namespace}/`);

/** Namespaces that are not within another one of them; all are within the empty one. */
const outermost = (namespaces: Iterable<string>): string[] => {
  const all = [...new Set(namespaces)].sort();
  return all.filter((one) => !all.some((other) => other !== one && isWithin(one, other)));
};

/** True if a program other than this page uses a topic. Recordings have no endpoints. */
function isUsed({ publishers, subscribers }: Endpoints): boolean {
  const nodes = [...publishers, ...subscribers];
  return nodes.length === 0 || nodes.some((node) => node !== OWN_NODE);
}

const isCommand = ({ name, type }: Endpoints): boolean =>
  /(^|\/)cmd_vel$/.test(name) && (!type || /\/Twist(Stamped)?$/.test(type));

/** Robots sorted by namespace. */
export function findRobots({ topics, services, frames }: Wire): Robot[] {
  // Topics of a second recording begin with a letter and a colon.
  const own = topics.filter(({ name }) => name.startsWith('/'));
  const descriptions = own.filter(
    ({ name, type }) => /\/robot_description$/.test(name) && /^$|\/String$/.test(type),
  );
  const transforms = own.filter(
    ({ name, type }) =>
      /.\/tf(_static)?$/.test(name) && /^$|\/TFMessage$/.test(type) && !OF_GAZEBO.test(name),
  );
  const navigators = namespacesOf([...own, ...services].map(({ name }) => name));
  const commands = own.filter((one) => isCommand(one) && isUsed(one));
  const odometry = own.filter(({ name, type }) => /\/odom$/.test(name) && /\/Odometry$/.test(type));
  const prefixes = frames.flatMap((frame) => {
    const at = frame.lastIndexOf('/');
    return at > 0 && BASE_FRAMES.includes(frame.slice(at + 1)) ? [`/${frame.slice(0, at)}`] : [];
  });
  // A prefix of frames alone is no namespace: a single robot may have one.
  const named = prefixes.filter((prefix) => own.some(({ name }) => name.startsWith(`${prefix}/`)));

  const certain = [
    ...[...descriptions, ...transforms].map(({ name }) => namespaceOf(name)),
    ...navigators,
    ...named,
  ];
  const inNamespace = outermost(certain.filter((one) => one !== ''));
  let namespaces = certain.includes('') ? ['', ...inNamespace] : inNamespace;
  if (namespaces.length === 0) {
    const of = (all: readonly Endpoints[]) => outermost(all.map(({ name }) => namespaceOf(name)));
    namespaces = commands.length > 0 ? of(commands) : of(odometry);
  }

  /** The robot to which a name belongs. */
  const ownerOf = (name: string): string | undefined =>
    namespaces.filter((one) => isWithin(name, one)).sort((a, b) => b.length - a.length)[0];
  return namespaces.map((namespace) => {
    const isOwn = ({ name }: { name: string }) => ownerOf(name) === namespace;
    const bare = namespace.slice(1);
    const hasOwnTf = namespace !== '' && transforms.some(isOwn);
    const isPrefixed = prefixes.includes(namespace);
    const only = namespace === '' && named.length === 0 && prefixes.length === 1;
    const alone =
      only && !frames.some((one) => BASE_FRAMES.includes(one)) ? prefixes[0] : undefined;
    const rank = (name: string) => (name === `${namespace}/cmd_vel` ? 0 : 1);
    return {
      namespace,
      framePrefix: alone ? `${alone.slice(1)}/` : hasOwnTf || isPrefixed ? `${bare}/` : '',
      hasOwnTf,
      description: descriptions.find(isOwn)?.name,
      commandTopics: commands
        .filter(isOwn)
        .map(({ name }) => name)
        .sort((a, b) => rank(a) - rank(b)),
      navigator: navigators.find((one) => ownerOf(`${one}/`) === namespace),
    };
  });
}

/** Name for users: that of the namespace. */
export const robotName = ({ namespace }: Pick<Robot, 'namespace'>): string =>
  namespace.slice(1) || '/';

/** The robot to which a topic belongs. */
export function robotOfTopic(robots: readonly Robot[], topic: string): Robot | undefined {
  let found: Robot | undefined;
  for (const robot of robots) {
    if (!isWithin(topic, robot.namespace)) continue;
    if (!found || robot.namespace.length > found.namespace.length) found = robot;
  }
  return found;
}

/** Name on this page of a frame that a robot names. */
export function frameHere(robot: Robot, frame: string): string {
  const bare = frame.startsWith('/') ? frame.slice(1) : frame;
  const { hasOwnTf, framePrefix } = robot;
  if (!hasOwnTf || !bare || SHARED_FRAMES.includes(bare) || bare.startsWith(framePrefix))
    return bare;
  return framePrefix + bare;
}

/** Name of a frame for the robot itself; the inverse of `frameHere`. */
export function frameThere({ hasOwnTf, framePrefix }: Robot, frame: string): string {
  return hasOwnTf && frame.startsWith(framePrefix) ? frame.slice(framePrefix.length) : frame;
}
