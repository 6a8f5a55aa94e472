/** Server of recordings in memory, with the contract of docs/live.md. */
import { encoder, type Message } from '../src/core/cdr';
import { parseFrame, type Recording } from '../src/core/protocol';
import { RecordingRequests, type TopicNeed } from '../src/core/replay_requests';
import { parseSchema } from '../src/core/schema';

export const HEADER =
  'builtin_interfaces/Time stamp\nstring frame_id\n===\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec';
export const TEXTS: Record<string, string> = {
  'std_msgs/msg/Int32': 'int32 data',
  'std_msgs/msg/Header': HEADER,
  'tf2_msgs/msg/TFMessage': `geometry_msgs/TransformStamped[] transforms
===
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
geometry_msgs/Transform transform
===
MSG: geometry_msgs/Transform
geometry_msgs/Vector3 translation
geometry_msgs/Quaternion rotation
===
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
===
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
===
MSG: std_msgs/Header
${HEADER}`,
};

/** Message at a time in seconds after the start of the recording. */
export interface Entry {
  atS: number;
  topic: string;
  type: string;
  message: Message;
}

/** Fields of the requests that are answered. */
interface Request {
  op: string;
  requestId: number;
  recording: number;
  topics: TopicNeed[] | number[];
  timeNs: string;
  startNs: string;
  endNs: string;
  maxBytes: number;
}

interface Stored {
  topic: number;
  timeNs: bigint;
  data: Uint8Array;
}

const ns = (seconds: number) => BigInt(Math.round(seconds * 1e9));

export class MemoryServer {
  readonly requests: RecordingRequests;
  readonly failures: string[] = [];
  /** All requests, in order. */
  asked: Partial<Request>[] = [];
  /** Requests wait in `asked` until `answer` is called. */
  isHeld = false;
  private stored = new Map<number, Stored[]>();
  private names = new Map<number, string[]>();
  private held: (() => void)[] = [];
  private lastId = 0;

  constructor() {
    this.requests = new RecordingRequests(
      {
        isOpen: () => true,
        send: (data) => this.receive(data),
        waitingBytes: () => 0,
        nextId: () => ++this.lastId,
      },
      () => undefined,
      (message) => this.failures.push(message),
    );
  }

  recording(id: number, startS: number, entries: readonly Entry[], latched: string[] = []) {
    const names = [...new Set(entries.map((one) => one.topic))];
    const all = entries.map((one): Stored => {
      const encode = encoder(parseSchema(one.type, TEXTS[one.type]!));
      const topic = names.indexOf(one.topic) + 1;
      return { topic, timeNs: ns(startS + one.atS), data: encode(one.message) };
    });
    all.sort((a, b) => Number(a.timeNs - b.timeNs));
    this.stored.set(id, all);
    this.names.set(id, names);
    const recording: Recording = {
      ...{ id, name: `run${id}`, kind: 'mcap', state: 'ready', progress: 1, error: null },
      startNs: String(ns(startS)),
      endNs: String(all[all.length - 1]!.timeNs),
      ...{ bytes: 1, messageCount: all.length, findings: [], origin: null },
      topics: names.map((topic, i) => {
        const { type } = entries.find((one) => one.topic === topic)!;
        return {
          ...{ id: i + 1, topic, encoding: 'cdr', schemaName: type, schemaEncoding: 'ros2msg' },
          schema: TEXTS[type]!,
          count: all.filter((one) => one.topic === i + 1).length,
          isLatched: latched.includes(topic),
        };
      }),
    };
    return recording;
  }

  /** Topic of the grid that a topic updates. */
  private updatedBy(recording: number, topic: number): number {
    const names = this.names.get(recording) ?? [];
    const own = names[topic - 1]!;
    return own.endsWith('_updates') ? names.indexOf(own.slice(0, -'_updates'.length)) + 1 : 0;
  }

  /** Answers the oldest held request. */
  answer(): void {
    this.held.shift()?.();
  }

  private receive(data: string | Uint8Array): void {
    if (typeof data !== 'string') return;
    const request = JSON.parse(data) as Request;
    this.asked.push(request);
    if (request.op === 'cancelFetch') return;
    const reply = () => this.reply(request);
    if (this.isHeld) this.held.push(reply);
    else queueMicrotask(reply);
  }

  private reply(request: Request): void {
    const { op, requestId, recording } = request;
    const all = this.stored.get(recording) ?? [];
    if (op === 'fetchState') {
      const { timeNs } = request;
      const topics = request.topics as TopicNeed[];
      const now = BigInt(timeNs);
      const found = topics.flatMap(({ id, historyNs, count }) => {
        const before = all.filter((one) => one.topic === id && one.timeNs <= now);
        const base = this.updatedBy(recording, id);
        const grid =
          before.length > 0 && all.findLast((one) => one.topic === base && one.timeNs <= now);
        if (grid) return before.filter((one) => one.timeNs > grid.timeNs);
        const from = before.findIndex((one) => one.timeNs > now - BigInt(historyNs));
        const begin = Math.min(from < 0 ? Infinity : from, Math.max(0, before.length - count));
        return before.slice(begin);
      });
      this.frame(requestId, found, false, now);
    } else if (op === 'fetchMessages') {
      const { startNs, endNs, maxBytes } = request;
      const topics = request.topics as number[];
      const span = all.filter(
        (one) =>
          topics.includes(one.topic) && one.timeNs >= BigInt(startNs) && one.timeNs < BigInt(endNs),
      );
      const out: Stored[] = [];
      let bytes = 0;
      for (const one of span) {
        if (bytes >= maxBytes && one.timeNs !== out[out.length - 1]?.timeNs) break;
        out.push(one);
        bytes += one.data.length;
      }
      const isMore = out.length < span.length;
      this.frame(requestId, out, isMore, isMore ? out[out.length - 1]!.timeNs : BigInt(endNs));
    } else {
      const message = `${String(op)} is not answered`;
      this.requests.receiveText({ op: 'fetchFailure', requestId, message });
    }
  }

  private frame(id: number, messages: Stored[], isMore: boolean, reachedNs: bigint): void {
    const bytes = messages.reduce((sum, one) => sum + 16 + one.data.length, 14);
    const out = new Uint8Array(bytes);
    const view = new DataView(out.buffer);
    out[0] = 0x10;
    view.setUint32(1, id, true);
    out[5] = 1 + (isMore ? 2 : 0);
    view.setBigUint64(6, reachedNs, true);
    let at = 14;
    for (const { topic, timeNs, data } of messages) {
      view.setUint32(at, topic, true);
      view.setBigUint64(at + 4, timeNs, true);
      view.setUint32(at + 12, data.length, true);
      out.set(data, at + 16);
      at += 16 + data.length;
    }
    const frame = parseFrame(out.buffer);
    if (frame?.op === 'stored') this.requests.receiveFrame(frame);
  }
}
