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
  | { op: 'repairQosResult'; id: number; isRepaired: boolean; message: string }
  | { op: 'serviceCallFailure'; serviceId: number; callId: number; message: string };

export type ServerFrame =
  | { op: 'message'; subscription: number; payload: Uint8Array }
  | { op: 'time'; nanoseconds: bigint }
  | { op: 'answer'; service: number; call: number; encoding: string; payload: Uint8Array }
  | { op: 'asset'; request: number; error?: string; data: Uint8Array };

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
    default:
      return undefined;
  }
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
