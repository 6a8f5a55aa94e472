/**
 * Settings in the address of a page without a server: `?seed=3&explore`, `?session=NAME`, `?world=PATH&robot=PATH`.
 * Unknown names and wrong values are refused, so that a link never starts anything else.
 */
import { t } from '../texts/language.svelte';
import type { SessionOptions } from './messages';

/** What is started. */
export type Launch =
  | { kind: 'options'; options: SessionOptions }
  /** A ready session of the page. */
  | { kind: 'session'; name: string; seed?: number }
  /** A world and robots from files that the page has beside it. */
  | { kind: 'files'; options: SessionOptions; paths: string[] };

/** A link, or the reason why it cannot be used, in the present language. */
export type Link = Launch | { kind: 'refused'; why: () => string };

class Refusal extends Error {
  constructor(readonly words: () => string) {
    super(words());
  }
}

/** Settings that a link may have; `robot` may be repeated. */
export const NAMES = ['session', 'world', 'robot', 'seed', 'explore'] as const;
type Name = (typeof NAMES)[number];

/** Largest seed: numbers of JSON are exact up to it. */
const MAX_SEED = Number.MAX_SAFE_INTEGER;

/** The robot drives to goals of the user. */
export const DEMO: Launch = {
  kind: 'options',
  options: { demo: { is_paced: true, navigation: true } },
};

function seedOf(text: string): number {
  const seed = Number(text);
  if (!/^\d+$/.test(text) || seed > MAX_SEED)
    throw new Refusal(() => t().tab.badSeed(text, MAX_SEED));
  return seed;
}

function flagOf(name: Name, text: string): boolean {
  if (['', '1', 'true'].includes(text)) return true;
  if (['0', 'false'].includes(text)) return false;
  throw new Refusal(() => t().tab.badFlag(name, text));
}

function launchOf(query: URLSearchParams): Launch {
  for (const name of query.keys()) {
    if (!(NAMES as readonly string[]).includes(name)) {
      throw new Refusal(() => t().tab.unknownSetting(name, NAMES.join(', ')));
    }
    if (name !== 'robot' && query.getAll(name).length > 1) {
      throw new Refusal(() => t().tab.twice(name));
    }
  }
  for (const [name, text] of query) {
    if (['session', 'world', 'robot'].includes(name) && !text) {
      throw new Refusal(() => t().tab.empty(name));
    }
  }
  const [session, world, seed, explore] = (['session', 'world', 'seed', 'explore'] as const).map(
    (name) => query.get(name),
  );
  const robots = query.getAll('robot');
  const seeded = seed == null ? {} : { seed: seedOf(seed) };
  const hasFiles = world != null || robots.length > 0;
  if (explore != null && (hasFiles || session != null)) {
    throw new Refusal(() => t().tab.onlyDemo('explore'));
  }
  if (session != null) {
    if (hasFiles) throw new Refusal(() => t().tab.onlyOne('session', 'world, robot'));
    return { kind: 'session', name: session, ...seeded };
  }
  if (hasFiles) {
    const run = {
      is_paced: true,
      ...(world != null && { world }),
      robots: robots.map((file) => ({ file })),
      ...seeded,
    };
    const paths = world == null ? robots : [world, ...robots];
    return { kind: 'files', options: { run }, paths };
  }
  const explores = explore != null && flagOf('explore', explore);
  const driver = explores ? { explore: true } : { navigation: true };
  return { kind: 'options', options: { demo: { is_paced: true, ...driver, ...seeded } } };
}

export function readLink(search: string): Link {
  try {
    return launchOf(new URLSearchParams(search));
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    return { kind: 'refused', why: error.words };
  }
}
