/**
 * Client of a Periplus server, a Foxglove bridge or any other server of the protocol: topics, services,
 * parameters, assets, time. It reconnects by itself, and subscribes only to topics that have a handler.
 */
import { decoder, encoder, type Message } from './cdr';
import {
  callFrame,
  messageFrame,
  parseFrame,
  SUBPROTOCOL,
  type Channel,
  type Ends,
  type Mismatch,
  type Parameter,
  type ServerFrame,
  type ServerText,
  type ServiceOffer,
} from './protocol';
import { RecordingRequests } from './replay_requests';
import { parseSchema } from './schema';
import { t } from '../texts/language.svelte';

/** Part of a WebSocket that the client uses; tests replace it. */
export interface Socket {
  binaryType: string;
  readonly readyState: number;
  readonly bufferedAmount: number;
  /** False for a connection that the user opens again; others are opened again by the client. */
  readonly reopens?: boolean;
  send(data: string | Uint8Array<ArrayBuffer>): void;
  close(): void;
  onopen: ((event: never) => void) | null;
  onclose: ((event: { reason: string }) => void) | null;
  onerror: ((event: never) => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
}

/** `timeS`: the log time of a recorded message [s]; `undefined` for a message that was just published. */
export type Handler = (message: Message, topic: string, bytes: number, timeS?: number) => void;

export type State = 'connecting' | 'open' | 'closed';

export interface Events {
  state(state: State, why: string): void;
  /** Topics, services or their publishers, subscribers and providers changed. */
  graphChanged(): void;
  parameters(parameters: Parameter[]): void;
  time(seconds: number): void;
  /** `serverInfo`, once per connection. */
  info?(metadata: Record<string, string>): void;
  /** The list of recordings changed. */
  recordings?(): void;
  /** Status message of the server, or an error of a message that cannot be decoded. */
  status(level: number, message: string): void;
}

interface Topic {
  handlers: Set<Handler>;
  subscription?: number;
  decode?: (bytes: Uint8Array) => Message;
  isBroken?: boolean;
}

/** A topic that this page publishes. */
interface OwnChannel {
  id: number;
  schema: string;
  text: string;
  isLatched: boolean;
}

interface Pending<T> {
  resolve(value: T): void;
  reject(error: Error): void;
  timer: ReturnType<typeof setTimeout>;
}

const FIRST_RETRY_MS = 250;
const LONGEST_RETRY_MS = 3000;
const CALL_TIMEOUT_MS = 15_000;
/** The server reads the meshes of a world one after the other. */
const MESH_TIMEOUT_MS = 120_000;

export class Client {
  /** Subscriptions by topic. */
  readonly channels = new Map<string, Channel>();
  readonly services = new Map<string, ServiceOffer>();
  ends: Ends = { publishedTopics: [], subscribedTopics: [], advertisedServices: [] };
  /** Publishers and subscriptions with incompatible QoS or types. */
  mismatches: Mismatch[] = [];
  serverName = '';
  capabilities: string[] = [];
  state: State = 'connecting';
  bytesReceived = 0;
  /** Recordings of the server, and requests for their messages. */
  readonly recordings: RecordingRequests;

  private socket?: Socket;
  private topics = new Map<string, Topic>();
  private topicOf = new Map<number, string>();
  private ours = new Map<string, OwnChannel>();
  private schemas = new Map<number, Pending<{ schema: string | null; names: string[] }>>();
  /** True if the server is Periplus, which has more than the protocol. */
  private isPeriplus = false;
  private calls = new Map<number, Pending<Message> & { offer: ServiceOffer }>();
  private assets = new Map<number, Pending<Uint8Array>>();
  private repairs = new Map<number, Pending<string>>();
  private lastId = 0;
  private retryMs = FIRST_RETRY_MS;
  private retry?: ReturnType<typeof setTimeout>;
  private isStopped = false;

