/** Worker with the simulator: loads the module, and runs one session at a time. */
import type { Core } from '../../../crates/apps/tab/scripts/core.mjs';
import type { Request, FromWorker, SessionOptions, ToWorker } from './messages';
import { loadModule } from './module';
import { SessionLoop } from './session_loop';

const scope = self as unknown as {
  postMessage(message: FromWorker, transfer?: Transferable[]): void;
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
};
const post = (message: FromWorker, transfer: Transferable[] = []) =>
  scope.postMessage(message, transfer);

// A timer of 0 ms waits for 4 ms after some calls; a message does not wait.
const channel = new MessageChannel();
const waiting: (() => void)[] = [];
channel.port1.onmessage = () => waiting.shift()?.();
function later(run: () => void, waitMs: number): void {
  if (waitMs > 0) setTimeout(run, waitMs);
  else {
    waiting.push(run);
    channel.port2.postMessage(undefined);
  }
}
const nowMs = () => performance.now();

let core: Promise<Core> | undefined;
let loop: SessionLoop | undefined;

async function open(session: number, options: SessionOptions): Promise<void> {
  loop?.stop();
  loop = undefined;
  const module = await core!;
  try {
    module.open(options);
  } catch (error) {
    const why = (error as Error).message;
    post(module.isBroken ? { kind: 'failed', why } : { kind: 'ended', session, why });
    return;
  }
  loop = new SessionLoop(session, module, { post, later, nowMs });
  loop.start();
}

function answer(module: Core, request: Request) {
  switch (request.op) {
    case 'call':
      return module.callBytes(request.name, request.args);
    case 'list':
      return module.listFiles(request.folder);
    case 'read':
      return module.readFile(request.path);
    case 'write':
      module.writeFile(request.path, request.content);
      return undefined;
    case 'remove':
      module.removeFile(request.path);
      return undefined;
  }
}

async function work(id: number, request: Request): Promise<void> {
  try {
    const result = answer(await core!, request);
    post({ kind: 'answer', id, result }, result instanceof Uint8Array ? [result.buffer] : []);
  } catch (error) {
    post({ kind: 'refusal', id, why: (error as Error).message });
  }
}

function load(url: string): void {
  core = loadModule(url, (receivedBytes) => post({ kind: 'progress', receivedBytes }));
  core.then(
    () => post({ kind: 'loaded' }),
    (error: Error) => post({ kind: 'failed', why: error.message }),
  );
}

scope.onmessage = ({ data: message }) => {
  switch (message.kind) {
    case 'load':
      load(message.url);
      break;
    case 'open':
      // A module that cannot be loaded is reported once, by `load`.
      open(message.session, message.options).catch(() => undefined);
      break;
    case 'close':
      if (loop?.session === message.session) loop.stop();
      break;
    case 'data':
      if (loop?.session === message.session) loop.data(message.data);
      break;
    case 'received':
      if (loop?.session === message.session) loop.received(message.bytes);
      break;
    case 'request':
      void work(message.id, message.request);
      break;
  }
};
