import { expect, test } from 'vitest';
import type { Handler } from '../src/core/client';
import { Feed, type Need, type Source } from '../src/core/feed';

function source() {
  const handlers = new Map<Handler, string>();
  const needs: Need[] = [];
  const it: Source = {
    channels: new Map(),
    services: new Map(),
    ends: { publishedTopics: [], subscribedTopics: [], advertisedServices: [] },
    mismatches: [],
    subscribe: (topic, handler, need = {}) => {
      handlers.set(handler, topic);
      needs.push(need);
      return () => handlers.delete(handler);
    },
  };
  return { it, handlers, needs };
}

test('subscriptions move to the next source with what they need', () => {
  const [live, recorded] = [source(), source()];
  const feed = new Feed(live.it);
  const scan: Handler = () => undefined;
  const map: Handler = () => undefined;
  feed.subscribe('/scan', scan, { historyS: 2 });
  const leave = feed.subscribe('/map', map);
  feed.use(recorded.it);
  expect([...live.handlers.values()]).toEqual([]);
  expect([...recorded.handlers.values()]).toEqual(['/scan', '/map']);
  expect(recorded.needs[0]).toEqual({ historyS: 2 });
  leave();
  leave();
  feed.use(live.it);
  expect([...live.handlers.values()]).toEqual(['/scan']);
});
