/** Requests of a client for recordings (docs/live.md, "Recordings"). */
import {
  uploadFrame,
  type JobKind,
  type JobParameter,
  type Mark,
  type ParameterValue,
  type Recording,
  type RecordingText,
  type ServerFrame,
  type StoredDifference,
  type StoredMessage,
} from './protocol';

/** Connection that the requests are sent over. */
export interface Wire {
  isOpen(): boolean;
  send(data: string | Uint8Array<ArrayBuffer>): void;
  /** Bytes that were sent and have not left yet. */
  waitingBytes(): number;
  nextId(): number;
}

export interface TopicNeed {
  id: number;
  historyNs: string;
  count: number;
}

/** Messages of a span, up to and including `reachedNs`. */
export interface Span {
  messages: StoredMessage[];
  reachedNs: bigint;
  isMore: boolean;
}

/** Series of numbers: a list of values per path. */
export interface StoredSeries {
  timesNs: bigint[];
  values: number[][];
  isReduced: boolean;
}

/** File of an upload: a `File` of the browser, or bytes. */
export interface UploadedFile {
  name: string;
  size: number;
  slice(start: number, end: number): { arrayBuffer(): Promise<ArrayBuffer> };
}

interface Pending {
  messages: StoredMessage[];
  text(text: RecordingText): void;
  span(span: Span): void;
  fail(error: Error): void;
}

const NOT_CONNECTED = 'not connected';
/** Size of the parts of an upload [bytes]. */
const UPLOAD_PART_BYTES = 1 << 20;
/** Parts wait while this much has not left the browser, or is not confirmed [bytes]. */
const UPLOAD_AHEAD_BYTES = 8 << 20;

export class RecordingRequests {
  recordings: readonly Recording[] = [];
  /** True while the server records the running system. */
  isRecording = false;
  private pending = new Map<number, Pending>();
  /** Requests that are answered by a change of the list, or by a failure. */
  private commands = new Set<number>();
  /** Receivers of the parts of files. */
  private files = new Map<number, (part: Uint8Array<ArrayBuffer>, isLast: boolean) => void>();
  private uploads = new Map<
    number,
    { confirmedBytes: number; wake(): void; fail(e: Error): void }
  >();

  constructor(
    private wire: Wire,
    private changed: () => void,
    /** A command (open, close, record, run) failed. */
    private commandFailed: (message: string) => void,
  ) {}

  find(id: number): Recording | undefined {
    return this.recordings.find((one) => one.id === id);
  }

  // Messages.

  /** Messages that show a time: of each topic the newest ones at or before it. */
  async state(
    recording: number,
    timeNs: bigint,
    topics: readonly TopicNeed[],
    signal?: AbortSignal,
  ): Promise<StoredMessage[]> {
    const request = { op: 'fetchState', recording, timeNs: String(timeNs), topics };
    return (await this.span(request, signal)).messages;
  }

  /** Messages with `startNs <= time < endNs`, until they have `maxBytes`. */
  messages(
    recording: number,
    topics: readonly number[],
    startNs: bigint,
    endNs: bigint,
    maxBytes: number,
    signal?: AbortSignal,
  ): Promise<Span> {
    const span = { startNs: String(startNs), endNs: String(endNs) };
    return this.span({ op: 'fetchMessages', recording, topics, ...span, maxBytes }, signal);
  }

  private span(request: object, signal?: AbortSignal): Promise<Span> {
    return new Promise((resolve, reject) => {
      const requestId = this.ask(request, { span: resolve, fail: reject });
      if (requestId === undefined) return;
      signal?.addEventListener(
        'abort',
        () => {
          if (!this.pending.delete(requestId)) return;
          this.send({ op: 'cancelFetch', requestIds: [requestId] });
          reject(new DOMException('The request was cancelled', 'AbortError'));
        },
        { once: true },
      );
    });
  }

  // Summaries.

  /** Message counts by topic id in equal parts of the recording. */
  async density(recording: number, bins: number): Promise<Map<number, number[]>> {
    const text = await this.text({ op: 'fetchDensity', recording, bins }, 'density');
    return new Map(Object.entries(text.topics).map(([id, counts]) => [Number(id), counts]));
  }

