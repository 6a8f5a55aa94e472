import { describe, expect, test, vi } from 'vitest';
import { Client } from '../src/core/client';
import { Host, type WorkerPort } from '../src/tab/host.svelte';
import { readLink } from '../src/tab/link';
import { MapJob, type Caller } from '../src/tab/map_job.svelte';
import { Sessions } from '../src/tab/sessions';
import type { FromWorker, ToWorker } from '../src/tab/messages';
import { PortSocket } from '../src/tab/port_socket';
import { MAX_IN_FLIGHT_BYTES, SessionLoop, type Runner } from '../src/tab/session_loop';
import { bytesText } from '../src/app/bytes_text';

describe('link', () => {
  test('without settings it is the demo, whose robot drives to goals', () => {
    const options = { demo: { is_paced: true, navigation: true } };
    expect(readLink('')).toEqual({ kind: 'options', options });
  });

  test('seed and exploration belong to the demo', () => {
    const options = { demo: { is_paced: true, explore: true, seed: 3 } };
    expect(readLink('?seed=3&explore')).toEqual({ kind: 'options', options });
  });

  test('world and robots are a run with their files', () => {
    const robots = [{ file: 'a.urdf' }, { file: 'b.xacro' }];
    const options = { run: { is_paced: true, world: 'room.world', robots, seed: 1 } };
    const paths = ['room.world', 'a.urdf', 'b.xacro'];
    const link = readLink('?world=room.world&robot=a.urdf&robot=b.xacro&seed=1');
    expect(link).toEqual({ kind: 'files', options, paths });
  });

  test('a session has a name', () => {
    expect(readLink('?session=kbot&seed=2')).toEqual({ kind: 'session', name: 'kbot', seed: 2 });
  });

  test.each([
    ['?sed=3', /"sed" is unknown.*seed/],
    ['?seed=-1', /seed is "-1"/],
    ['?seed=1.5', /seed is "1.5"/],
    ['?seed=1&seed=2', /more than once/],
    ['?explore=maybe', /true or false/],
    ['?world=', /is empty/],
    ['?world=room.world&explore', /belongs to the demo/],
    ['?session=kbot&world=room.world', /cannot be combined/],
  ])('%s is refused', (search, why) => {
    const link = readLink(search);
    expect(link.kind === 'refused' && link.why()).toMatch(why);
  });
});

describe('ready sessions', () => {
  const list = [
    { name: 'a', title: { en: 'A' }, files: ['w/room.sdf', 'r/bot.urdf'], options: {} },
    { name: 'b', title: { en: 'B' }, files: ['w/hall.sdf', 'r/bot.urdf'], options: {} },
  ];
  const served = (status: number) =>
    vi.fn(() => Promise.resolve(new Response(JSON.stringify({ sessions: list }), { status })));

  test('a file comes with those of all sessions that have it', async () => {
    vi.stubGlobal('fetch', served(200));
    const sessions = await Sessions.load(new URL('http://x/'));
    expect(sessions.around(['w/hall.sdf'])).toEqual(['w/hall.sdf', 'r/bot.urdf']);
    expect(sessions.around(['r/bot.urdf'])).toEqual(['w/room.sdf', 'r/bot.urdf', 'w/hall.sdf']);
    expect(() => sessions.around(['w/none.sdf'])).toThrow('does not have the file w/none.sdf');
    expect(() => sessions.named('c')).toThrow('This page has: a, b');
    vi.unstubAllGlobals();
  });

  test('a page without sessions has none; another failure is reported', async () => {
    vi.stubGlobal('fetch', served(404));
    expect((await Sessions.load(new URL('http://x/'))).list).toEqual([]);
    vi.stubGlobal('fetch', served(503));
    await expect(Sessions.load(new URL('http://x/'))).rejects.toThrow('503');
    vi.unstubAllGlobals();
  });
});

