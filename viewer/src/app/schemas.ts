/** Definitions of the messages on topics, parsed once. */
import { parseSchema, type Schema } from '../core/schema';
import type { Channel } from '../core/protocol';
import type { App } from './app.svelte';

const parsed = new WeakMap<Channel, Schema>();

/** Definition of a topic's messages; `undefined` without a publisher. Throws if it cannot be read. */
export function schemaOfTopic(app: App, topic: string): Schema | undefined {
  const channel = app.feed.source.channels.get(topic);
  if (!channel) return undefined;
  let schema = parsed.get(channel);
  if (!schema) parsed.set(channel, (schema = parseSchema(channel.schemaName, channel.schema)));
  return schema;
}
