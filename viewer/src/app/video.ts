/** Video of a canvas: WebCodecs into a WebM file, frame by frame; otherwise the recorder of the browser. */
import { t } from '../texts/language.svelte';
import { writeWebm, type Packet, type VideoTrack } from './webm';

export const FRAMES_PER_S = 30;
const KEY_FRAME_MS = 2000;
/** Frames that wait for the encoder; a slow machine leaves frames out of a live video. */
const MAX_QUEUE = 4;
/** Bits per pixel and frame: lines and text of a 3D view stay sharp. */
const BITS_PER_PIXEL = 0.2;
/** Codecs in WebM, best first: WebCodecs' name and Matroska's. */
const CODECS: [string, string][] = [
  ['vp09.00.41.08', 'V_VP9'],
  ['vp8', 'V_VP8'],
];

export interface VideoFile {
  blob: Blob;
  /** Without a dot. */
  extension: string;
}

/** Takes pictures of a canvas and makes a video of them. */
export interface Recorder {
  /** Adds the present picture; the time is the one in the video. */
  add(timeMs: number): Promise<void>;
  /** True if the encoder is behind: a live video leaves the frame out. */
  isBehind(): boolean;
  finish(durationMs: number): Promise<VideoFile>;
  cancel(): void;
}

/** Codecs need even sizes. */
const even = (px: number) => Math.max(2, px & ~1);

async function encoderFor(width: number, height: number) {
  for (const [codec, name] of CODECS) {
    const config: VideoEncoderConfig = {
      codec,
      width,
      height,
      bitrate: Math.max(1_000_000, width * height * FRAMES_PER_S * BITS_PER_PIXEL),
      framerate: FRAMES_PER_S,
      latencyMode: 'quality',
    };
    const { supported } = await VideoEncoder.isConfigSupported(config).catch(() => ({
      supported: false,
    }));
    if (supported) return { config, name };
  }
  return undefined;
}

class CodecRecorder implements Recorder {
  private readonly packets: Packet[] = [];
  private readonly encoder: VideoEncoder;
  private readonly picture: OffscreenCanvas;
  private keyMs = -Infinity;
  private failure?: Error;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    config: VideoEncoderConfig,
    private readonly track: VideoTrack,
  ) {
    // The size of a video is fixed; the canvas may change its own.
    this.picture = new OffscreenCanvas(track.width, track.height);
    this.encoder = new VideoEncoder({
      output: (chunk) => {
        const data = new Uint8Array(chunk.byteLength);
        chunk.copyTo(data);
        this.packets.push({ timeMs: chunk.timestamp / 1000, isKey: chunk.type === 'key', data });
      },
      error: (error) => (this.failure = error),
    });
    this.encoder.configure(config);
  }

  isBehind(): boolean {
    return this.encoder.encodeQueueSize > MAX_QUEUE;
  }

  async add(timeMs: number): Promise<void> {
    if (this.failure) throw this.failure;
    const { width, height } = this.picture;
    this.picture.getContext('2d')!.drawImage(this.canvas, 0, 0, width, height);
    const frame = new VideoFrame(this.picture, { timestamp: Math.round(timeMs * 1000) });
    const isKey = timeMs - this.keyMs >= KEY_FRAME_MS;
    if (isKey) this.keyMs = timeMs;
    this.encoder.encode(frame, { keyFrame: isKey });
    frame.close();
    while (this.isBehind()) await new Promise((resolve) => setTimeout(resolve, 5));
  }

  async finish(durationMs: number): Promise<VideoFile> {
    await this.encoder.flush();
    this.encoder.close();
    if (this.failure) throw this.failure;
    if (this.packets.length === 0) throw new Error(t().share.shortVideo);
    const bytes = writeWebm(this.track, this.packets, durationMs);
    return { blob: new Blob([bytes], { type: 'video/webm' }), extension: 'webm' };
  }

  cancel(): void {
    if (this.encoder.state !== 'closed') this.encoder.close();
  }
}

/** The recorder of the browser: only in real time, its files may have no duration. */
class StreamRecorder implements Recorder {
  private readonly parts: Blob[] = [];
  private readonly recorder: MediaRecorder;

  constructor(canvas: HTMLCanvasElement) {
    this.recorder = new MediaRecorder(canvas.captureStream(FRAMES_PER_S));
    this.recorder.ondataavailable = ({ data }) => this.parts.push(data);
    this.recorder.start(1000);
  }

  isBehind(): boolean {
    return false;
  }

  async add(): Promise<void> {}

  async finish(): Promise<VideoFile> {
    const isOver = new Promise((resolve) => (this.recorder.onstop = resolve));
    this.recorder.stop();
    await isOver;
    const type = this.recorder.mimeType || this.parts[0]?.type || 'video/webm';
    if (this.parts.length === 0) throw new Error(t().share.shortVideo);
    return {
      blob: new Blob(this.parts, { type }),
      extension: type.includes('mp4') ? 'mp4' : 'webm',
    };
  }

  cancel(): void {
    if (this.recorder.state !== 'inactive') this.recorder.stop();
  }
}

/** Recorder for a canvas; throws an error with the reason if the browser has none. */
export async function recorderFor(canvas: HTMLCanvasElement, isExact: boolean): Promise<Recorder> {
  const [width, height] = [even(canvas.width), even(canvas.height)];
  if (typeof VideoEncoder !== 'undefined') {
    const found = await encoderFor(width, height);
    if (found) return new CodecRecorder(canvas, found.config, { codec: found.name, width, height });
    if (isExact) throw new Error(t().share.noCodec);
  }
  if (typeof MediaRecorder === 'undefined' || isExact) throw new Error(t().share.noVideo);
  return new StreamRecorder(canvas);
}