  constructor(
    private open: () => Socket,
    private events: Events,
    /** Definitions of types that the page publishes although the server has not sent them. */
    private texts: Record<string, string> = {},
  ) {
    this.recordings = new RecordingRequests(
      {
        isOpen: () => this.socket?.readyState === 1,
        send: (data) => this.socket?.send(data),
        waitingBytes: () => this.socket?.bufferedAmount ?? 0,
        nextId: () => ++this.lastId,
      },
      () => events.recordings?.(),
      (message) => events.status(2, message),
    );
  }

  start(): void {
    this.isStopped = false;
    this.setState('connecting', '');
    let socket: Socket;
    try {
      socket = this.open();
    } catch (error) {
      this.lost(t().connection.badAddress(String(error)));
      return;
    }
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.retryMs = FIRST_RETRY_MS;
      this.setState('open', '');
      for (const [topic, channel] of this.ours) this.sendAdvertise(topic, channel);
    };
    socket.onmessage = (event) => this.receive(event.data);
    socket.onerror = () => undefined;
    socket.onclose = ({ reason }) => {
      if (this.socket !== socket) return;
      if (socket.reopens === false) this.ended(reason);
      else this.lost(t().connection.unreachable);
    };
  }

  stop(): void {
    this.isStopped = true;
    clearTimeout(this.retry);
    const { socket } = this;
    this.socket = undefined;
    socket?.close();
    this.forget(t().connection.closed);
    this.setState('closed', '');
  }

  private ended(why: string): void {
    this.socket = undefined;
    this.forget(why);
    this.setState('closed', why);
  }

  private lost(why: string): void {
    this.ended(why);
    if (this.isStopped) return;
    this.retry = setTimeout(() => this.start(), this.retryMs);
    this.retryMs = Math.min(this.retryMs * 2, LONGEST_RETRY_MS);
  }

  private forget(why: string): void {
    this.channels.clear();
    this.services.clear();
    this.topicOf.clear();
    this.ends = { publishedTopics: [], subscribedTopics: [], advertisedServices: [] };
    for (const topic of this.topics.values()) {
      topic.subscription = undefined;
      topic.decode = undefined;
      topic.isBroken = false;
    }
    this.mismatches = [];
    const { calls, assets, repairs, schemas } = this;
    for (const pending of [calls, assets, repairs, schemas].flatMap((all) => [...all.values()])) {
      clearTimeout(pending.timer);
      pending.reject(new Error(why));
    }
    this.calls.clear();
    this.assets.clear();
    this.repairs.clear();
    this.schemas.clear();
    this.recordings.disconnected(why);
    this.events.graphChanged();
  }

  private setState(state: State, why: string): void {
    this.state = state;
    this.events.state(state, why);
  }

  private send(message: object): void {
    if (this.socket?.readyState === 1) this.socket.send(JSON.stringify(message));
  }

  // Topics.

  /** Subscribes to a topic, now or once it is advertised. Call the returned function to unsubscribe. */
  subscribe(topic: string, handler: Handler): () => void {
    let entry = this.topics.get(topic);
    if (!entry) this.topics.set(topic, (entry = { handlers: new Set() }));
    entry.handlers.add(handler);
    // A new handler needs the last message of a latched topic (map, robot description): subscribe again.
    if (entry.handlers.size > 1) this.unsubscribe(entry);
    this.ask(topic, entry);
    return () => {
      entry.handlers.delete(handler);
      if (entry.handlers.size > 0 || this.topics.get(topic) !== entry) return;
      this.topics.delete(topic);
      this.unsubscribe(entry);
    };
  }

  private unsubscribe(entry: Topic): void {
    if (entry.subscription === undefined) return;
    this.topicOf.delete(entry.subscription);
    this.send({ op: 'unsubscribe', subscriptionIds: [entry.subscription] });
    entry.subscription = undefined;
  }

  private ask(topic: string, entry: Topic): void {
    const channel = this.channels.get(topic);
    if (!channel || entry.subscription !== undefined) return;
    if (channel.encoding !== 'cdr') {
      this.events.status(1, t().connection.encoding(topic, channel.encoding));
      return;
    }
    try {
      entry.decode = decoder(parseSchema(channel.schemaName, channel.schema));
    } catch (error) {
      this.events.status(2, `${topic}: ${(error as Error).message}`);
      return;
    }
    entry.subscription = ++this.lastId;
    this.topicOf.set(entry.subscription, topic);
    const subscriptions = [{ id: entry.subscription, channelId: channel.id }];
    this.send({ op: 'subscribe', subscriptions });
  }