describe('mapping of a log', () => {
  /** Answers of the module by the names of its functions. */
  const caller = (answers: Record<string, (() => unknown) | undefined>) => {
    const calls: string[] = [];
    const call = async (name: string) => {
      calls.push(name);
      return answers[name]?.() ?? {};
    };
    const callBytes = async () => new Uint8Array([1]);
    return { calls, host: { call, callBytes } as unknown as Caller };
  };

  test('it steps until the map is complete, and frees it', async () => {
    let steps = 0;
    const { calls, host } = caller({
      map_step: () => ({ phase: ++steps === 3 ? 'complete' : 'mapping', fraction: steps / 3 }),
      map_write: () => ({ text: '3 scans', failure: null }),
    });
    const job = new MapJob(host, '/a.log', '/results/a');
    await job.run();
    expect(calls).toEqual([
      'map_open',
      'map_step',
      'map_step',
      'map_step',
      'map_write',
      'map_close',
    ]);
    expect([job.text, job.fraction, job.isRunning]).toEqual(['3 scans', 1, false]);
  });

  test('it can be cancelled between two steps', async () => {
    const found = caller({ map_step: () => (job.cancel(), { phase: 'mapping', fraction: 0.1 }) });
    const job = new MapJob(found.host, '/a.log', '/results/a');
    await job.run();
    expect(found.calls).toEqual(['map_open', 'map_step', 'map_close']);
  });
});

/** A module whose frames are given; steps do nothing. */
class Frames implements Runner {
  isBroken = false;
  memoryBytes = 65536;
  sent: unknown[] = [];
  isClosed = false;
  error?: Error;
  constructor(public frames: (string | Uint8Array<ArrayBuffer>)[]) {}
  runPaced = () => {
    if (this.error) throw this.error;
    return 5;
  };
  send = (data: unknown) => void this.sent.push(data);
  take = () => this.frames.shift() ?? null;
  close = () => void (this.isClosed = true);
}

function loopOf(core: Frames) {
  const posted: FromWorker[] = [];
  const runs: (() => void)[] = [];
  const outside = {
    post: (message: FromWorker) => void posted.push(message),
    later: (run: () => void) => void runs.push(run),
    nowMs: () => 0,
  };
  return { loop: new SessionLoop(7, core, outside), posted, runs };
}

const framesIn = (posted: FromWorker[]) =>
  posted.flatMap((message) => (message.kind === 'frames' ? message.frames : []));

describe('session in the worker', () => {
  test('frames wait in the module until the page has processed those before', () => {
    const half = () => new Uint8Array(MAX_IN_FLIGHT_BYTES / 2);
    const core = new Frames([half(), half(), half(), half()]);
    const { loop, posted } = loopOf(core);
    loop.start();
    expect(framesIn(posted).length).toBe(2);
    expect(core.frames.length).toBe(2);
    loop.received(MAX_IN_FLIGHT_BYTES / 2);
    expect(framesIn(posted).length).toBe(3);
  });

  test('messages of the page are confirmed by their size', () => {
    const core = new Frames([]);
    const { loop, posted } = loopOf(core);
    loop.start();
    loop.data(new Uint8Array(12));
    expect(core.sent.length).toBe(1);
    expect(posted).toContainEqual({ kind: 'sent', session: 7, bytes: 12 });
  });

  test('an error ends the session, a panic the module', () => {
    for (const isBroken of [false, true]) {
      const core = new Frames([]);
      const { loop, posted, runs } = loopOf(core);
      loop.start();
      core.error = new Error('the body diverged');
      core.isBroken = isBroken;
      runs.shift()!();
      const why = 'the body diverged';
      const ended: FromWorker = { kind: 'ended', session: 7, why };
      expect(posted.at(-1)).toEqual(isBroken ? { kind: 'failed', why } : ended);
      expect(runs).toEqual([]);
      // A module that has panicked is not called again.
      expect(core.isClosed).toBe(!isBroken);
    }
  });
});

