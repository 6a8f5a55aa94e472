/** Parser of ROS message definitions ("ros2msg"). */
import { t } from '../texts/language.svelte';

export interface Field {
  name: string;
  /** Primitive type ("float64", "string") or full name of another type ("geometry_msgs/Point"). */
  type: string;
  isComplex: boolean;
  /** Undefined: one value; "sequence": any number of values; a number: an array of this length. */
  array: undefined | 'sequence' | number;
}

export interface Constant {
  name: string;
  type: string;
  value: string;
}

export interface Definition {
  name: string;
  fields: Field[];
  constants: Constant[];
}

/** All types of a definition; `root` is the first. */
export interface Schema {
  root: Definition;
  types: Map<string, Definition>;
}

const PRIMITIVES = new Set(
  (
    'bool byte char int8 uint8 int16 uint16 int32 uint32 int64 uint64 float32 float64 ' +
    'string wstring'
  ).split(' '),
);
/** Primitive types of ROS 1. */
const ALIASES: Record<string, string> = {
  time: 'builtin_interfaces/Time',
  duration: 'builtin_interfaces/Duration',
  Header: 'std_msgs/Header',
};

/** "geometry_msgs/msg/Point" and "geometry_msgs/Point" are the same type. */
export function shortName(type: string): string {
  const parts = type.split('/');
  return parts.length > 2 ? `${parts[0]}/${parts[parts.length - 1]}` : type;
}

/** Name of ROS 2: "geometry_msgs/msg/Point" for "geometry_msgs/Point". */
export function longName(type: string): string {
  const parts = type.split('/');
  return parts.length === 2 ? `${parts[0]}/msg/${parts[1]}` : type;
}

/** Parses the definition of `name` with all types that it uses, separated by lines of `=`. */
export function parseSchema(name: string, text: string): Schema {
  const types = new Map<string, Definition>();
  let root: Definition | undefined;
  for (const part of text.split(/^={3,}\s*$/m)) {
    const header = /^\s*MSG:\s*(\S+)\s*$/m.exec(part);
    const own = shortName(header?.[1] ?? name);
    const written = header ? part.replace(header[0], '') : part;
    const definition = parseOne(own, root || written.trim() ? written : impliedText(own));
    types.set(own, definition);
    root ??= definition;
  }
  for (const word of ['Time', 'Duration']) {
    const own = `builtin_interfaces/${word}`;
    if (!types.has(own)) types.set(own, parseOne(own, 'int32 sec\nuint32 nanosec'));
  }
  return { root: root!, types };
}

const UUID = 'unique_identifier_msgs/UUID goal_id';

/**
 * Definition of a type that an action implies. No file contains it, and servers may send an empty text. Source: ROS 2's
 * design article "Actions".
 */
function impliedText(name: string): string {
  const [, action, end] =
    /\/(\w+?)_(SendGoal_Request|SendGoal_Response|GetResult_Request|GetResult_Response|FeedbackMessage)$/.exec(
      name,
    ) ?? [];
  switch (end) {
    case 'SendGoal_Request':
      return `${UUID}\n${action}_Goal goal`;
    case 'SendGoal_Response':
      return 'bool accepted\nbuiltin_interfaces/Time stamp';
    case 'GetResult_Request':
      return UUID;
    case 'GetResult_Response':
      return `int8 status\n${action}_Result result`;
    case 'FeedbackMessage':
      return `${UUID}\n${action}_Feedback feedback`;
    default:
      return '';
  }
}

function parseOne(name: string, text: string): Definition {
  const definition: Definition = { name, fields: [], constants: [] };
  const own = name.split('/')[0] ?? '';
  for (const raw of text.split('\n')) {
    const line = withoutComment(raw).trim();
    if (!line) continue;
    const constant = /^(\S+)\s+([A-Z][A-Z0-9_]*)\s*=\s*(.*)$/i.exec(line);
    if (constant && !/[<>]/.test(constant[1]!)) {
      definition.constants.push({
        type: constant[1]!,
        name: constant[2]!,
        value: constant[3]!.replace(/^["'](.*)["']$/, '$1'),
      });
      continue;
    }
    const field = /^(\S+)\s+([A-Za-z]\w*)/.exec(line);
    if (!field) throw new Error(t().messages.badLine(name, line));
    definition.fields.push(readField(own, field[1]!, field[2]!));
  }
  return definition;
}

/** Comment after `#`, unless the `#` is inside a string. */
function withoutComment(line: string): string {
  let quote = '';
  for (let i = 0; i < line.length; i++) {
    const c = line[i]!;
    if (quote) {
      if (c === quote) quote = '';
    } else if (c === '"' || c === "'") quote = c;
    else if (c === '#') return line.slice(0, i);
  }
  return line;
}

function readField(own: string, written: string, name: string): Field {
  const array = /\[(<=)?(\d*)\]$/.exec(written);
  let base = (array ? written.slice(0, array.index) : written).replace(/<=\d+$/, '');
  base = ALIASES[base] ?? base;
  const isComplex = !PRIMITIVES.has(base);
  const type = isComplex ? shortName(base.includes('/') ? base : `${own}/${base}`) : base;
  const size = array && !array[1] && array[2] ? Number(array[2]) : 'sequence';
  return { name, type, isComplex, array: array ? size : undefined };
}

export function definitionOf(schema: Schema, type: string): Definition {
  const found = schema.types.get(type);
  if (!found) throw new Error(t().messages.lacksType(schema.root.name, type));
  return found;
}
