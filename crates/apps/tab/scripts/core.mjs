// The WebAssembly module as a class, for node and for the worker of the page. Types are in core.d.mts.

/** A session in WebAssembly. Errors of the simulator are thrown with its words. */
export class Core {
  #exports;
  #panic = "";
  #isBroken = false;

  /** Compiles and starts the module from its bytes, or from a response that is compiled while it is received. */
  static async start(source) {
    const core = new Core();
    const imports = {
      periplus: {
        clock_ms: () => performance.timeOrigin + performance.now(),
        panicked: (address, length) => {
          core.#panic = new TextDecoder().decode(core.#bytes(address, length));
        },
      },
    };
    const { instance } =
      typeof Response === "function" && source instanceof Response
        ? await WebAssembly.instantiateStreaming(source, imports)
        : await WebAssembly.instantiate(source, imports);
    core.#exports = instance.exports;
    return core;
  }

  #bytes(address, length) {
    return new Uint8Array(this.#exports.memory.buffer, address >>> 0, length >>> 0);
  }

  #pass(bytes) {
    const address = this.#exports.periplus_alloc(bytes.length);
    this.#bytes(address, bytes.length).set(bytes);
    return [address, bytes.length];
  }

  #answer() {
    const address = this.#exports.periplus_answer();
    return this.#bytes(address, this.#exports.periplus_answer_length()).slice();
  }

  #call(name, ...args) {
    if (!this.#exports[name]) throw new Error(`this module was built without ${name}`);
    let code;
    try {
      code = this.#exports[name](...args);
    } catch (error) {
      this.#isBroken = true;
      throw new Error(this.#panic || `${name}: ${error.message}`, { cause: error });
    }
    if (code !== 0) throw new Error(new TextDecoder().decode(this.#answer()));
    return this.#answer();
  }

  #text(text) {
    return this.#pass(new TextEncoder().encode(text));
  }

  open(options) {
    this.#call("periplus_open", ...this.#text(JSON.stringify(options)));
  }

  /** Steps until a simulated time [ns, bigint]. */
  stepUntil(endNs) {
    this.#call("periplus_step_until", endNs);
  }

  /**
   * Steps at the real-time factor of the world for at most this much wall time [ms]; returns the time until the next
   * step is due [ms].
   */
  runPaced(budgetMs) {
    const answer = this.#call("periplus_run_paced", budgetMs);
    return new DataView(answer.buffer).getFloat64(0, true);
  }

  get timeNs() {
    return this.#exports.periplus_time_ns();
  }

  /** True after a panic: the module must not be used any more. */
  get isBroken() {
    return this.#isBroken;
  }

  /** Bytes of the memory of the module. */
  get memoryBytes() {
    return this.#exports.memory.buffer.byteLength;
  }

  /** Processes a message of the client: text, or bytes. */
  send(message) {
    if (typeof message === "string") this.#call("periplus_text", ...this.#text(message));
    else this.#call("periplus_binary", ...this.#pass(message));
  }

  /** Takes the next message to the client: text, bytes, or null. Throws when the client is disconnected. */
  take() {
    const kind = this.#exports.periplus_take();
    if (kind === 0) return null;
    const bytes = this.#answer();
    if (kind === 2) return bytes;
    const text = new TextDecoder().decode(bytes);
    if (kind === 3) throw new Error(text || "the session has ended");
    return text;
  }

  /** Ends the session. */
  close() {
    this.#exports.periplus_close();
  }

  closeRecording() {
    this.#call("periplus_close_recording");
  }

  readFile(path) {
    return this.#call("periplus_read_file", ...this.#text(path));
  }

  writeFile(path, content) {
    this.#call("periplus_write_file", ...this.#text(path), ...this.#pass(content));
  }

  removeFile(path) {
    this.#call("periplus_remove_file", ...this.#text(path));
  }

  /** Files below a folder, with their paths and sizes. */
  listFiles(folder) {
    return JSON.parse(new TextDecoder().decode(this.#call("periplus_list_files", ...this.#text(folder))));
  }

  /** Executes a function with arguments in JSON, such as `check`, and returns its answer. */
  call(name, args = {}) {
    return JSON.parse(new TextDecoder().decode(this.callBytes(name, args)));
  }

  /** As `call`, for an answer of bytes, such as `map_preview`. */
  callBytes(name, args = {}) {
    return this.#call("periplus_call", ...this.#text(JSON.stringify({ [name]: args })));
  }
}