  /** Calls `found` with all marks known so far, again when there are more; returns a function that stops it. */
  marks(
    recording: number,
    found: (marks: Mark[], isComplete: boolean) => void,
    failed: (error: Error) => void,
  ): () => void {
    const id = this.ask(
      { op: 'fetchMarks', recording },
      {
        fail: failed,
        text: (text) => {
          if (text.op !== 'marks') return;
          if (text.isComplete) this.pending.delete(text.requestId);
          found(text.marks, text.isComplete);
        },
      },
    );
    return () => {
      if (id !== undefined && this.pending.delete(id)) {
        this.send({ op: 'cancelFetch', requestIds: [id] });
      }
    };
  }

  async series(
    recording: number,
    topic: number,
    paths: readonly string[],
    startNs: bigint,
    endNs: bigint,
    points: number,
  ): Promise<StoredSeries> {
    const span = { startNs: String(startNs), endNs: String(endNs) };
    const request = { op: 'fetchSeries', recording, topic, paths, ...span, points };
    const text = await this.text(request, 'series');
    return {
      timesNs: text.timesNs.map(BigInt),
      values: text.values.map((all) => all.map((value) => value ?? NaN)),
      isReduced: text.isReduced,
    };
  }

  // Recordings.

  close(recording: number): void {
    this.command({ op: 'closeRecording', recording });
  }

  /** Uploads the files of a recording and opens it; `progress` gets the confirmed bytes. */
  async upload(
    files: readonly UploadedFile[],
    progress: (bytes: number) => void,
    signal: AbortSignal,
  ): Promise<void> {
    const list = files.map(({ name, size }) => ({ name, bytes: size }));
    const { upload } = await this.text({ op: 'startUpload', files: list }, 'uploadStarted');
    let failure: Error | undefined;
    let wake = () => undefined as void;
    const state = {
      confirmedBytes: 0,
      wake: () => {
        progress(state.confirmedBytes);
        wake();
      },
      fail: (error: Error) => {
        failure = error;
        wake();
      },
    };
    this.uploads.set(upload, state);
    signal.addEventListener('abort', () => state.fail(new DOMException('cancelled', 'AbortError')));
    try {
      let sentBytes = 0;
      const mayGoOn = async (aheadBytes: number) => {
        while (!failure && sentBytes - state.confirmedBytes > aheadBytes) {
          await new Promise<void>((resolve) => (wake = resolve));
        }
        if (failure) throw failure;
      };
      for (const file of files) {
        for (let at = 0; at < file.size; at += UPLOAD_PART_BYTES) {
          const end = Math.min(file.size, at + UPLOAD_PART_BYTES);
          const part = new Uint8Array(await file.slice(at, end).arrayBuffer());
          await mayGoOn(UPLOAD_AHEAD_BYTES);
          if (!this.wire.isOpen()) throw new Error(NOT_CONNECTED);
          this.wire.send(uploadFrame(upload, part));
          sentBytes += part.length;
        }
      }
      await mayGoOn(0);
    } catch (error) {
      this.send({ op: 'cancelFetch', requestIds: [upload] });
      throw error;
    } finally {
      this.uploads.delete(upload);
    }
    this.command({ op: 'openRecording', upload });
  }

  /** Report of one recording, or of two, as an HTML document. */
  async report(recordings: readonly number[]): Promise<string> {
    return (await this.text({ op: 'fetchReport', recordings }, 'report')).html;
  }

  /** Difference of two recordings: their topics, maps and trajectories. */
  async difference(
    recording: number,
    other: number,
    signal: AbortSignal,
  ): Promise<StoredDifference> {
    const request = { op: 'fetchDifference', recording, other };
    return (await this.text(request, 'difference', signal)).difference;
  }

  /** File of a recording; `progress` gets the received part, 0 to 1. */
  file(recording: number, progress: (part: number) => void): Promise<{ name: string; blob: Blob }> {
    return new Promise((resolve, reject) => {
      const parts: Uint8Array<ArrayBuffer>[] = [];
      let head = { name: '', bytes: 0 };
      let receivedBytes = 0;
      const requestId = this.ask(
        { op: 'fetchFile', recording },
        {
          fail: (error) => {
            if (requestId !== undefined) this.files.delete(requestId);
            reject(error);
          },
          text: (text) => {
            if (text.op === 'file') head = text;
          },
        },
      );
      if (requestId === undefined) return;
      this.files.set(requestId, (part, isLast) => {
        parts.push(part);
        receivedBytes += part.length;
        progress(head.bytes > 0 ? receivedBytes / head.bytes : 1);
        if (!isLast) return;
        this.files.delete(requestId);
        this.pending.delete(requestId);
        resolve({ name: head.name, blob: new Blob(parts) });
      });
    });
  }

