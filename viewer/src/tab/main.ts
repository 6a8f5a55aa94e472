/** Start of the page without a server: the module is received while the page is. */
import moduleUrl from 'periplus-module?url';
import type { FromWorker, ToWorker } from './messages';
import type { WorkerPort } from './host.svelte';

/** Size of the module [bytes], from the build. */
declare const MODULE_BYTES: number;

function makeWorker(): WorkerPort {
  const early: FromWorker[] = [];
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
  const url = new URL(moduleUrl, location.href).href;
  worker.postMessage({ kind: 'load', url } satisfies ToWorker);
  worker.onmessage = ({ data }: MessageEvent<FromWorker>) => early.push(data);
  return Object.assign(worker as unknown as WorkerPort, { early });
}

// Compiling takes longest: it begins before the page itself is loaded.
let first: WorkerPort | undefined = makeWorker();
const take = () => {
  const worker = first ?? makeWorker();
  first = undefined;
  return worker;
};
void import('./page').then(({ show }) => show(take, MODULE_BYTES));
