/**
 * Conversion of messages from and to CDR, the encoding of DDS (OMG DDS-XTypes 1.3, 7.4.3; plain CDR versions 1 and 2).
 *
 * Each type is compiled once into a plan of small functions. Arrays of numbers are views of the message's bytes
 * if these are aligned, and copies otherwise.
 */
import { definitionOf, type Definition, type Field, type Schema } from './schema';
import { t } from '../texts/language.svelte';

export type Message = Record<string, unknown>;
type Numbers =
  | Int8Array
  | Uint8Array
  | Int16Array
  | Uint16Array
  | Int32Array
  | Uint32Array
  | Float32Array
  | Float64Array
  | BigInt64Array
  | BigUint64Array;

const TEXT = new TextDecoder();
const BYTES = new TextEncoder();

class Reader {
  readonly view: DataView;
  readonly bytes: Uint8Array;
  offset = 4;
  readonly isLittle: boolean;
  readonly maxAlign: number;

  constructor(bytes: Uint8Array) {
    if (bytes.byteLength < 4) throw new Error(t().messages.noHeader);
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const kind = this.view.getUint16(0);
    if (kind > 11) throw new Error(t().messages.encapsulation(kind));
    this.isLittle = (kind & 1) === 1;
    this.maxAlign = kind >= 6 ? 4 : 8;
  }

  align(size: number): number {
    const to = Math.min(size, this.maxAlign);
    this.offset = 4 + Math.ceil((this.offset - 4) / to) * to;
    return this.offset;
  }

  advance(size: number, align: number): number {
    const at = this.align(align);
    if (at + size > this.bytes.byteLength) throw new Error(t().messages.truncated);
    this.offset = at + size;
    return at;
  }

  count(leastBytes: number): number {
    const count = this.view.getUint32(this.advance(4, 4), this.isLittle);
    if (count * leastBytes > this.bytes.byteLength - this.offset) {
      throw new Error(t().messages.short(count));
    }
    return count;
  }

  string(): string {
    const length = this.view.getUint32(this.advance(4, 4), this.isLittle);
    const at = this.advance(length, 1);
    const end = length > 0 && this.bytes[at + length - 1] === 0 ? at + length - 1 : at + length;
    return TEXT.decode(this.bytes.subarray(at, end));
  }
}

class Writer {
  bytes = new Uint8Array(256);
  view = new DataView(this.bytes.buffer);
  offset = 4;

  constructor() {
    this.bytes.set([0, 1, 0, 0]);
  }

  grow(size: number, align: number): number {
    const at = 4 + Math.ceil((this.offset - 4) / align) * align;
    if (at + size > this.bytes.length) {
      const larger = new Uint8Array(Math.max(this.bytes.length * 2, at + size));
      larger.set(this.bytes.subarray(0, this.offset));
      this.bytes = larger;
      this.view = new DataView(larger.buffer);
    }
    this.offset = at + size;
    return at;
  }

  count(count: number): void {
    const at = this.grow(4, 4);
    // `grow` may have replaced the view.
    this.view.setUint32(at, count, true);
  }
}

interface Primitive {
  size: number;
  read(view: DataView, at: number, isLittle: boolean): unknown;
  write(view: DataView, at: number, value: unknown): void;
  array?: new (buffer: ArrayBuffer, offset: number, length: number) => Numbers;
}

const asNumber = (v: unknown) => Number(v ?? 0);
const asBig = (v: unknown) => BigInt(typeof v === 'bigint' ? v : Math.trunc(Number(v ?? 0)));
/** 64-bit integer as a `number` if exact, otherwise as a `bigint`. */
const plain = (v: bigint) => (BigInt.asIntN(54, v) === v ? Number(v) : v);

