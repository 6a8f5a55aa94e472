/** Messages of the WebSocket protocol `foxglove.websocket.v1`. */

export const SUBPROTOCOL = 'foxglove.websocket.v1';

export interface Channel {
  id: number;
  topic: string;
  encoding: string;
  schemaName: string;
  schema: string;
  schemaEncoding?: string;
  /** Extension of Periplus: more about a topic; other servers leave it out. */
  metadata?: Record<string, string>;
}

export interface ServiceOffer {
  id: number;
  name: string;
  type: string;
  requestSchema?: string;
  responseSchema?: string;
  request?: { encoding: string; schemaName: string; schema: string };
  response?: { encoding: string; schemaName: string; schema: string };
}

export type ParameterValue =
  | undefined
  | null
  | boolean
  | number
  | string
  | ParameterValue[]
  | { [key: string]: ParameterValue };

export interface Parameter {
  name: string;
  value?: ParameterValue;
  type?: string;
}

export interface Ends {
  publishedTopics: { name: string; publisherIds: string[] }[];
  subscribedTopics: { name: string; subscriberIds: string[] }[];
  advertisedServices: { name: string; providerIds: string[] }[];
}

/** Publisher and subscription that are incompatible; an extension of Periplus, see docs/live.md. */
export interface Mismatch {
  topic: string;
  publisher: { node: string; isOurs: boolean };
  subscription: { node: string; isOurs: boolean };
  policies: { policy: string; offered: string; asked: string }[];
  /** Side that the server can change: publisher or subscription. */
  repair: 'publisher' | 'subscription' | null;
  advice: string;
}

/** Topic of a recording; an extension of Periplus, see docs/live.md. */
export interface RecordingTopic {
  id: number;
  topic: string;
  encoding: string;
  schemaName: string;
  schemaEncoding: string;
  schema: string;
  count: number;
  isLatched: boolean;
}

export type JobKind = 'slam' | 'amcl' | 'costmap';

/** Recording on the server. Times are nanoseconds of the log time. */
export interface Recording {
  id: number;
  name: string;
  kind: string;
  state: 'opening' | 'ready' | 'failed';
  /** Fraction of the work while it is opened, 0 to 1. */
  progress: number;
  error: string | null;
  startNs: string;
  endNs: string;
  bytes: number;
  messageCount: number;
  findings: string[];
  /** Recording and parameters that an estimator was run on. */
  origin: { recording: number; kind: string; parameters: Record<string, ParameterValue> } | null;
  /** True if the server removes its file when it is closed. */
  isTemporary?: boolean;
  /** Facts that the recorder wrote, by name. */
  customData?: Record<string, string>;
  topics: RecordingTopic[];
}

/** Event in a recording: an error, a goal, a collision. */
export interface Mark {
  timeNs: string;
  kind: string;
  topic: string;
  text: string;
}

/** Parameter of an estimator that can be run on a recording. */
export interface JobParameter {
  name: string;
  type: string;
  default: ParameterValue;
  min: number | null;
  max: number | null;
  unit: string | null;
  doc: string;
  /** The only values, for a parameter of the type `choice`. */
  choices?: string[];
}

export type RecordingText =
  | { op: 'recordings'; isRecording: boolean; recordings: Recording[] }
  | { op: 'density'; requestId: number; topics: Record<string, number[]> }
  | { op: 'marks'; requestId: number; marks: Mark[]; isComplete: boolean }
  | {
      op: 'series';
      requestId: number;
      timesNs: string[];
      values: (number | null)[][];
      isReduced: boolean;
    }
  | { op: 'uploadStarted'; requestId: number; upload: number }
  | { op: 'uploadProgress'; upload: number; bytes: number }
  | { op: 'jobParameters'; requestId: number; kind: string; parameters: JobParameter[] }
  | { op: 'report'; requestId: number; html: string }
  | { op: 'difference'; requestId: number; difference: StoredDifference }
  | { op: 'file'; requestId: number; name: string; bytes: number }
  | { op: 'fetchFailure'; requestId: number; message: string };

/** Difference of two recordings; pairs are of the first and of the second, `null` where one has nothing. */
export interface StoredDifference {
  map: {
    knownCount: number;
    changedCount: number;
    onlyFirstCount: number;
    onlySecondCount: number;
    resolutionM: number;
  } | null;
  trajectory: { frame: string; isSinceStart: boolean; rmsM: number; maxM: number } | null;
  topics: StoredTopicDifference[];
}

export interface StoredTopicDifference {
  topic: string;
  types: [string | null, string | null];
  counts: [number | null, number | null];
  ratesHz: [number | null, number | null];
  /** Number of messages that were compared, the Nth of one with the Nth of the other. */
  comparedCount: number;
  /** First messages that differ. */
  first: {
    index: number;
    timesNs: [string, string];
    /** Values as JSON; empty where there is none. */
    values: { path: string; values: [string, string] }[];
    valueCount: number;
  } | null;
}

/** Message of a recording, not decoded. */
export interface StoredMessage {
  topic: number;
  timeNs: bigint;
  data: Uint8Array;
}

