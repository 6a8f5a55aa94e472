/** Files in the memory of the simulator: dropped ones, and results. */
import type { App } from '../app/app.svelte';
import { download } from '../app/download';
import type { Dropped, FileReceiver } from '../app/drop';
import { t } from '../texts/language.svelte';
import type { Host } from './host.svelte';
import type { Launcher } from './launcher';
import { MapJob } from './map_job.svelte';
import type { MemoryFile } from './messages';
import type { ReadySession } from './sessions';

/** Folder of dropped files. */
const DROPPED = '/files';
/** Folder of saved maps. */
const RESULTS = '/results';
/** Largest file [bytes]: the memory of the module ends at 4 GiB, and a file is there twice while it is written. */
const MAX_FILE_BYTES = 1 << 30;

const SAVE_MAP = /^slam_toolbox\/(srv\/)?SaveMap$/;
const WORLD = /\.(world|sdf)$/i;
const CHECKED = /\.(world|sdf|urdf|xacro|launch|ya?ml)$/i;
const LOG = /\.(log|clf|gfs|bag|mcap|db3)$/i;
const ARCHIVE = /\.(zip|tar|tar\.gz|tgz)$/i;

export class Files implements FileReceiver {
  list: readonly MemoryFile[] = $state.raw([]);
  /** Ready sessions of this page. */
  sessions: readonly ReadySession[] = $state.raw([]);
  /** Findings of the file that was checked last. */
  checked: { path: string; text: string } | undefined = $state.raw();
  /** Mapping of a log. */
  job: MapJob | undefined = $state.raw();

  constructor(
    private app: App,
    readonly host: Host,
    private launcher: Launcher,
  ) {}

  async loadSessions(): Promise<void> {
    await this.attempt(async () => {
      this.sessions = (await this.launcher.sessions()).list;
    });
  }

  /** Starts a ready session, which is then in the address. */
  async launch(name: string): Promise<void> {
    history.replaceState(history.state, '', `?session=${encodeURIComponent(name)}`);
    await this.launcher.launch({ kind: 'session', name });
  }

  async refresh(): Promise<void> {
    if (this.host.phase.kind !== 'running') return;
    try {
      this.list = await this.host.list('/');
    } catch (error) {
      this.app.notice('error', (error as Error).message, 'tab files');
    }
  }

  /** Writes dropped files into memory; archives are unpacked. */
  async take({ name, files }: Dropped): Promise<void> {
    for (const file of files) {
      if (file.size > MAX_FILE_BYTES) {
        throw new Error(t().tab.tooLarge(file.name, MAX_FILE_BYTES / 2 ** 20));
      }
      const content = new Uint8Array(await file.slice(0, file.size).arrayBuffer());
      const path = `${DROPPED}/${file.name}`;
      await this.host.write(path, content);
      if (ARCHIVE.test(file.name)) await this.unpack(path);
    }
    await this.refresh();
    this.app.notice('info', t().tab.taken(name, t().tab.files));
    this.app.workbench?.open('tabFiles');
  }

  private async unpack(path: string): Promise<void> {
    const { left_out } = await this.host.call<{ left_out: string[] }>('unpack', {
      archive: path,
      folder: DROPPED,
    });
    await this.host.remove(path);
    if (left_out.length > 0) this.app.notice('warn', t().tab.leftOut(left_out.join('; ')));
  }

  isWorld = (file: MemoryFile): boolean => WORLD.test(file.path);
  isChecked = (file: MemoryFile): boolean => CHECKED.test(file.path);
  isLog = (file: MemoryFile): boolean => LOG.test(file.path);

  /** Starts a session with a world from memory. */
  async run(file: MemoryFile): Promise<void> {
    const options = { run: { is_paced: true, world: file.path, robots: [] } };
    await this.launcher.launch({ kind: 'options', options });
  }

  /** Shows the findings of `periplus check`. */
  async check({ path }: MemoryFile): Promise<void> {
    await this.attempt(async () => {
      const { text } = await this.host.call<{ text: string }>('check', { files: [path] });
      this.checked = { path, text };
    });
  }

  /** Maps a log, as `periplus slam`; the results are in a folder of its name. */
  async map({ path }: MemoryFile): Promise<void> {
    if (this.job?.isRunning) return;
    const name = path
      .split('/')
      .pop()!
      .replace(/\.\w+$/, '');
    this.job = new MapJob(this.host, path, `${RESULTS}/${name}`);
    await this.attempt(() => this.job!.run());
    await this.refresh();
  }

  async save(file: MemoryFile): Promise<void> {
    await this.attempt(async () => {
      const content = await this.host.read(file.path);
      download(content, file.path.split('/').pop()!, 'application/octet-stream');
    });
  }

  async remove(file: MemoryFile): Promise<void> {
    await this.attempt(async () => {
      await this.host.remove(file.path);
      await this.refresh();
    });
  }

  /** Services that save a map. */
  get mapServices(): string[] {
    return this.app.services.filter(({ type }) => SAVE_MAP.test(type)).map(({ name }) => name);
  }

  /** Saves a map as an image with its YAML file, and offers both as downloads. */
  async saveMap(service: string): Promise<void> {
    await this.attempt(async () => {
      const stem = `${RESULTS}/map`;
      // The service writes into folders that exist.
      await this.host.write(`${RESULTS}/.keep`, new Uint8Array(0));
      const answer = await this.app.call(service, { name: { data: stem } });
      await this.host.remove(`${RESULTS}/.keep`);
      await this.refresh();
      if (!answer) return;
      const saved = this.list.filter(({ path }) => /^\/results\/map\.(pgm|yaml|png)$/.test(path));
      if (saved.length === 0) throw new Error(t().tab.noMap(service));
      for (const file of saved) await this.save(file);
    });
  }

  private async attempt(work: () => Promise<void>): Promise<void> {
    try {
      await work();
    } catch (error) {
      this.app.notice('error', (error as Error).message);
    }
  }
}
