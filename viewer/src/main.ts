import { App } from './app/app.svelte';
import type { Socket } from './core/client';
import { SUBPROTOCOL } from './core/protocol';
import { start } from './start';

/**
 * Token of a server. It arrives once in the address and is then kept in this tab's session storage: an address
 * bar is seen by others, copied and synchronized.
 */
function tokenFor(base: string): string | null {
  const key = `token ${base}`;
  const here = new URL(location.href);
  const given = here.searchParams.get('token');
  try {
    if (given === null) return sessionStorage.getItem(key);
    sessionStorage.setItem(key, given);
  } catch {
    // Without session storage the token stays in the address; a reload would lose it otherwise.
    return given;
  }
  here.searchParams.delete('token');
  history.replaceState(history.state, '', here);
  return given;
}

/** Address of the server: the host of the page, unless `?ws=` names another. */
function address(): string {
  const query = new URLSearchParams(location.search);
  const base =
    query.get('ws') ??
    (import.meta.env.DEV
      ? 'ws://localhost:8765'
      : `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/ws`);
  const token = tokenFor(base);
  return token
    ? `${base}${base.includes('?') ? '&' : '?'}token=${encodeURIComponent(token)}`
    : base;
}

const url = address();
start(new App(() => new WebSocket(url, [SUBPROTOCOL]) as unknown as Socket));
