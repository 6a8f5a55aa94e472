/** Options of a session; see `TabOptions` in src/options.rs. */
export type SessionOptions = Record<string, unknown>;

export interface MemoryFile {
  path: string;
  bytes: number;
}

/** A session in WebAssembly. Errors of the simulator are thrown with its words. */
export class Core {
  private constructor();
  /** Compiles and starts the module from its bytes, or from a response that is compiled while it is received. */
  static start(source: BufferSource | Response): Promise<Core>;
  /** Starts a session; one that runs is ended. */
  open(options: SessionOptions): void;
  /** Ends the session. */
  close(): void;
  /** Steps until a simulated time [ns]. */
  stepUntil(endNs: bigint): void;
  /**
   * Steps at the real-time factor of the world for at most this much wall time [ms]; returns the time until the next
   * step is due [ms].
   */
  runPaced(budgetMs: number): number;
  /** Simulated time [ns]. */
  get timeNs(): bigint;
  /** True after a panic: the module must not be used any more. */
  get isBroken(): boolean;
  /** Bytes of the memory of the module. */
  get memoryBytes(): number;
  /** Processes a message of the client: text, or bytes. */
  send(message: string | Uint8Array): void;
  /** Takes the next message to the client: text, bytes, or null. Throws when the client is disconnected. */
  take(): string | Uint8Array<ArrayBuffer> | null;
  /** Closes the recording of the session, so that its file is complete. */
  closeRecording(): void;
  readFile(path: string): Uint8Array<ArrayBuffer>;
  /** Writes a file, with its folders. */
  writeFile(path: string, content: Uint8Array): void;
  removeFile(path: string): void;
  /** Files below a folder, with their paths and sizes. */
  listFiles(folder: string): MemoryFile[];
  /** Executes a function with arguments in JSON, such as `check`, and returns its answer. */
  call(name: string, args?: object): unknown;
  /** As `call`, for an answer of bytes, such as `map_preview`. */
  callBytes(name: string, args?: object): Uint8Array<ArrayBuffer>;
}