const PRIMITIVES: Record<string, Primitive> = {
  bool: {
    size: 1,
    read: (v, at) => v.getUint8(at) !== 0,
    write: (v, at, x) => v.setUint8(at, x ? 1 : 0),
  },
  int8: {
    size: 1,
    read: (v, at) => v.getInt8(at),
    write: (v, at, x) => v.setInt8(at, asNumber(x)),
    array: Int8Array as never,
  },
  uint8: {
    size: 1,
    read: (v, at) => v.getUint8(at),
    write: (v, at, x) => v.setUint8(at, asNumber(x)),
    array: Uint8Array as never,
  },
  int16: {
    size: 2,
    read: (v, at, l) => v.getInt16(at, l),
    write: (v, at, x) => v.setInt16(at, asNumber(x), true),
    array: Int16Array as never,
  },
  uint16: {
    size: 2,
    read: (v, at, l) => v.getUint16(at, l),
    write: (v, at, x) => v.setUint16(at, asNumber(x), true),
    array: Uint16Array as never,
  },
  int32: {
    size: 4,
    read: (v, at, l) => v.getInt32(at, l),
    write: (v, at, x) => v.setInt32(at, asNumber(x), true),
    array: Int32Array as never,
  },
  uint32: {
    size: 4,
    read: (v, at, l) => v.getUint32(at, l),
    write: (v, at, x) => v.setUint32(at, asNumber(x), true),
    array: Uint32Array as never,
  },
  float32: {
    size: 4,
    read: (v, at, l) => v.getFloat32(at, l),
    write: (v, at, x) => v.setFloat32(at, asNumber(x), true),
    array: Float32Array as never,
  },
  float64: {
    size: 8,
    read: (v, at, l) => v.getFloat64(at, l),
    write: (v, at, x) => v.setFloat64(at, asNumber(x), true),
    array: Float64Array as never,
  },
  int64: {
    size: 8,
    read: (v, at, l) => plain(v.getBigInt64(at, l)),
    write: (v, at, x) => v.setBigInt64(at, asBig(x), true),
    array: BigInt64Array as never,
  },
  uint64: {
    size: 8,
    read: (v, at, l) => plain(v.getBigUint64(at, l)),
    write: (v, at, x) => v.setBigUint64(at, asBig(x), true),
    array: BigUint64Array as never,
  },
};
PRIMITIVES.byte = PRIMITIVES.uint8!;
PRIMITIVES.char = PRIMITIVES.uint8!;

const HOST_IS_LITTLE = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;

type Read = (reader: Reader) => unknown;
type Write = (writer: Writer, value: unknown) => void;

/** Compiles a decoder for messages of one type. */
export function decoder(schema: Schema): (bytes: Uint8Array) => Message {
  const plans = new Map<string, Read>();
  const root = readStruct(schema, schema.root, plans);
  return (bytes) => root(new Reader(bytes)) as Message;
}

/** Compiles an encoder (little endian) for messages of one type; missing fields are written as zero. */
export function encoder(schema: Schema): (message: Message) => Uint8Array {
  const plans = new Map<string, Write>();
  const root = writeStruct(schema, schema.root, plans);
  return (message) => {
    const writer = new Writer();
    root(writer, message);
    return writer.bytes.slice(0, writer.offset);
  };
}

function readStruct(schema: Schema, definition: Definition, plans: Map<string, Read>): Read {
  const known = plans.get(definition.name);
  if (known) return known;
  const names: string[] = [];
  const reads: Read[] = [];
  const plan: Read = (reader) => {
    const out: Message = {};
    for (let i = 0; i < reads.length; i++) out[names[i]!] = reads[i]!(reader);
    return out;
  };
  // A definition with a cycle is wrong, but must not recurse without end: the plan is registered before its fields.
  plans.set(definition.name, plan);
  for (const field of definition.fields) {
    names.push(field.name);
    reads.push(readField(schema, field, plans));
  }
  // A struct without fields takes one byte in CDR (rosidl).
  if (reads.length === 0) return noMembers;
  return plan;
}

const noMembers: Read = (reader) => {
  if (reader.offset < reader.bytes.byteLength) reader.offset += 1;
  return {};
};

function readField(schema: Schema, field: Field, plans: Map<string, Read>): Read {
  const one = readOne(schema, field, plans);
  if (field.array === undefined) return one;
  const fixed = field.array === 'sequence' ? undefined : field.array;
  const primitive = PRIMITIVES[field.type];
  if (primitive?.array) {
    return (reader) => readNumbers(reader, primitive, fixed ?? reader.count(primitive.size));
  }
  return (reader) => {
    const count = fixed ?? reader.count(1);
    const out: unknown[] = [];
    for (let i = 0; i < count; i++) out.push(one(reader));
    return out;
  };
}

