/** Commands that show the page to others: links, pictures, videos, recordings. */
import type { App } from '../app/app.svelte';
import { linkOf, MAX_LINK_LENGTH } from '../app/layout_link';
import type { Recorder } from '../app/video';
import type { Workbench } from '../app/workbench.svelte';
import type { Stage } from '../scene/stage';
import { t } from '../texts/language.svelte';
import { download } from './layout_actions.svelte';

/** What is recorded as a video now. */
type Video =
  | { kind: 'none' }
  | { kind: 'live'; seconds: number }
  | { kind: 'exact'; done: number; all: number };

function now(): string {
  const date = new Date();
  const two = (value: number) => String(value).padStart(2, '0');
  const day = `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())}`;
  return `${day}_${two(date.getHours())}-${two(date.getMinutes())}-${two(date.getSeconds())}`;
}

export class ShareActions {
  video: Video = $state({ kind: 'none' });
  /** Link to copy by hand, where the browser does not let the page copy it. */
  link = $state('');
  private recorder?: Recorder;
  private endLive = () => {};
  private isCanceled = false;

  constructor(
    private app: App,
    private workbench: Workbench,
  ) {}

  private fileName(what: string, extension: string): string {
    const name = (this.app.worldName || this.app.serverName || 'periplus').replace(
      /[^\w.-]+/g,
      '-',
    );
    return `${name}-${what}-${now()}.${extension}`;
  }

  private save(what: string, extension: string, blob: Blob): void {
    const name = this.fileName(what, extension);
    download(name, blob);
    this.app.notice('info', t().share.saved(name));
  }

  // Links.

  async copyLink(): Promise<void> {
    const { app } = this;
    const layout = this.workbench.save();
    for (const { kind, state } of Object.values(layout.panels)) {
      // The reader sees the frame that is seen here, also where others exist.
      if (kind === '3d') state.isFrameChosen = true;
    }
    const timeS = app.replay?.timeS;
    const link = await linkOf(location.href, { layout, timeS });
    if (link.length > MAX_LINK_LENGTH) {
      app.notice('error', t().share.tooLong(link.length, MAX_LINK_LENGTH));
      return;
    }
    this.link = link;
    try {
      await navigator.clipboard.writeText(link);
      const told = timeS === undefined ? t().share.copied : t().share.copiedAt(timeS.toFixed(2));
      app.notice('info', told);
      this.link = '';
    } catch {
      // Without permission, or on a page without TLS, the menu shows the link.
    }
  }

  // Pictures.

  private stage(): Stage | undefined {
    const { stage } = this.app;
    if (!stage) this.app.notice('warn', t().share.noView);
    return stage;
  }

  async screenshot(): Promise<void> {
    const canvas = this.stage()?.render();
    if (!canvas) return;
    const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
    if (blob) this.save('view', 'png', blob);
  }

  get canShootPage(): boolean {
    return !!navigator.mediaDevices?.getDisplayMedia;
  }

  /** The browser asks the user what to show; one picture of it is kept. */
  async pageShot(): Promise<void> {
    let stream: MediaStream | undefined;
    try {
      stream = await navigator.mediaDevices.getDisplayMedia({
        video: true,
        preferCurrentTab: true,
      } as DisplayMediaStreamOptions);
      const video = document.createElement('video');
      video.srcObject = stream;
      await video.play();
      // The menu and the question of the browser have gone by then.
      await new Promise((resolve) => setTimeout(resolve, 400));
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
      canvas.getContext('2d')!.drawImage(video, 0, 0);
      const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
      if (!blob || canvas.width === 0) throw new Error(t().share.noPageShot);
      this.save('page', 'png', blob);
    } catch (error) {
      // A user who cancels the question of the browser needs no message.
      if ((error as Error).name !== 'NotAllowedError') {
        this.app.notice('error', `${t().share.noPageShot}: ${(error as Error).message}`);
      }
    } finally {
      for (const track of stream?.getTracks() ?? []) track.stop();
    }
  }

  // Videos.

  private async prepare(stage: Stage, isExact: boolean): Promise<Recorder | undefined> {
    try {
      const { recorderFor } = await import('../app/video');
      return await recorderFor(stage.render(), isExact);
    } catch (error) {
      this.app.notice('error', (error as Error).message);
      return undefined;
    }
  }

  async startVideo(): Promise<void> {
    const stage = this.stage();
    const recorder = stage && (await this.prepare(stage, false));
    if (!stage || !recorder) return;
    const { FRAMES_PER_S } = await import('../app/video');
    this.recorder = recorder;
    const startMs = performance.now();
    let count = 0;
    const tick = (nowMs: number) => {
      const timeMs = nowMs - startMs;
      this.video = { kind: 'live', seconds: Math.max(0, Math.floor(timeMs / 1000)) };
      if (timeMs < (count * 1000) / FRAMES_PER_S || recorder.isBehind()) return;
      count = Math.floor((timeMs * FRAMES_PER_S) / 1000) + 1;
      stage.draw(nowMs);
      recorder.add(Math.max(0, timeMs)).catch((error: Error) => {
        this.app.notice('error', t().share.videoFailed(error.message));
        this.cancelVideo();
      });
    };
    stage.ticks.add(tick);
    this.video = { kind: 'live', seconds: 0 };
    this.endLive = () => {
      stage.ticks.delete(tick);
      void this.finish(performance.now() - startMs);
    };
  }

  stopVideo(): void {
    this.endLive();
    this.endLive = () => {};
  }

  private async finish(durationMs: number): Promise<void> {
    const { recorder } = this;
    this.recorder = undefined;
    this.video = { kind: 'none' };
    try {
      const file = await recorder?.finish(durationMs);
      if (file) this.save('view', file.extension, file.blob);
    } catch (error) {
      this.app.notice('error', t().share.videoFailed((error as Error).message));
    }
  }

  cancelVideo(): void {
    this.isCanceled = true;
    this.endLive = () => {};
    if (this.video.kind === 'live') {
      this.recorder?.cancel();
      this.recorder = undefined;
      this.video = { kind: 'none' };
    }
  }

  /** Video of a replay: each frame shows its time exactly, however slow the machine is. */
  async exactVideo(fromS: number, toS: number, rate: number): Promise<void> {
    const { replay } = this.app;
    const stage = this.stage();
    if (!replay || !stage) return;
    const recorder = await this.prepare(stage, true);
    if (!recorder) return;
    const { FRAMES_PER_S } = await import('../app/video');
    replay.pause();
    const before = replay.timeS;
    const all = Math.max(1, Math.round(((toS - fromS) / rate) * FRAMES_PER_S));
    this.recorder = recorder;
    this.isCanceled = false;
    try {
      for (let i = 0; i < all && !this.isCanceled; i++) {
        this.video = { kind: 'exact', done: i, all };
        await replay.show(fromS + (i * rate) / FRAMES_PER_S);
        stage.render();
        await recorder.add((i * 1000) / FRAMES_PER_S);
      }
      if (this.isCanceled) {
        recorder.cancel();
        this.video = { kind: 'none' };
      } else await this.finish((all * 1000) / FRAMES_PER_S);
    } catch (error) {
      recorder.cancel();
      this.video = { kind: 'none' };
      this.app.notice('error', t().share.videoFailed((error as Error).message));
    } finally {
      replay.seek(before);
    }
  }
}
