import { expect, test } from 'vitest';
import { ReplaySource } from '../src/core/replay';
import type { TopicNeed } from '../src/core/replay_requests';
import { MemoryServer, type Entry } from './replay_server';

/** A number per second on /count, from 0 s to 10 s. */
const counts = (first = 0): Entry[] =>
  Array.from({ length: 11 }, (_, i) => ({
    atS: i,
    topic: '/count',
    type: 'std_msgs/msg/Int32',
    message: { data: first + i },
  }));

function replayOf(server: MemoryServer, startS: number, entries: Entry[], latched: string[] = []) {
  const log: string[] = [];
  const source = new ReplaySource(server.recording(1, startS, entries, latched), server.requests, {
    time: () => undefined,
    jumped: () => log.push('jump'),
    shown: () => log.push('shown'),
    offersChanged: () => undefined,
    failed: (message) => log.push(message),
  });
  const heard = (message: Record<string, unknown>) => log.push(String(message.data));
  return { source, log, heard };
}

const settled = () => new Promise((resolve) => setTimeout(resolve, 0));

/** Plays for some frames of 100 ms. */
async function play(source: ReplaySource, frames: number) {
  for (let i = 0; i <= frames; i++) {
    source.tick(i * 100);
    await settled();
  }
}

test('a new subscription gets the newest message, or as many as it needs', async () => {
  const server = new MemoryServer();
  const { source, log, heard } = replayOf(server, 100, counts());
  await source.seek(4.5e9);
  log.length = 0;
  source.subscribe('/count', heard);
  await settled();
  expect(log).toEqual(['4', 'shown']);
  log.length = 0;
  source.subscribe('/count', heard, { count: 3 });
  await settled();
  expect(log).toEqual(['2', '3', '4', 'shown']);
  log.length = 0;
  source.subscribe('/count', heard, { historyS: 1 });
  await settled();
  expect(log).toEqual(['4', 'shown']);
});

test('a jump forgets everything and shows the state of its time', async () => {
  const { source, log, heard } = replayOf(new MemoryServer(), 100, counts());
  source.subscribe('/count', heard);
  await settled();
  log.length = 0;
  await source.seek(7e9);
  expect(log).toEqual(['jump', '7', 'shown']);
  expect(source.timeS()).toBe(107);
  await source.seek(99e9);
  expect(source.timeS()).toBe(110);
});

test('while one jump is fetched, only the newest of the others waits', async () => {
  const server = new MemoryServer();
  const { source, log, heard } = replayOf(server, 0, counts());
  source.subscribe('/count', heard);
  await settled();
  log.length = 0;
  server.asked = [];
  server.isHeld = true;
  const all = [1, 2, 3, 4].map((s) => source.seek(s * 1e9));
  server.answer();
  await settled();
  server.answer();
  await Promise.all(all);
  expect(server.asked.map((one) => one.timeNs)).toEqual(['1000000000', '4000000000']);
  expect(log).toEqual(['jump', '1', 'shown', 'jump', '4', 'shown']);
});

test('plays messages in the order of time, at the rate, and stops at the end', async () => {
  const { source, log, heard } = replayOf(new MemoryServer(), 0, counts());
  source.subscribe('/count', heard);
  await source.seek(0);
  log.length = 0;
  source.rate = 10;
  source.play();
  // The first frame fetches, the second begins.
  await play(source, 6);
  expect(log).toEqual(['1', '2', '3', '4', '5', '6']);
  await play(source, 10);
  expect(log.slice(6)).toEqual(['7', '8', '9', '10']);
  expect(source.playhead.isPlaying).toBe(false);
});

test('a loop goes back to its start by a jump', async () => {
  const { source, log, heard } = replayOf(new MemoryServer(), 0, counts());
  source.subscribe('/count', heard);
  await source.seek(2e9);
  source.playhead.loop = { fromNs: 2e9, toNs: 4e9 };
  log.length = 0;
  source.rate = 10;
  source.play();
  await play(source, 4);
  expect(log).toEqual(['3', '4', 'jump', '2', 'shown']);
  expect(source.playhead.isPlaying).toBe(true);
});

test('steps by message of a topic, forward and back', async () => {
  const entries = counts();
  entries.push({ atS: 4.5, topic: '/other', type: 'std_msgs/msg/Int32', message: { data: 9 } });
  const { source } = replayOf(new MemoryServer(), 50, entries);
  source.subscribe('/count', () => undefined);
  source.subscribe('/other', () => undefined);
  await source.seek(4e9);
  expect(await source.neighbour(1)).toBe(4.5e9);
  expect(await source.neighbour(1, '/count')).toBe(5e9);
  expect(await source.neighbour(-1)).toBe(3e9);
  expect(await source.neighbour(-1, '/other')).toBeUndefined();
});

