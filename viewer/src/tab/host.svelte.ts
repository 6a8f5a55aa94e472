/** The worker with the simulator, as the page sees it: its loading, its end, its files. */
import type { Socket } from '../core/client';
import { t } from '../texts/language.svelte';
import type { Request, FromWorker, MemoryFile, SessionOptions, ToWorker } from './messages';
import { PortSocket } from './port_socket';

export type Phase =
  /** The module is received and compiled. */
  | { kind: 'loading'; receivedBytes: number }
  /** The session starts. */
  | { kind: 'starting' }
  | { kind: 'running' }
  | { kind: 'ended'; why: string }
  /** The module cannot be received or compiled. */
  | { kind: 'unloaded'; why: string }
  /** The link has settings that cannot be used. */
  | { kind: 'refused'; why: () => string };

interface Pending {
  resolve(result: MemoryFile[] | Uint8Array<ArrayBuffer> | undefined): void;
  reject(error: Error): void;
}

/** Part of a worker that the host uses; tests replace it. */
export interface WorkerPort {
  postMessage(message: ToWorker, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: { data: FromWorker }) => void) | null;
  onerror: ((event: { message: string }) => void) | null;
  /** Messages that came before they could be handled. */
  readonly early: readonly FromWorker[];
}

export class Host {
  phase: Phase = $state.raw({ kind: 'loading', receivedBytes: 0 });
  /** Memory of the module [bytes]. */
  memoryBytes = $state(0);
  private options: SessionOptions = {};
  private worker?: WorkerPort;
  private socket?: PortSocket;
  private isLoaded = false;
  private sessions = 0;
  private lastId = 0;
  private requests = new Map<number, Pending>();

  constructor(
    /** Starts a worker that already loads the module. */
    private makeWorker: () => WorkerPort,
    /** Size of the module [bytes]. */
    readonly moduleBytes: number,
  ) {
    this.load();
  }

  /** Options of the next session. */
  use(options: SessionOptions): void {
    this.options = options;
  }

  /** The link cannot be opened; the reason in the present language. */
  refuse(why: () => string): void {
    this.phase = { kind: 'refused', why };
  }

  /** Loads the module again after it was lost. */
  renew(): void {
    if (!this.worker) this.load();
  }

  /** Starts a session with the present options; for the client. */
  open(): Socket {
    this.renew();
    this.phase = this.isLoaded ? { kind: 'starting' } : { kind: 'loading', receivedBytes: 0 };
    const post = (message: ToWorker, transfer: Transferable[] = []) => this.post(message, transfer);
    this.socket = new PortSocket(++this.sessions, this.options, post);
    return this.socket;
  }

  private load(): void {
    this.isLoaded = false;
    const worker = this.makeWorker();
    this.worker = worker;
    worker.onmessage = ({ data }) => {
      if (this.worker === worker) this.receive(data);
    };
    worker.onerror = ({ message }) => {
      const why = message || t().tab.noWorker;
      if (this.worker === worker) this.receive({ kind: 'failed', why });
    };
    for (const message of worker.early) this.receive(message);
  }

  private post(message: ToWorker, transfer: Transferable[]): void {
    this.worker?.postMessage(message, transfer);
  }

  private receive(message: FromWorker): void {
    switch (message.kind) {
      case 'progress':
        if (this.phase.kind === 'loading') {
          this.phase = { kind: 'loading', receivedBytes: message.receivedBytes };
        }
        return;
      case 'loaded':
        this.isLoaded = true;
        if (this.phase.kind === 'loading') this.phase = { kind: 'starting' };
        return;
      case 'memory':
        this.memoryBytes = message.bytes;
        return;
      case 'answer':
        this.settle(message.id, (pending) => pending.resolve(message.result));
        return;
      case 'refusal':
        this.settle(message.id, (pending) => pending.reject(new Error(message.why)));
        return;
      case 'failed':
        this.failed(message.why);
        break;
      case 'opened':
        if (message.session === this.sessions) this.phase = { kind: 'running' };
        break;
      case 'ended':
        if (message.session === this.sessions) this.phase = { kind: 'ended', why: message.why };
        break;
    }
    this.socket?.receive(message);
  }

  /** The module is lost, with the files in its memory; the next session loads it again. */
  private failed(why: string): void {
    this.phase = { kind: this.isLoaded ? 'ended' : 'unloaded', why };
    this.worker?.terminate();
    this.worker = undefined;
    for (const pending of this.requests.values()) pending.reject(new Error(why));
    this.requests.clear();
  }

  /** Executes a function of the module whose answer is JSON. */
  async call<Answer>(name: string, args: object = {}): Promise<Answer> {
    return JSON.parse(new TextDecoder().decode(await this.callBytes(name, args))) as Answer;
  }

  async callBytes(name: string, args: object = {}): Promise<Uint8Array<ArrayBuffer>> {
    return (await this.ask({ op: 'call', name, args })) as Uint8Array<ArrayBuffer>;
  }

  // Files in the memory of the module.

  async list(folder: string): Promise<MemoryFile[]> {
    return (await this.ask({ op: 'list', folder })) as MemoryFile[];
  }

  async read(path: string): Promise<Uint8Array<ArrayBuffer>> {
    return (await this.ask({ op: 'read', path })) as Uint8Array<ArrayBuffer>;
  }

  async write(path: string, content: Uint8Array<ArrayBuffer>): Promise<void> {
    await this.ask({ op: 'write', path, content }, [content.buffer]);
  }

  async remove(path: string): Promise<void> {
    await this.ask({ op: 'remove', path });
  }

  private ask(request: Request, transfer: Transferable[] = []) {
    return new Promise<MemoryFile[] | Uint8Array<ArrayBuffer> | undefined>((resolve, reject) => {
      if (!this.worker) {
        reject(new Error(t().tab.notLoaded));
        return;
      }
      const id = ++this.lastId;
      this.requests.set(id, { resolve, reject });
      this.post({ kind: 'request', id, request }, transfer);
    });
  }

  private settle(id: number, act: (pending: Pending) => void): void {
    const pending = this.requests.get(id);
    this.requests.delete(id);
    if (pending) act(pending);
  }
}
