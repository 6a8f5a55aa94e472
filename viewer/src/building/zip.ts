/** ZIP archive of several files (APPNOTE 6.3), stored without compression. */

const TABLE = Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});

export function crc32(bytes: Uint8Array): number {
  let c = 0xffffffff;
  for (const byte of bytes) c = TABLE[(c ^ byte) & 0xff]! ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

/** 1980-01-01: a fixed date, so that the same files give the same bytes. */
const DATE = 0x21;

export function zip(files: Record<string, string>): Uint8Array<ArrayBuffer> {
  const encoder = new TextEncoder();
  const parts: Uint8Array[] = [];
  const directory: Uint8Array[] = [];
  let offset = 0;
  for (const [name, text] of Object.entries(files)) {
    const data = encoder.encode(text);
    const path = encoder.encode(name);
    const shared = new DataView(new ArrayBuffer(26));
    // Version 2.0, names in UTF-8, no compression.
    [20, 0x0800, 0, 0, DATE].forEach((v, i) => shared.setUint16(i * 2, v, true));
    [crc32(data), data.length, data.length].forEach((v, i) =>
      shared.setUint32(10 + i * 4, v, true),
    );
    shared.setUint16(22, path.length, true);
    const middle = new Uint8Array(shared.buffer);
    const local = [signature(0x04034b50), middle, path, data];
    const tail = new DataView(new ArrayBuffer(14));
    tail.setUint32(10, offset, true);
    directory.push(
      signature(0x02014b50),
      new Uint8Array([20, 0]),
      middle,
      new Uint8Array(tail.buffer),
      path,
    );
    parts.push(...local);
    offset += local.reduce((sum, part) => sum + part.length, 0);
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const count = Object.keys(files).length;
  const end = new DataView(new ArrayBuffer(18));
  end.setUint16(4, count, true);
  end.setUint16(6, count, true);
  end.setUint32(8, size, true);
  end.setUint32(12, offset, true);
  const all = [...parts, ...directory, signature(0x06054b50), new Uint8Array(end.buffer)];
  const out = new Uint8Array(all.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of all) {
    out.set(part, at);
    at += part.length;
  }
  return out;
}

function signature(value: number): Uint8Array {
  const out = new Uint8Array(4);
  new DataView(out.buffer).setUint32(0, value, true);
  return out;
}
