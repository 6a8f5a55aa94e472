import { mount } from 'svelte';
import App from './panels/App.svelte';
import { App as State } from './app/app.svelte';

/** Where the server is: beside the page, unless `?ws=` names another. */
function address(): string {
  const query = new URLSearchParams(location.search);
  const token = query.get('token');
  const base =
    query.get('ws') ??
    (import.meta.env.DEV
      ? 'ws://localhost:8765'
      : `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/ws`);
  return token
    ? `${base}${base.includes('?') ? '&' : '?'}token=${encodeURIComponent(token)}`
    : base;
}

const state = new State(address());
mount(App, { target: document.getElementById('app')!, props: { app: state } });
// Tests and pictures look in by this.
(window as unknown as { periplus: State }).periplus = state;
state.client.start();
