/** Files that are dropped on the page or chosen: what they are, and what the page does with them. */
import type { UploadedFile } from '../core/replay_requests';
import { t } from '../texts/language.svelte';
import type { App } from './app.svelte';

/** File with its path inside the dropped folder. */
export interface NamedFile extends UploadedFile {
  text(): Promise<string>;
}

export interface Dropped {
  /** Name of the file or folder. */
  name: string;
  files: NamedFile[];
  isFolder: boolean;
}

/** Takes dropped files. */
export interface FileReceiver {
  take(dropped: Dropped): Promise<void>;
}

export type FileKind = 'recording' | 'rviz' | 'world' | 'unknown';

/** Files of a folder: more are no recording. */
const MAX_FILES = 500;
const MAX_DEPTH = 4;
/** First bytes of the kinds of files. */
const HEAD_BYTES = 4096;

const RECORDING = /\.(mcap|bag|db3)(\.(zstd|zst|lz4|active))?$|\.(clf|carmen|gfs|log)(\.gz)?$/i;
const WORLD = /\.(sdf|world|urdf|xacro|launch|launch\.py|xml)$/i;

/** Kind of a file by its name, otherwise by its first bytes. */
export function kindOfFile(name: string, head: Uint8Array): FileKind {
  // Layouts are opened by the same reader.
  if (/\.(rviz|json)$/i.test(name)) return 'rviz';
  // Byte by byte: in browsers "latin1" is windows-1252, in which the first byte of MCAP is another character.
  const text = Array.from(head, (byte) => String.fromCharCode(byte)).join('');
  const isMagic =
    text.startsWith('\x89MCAP0\r\n') ||
    text.startsWith('#ROSBAG V') ||
    text.startsWith('SQLite format 3\0') ||
    // Compressed with Zstandard or LZ4: the server looks into it.
    (/\.(mcap|db3)\.\w+$/i.test(name) && head.length > 0);
  if (isMagic) return 'recording';
  // CARMEN logs are lines that begin with the name of a message.
  if (/^(PARAM|ODOM|FLASER|RLASER|ROBOTLASER1|LASER3?|SYNC|TRUEPOS|NMEAGGA)\s/m.test(text)) {
    return 'recording';
  }
  if (WORLD.test(name)) return 'world';
  return 'unknown';
}

/** True for names of recordings, before their content is known: the header may be damaged. */
export const isNamedRecording = (name: string): boolean => RECORDING.test(name);

const headOf = async (file: NamedFile) =>
  new Uint8Array(await file.slice(0, Math.min(HEAD_BYTES, file.size)).arrayBuffer());

/** Opens dropped files and folders; files that the page cannot open are named with what to do. */
export async function openDropped(app: App, all: readonly Dropped[]): Promise<void> {
  for (const dropped of all) {
    try {
      await openOne(app, dropped);
    } catch (error) {
      app.notice('error', `${dropped.name}: ${(error as Error).message}`);
    }
  }
}

async function openOne(app: App, { name, files, isFolder }: Dropped): Promise<void> {
  const texts = t().recordings;
  const heads = await Promise.all(files.map(headOf));
  const kinds = files.map((file, i) => kindOfFile(file.name, heads[i]!));
  const isMetadata = (file: NamedFile) => /(^|\/)metadata\.yaml$/.test(file.name);
  if (isFolder) {
    const parts = files.filter((file, i) => kinds[i] === 'recording' || isMetadata(file));
    if (!kinds.includes('recording')) {
      if (app.receiver) await app.receiver.take({ name, files, isFolder });
      else app.notice('error', texts.emptyFolder(name));
      return;
    }
    await upload(app, name, parts);
    return;
  }
  const [file] = files;
  if (!file) return;
  const [kind] = kinds;
  if (kind === 'rviz') await app.workbench?.openFile?.(name, await file.text());
  else if (kind === 'recording' || isNamedRecording(name)) await upload(app, name, [file]);
  else if (app.receiver) await app.receiver.take({ name, files, isFolder });
  else if (kind === 'world') app.notice('warn', texts.worldFile(name));
  else app.notice('error', texts.notARecording(name));
}

async function upload(app: App, name: string, files: readonly NamedFile[]): Promise<void> {
  if (!app.recordings.isServed) app.notice('error', t().recordings.noServer(name));
  else await app.recordings.upload(name, files);
}

// Files of the browser.

function named(file: File, name: string): NamedFile {
  return {
    name,
    size: file.size,
    slice: (start, end) => file.slice(start, end),
    text: () => file.text(),
  };
}

/** Files chosen in a dialog: those of a folder belong together. */
export function chosen(files: readonly File[]): Dropped[] {
  const folder = files[0]?.webkitRelativePath.split('/')[0];
  if (folder) {
    const all = files.map((file) => named(file, file.webkitRelativePath));
    return [{ name: folder, files: all.slice(0, MAX_FILES), isFolder: true }];
  }
  return files.map((file) => ({
    name: file.name,
    files: [named(file, file.name)],
    isFolder: false,
  }));
}

const fileOf = (entry: FileSystemFileEntry) =>
  new Promise<File>((resolve, reject) => entry.file(resolve, reject));

/** All entries: a reader returns them in parts. */
async function entriesOf(entry: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = entry.createReader();
  const out: FileSystemEntry[] = [];
  for (;;) {
    const part = await new Promise<FileSystemEntry[]>((resolve, reject) =>
      reader.readEntries(resolve, reject),
    );
    if (part.length === 0) return out;
    out.push(...part);
  }
}

async function filesIn(
  entry: FileSystemDirectoryEntry,
  path: string,
  depth: number,
): Promise<NamedFile[]> {
  const out: NamedFile[] = [];
  for (const inner of await entriesOf(entry)) {
    const name = `${path}/${inner.name}`;
    if (inner.isFile) out.push(named(await fileOf(inner as FileSystemFileEntry), name));
    else if (depth > 1) {
      out.push(...(await filesIn(inner as FileSystemDirectoryEntry, name, depth - 1)));
    }
    if (out.length > MAX_FILES) throw new Error(t().recordings.tooMany(MAX_FILES));
  }
  return out;
}

/** What was dropped. The items are read at once: they are gone when the event is over. */
export function readDrop(data: DataTransfer): Promise<Dropped[]> {
  const items = [...data.items].filter((item) => item.kind === 'file');
  const entries = items.map((item) => ({
    entry: item.webkitGetAsEntry(),
    file: item.getAsFile(),
  }));
  return Promise.all(
    entries.map(async ({ entry, file }): Promise<Dropped> => {
      if (entry?.isDirectory) {
        const folder = entry as FileSystemDirectoryEntry;
        const files = await filesIn(folder, folder.name, MAX_DEPTH);
        return { name: entry.name, files, isFolder: true };
      }
      return {
        name: file?.name ?? '',
        files: file ? [named(file, file.name)] : [],
        isFolder: false,
      };
    }),
  );
}
