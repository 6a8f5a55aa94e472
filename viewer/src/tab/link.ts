/**
 * Settings in the address of a page without a server: `?seed=3&explore`, `?world=PATH&robot=PATH`. Unknown names and
 * wrong values are refused, so that a link never shows something else than it says.
 */
import { t } from '../texts/language.svelte';
import type { SessionOptions } from './messages';

/** A link, or the reason why it cannot be used, in the present language. */
export type Link = { options: SessionOptions } | { refusal: () => string };

class Refusal extends Error {
  constructor(readonly words: () => string) {
    super(words());
  }
}

/** Settings that a link may have; `robot` may be repeated. */
export const NAMES = ['world', 'robot', 'seed', 'explore'] as const;
type Name = (typeof NAMES)[number];

/** Largest seed: numbers of JSON are exact up to it. */
const MAX_SEED = Number.MAX_SAFE_INTEGER;

/** The robot drives to goals of the user. */
export const DEMO: SessionOptions = { demo: { is_paced: true, navigation: true } };

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

function optionsOf(query: URLSearchParams): SessionOptions {
  for (const name of query.keys()) {
    if (!(NAMES as readonly string[]).includes(name)) {
      throw new Refusal(() => t().tab.unknownSetting(name, NAMES.join(', ')));
    }
    if (name !== 'robot' && query.getAll(name).length > 1)
      throw new Refusal(() => t().tab.twice(name));
  }
  const [world, seed, explore] = [query.get('world'), query.get('seed'), query.get('explore')];
  const robots = query.getAll('robot');
  for (const [name, text] of query) {
    if ((name === 'world' || name === 'robot') && !text)
      throw new Refusal(() => t().tab.empty(name));
  }
  const seeded = seed === null ? {} : { seed: seedOf(seed) };
  if (world === null && robots.length === 0) {
    const explores = explore !== null && flagOf('explore', explore);
    const driver = explores ? { explore: true } : { navigation: true };
    return { demo: { is_paced: true, ...driver, ...seeded } };
  }
  if (explore !== null) throw new Refusal(() => t().tab.onlyDemo('explore'));
  const run = { ...(world !== null && { world }), robots: robots.map((file) => ({ file })) };
  return { run: { is_paced: true, ...run, ...seeded } };
}

export function readLink(search: string): Link {
  try {
    return { options: optionsOf(new URLSearchParams(search)) };
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    return { refusal: error.words };
  }
}
