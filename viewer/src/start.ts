/** Shows a page, and connects its client unless it waits for the user. */
import { mount } from 'svelte';
import App from './panels/App.svelte';
import type { App as State } from './app/app.svelte';
import { language } from './texts/language.svelte';

export function start(state: State, connects = true): void {
  mount(App, { target: document.getElementById('app')!, props: { app: state } });
  // Entry point for end-to-end tests and screenshots.
  (window as unknown as { periplus: State }).periplus = state;
  if (connects) state.client.start();
  // Needed when a file is dragged over the page.
  void import('./panels/DropTarget.svelte').then(({ default: DropTarget }) =>
    mount(DropTarget, { target: document.body, props: { app: state } }),
  );
  void language.start();
}