test('a large topic drops to its newest messages, a latched one does not', async () => {
  const entries: Entry[] = [];
  for (const topic of ['/frame', '/latched']) {
    for (let i = 0; i < 4; i++) {
      const message = { stamp: { sec: i, nanosec: 0 }, frame_id: 'x'.repeat(200_000) };
      entries.push({ atS: i * 0.01, topic, type: 'std_msgs/msg/Header', message });
    }
  }
  const { source } = replayOf(new MemoryServer(), 0, entries, ['/latched']);
  const got: Record<string, number[]> = { '/frame': [], '/latched': [] };
  for (const topic of Object.keys(got)) {
    source.subscribe(topic, (message, name) =>
      got[name]!.push((message.stamp as { sec: number }).sec),
    );
  }
  await source.seek(0);
  source.play();
  await play(source, 3);
  expect(got['/frame']!.slice(-1)).toEqual([3]);
  expect(got['/frame']).not.toContain(2);
  expect(got['/latched']!.slice(-3)).toEqual([1, 2, 3]);
});

test('the transforms of a state reach back as far as the messages placed by them', async () => {
  const server = new MemoryServer();
  const transform = { transforms: [] };
  const entries = [
    ...counts(),
    { atS: 1, topic: '/tf', type: 'tf2_msgs/msg/TFMessage', message: transform },
  ];
  const { source } = replayOf(server, 0, entries);
  source.subscribe('/tf', () => undefined);
  source.subscribe('/count', () => undefined, { historyS: 5 });
  await settled();
  await source.seek(8e9);
  const topics = server.asked.at(-1)!.topics as TopicNeed[];
  expect(topics.find((one) => one.id === 2)!.historyNs).toBe('6000000000');
});

test('updates of a map come since the map', async () => {
  const int = 'std_msgs/msg/Int32';
  const at = (atS: number, topic: string, data: number): Entry => {
    return { atS, topic, type: int, message: { data } };
  };
  const entries = [at(1, '/map', 100), at(0.5, '/map_updates', 1), at(2, '/map_updates', 2)];
  entries.push(at(3, '/map_updates', 3), at(4, '/map_updates', 4), at(9, '/map', 200));
  const { source, log, heard } = replayOf(new MemoryServer(), 0, entries);
  source.subscribe('/map', heard);
  source.subscribe('/map_updates', heard, { isUpdates: true });
  await settled();
  log.length = 0;
  // The start of the recording is its first message, at 0.5 s: position 3 s is 3 s after the time 0.
  await source.seek(3e9);
  expect(log).toEqual(['jump', '100', '2', '3', 'shown']);
});

test('a second recording has the prefix B: in topics and frames, and the time of the first', async () => {
  const server = new MemoryServer();
  const header = (sec: number): Entry[] => [
    {
      atS: 1,
      topic: '/at',
      type: 'std_msgs/msg/Header',
      message: { stamp: { sec, nanosec: 5 }, frame_id: '/map' },
    },
    { atS: 9, topic: '/count', type: 'std_msgs/msg/Int32', message: { data: 1 } },
  ];
  const { source } = replayOf(server, 100, header(101));
  const second = source.add(server.recording(2, 5000, header(5001)));
  expect([...source.channels.keys()]).toEqual(['/at', '/count', 'B:/at', 'B:/count']);
  const got: unknown[] = [];
  for (const topic of ['/at', 'B:/at']) source.subscribe(topic, (message) => got.push(message));
  await source.seek(2e9);
  expect(got).toContainEqual({ stamp: { sec: 101, nanosec: 5 }, frame_id: '/map' });
  expect(got).toContainEqual({ stamp: { sec: 101, nanosec: 5 }, frame_id: 'B:map' });
  // Moved by three seconds: nothing of it is there yet.
  source.align(second, 3e9);
  expect(source.playhead.endNs).toBe(12e9);
  source.remove(second);
  expect([...source.channels.keys()]).toEqual(['/at', '/count']);
});

test('recordings that overlap in time are aligned by their times', () => {
  const server = new MemoryServer();
  const { source } = replayOf(server, 100, counts());
  expect(source.add(server.recording(2, 104, counts())).beginNs).toBe(4e9);
  expect(source.add(server.recording(3, 300, counts())).beginNs).toBe(0);
  expect(source.tracks.map((track) => track.prefix)).toEqual(['', 'B:', 'C:']);
});
