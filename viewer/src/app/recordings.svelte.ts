/** Recordings of the server: opening, uploading, comparing, recording the running system, and back to it. */
import type { JobKind, ParameterValue, Recording } from '../core/protocol';
import type { UploadedFile } from '../core/replay_requests';
import { t } from '../texts/language.svelte';
import type { App } from './app.svelte';
import { download } from './download';

export interface Upload {
  id: number;
  name: string;
  sentBytes: number;
  totalBytes: number;
  cancel(): void;
}

/** What becomes of a recording once it is ready. */
type Wanted = 'open' | 'compare';

let lastUpload = 0;

export class Recordings {
  list: readonly Recording[] = $state.raw([]);
  isRecording = $state(false);
  uploads: Upload[] = $state([]);
  /** Reports that are written, and files that are fetched; `part` is the received part, 0 to 1, if it is known. */
  works: { id: number; name: string; part: number | undefined }[] = $state.raw([]);
  /** True if the server has recordings. */
  isServed = $state(false);
  /** True if the server has nothing but recordings. */
  isReplayOnly = $state(false);
  private known = new Set<number>();
  /** Names of recordings that are uploaded, and what becomes of them. */
  private awaited: { isMatch: (one: Recording) => boolean; wanted: Wanted }[] = [];
  private pendingById = new Map<number, Wanted>();
  private queue: Promise<void> = Promise.resolve();
  private wasLost = false;

  constructor(private app: App) {}

  private get requests() {
    return this.app.client.recordings;
  }

  connected(metadata: Record<string, string>): void {
    this.isServed = this.app.client.capabilities.includes('recordings');
    this.isReplayOnly = metadata.mode === 'replay';
    // Loaded while the server opens the recording.
    if (this.isReplayOnly) void import('./replay.svelte');
  }

  /** The server sent its list, or the connection was lost. */
  changed(): void {
    const { app } = this;
    if (app.client.state !== 'open') return;
    this.list = this.requests.recordings;
    const isFinished = this.isRecording && !this.requests.isRecording;
    this.isRecording = this.requests.isRecording;
    const added = this.list.filter((one) => !this.known.has(one.id));
    if (isFinished && added[0]) app.notice('info', t().recordings.recorded(added[0].name));
    for (const one of this.list) this.note(one);
    const ids = new Set(this.list.map((one) => one.id));
    for (const id of this.known) if (!ids.has(id)) this.known.delete(id);
    this.followList(ids);
    for (const [id, wanted] of [...this.pendingById]) {
      const found = this.list.find((one) => one.id === id);
      const isFirstMissing = [...this.pendingById.values()].includes('open');
      if (found?.state === 'opening' || (wanted === 'compare' && isFirstMissing)) continue;
      this.pendingById.delete(id);
      if (found?.state === 'ready') {
        // One after the other: the first one loads its code.
        this.queue = this.queue.then(() =>
          wanted === 'open' ? this.open(found) : this.compare(found),
        );
      }
      if (found?.state === 'failed') app.notice('error', `${found.name}: ${found.error}`);
    }
  }

  /** A recording that is new in the list. */
  private note(one: Recording): void {
    if (this.known.has(one.id)) return;
    this.known.add(one.id);
    const awaited = this.awaited.findIndex(({ isMatch }) => isMatch(one));
    if (awaited >= 0) {
      this.pendingById.set(one.id, this.awaited.splice(awaited, 1)[0]!.wanted);
    } else if (this.isReplayOnly && !one.origin) {
      const isFirst = !this.app.replay && this.pendingById.size === 0;
      this.pendingById.set(one.id, isFirst ? 'open' : 'compare');
    }
  }

  /** Recordings of the replay that were closed, or are there again after a reconnection. */
  private followList(ids: ReadonlySet<number>): void {
    const { replay } = this.app;
    if (!replay) return;
    const [first, ...others] = replay.source.tracks;
    if (!ids.has(first!.recording.id)) {
      this.app.notice('warn', t().timeline.closed(first!.recording.name));
      this.leave();
      return;
    }
    for (const track of others) if (!ids.has(track.recording.id)) replay.remove(track);
    if (this.wasLost) replay.renew();
    this.wasLost = false;
  }

