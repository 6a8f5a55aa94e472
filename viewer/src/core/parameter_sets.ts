/** Parameter files of ROS 2, as Nav2 has them: nodes with `ros__parameters`, and nested names. */
import { dump, load } from 'js-yaml';
import type { Parameter, ParameterValue } from './protocol';
import { isEqual } from './tree';

/** Full name ("/amcl.max_beams") and value. */
export type ParameterSet = Map<string, ParameterValue>;

type Tree = { [key: string]: unknown };
const isTree = (value: unknown): value is Tree =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

const ROOT = 'ros__parameters';

/** Writes parameters of nodes. Floats without a fraction keep a point: `1.0` is no integer in ROS. */
export function writeParameters(parameters: readonly Parameter[]): string {
  const out: Tree = {};
  for (const { name: full, value, type } of parameters) {
    if (value === undefined || value === null) continue;
    const dot = full.indexOf('.');
    if (dot < 0) continue;
    const node = full.slice(0, dot);
    const tree = ((out[node] ??= { [ROOT]: {} }) as Tree)[ROOT] as Tree;
    put(tree, full.slice(dot + 1).split('.'), marked(value, type));
  }
  const text = dump(out, { lineWidth: -1, sortKeys: true, noRefs: true, flowLevel: 20 });
  return text.replace(/'?§float (.*?)§'?/g, '$1');
}

/** A number of a floating-point parameter is marked, and gets its point in the text. */
function marked(value: ParameterValue, type: string | undefined): unknown {
  const isFloat = type === 'float64' || type === 'float64_array';
  if (Array.isArray(value)) return value.map((one) => marked(one, type));
  if (!isFloat) return value;
  if (typeof value !== 'number' || !Number.isInteger(value)) return special(value);
  return `§float ${value.toFixed(1)}§`;
}

/** NaN and infinities, as the protocol writes them, in the words of YAML. */
function special(value: ParameterValue): unknown {
  switch (value) {
    case 'NaN':
      return NaN;
    case 'Infinity':
      return Infinity;
    case '-Infinity':
      return -Infinity;
    default:
      return value;
  }
}

/** Puts a value at a path. A name that is a value and a group at once stays one name with dots. */
function put(tree: Tree, path: readonly string[], value: unknown): void {
  const [first = '', ...rest] = path;
  if (rest.length === 0) {
    tree[first] = value;
    return;
  }
  const inner = (tree[first] ??= {});
  if (isTree(inner)) put(inner, rest, value);
  else tree[path.join('.')] = value;
}

/** Reads a file; fails if it is no YAML or has no parameters. */
export function readParameters(text: string): ParameterSet {
  const out: ParameterSet = new Map();
  const visit = (tree: Tree, node: string): void => {
    for (const [key, inner] of Object.entries(tree)) {
      if (key === ROOT && isTree(inner)) values(inner, node, '', out);
      else if (isTree(inner)) visit(inner, `${node}/${key.replace(/^\//, '')}`.replace('//', '/'));
    }
  };
  const root = load(text);
  if (isTree(root)) visit(root, '');
  return out;
}

function values(tree: Tree, node: string, prefix: string, out: ParameterSet): void {
  for (const [key, inner] of Object.entries(tree)) {
    const name = prefix ? `${prefix}.${key}` : key;
    if (isTree(inner)) values(inner, node, name, out);
    else if (inner !== null && inner !== undefined) {
      out.set(`${node}.${name}`, protocolValue(inner));
    }
  }
}

/** NaN and infinities as the protocol has them. */
function protocolValue(value: unknown): ParameterValue {
  if (Array.isArray(value)) return value.map(protocolValue);
  if (typeof value === 'number' && !Number.isFinite(value)) return String(value);
  if (value instanceof Date) return value.toISOString();
  return value as ParameterValue;
}

export interface Difference {
  name: string;
  present: ParameterValue;
  wanted: ParameterValue;
}

/** Names of a file that fit a parameter: by its full name, with wildcards, or by the name of the node alone. */
export function matchingNames(fileName: string, present: readonly string[]): string[] {
  const dot = fileName.indexOf('.');
  const [node, rest] = [fileName.slice(0, dot), fileName.slice(dot)];
  // `/**` stands for all nodes, `*` for one part of a name.
  const pattern = node
    .split(/(\*\*|\*)/)
    .map((part) =>
      part === '**' ? '.*' : part === '*' ? '[^/]*' : part.replace(/[.+?^${}()|[\]\\]/g, '\\$&'),
    )
    .join('');
  const expression = new RegExp(`^${pattern}$`);
  return present.filter((name) => {
    const at = name.indexOf('.');
    return name.slice(at) === rest && expression.test(name.slice(0, at));
  });
}

/** What applying a set would change, and the names that no node has. */
export function differences(
  set: ParameterSet,
  present: Readonly<Record<string, Parameter>>,
): { changes: Difference[]; missing: string[] } {
  const changes = new Map<string, Difference>();
  const missing: string[] = [];
  const names = Object.keys(present);
  for (const [fileName, wanted] of set) {
    const found = matchingNames(fileName, names);
    if (found.length === 0) missing.push(fileName);
    for (const name of found) {
      const now = present[name]!.value;
      // A later entry of the file wins.
      changes.delete(name);
      if (!isEqual(now, wanted)) changes.set(name, { name, present: now, wanted });
    }
  }
  return {
    changes: [...changes.values()].sort((a, b) => (a.name < b.name ? -1 : 1)),
    missing: missing.sort(),
  };
}

/** Types of `rcl_interfaces/msg/ParameterType`. */
const TYPES: Record<string, number> = { bool: 1, integer: 2, double: 3, string: 4 };

/** Value as `rcl_interfaces/msg/ParameterValue`; the type is that of the present value. */
export function parameterMessage(
  wanted: ParameterValue,
  { value: present, type }: Parameter,
): Record<string, unknown> {
  const isFloat = type === 'float64' || type === 'float64_array';
  const kindOf = (one: unknown) =>
    typeof one === 'boolean'
      ? 'bool'
      : isFloat
        ? 'double'
        : typeof one === 'number'
          ? 'integer'
          : 'string';
  if (Array.isArray(wanted)) {
    const like = wanted[0] ?? (Array.isArray(present) ? present[0] : undefined) ?? '';
    const kind = kindOf(like);
    const list = isFloat ? wanted.map(Number) : wanted;
    return { type: TYPES[kind]! + 5, [`${kind}_array_value`]: list };
  }
  const kind = kindOf(wanted);
  return { type: TYPES[kind], [`${kind}_value`]: kind === 'double' ? Number(wanted) : wanted };
}
