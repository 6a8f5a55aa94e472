/**
 * WebM files with one video track: EBML elements by the Matroska specification (RFC 9559) and the WebM guidelines.
 * The packets are kept until the end, so that the file has its duration and an index for seeking.
 */

/** Packet of an encoder. */
export interface Packet {
  timeMs: number;
  isKey: boolean;
  data: Uint8Array<ArrayBuffer>;
}

export interface VideoTrack {
  /** Codec by Matroska's name: `V_VP9`, `V_VP8`, `V_AV1`. */
  codec: string;
  width: number;
  height: number;
}

type Part = Uint8Array<ArrayBuffer>;

/** Longest time of a cluster: block times are relative, with 16 bits [ms]. */
const MAX_CLUSTER_MS = 30_000;
const ID = {
  ebml: 0x1a45dfa3,
  ebmlVersion: 0x4286,
  ebmlReadVersion: 0x42f7,
  ebmlMaxIdLength: 0x42f2,
  ebmlMaxSizeLength: 0x42f3,
  docType: 0x4282,
  docTypeVersion: 0x4287,
  docTypeReadVersion: 0x4285,
  segment: 0x18538067,
  info: 0x1549a966,
  timestampScale: 0x2ad7b1,
  duration: 0x4489,
  muxingApp: 0x4d80,
  writingApp: 0x5741,
  tracks: 0x1654ae6b,
  trackEntry: 0xae,
  trackNumber: 0xd7,
  trackUid: 0x73c5,
  flagLacing: 0x9c,
  trackType: 0x83,
  codecId: 0x86,
  video: 0xe0,
  pixelWidth: 0xb0,
  pixelHeight: 0xba,
  cluster: 0x1f43b675,
  timestamp: 0xe7,
  simpleBlock: 0xa3,
  cues: 0x1c53bb6b,
  cuePoint: 0xbb,
  cueTime: 0xb3,
  cueTrackPositions: 0xb7,
  cueTrack: 0xf7,
  cueClusterPosition: 0xf1,
} as const;

function bytesOf(value: number): number[] {
  const bytes: number[] = [];
  for (let rest = value; rest > 0 || bytes.length === 0; rest = Math.floor(rest / 256)) {
    bytes.unshift(rest % 256);
  }
  return bytes;
}

/** Size of an element in 8 bytes: all sizes that occur fit. */
function sizeOf(length: number): number[] {
  const bytes = bytesOf(length);
  return [0x01, ...Array<number>(7 - bytes.length).fill(0), ...bytes];
}

function element(id: number, ...content: Part[]): Part {
  const length = content.reduce((sum, part) => sum + part.length, 0);
  return join([new Uint8Array([...bytesOf(id), ...sizeOf(length)]), ...content]);
}

function join(parts: readonly Part[]): Part {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

const uint = (id: number, value: number): Part => element(id, new Uint8Array(bytesOf(value)));
const text = (id: number, value: string): Part => element(id, new TextEncoder().encode(value));
function float(id: number, value: number): Part {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setFloat64(0, value);
  return element(id, bytes);
}

/** A block: track 1, its time relative to the cluster, and whether it can be decoded by itself. */
function block({ timeMs, isKey, data }: Packet, clusterMs: number): Part {
  const head = new Uint8Array(4);
  head[0] = 0x81;
  new DataView(head.buffer).setInt16(1, Math.round(timeMs) - clusterMs);
  head[3] = isKey ? 0x80 : 0;
  return element(ID.simpleBlock, head, data);
}

/** Packets from one key frame to the next; a player can start at each cluster. */
function clustersOf(packets: readonly Packet[]): Packet[][] {
  const clusters: Packet[][] = [];
  for (const packet of packets) {
    const last = clusters[clusters.length - 1];
    const isLong = last && packet.timeMs - last[0]!.timeMs > MAX_CLUSTER_MS;
    if (!last || packet.isKey || isLong) clusters.push([packet]);
    else last.push(packet);
  }
  return clusters;
}

/** File of the packets, which are in the order of time. */
export function writeWebm(track: VideoTrack, packets: readonly Packet[], durationMs: number): Part {
  const header = element(
    ID.ebml,
    uint(ID.ebmlVersion, 1),
    uint(ID.ebmlReadVersion, 1),
    uint(ID.ebmlMaxIdLength, 4),
    uint(ID.ebmlMaxSizeLength, 8),
    text(ID.docType, 'webm'),
    uint(ID.docTypeVersion, 4),
    uint(ID.docTypeReadVersion, 2),
  );
  const info = element(
    ID.info,
    // Times are in milliseconds.
    uint(ID.timestampScale, 1_000_000),
    float(ID.duration, durationMs),
    text(ID.muxingApp, 'Periplus'),
    text(ID.writingApp, 'Periplus'),
  );
  const tracks = element(
    ID.tracks,
    element(
      ID.trackEntry,
      uint(ID.trackNumber, 1),
      uint(ID.trackUid, 1),
      uint(ID.trackType, 1),
      uint(ID.flagLacing, 0),
      text(ID.codecId, track.codec),
      element(ID.video, uint(ID.pixelWidth, track.width), uint(ID.pixelHeight, track.height)),
    ),
  );
  const clusters = clustersOf(packets).map((group) => {
    const startMs = Math.round(group[0]!.timeMs);
    const blocks = group.map((packet) => block(packet, startMs));
    return { startMs, bytes: element(ID.cluster, uint(ID.timestamp, startMs), ...blocks) };
  });
  let at = info.length + tracks.length;
  const cues = clusters.map(({ startMs, bytes }) => {
    const position = at;
    at += bytes.length;
    const place = element(
      ID.cueTrackPositions,
      uint(ID.cueTrack, 1),
      uint(ID.cueClusterPosition, position),
    );
    return element(ID.cuePoint, uint(ID.cueTime, startMs), place);
  });
  const body = [info, tracks, ...clusters.map(({ bytes }) => bytes), element(ID.cues, ...cues)];
  return join([header, element(ID.segment, ...body)]);
}