export type ServerText =
  | {
      op: 'serverInfo';
      name: string;
      capabilities: string[];
      supportedEncodings?: string[];
      metadata?: Record<string, string>;
      sessionId?: string;
    }
  | { op: 'status'; level: number; message: string; id?: string }
  | { op: 'removeStatus'; statusIds: string[] }
  | { op: 'advertise'; channels: Channel[] }
  | { op: 'unadvertise'; channelIds: number[] }
  | { op: 'parameterValues'; parameters: Parameter[]; id?: string }
  | { op: 'advertiseServices'; services: ServiceOffer[] }
  | { op: 'unadvertiseServices'; serviceIds: number[] }
  | ({
      op: 'connectionGraphUpdate';
      removedTopics: string[];
      removedServices: string[];
      mismatches?: Mismatch[];
    } & Ends)
  | { op: 'schema'; requestId: number; schema: string | null; names: string[] }
  | { op: 'repairQosResult'; id: number; isRepaired: boolean; message: string }
  | RecordingText
  | { op: 'serviceCallFailure'; serviceId: number; callId: number; message: string };

export type ServerFrame =
  | { op: 'message'; subscription: number; payload: Uint8Array }
  | { op: 'time'; nanoseconds: bigint }
  | { op: 'answer'; service: number; call: number; encoding: string; payload: Uint8Array }
  | { op: 'asset'; request: number; error?: string; data: Uint8Array }
  | { op: 'filePart'; request: number; isLast: boolean; part: Uint8Array<ArrayBuffer> }
  | {
      op: 'stored';
      request: number;
      isLast: boolean;
      /** More messages of the span follow after `reachedNs`. */
      isMore: boolean;
      reachedNs: bigint;
      messages: StoredMessage[];
    };

const TEXT = new TextDecoder();
const BYTES = new TextEncoder();

/** Decodes a binary message of the server; `undefined` for kinds that later versions may add. */
export function parseFrame(data: ArrayBuffer): ServerFrame | undefined {
  const view = new DataView(data);
  const bytes = new Uint8Array(data);
  switch (bytes[0]) {
    case 1:
      return { op: 'message', subscription: view.getUint32(1, true), payload: bytes.subarray(13) };
    case 2:
      return { op: 'time', nanoseconds: view.getBigUint64(1, true) };
    case 3: {
      const end = 13 + view.getUint32(9, true);
      return {
        op: 'answer',
        service: view.getUint32(1, true),
        call: view.getUint32(5, true),
        encoding: TEXT.decode(bytes.subarray(13, end)),
        payload: bytes.subarray(end),
      };
    }
    case 4: {
      const end = 10 + view.getUint32(6, true);
      const error = TEXT.decode(bytes.subarray(10, end));
      const failed = view.getUint8(5) !== 0;
      return {
        op: 'asset',
        request: view.getUint32(1, true),
        error: failed ? error || 'the server does not have it' : undefined,
        data: bytes.subarray(end),
      };
    }
    case 0x10:
      return {
        op: 'stored',
        request: view.getUint32(1, true),
        isLast: (view.getUint8(5) & 1) !== 0,
        isMore: (view.getUint8(5) & 2) !== 0,
        reachedNs: view.getBigUint64(6, true),
        messages: storedMessages(view, bytes),
      };
    case 0x12:
      return {
        op: 'filePart',
        request: view.getUint32(1, true),
        isLast: (view.getUint8(5) & 1) !== 0,
        part: bytes.subarray(6),
      };
    default:
      return undefined;
  }
}

function storedMessages(view: DataView, bytes: Uint8Array): StoredMessage[] {
  const out: StoredMessage[] = [];
  for (let at = 14; at + 16 <= bytes.length;) {
    const length = view.getUint32(at + 12, true);
    const begin = at + 16;
    out.push({
      topic: view.getUint32(at, true),
      timeNs: view.getBigUint64(at + 4, true),
      data: bytes.subarray(begin, begin + length),
    });
    at = begin + length;
  }
  return out;
}

/** Part of the files that are uploaded, which follow one after the other. */
export function uploadFrame(upload: number, part: Uint8Array): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(5 + part.length);
  out[0] = 0x11;
  new DataView(out.buffer).setUint32(1, upload, true);
  out.set(part, 5);
  return out;
}

export function messageFrame(channel: number, payload: Uint8Array): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(5 + payload.length);
  out[0] = 1;
  new DataView(out.buffer).setUint32(1, channel, true);
  out.set(payload, 5);
  return out;
}

export function callFrame(
  service: number,
  call: number,
  encoding: string,
  payload: Uint8Array,
): Uint8Array<ArrayBuffer> {
  const name = BYTES.encode(encoding);
  const out = new Uint8Array(13 + name.length + payload.length);
  const view = new DataView(out.buffer);
  out[0] = 2;
  view.setUint32(1, service, true);
  view.setUint32(5, call, true);
  view.setUint32(9, name.length, true);
  out.set(name, 13);
  out.set(payload, 13 + name.length);
  return out;
}