  startRecording(): void {
    this.command({ op: 'startRecording' });
  }

  stopRecording(): void {
    this.command({ op: 'stopRecording' });
  }

  // Estimators that are run on a recording.

  async jobParameters(kind: JobKind): Promise<JobParameter[]> {
    return (await this.text({ op: 'fetchJobParameters', kind }, 'jobParameters')).parameters;
  }

  /** Starts an estimator; its result is a new recording. */
  startJob(kind: JobKind, recording: number, parameters: Record<string, ParameterValue>): void {
    this.command({ op: 'startJob', kind, recording, parameters });
  }

  // What the server sends.

  receiveText(text: RecordingText): void {
    switch (text.op) {
      case 'recordings':
        this.recordings = text.recordings;
        this.isRecording = text.isRecording;
        this.changed();
        break;
      case 'uploadProgress': {
        const upload = this.uploads.get(text.upload);
        if (upload) upload.confirmedBytes = text.bytes;
        upload?.wake();
        break;
      }
      case 'fetchFailure': {
        const pending = this.pending.get(text.requestId);
        this.pending.delete(text.requestId);
        pending?.fail(new Error(text.message));
        if (this.commands.delete(text.requestId)) this.commandFailed(text.message);
        break;
      }
      default:
        if ('requestId' in text) this.pending.get(text.requestId)?.text(text);
    }
  }

  receivePart(frame: ServerFrame & { op: 'filePart' }): void {
    this.files.get(frame.request)?.(frame.part, frame.isLast);
  }

  receiveFrame(frame: ServerFrame & { op: 'stored' }): void {
    const pending = this.pending.get(frame.request);
    if (!pending) return;
    for (const message of frame.messages) pending.messages.push(message);
    if (!frame.isLast) return;
    this.pending.delete(frame.request);
    const { reachedNs, isMore } = frame;
    pending.span({ messages: pending.messages, reachedNs, isMore });
  }

  /** Fails all requests. */
  disconnected(why: string): void {
    const error = new Error(why);
    for (const pending of this.pending.values()) pending.fail(error);
    for (const upload of this.uploads.values()) upload.fail(error);
    this.pending.clear();
    this.commands.clear();
    if (this.recordings.length === 0 && !this.isRecording) return;
    this.recordings = [];
    this.isRecording = false;
    this.changed();
  }

  private command(request: object): void {
    if (!this.wire.isOpen()) {
      this.commandFailed(NOT_CONNECTED);
      return;
    }
    const requestId = this.wire.nextId();
    this.commands.add(requestId);
    this.send({ ...request, requestId });
  }

  private text<Op extends RecordingText['op']>(
    request: object,
    op: Op,
    signal?: AbortSignal,
  ): Promise<RecordingText & { op: Op }> {
    return new Promise((resolve, reject) => {
      const id = this.ask(request, {
        fail: reject,
        text: (text) => {
          if (text.op !== op) return;
          if ('requestId' in text) this.pending.delete(text.requestId);
          resolve(text as RecordingText & { op: Op });
        },
      });
      signal?.addEventListener(
        'abort',
        () => {
          if (id === undefined || !this.pending.delete(id)) return;
          this.send({ op: 'cancelFetch', requestIds: [id] });
          reject(new DOMException('The request was cancelled', 'AbortError'));
        },
        { once: true },
      );
    });
  }

  private ask(
    request: object,
    answer: Partial<Pending> & Pick<Pending, 'fail'>,
  ): number | undefined {
    if (!this.wire.isOpen()) {
      answer.fail(new Error(NOT_CONNECTED));
      return undefined;
    }
    const requestId = this.wire.nextId();
    const nothing = () => undefined;
    this.pending.set(requestId, { messages: [], text: nothing, span: nothing, ...answer });
    this.send({ ...request, requestId });
    return requestId;
  }

  private send(message: object): void {
    if (this.wire.isOpen()) this.wire.send(JSON.stringify(message));
  }
}
