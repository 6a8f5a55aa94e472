/** Starts sessions: what a link, a file or a user names, with the files that it needs. */
import type { App } from '../app/app.svelte';
import type { Host } from './host.svelte';
import type { Launch, Link } from './link';
import type { SessionOptions } from './messages';
import { Sessions } from './sessions';

export class Launcher {
  private last: Link | undefined;
  private ready: Promise<Sessions> | undefined;

  constructor(
    private app: App,
    private host: Host,
    private root: URL,
  ) {}

  /** The ready sessions, loaded once. */
  sessions(): Promise<Sessions> {
    this.ready ??= Sessions.load(this.root);
    // A failure is not kept: the network may be back.
    this.ready.catch(() => (this.ready = undefined));
    return this.ready;
  }

  /** Ends the present session, if there is one, and starts another. */
  async launch(link: Link): Promise<void> {
    const { app, host } = this;
    this.last = link;
    if (app.client.state !== 'connecting') app.client.stop();
    if (link.kind === 'refused') {
      host.refuse(link.why);
      return;
    }
    host.renew();
    try {
      host.use(link.kind === 'options' ? link.options : await this.prepare(link));
    } catch (error) {
      const why = (error as Error).message;
      if (this.last === link) host.refuse(() => why);
      return;
    }
    // Another one may have been started since.
    if (this.last === link) app.client.start();
  }

  async again(): Promise<void> {
    if (this.last) await this.launch(this.last);
  }

  /** Puts the files into memory, and returns the options. */
  private async prepare(launch: Exclude<Launch, { kind: 'options' }>): Promise<SessionOptions> {
    const sessions = await this.sessions();
    if (launch.kind === 'files') {
      await this.put(sessions, sessions.around(launch.paths));
      return launch.options;
    }
    const { files, options } = sessions.named(launch.name);
    await this.put(sessions, files);
    if (launch.seed === undefined) return options;
    return { ...options, run: { ...(options.run as object), seed: launch.seed } };
  }

  private async put(sessions: Sessions, paths: readonly string[]): Promise<void> {
    await Promise.all(
      paths.map(async (path) => this.host.write(`/${path}`, await sessions.fetch(path))),
    );
  }
}