  /**
   * Advertises a topic; the returned function publishes on it. `text` is the definition of the type, by default that
   * of the server; a topic `isLatched` keeps its last message for late subscribers.
   */
  publisher(
    topic: string,
    schema: string,
    text = this.textOf(schema),
    isLatched = false,
  ): (message: Message) => void {
    this.advertise(topic, schema, text, isLatched);
    let encode: ((message: Message) => Uint8Array) | undefined;
    return (message) => {
      encode ??= encoder(parseSchema(schema, text));
      const bytes = encode(message);
      // Another part of the page may have advertised the topic with another type since.
      const id = this.advertise(topic, schema, text, isLatched);
      if (this.socket?.readyState === 1) this.socket.send(messageFrame(id, bytes));
    };
  }

  private advertise(topic: string, schema: string, text: string, isLatched: boolean): number {
    const known = this.ours.get(topic);
    if (known?.schema === schema && known.isLatched === isLatched) return known.id;
    this.unadvertise(topic);
    const channel = { id: ++this.lastId, schema, text, isLatched };
    this.ours.set(topic, channel);
    this.sendAdvertise(topic, channel);
    return channel.id;
  }

  /** Ends publishing on a topic. */
  unadvertise(topic: string): void {
    const known = this.ours.get(topic);
    if (!known) return;
    this.ours.delete(topic);
    this.send({ op: 'unadvertise', channelIds: [known.id] });
  }

  private sendAdvertise(topic: string, { id, schema: schemaName, text, isLatched }: OwnChannel) {
    const channel = { id, topic, encoding: 'cdr', schemaName, schema: text };
    const more = { schemaEncoding: 'ros2msg', ...(isLatched && { isLatched }) };
    this.send({ op: 'advertise', channels: [{ ...channel, ...more }] });
  }