describe('socket', () => {
  test('bytes are counted until the module has processed them, and buffers are moved', () => {
    const posted: [ToWorker, Transferable[]?][] = [];
    const socket = new PortSocket(1, {}, (message, transfer) => posted.push([message, transfer]));
    socket.receive({ kind: 'opened', session: 1 });
    const whole = new Uint8Array([1, 2, 3]);
    socket.send(whole);
    const part = whole.subarray(1);
    socket.send(part);
    expect(socket.bufferedAmount).toBe(5);
    expect(posted[1]![1]).toEqual([whole.buffer]);
    expect(posted[2]![1]![0]).not.toBe(whole.buffer);
    socket.receive({ kind: 'sent', session: 1, bytes: 5 });
    expect(socket.bufferedAmount).toBe(0);
  });

  test('frames are confirmed, also if one of them cannot be handled', () => {
    const posted: ToWorker[] = [];
    const socket = new PortSocket(1, {}, (message) => posted.push(message));
    socket.receive({ kind: 'opened', session: 1 });
    socket.onmessage = () => {
      throw new Error('bad');
    };
    const frames = { kind: 'frames', session: 1, frames: ['x'], bytes: 1 } as const;
    expect(() => socket.receive({ ...frames, frames: [...frames.frames] })).toThrow('bad');
    expect(posted.at(-1)).toEqual({ kind: 'received', session: 1, bytes: 1 });
  });

  test('messages of an earlier session have no effect', () => {
    const socket = new PortSocket(2, {}, () => undefined);
    const heard = vi.fn();
    socket.onmessage = heard;
    socket.receive({ kind: 'opened', session: 1 });
    expect(socket.readyState).toBe(0);
    socket.receive({ kind: 'frames', session: 1, frames: ['x'], bytes: 1 });
    expect(heard).not.toHaveBeenCalled();
  });
});

function hostOf() {
  const workers: (WorkerPort & { posted: ToWorker[]; isGone: boolean })[] = [];
  const make = () => {
    const posted: ToWorker[] = [];
    const worker = {
      posted,
      isGone: false,
      early: [],
      onmessage: null,
      onerror: null,
      postMessage: (message: ToWorker) => void posted.push(message),
      terminate: () => void (worker.isGone = true),
    };
    workers.push(worker);
    return worker;
  };
  return { host: new Host(make, 100), workers };
}

const nothing = () => undefined;

test('a panic is shown, and a start loads the module again', () => {
  vi.useFakeTimers();
  const { host, workers } = hostOf();
  const states: [string, string][] = [];
  const client = new Client(() => host.open(), {
    state: (state, why) => states.push([state, why]),
    graphChanged: nothing,
    parameters: nothing,
    time: nothing,
    status: nothing,
  });
  client.start();
  const tell = (data: FromWorker) => workers.at(-1)!.onmessage!({ data });
  tell({ kind: 'loaded' });
  expect(host.phase.kind).toBe('starting');
  tell({ kind: 'opened', session: 1 });
  expect(host.phase.kind).toBe('running');
  tell({ kind: 'failed', why: 'panicked at x.rs:1' });
  expect(host.phase).toEqual({ kind: 'ended', why: 'panicked at x.rs:1' });
  expect(states.at(-1)).toEqual(['closed', 'panicked at x.rs:1']);
  expect(workers[0]!.isGone).toBe(true);
  // It would only end again: the client does not open it by itself.
  vi.advanceTimersByTime(60_000);
  expect(workers.length).toBe(1);
  client.start();
  expect(workers.length).toBe(2);
  vi.useRealTimers();
});

test('files are asked of the worker, and refused with its reason', async () => {
  const { host, workers } = hostOf();
  const tell = (data: FromWorker) => workers[0]!.onmessage!({ data });
  const listed = host.list('/');
  const read = host.read('/none');
  tell({ kind: 'answer', id: 1, result: [{ path: '/a', bytes: 1 }] });
  tell({ kind: 'refusal', id: 2, why: '`/none`: entity not found' });
  expect(await listed).toEqual([{ path: '/a', bytes: 1 }]);
  await expect(read).rejects.toThrow('entity not found');
});

test('sizes have a unit that fits', () => {
  expect([0, 999, 1500, 19_800_000].map(bytesText)).toEqual(['0 B', '999 B', '1.5 kB', '19.8 MB']);
});
