/** The page without a server: the client talks to the simulator in a worker. */
import { mount } from 'svelte';
import { App } from '../app/app.svelte';
import { offerPanel } from '../panels/registry';
import { start } from '../start';
import { t } from '../texts/language.svelte';
import { Files } from './files.svelte';
import { Host, type WorkerPort } from './host.svelte';
import { readLink } from './link';
import TabStatus from './TabStatus.svelte';

export function show(makeWorker: () => WorkerPort, moduleBytes: number): void {
  const link = readLink(location.search);
  const host = new Host(makeWorker, moduleBytes, link);
  const app = new App(() => host.open());
  app.isWithoutServer = true;
  if ('refusal' in link) app.connection = 'closed';
  const files = new Files(app, host);
  app.receiver = files;
  offerPanel({
    id: 'tabFiles',
    title: () => t().tab.files,
    icon: 'save',
    isFirst: true,
    load: async () => {
      const { default: FilesPanel } = await import('./FilesPanel.svelte');
      return { default: FilesPanel };
    },
  });
  start(app, 'options' in link);
  mount(TabStatus, { target: document.body, props: { app, host } });
  // Entry points for end-to-end tests.
  Object.assign(window, { periplusTab: host, periplusFiles: files });
}
