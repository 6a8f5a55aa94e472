/** Options of a session; see `TabOptions` in src/options.rs. */
export type SessionOptions = Record<string, unknown>;

/** A session in WebAssembly. Errors of the simulator are thrown with its words. */
export class Core {
  private constructor();
  /** Compiles and starts the module from its bytes. */
  static start(source: BufferSource): Promise<Core>;
  /** Starts a session. */
  open(options: SessionOptions): void;
  /** Steps until a simulated time [ns]. */
  stepUntil(endNs: bigint): void;
  /** Simulated time [ns]. */
  get timeNs(): bigint;
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
}
