/** Subscriptions that outlive their source, a running system or recordings. */
import type { Handler } from './client';
import type { Channel, Ends, Mismatch, ServiceOffer } from './protocol';

/** Messages before a time that a subscriber needs to show that time; by default the newest one. */
export interface Need {
  /** All messages of the last seconds. */
  historyS?: number;
  /** At least this many messages, also older ones. */
  count?: number;
  /** Updates of a grid: all since the last complete grid. */
  isUpdates?: boolean;
}

/** Where messages come from. */
export interface Source {
  readonly channels: ReadonlyMap<string, Channel>;
  readonly services: ReadonlyMap<string, ServiceOffer>;
  readonly ends: Ends;
  readonly mismatches: readonly Mismatch[];
  /** Subscribes to a topic, now or once it exists. Call the returned function to unsubscribe. */
  subscribe(topic: string, handler: Handler, need?: Need): () => void;
}

interface Subscription {
  topic: string;
  handler: Handler;
  need: Need;
  leave: () => void;
}

/** The present source, and all subscriptions, which move to the next one. */
export class Feed {
  private subscriptions = new Set<Subscription>();

  constructor(private present: Source) {}

  get source(): Source {
    return this.present;
  }

  /** Moves all subscriptions to another source. */
  use(source: Source): void {
    if (source === this.present) return;
    for (const one of this.subscriptions) one.leave();
    this.present = source;
    for (const one of this.subscriptions) {
      one.leave = source.subscribe(one.topic, one.handler, one.need);
    }
  }

  subscribe(topic: string, handler: Handler, need: Need = {}): () => void {
    const leave = this.present.subscribe(topic, handler, need);
    const one: Subscription = { topic, handler, need, leave };
    this.subscriptions.add(one);
    return () => {
      if (this.subscriptions.delete(one)) one.leave();
    };
  }
}