  /** Definition of a type that the server knows, `null` if it does not; the names of all types for an empty name. */
  fetchSchema(schemaName: string): Promise<{ schema: string | null; names: string[] }> {
    if (!this.isPeriplus) return Promise.resolve({ schema: null, names: [] });
    const requestId = ++this.lastId;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => {
        this.schemas.delete(requestId);
        reject(new Error(t().connection.timeout(schemaName, CALL_TIMEOUT_MS / 1000)));
      }, CALL_TIMEOUT_MS);
      this.schemas.set(requestId, { resolve, reject, timer });
      this.send({ op: 'fetchSchema', requestId, schemaName });
    });
  }

  private textOf(schemaName: string): string {
    const known = this.texts[schemaName];
    if (known !== undefined) return known;
    for (const channel of this.channels.values()) {
      if (channel.schemaName === schemaName) return channel.schema;
    }
    throw new Error(t().connection.unknownType(schemaName));
  }

  // Services, assets and parameters.

  /** Calls a service; fails with the server's reason, or after a timeout. */
  call(name: string, request: Message, timeoutMs = CALL_TIMEOUT_MS): Promise<Message> {
    const offer = this.services.get(name);
    if (!offer) return Promise.reject(new Error(t().connection.noService(name)));
    const schema = offer.request?.schema ?? offer.requestSchema ?? '';
    const schemaName = offer.request?.schemaName ?? `${offer.type}_Request`;
    let payload: Uint8Array;
    try {
      payload = encoder(parseSchema(schemaName, schema))(request);
    } catch (error) {
      return Promise.reject(error as Error);
    }
    const id = ++this.lastId;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => {
        this.calls.delete(id);
        reject(new Error(t().connection.timeout(name, timeoutMs / 1000)));
      }, timeoutMs);
      this.calls.set(id, { resolve, reject, timer, offer });
      if (this.socket?.readyState === 1) this.socket.send(callFrame(offer.id, id, 'cdr', payload));
    });
  }

  /** Bytes of a `package://`, `model://` or other URI that the server resolves. */
  asset(uri: string): Promise<Uint8Array> {
    return this.file('fetchAsset', uri, CALL_TIMEOUT_MS);
  }

  /** Triangles of a mesh file; only Periplus has them, other servers send plain files. */
  mesh(uri: string): Promise<Uint8Array> {
    if (this.state === 'open' && !this.capabilities.includes('meshes'))
      return Promise.reject(new Error(t().meshes.unsupported(this.serverName)));
    return this.file('fetchMesh', uri, MESH_TIMEOUT_MS);
  }

  private file(
    op: 'fetchAsset' | 'fetchMesh',
    uri: string,
    timeoutMs: number,
  ): Promise<Uint8Array> {
    if (this.state !== 'open') return Promise.reject(new Error(t().connection.notConnected));
    const requestId = ++this.lastId;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => {
        this.assets.delete(requestId);
        reject(new Error(t().connection.assetTimeout(uri)));
      }, timeoutMs);
      this.assets.set(requestId, { resolve, reject, timer });
      this.send({ op, uri, requestId });
    });
  }

  /** Asks the server to make a publisher and a subscription compatible; returns its report, or fails with it. */
  repair({ topic, publisher, subscription }: Mismatch): Promise<string> {
    const id = ++this.lastId;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => {
        this.repairs.delete(id);
        reject(new Error(t().connection.repairTimeout(topic)));
      }, CALL_TIMEOUT_MS);
      this.repairs.set(id, { resolve, reject, timer });
      const ends = { publisher: publisher.node, subscription: subscription.node };
      this.send({ op: 'repairQos', id, topic, ...ends });
    });
  }

  getParameters(names: string[] = []): void {
    this.send({ op: 'getParameters', parameterNames: names, id: `get${++this.lastId}` });
  }

  setParameter(parameter: Parameter): void {
    const id = `set${++this.lastId}`;
    this.send({ op: 'setParameters', parameters: [parameter], id });
  }

  private receive(data: unknown): void {
    if (typeof data === 'string') {
      let text: ServerText;
      try {
        text = JSON.parse(data) as ServerText;
      } catch {
        this.events.status(2, t().connection.notJson);
        return;
      }
      this.receiveText(text);
    } else if (data instanceof ArrayBuffer) {
      this.bytesReceived += data.byteLength;
      const frame = parseFrame(data);
      if (frame) this.receiveFrame(frame);
    }
  }

  private receiveText(text: ServerText): void {
    switch (text.op) {
      case 'serverInfo':
        this.serverName = text.name;
        this.isPeriplus = !!text.metadata?.periplus;
        this.capabilities = text.capabilities;
        if (text.capabilities.includes('connectionGraph')) {
          this.send({ op: 'subscribeConnectionGraph' });
        }
        if (text.capabilities.includes('parameters')) this.getParameters();
        if (text.capabilities.includes('recordings')) this.send({ op: 'subscribeRecordings' });
        this.events.info?.(text.metadata ?? {});
        break;
      case 'status':
        this.events.status(text.level, text.message);
        break;
      case 'advertise':
        for (const channel of text.channels) this.advertised(channel);
        this.events.graphChanged();
        break;
      case 'unadvertise':
        for (const id of text.channelIds) this.unadvertised(id);
        this.events.graphChanged();
        break;
      case 'advertiseServices':
        for (const service of text.services) this.services.set(service.name, service);
        this.events.graphChanged();
        break;
      case 'unadvertiseServices':
        for (const [name, service] of this.services) {
          if (text.serviceIds.includes(service.id)) this.services.delete(name);
        }
        this.events.graphChanged();
        break;
      case 'parameterValues':
        this.events.parameters(text.parameters);
        break;
      case 'connectionGraphUpdate':
        this.graphChanged(text);
        if (text.mismatches) this.mismatches = text.mismatches;
        this.events.graphChanged();
        break;
      case 'repairQosResult': {
        const repair = this.repairs.get(text.id);
        this.repairs.delete(text.id);
        clearTimeout(repair?.timer);
        if (text.isRepaired) repair?.resolve(text.message);
        else repair?.reject(new Error(text.message));
        break;
      }
      case 'serviceCallFailure': {
        const call = this.calls.get(text.callId);
        this.calls.delete(text.callId);
        clearTimeout(call?.timer);
        call?.reject(new Error(text.message));
        break;
      }
      case 'schema': {
        const wanted = this.schemas.get(text.requestId);
        this.schemas.delete(text.requestId);
        clearTimeout(wanted?.timer);
        wanted?.resolve(text);
        break;
      }
      case 'removeStatus':
        break;
      default:
        this.recordings.receiveText(text);
    }
  }

  private advertised(channel: Channel): void {
    const before = this.channels.get(channel.topic);
    if (before && before.id !== channel.id) this.unadvertised(before.id);
    this.channels.set(channel.topic, channel);
    const entry = this.topics.get(channel.topic);
    if (entry) this.ask(channel.topic, entry);
  }

  private unadvertised(id: number): void {
    for (const [topic, channel] of this.channels) {
      if (channel.id !== id) continue;
      this.channels.delete(topic);
      const entry = this.topics.get(topic);
      if (entry?.subscription === undefined) continue;
      this.topicOf.delete(entry.subscription);
      entry.subscription = undefined;
      entry.isBroken = false;
    }
  }

  private graphChanged(
    update: Ends & { removedTopics: string[]; removedServices: string[] },
  ): void {
    const merge = <T extends { name: string }>(old: T[], now: T[], removed: string[]) => [
      ...old.filter((e) => !removed.includes(e.name) && !now.some((n) => n.name === e.name)),
      ...now,
    ];
    const { ends } = this;
    this.ends = {
      publishedTopics: merge(ends.publishedTopics, update.publishedTopics, update.removedTopics),
      subscribedTopics: merge(ends.subscribedTopics, update.subscribedTopics, update.removedTopics),
      advertisedServices: merge(
        ends.advertisedServices,
        update.advertisedServices,
        update.removedServices,
      ),
    };
  }

  private receiveFrame(frame: ServerFrame): void {
    switch (frame.op) {
      case 'message': {
        const topic = this.topicOf.get(frame.subscription);
        const entry = topic === undefined ? undefined : this.topics.get(topic);
        if (topic !== undefined && entry) this.deliver(topic, entry, frame.payload);
        break;
      }
      case 'time':
        this.events.time(Number(frame.nanoseconds) * 1e-9);
        break;
      case 'answer': {
        const call = this.calls.get(frame.call);
        if (!call) break;
        this.calls.delete(frame.call);
        clearTimeout(call.timer);
        const { offer } = call;
        const schema = offer.response?.schema ?? offer.responseSchema ?? '';
        const schemaName = offer.response?.schemaName ?? `${offer.type}_Response`;
        try {
          call.resolve(decoder(parseSchema(schemaName, schema))(frame.payload));
        } catch (error) {
          call.reject(error as Error);
        }
        break;
      }
      case 'asset': {
        const asset = this.assets.get(frame.request);
        if (!asset) break;
        this.assets.delete(frame.request);
        clearTimeout(asset.timer);
        if (frame.error) asset.reject(new Error(frame.error));
        else asset.resolve(frame.data);
        break;
      }
      case 'filePart':
        this.recordings.receivePart(frame);
        break;
      case 'stored':
        this.recordings.receiveFrame(frame);
        break;
    }
  }

  private deliver(topic: string, entry: Topic, payload: Uint8Array): void {
    let message: Message;
    try {
      message = entry.decode!(payload);
    } catch (error) {
      // Reported once: a topic may have a hundred messages per second.
      if (!entry.isBroken) this.events.status(2, `${topic}: ${(error as Error).message}`);
      entry.isBroken = true;
      return;
    }
    for (const handler of entry.handlers) handler(message, topic, payload.byteLength);
  }
}
