/** Commands on layouts: keep, show, export, import. */
import type { App } from '../app/app.svelte';
import { readLayout, writeLayout, type Layout } from '../app/layout';
import { sharedIn } from '../app/layout_link';
import { LayoutStore } from '../app/layout_store';
import type { Workbench } from '../app/workbench.svelte';
import { kindForType } from '../displays/registry';
import { t } from '../texts/language.svelte';
import { panelKind } from './registry';

/** Period at which the present layout is kept for the next visit [ms]. */
const KEEP_MS = 2000;
/** Largest file that is read as a layout [bytes]. */
const MAX_FILE_BYTES = 4_000_000;

function storage(): Storage | undefined {
  try {
    return window.localStorage;
  } catch {
    return undefined;
  }
}

/** Offers a file for download. */
export function download(name: string, blob: Blob): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export class LayoutActions {
  names: string[] = $state.raw([]);
  /** Name of the layout that was shown last. */
  current = $state('');
  /** Parts of a foreign file that could not be shown, with the reasons. */
  leftOut: string[] = $state.raw([]);
  /** File that `leftOut` is about. */
  leftOutOf = $state('');
  /** Time of a replay that a link names, until there is one [s]. */
  private timeS?: number;
  /** A layout of a link does not replace the own one until the user saves it. */
  private isFromLink = false;
  private readonly store = new LayoutStore(storage());
  private kept = '';

  constructor(
    private app: App,
    private workbench: Workbench,
  ) {
    this.names = this.store.names();
  }

  /** Shows the layout of the last visit; without one, the first layout. */
  start(widthPx: number): void {
    let last: Layout | undefined;
    try {
      last = this.store.last();
    } catch (error) {
      this.app.notice('warn', t().layouts.lastIsBroken((error as Error).message));
    }
    this.workbench.restore(last ?? this.workbench.first(widthPx));
    const keep = () => this.keep();
    setInterval(keep, KEEP_MS);
    this.workbench.openFile = (name, text) => this.openText(name, text);
    void this.openLink();
    window.addEventListener('hashchange', () => void this.openLink());
    window.addEventListener('pagehide', keep);
    document.addEventListener('visibilitychange', keep);
  }

  private async openLink(): Promise<void> {
    try {
      const shared = await sharedIn(location.hash);
      if (!shared) return;
      this.isFromLink = true;
      this.timeS = shared.timeS;
      this.show(shared.layout, '');
      this.app.notice('info', t().share.fromLink);
      this.showTime();
    } catch (error) {
      this.app.notice('error', t().share.linkIsBroken((error as Error).message));
    }
  }

  /** Shows the time that a link names, once a recording is open. */
  showTime(): void {
    const { replay } = this.app;
    if (!replay || this.timeS === undefined) return;
    replay.pause();
    replay.seek(Math.min(replay.endS, Math.max(replay.startS, this.timeS)));
    this.timeS = undefined;
  }

  private keep(): void {
    if (this.isFromLink) return;
    const layout = this.workbench.save();
    const text = JSON.stringify(layout);
    if (text === this.kept) return;
    this.kept = text;
    this.store.keepLast(layout);
  }

  private show(layout: Layout, name: string): void {
    this.workbench.restore(layout, true);
    this.current = name;
    const unknown = Object.values(layout.panels)
      .map(({ kind }) => kind)
      .filter((kind) => !panelKind(kind));
    if (unknown.length > 0) {
      this.app.notice('warn', t().layouts.unknownPanels([...new Set(unknown)].join(', ')));
    }
  }

  reset(): void {
    this.leaveLink();
    this.store.forgetLast();
    this.show(this.workbench.first(window.innerWidth), '');
  }

  saveAs(name: string): void {
    if (!this.store.set(name, this.workbench.save())) {
      this.app.notice('error', t().layouts.notKept);
      return;
    }
    this.names = this.store.names();
    this.current = name;
    this.leaveLink();
    this.app.notice('info', t().layouts.saved(name));
  }

  /** From now on the layout is the user's own. */
  private leaveLink(): void {
    if (!this.isFromLink) return;
    this.isFromLink = false;
    history.replaceState(history.state, '', location.pathname + location.search);
  }

  open(name: string): void {
    this.leaveLink();
    try {
      this.show(this.store.get(name), name);
    } catch (error) {
      this.app.notice('error', `${name}: ${(error as Error).message}`);
    }
  }

  rename(from: string, to: string): void {
    if (!this.store.rename(from, to)) {
      this.app.notice('error', t().layouts.nameIsTaken(to));
      return;
    }
    this.names = this.store.names();
    if (this.current === from) this.current = to;
  }

  delete(name: string): void {
    this.store.delete(name);
    this.names = this.store.names();
    if (this.current === name) this.current = '';
  }

  export(): void {
    const text = JSON.stringify(writeLayout(this.workbench.save()), undefined, 2);
    const name = `${(this.current || 'periplus').replace(/[^\w.-]+/g, '-')}.layout.json`;
    download(name, new Blob([text], { type: 'application/json' }));
  }

  // Files.

  saveRviz(): void {
    const { app } = this;
    const text = app.active.rvizText();
    download(app.active.fileName || 'periplus.rviz', new Blob([text], { type: 'text/yaml' }));
    if (app.viewports.length > 1) app.notice('info', t().layouts.oneView);
  }

  /** Opens an `.rviz` file, a layout of this page, or one of Foxglove or Lichtblick. */
  async openFile(file: File): Promise<void> {
    try {
      if (file.size > MAX_FILE_BYTES) throw new Error(t().layouts.tooLarge(MAX_FILE_BYTES / 1e6));
      await this.openText(file.name, await file.text());
    } catch (error) {
      this.app.notice('error', `${file.name}: ${(error as Error).message}`);
    }
  }

  private async openText(name: string, text: string): Promise<void> {
    if (/\.json$/i.test(name) || /^\s*\{/.test(text)) await this.openJson(text, name);
    else this.openRviz(text, name);
  }

  /** Opens an `.rviz` file in the active 3D view, and the panels that it names, as far as they exist here. */
  openRviz(text: string, fileName: string): void {
    const { panels, hidesDisplays } = this.app.active.openRviz(text, fileName);
    const displays = this.workbench.panels.find(({ kind }) => kind === 'displays');
    if (hidesDisplays && displays) this.workbench.close(displays);
    if (panels.some((name) => name.startsWith('nav2_rviz_plugins/'))) {
      this.workbench.open('navigate');
    }
  }

  private async openJson(text: string, fileName: string): Promise<void> {
    let json: unknown;
    try {
      json = JSON.parse(text);
    } catch (error) {
      throw new Error(t().layouts.notJson((error as Error).message));
    }
    const name = fileName.replace(/(\.layout)?\.json$/i, '');
    // Loaded for such files only.
    const { importFoxglove, isFoxglove } = await import('../app/layout_foxglove');
    if (!isFoxglove(json)) {
      this.show(readLayout(json), name);
      return;
    }
    const { layout, leftOut } = importFoxglove(json, {
      typeOf: (topic) => this.app.topics.find((one) => one.name === topic)?.type || undefined,
      displayOf: (type) => kindForType(type)?.class,
      panel: (id) => {
        const kind = panelKind(id);
        return kind && { isMany: kind.isMany === true };
      },
    });
    this.show(layout, name);
    this.leftOut = leftOut;
    this.leftOutOf = fileName;
  }
}