function readNumbers(reader: Reader, primitive: Primitive, count: number): Numbers {
  const Kind = primitive.array!;
  if (count === 0) return new Kind(new ArrayBuffer(0), 0, 0);
  const at = reader.advance(count * primitive.size, primitive.size);
  const { buffer, byteOffset } = reader.bytes;
  const start = byteOffset + at;
  if (primitive.size === 1 || reader.isLittle === HOST_IS_LITTLE) {
    if (start % primitive.size === 0) return new Kind(buffer as ArrayBuffer, start, count);
    const copy = buffer.slice(start, start + count * primitive.size) as ArrayBuffer;
    return new Kind(copy, 0, count);
  }
  const out = new Kind(new ArrayBuffer(count * primitive.size), 0, count);
  for (let i = 0; i < count; i++) {
    const value = primitive.read(reader.view, at + i * primitive.size, reader.isLittle);
    out[i] = (
      out instanceof BigInt64Array || out instanceof BigUint64Array
        ? BigInt(value as number)
        : value
    ) as never;
  }
  return out;
}

function readOne(schema: Schema, field: Field, plans: Map<string, Read>): Read {
  if (field.isComplex) return readStruct(schema, definitionOf(schema, field.type), plans);
  if (field.type === 'string') return (reader) => reader.string();
  if (field.type === 'wstring') return readWide;
  const { size, read } = PRIMITIVES[field.type]!;
  return (reader) => read(reader.view, reader.advance(size, size), reader.isLittle);
}

const readWide: Read = (reader) => {
  const count = reader.count(2);
  let out = '';
  for (let i = 0; i < count; i++) {
    out += String.fromCharCode(reader.view.getUint16(reader.advance(2, 2), reader.isLittle));
  }
  return out;
};

function writeStruct(schema: Schema, definition: Definition, plans: Map<string, Write>): Write {
  const known = plans.get(definition.name);
  if (known) return known;
  const fields: [string, Write][] = [];
  const plan: Write = (writer, value) => {
    const message = (value ?? {}) as Message;
    if (fields.length === 0) writer.grow(1, 1);
    for (const [name, write] of fields) write(writer, message[name]);
  };
  plans.set(definition.name, plan);
  for (const field of definition.fields) {
    fields.push([field.name, writeField(schema, field, plans)]);
  }
  return plan;
}

function writeField(schema: Schema, field: Field, plans: Map<string, Write>): Write {
  const one = writeOne(schema, field, plans);
  if (field.array === undefined) return one;
  const fixed = field.array === 'sequence' ? undefined : field.array;
  return (writer, value) => {
    const items = (value ?? []) as ArrayLike<unknown>;
    const count = fixed ?? items.length;
    if (fixed === undefined) writer.count(count);
    if (
      items instanceof Uint8Array &&
      PRIMITIVES[field.type]?.size === 1 &&
      items.length === count
    ) {
      const at = writer.grow(count, 1);
      writer.bytes.set(items, at);
      return;
    }
    for (let i = 0; i < count; i++) one(writer, items[i]);
  };
}

function writeOne(schema: Schema, field: Field, plans: Map<string, Write>): Write {
  if (field.isComplex) return writeStruct(schema, definitionOf(schema, field.type), plans);
  if (field.type === 'string') {
    return (writer, value) => {
      const bytes = BYTES.encode(String(value ?? ''));
      writer.count(bytes.length + 1);
      const at = writer.grow(bytes.length + 1, 1);
      writer.bytes.set(bytes, at);
      writer.bytes[at + bytes.length] = 0;
    };
  }
  if (field.type === 'wstring') {
    return (writer, value) => {
      const text = String(value ?? '');
      writer.count(text.length);
      for (let i = 0; i < text.length; i++) {
        const at = writer.grow(2, 2);
        writer.view.setUint16(at, text.charCodeAt(i), true);
      }
    };
  }
  const { size, write } = PRIMITIVES[field.type]!;
  // The view is read after growing, which may replace it.
  return (writer, value) => {
    const at = writer.grow(size, size);
    write(writer.view, at, value);
  };
}
