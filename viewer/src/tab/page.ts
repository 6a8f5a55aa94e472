/** The page without a server: the client talks to the simulator in a worker. */
import { mount } from 'svelte';
import { App } from '../app/app.svelte';
import { offerPanel } from '../panels/registry';
import { start } from '../start';
import { t } from '../texts/language.svelte';
import { Files } from './files.svelte';
import { Host, type WorkerPort } from './host.svelte';
import { Launcher } from './launcher';
import { readLink } from './link';
import TabStatus from './TabStatus.svelte';

export function show(makeWorker: () => WorkerPort, moduleBytes: number): void {
  const host = new Host(makeWorker, moduleBytes);
  const app = new App(() => host.open());
  app.isWithoutServer = true;
  const launcher = new Launcher(app, host, new URL('.', location.href));
  const files = new Files(app, host, launcher);
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
  start(app, false);
  mount(TabStatus, { target: document.body, props: { host, launcher } });
  // Entry points for end-to-end tests.
  Object.assign(window, { periplusTab: host, periplusFiles: files });
  void launcher.launch(readLink(location.search));
}