  disconnected(): void {
    this.wasLost = true;
    this.app.replay?.pause();
  }

  // Replay.

  async open(recording: Recording): Promise<void> {
    const { app } = this;
    const { Replay } = await import('./replay.svelte');
    app.replay?.stop();
    app.replay = new Replay(app, recording);
    this.move();
  }

  private move(): void {
    const { app } = this;
    app.jumped();
    app.feed.use(app.replay ? app.replay.source : app.client);
    app.graphChanged();
    for (const viewport of app.viewports) viewport.dropMissing();
    if (!app.replay) return;
    app.replay.opened(app.replay.startNs);
  }

  /** Shows a recording beside the one that is open. */
  async compare(recording: Recording): Promise<void> {
    const { replay } = this.app;
    if (!replay) await this.open(recording);
    else if (!replay.has(recording.id)) replay.add(recording);
  }

  /** Back to the running system. */
  leave(): void {
    const { app } = this;
    app.replay?.stop();
    app.replay = undefined;
    this.move();
  }

  close(recording: Recording): void {
    const { replay } = this.app;
    const track = replay?.source.tracks.find((one) => one.recording.id === recording.id);
    if (track && track === replay?.source.tracks[0]) this.leave();
    else if (track) replay?.remove(track);
    this.requests.close(recording.id);
  }

  // Files and the running system.

  /** Uploads files and opens them as one recording. */
  async upload(
    name: string,
    files: readonly UploadedFile[],
    wanted: Wanted = 'open',
  ): Promise<void> {
    const abort = new AbortController();
    const totalBytes = files.reduce((sum, file) => sum + file.size, 0);
    const id = ++lastUpload;
    this.uploads.push({ id, name, totalBytes, sentBytes: 0, cancel: () => abort.abort() });
    const upload = this.uploads.find((one) => one.id === id)!;
    const before = new Set(this.list.map((one) => one.id));
    const mine = { isMatch: (one: Recording) => !before.has(one.id) && !one.origin, wanted };
    this.awaited.push(mine);
    try {
      await this.requests.upload(files, (bytes) => (upload.sentBytes = bytes), abort.signal);
    } catch (error) {
      this.awaited = this.awaited.filter((one) => one !== mine);
      if ((error as Error).name !== 'AbortError') {
        this.app.notice('error', `${name}: ${(error as Error).message}`);
      }
    } finally {
      this.uploads = this.uploads.filter((one) => one.id !== id);
    }
  }

  /** Runs an estimator on a recording; its result is compared with what is open. */
  run(kind: JobKind, recording: number, parameters: Record<string, ParameterValue>): void {
    const before = new Set(this.list.map((one) => one.id));
    this.awaited.push({
      isMatch: (one) => !before.has(one.id) && one.origin?.kind === kind,
      wanted: 'compare',
    });
    this.requests.startJob(kind, recording, parameters);
  }

  /** Offers the report of one recording, or of two, as a download. */
  async report(recordings: readonly Recording[]): Promise<void> {
    const names = recordings.map(({ name }) => name);
    await this.work(names.join(' + '), async () => {
      const html = await this.requests.report(recordings.map(({ id }) => id));
      download(html, `${names.join('-')}.html`, 'text/html');
    });
  }

  /** Offers the file of a recording as a download. */
  async keep(recording: Recording): Promise<void> {
    await this.work(recording.name, async (set) => {
      const { name, blob } = await this.requests.file(recording.id, set);
      download(blob, recording.isTemporary ? `${recording.name}.${name.split('.').pop()}` : name);
    });
  }

  /** Shows that the server works, and reports a failure. */
  private async work(name: string, run: (set: (part: number) => void) => Promise<void>) {
    const id = ++lastUpload;
    const set = (part: number) => {
      this.works = this.works.map((one) => (one.id === id ? { ...one, part } : one));
    };
    this.works = [...this.works, { id, name, part: undefined }];
    try {
      await run(set);
    } catch (error) {
      this.app.notice('error', `${name}: ${(error as Error).message}`);
    } finally {
      this.works = this.works.filter((one) => one.id !== id);
    }
  }

  /** Records the running system, or ends the recording, which is then in the list. */
  record(isOn: boolean): void {
    if (isOn) this.requests.startRecording();
    else this.requests.stopRecording();
  }
}
