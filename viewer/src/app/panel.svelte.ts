/** One panel of the page: what it shows, and the state that is saved with the layout. */

/** Plain data, as JSON has it. */
export type JsonObject = { [key: string]: unknown };

/** Services of the layout that a panel uses. */
export interface PanelHost {
  /** Shows a panel of a kind: an open one unless several may exist and `isNew`, otherwise a new one. */
  open(kind: string, state?: JsonObject, isNew?: boolean): Panel | undefined;
  close(panel: Panel): void;
}

export class Panel {
  /** Saved with the layout. Plain data only. */
  state: JsonObject = $state({});
  /** Title set by the panel; empty for the title of its kind. */
  title = $state('');
  /** Title given by the user, which has precedence. */
  given = $state('');
  /** Short text beside the title, such as a number of problems. */
  badge = $state('');
  /** True while the panel is on the screen: a hidden one can save its work. */
  isVisible = $state(false);
  /** Returns the state to save, for a panel that does not keep `state` up to date itself. */
  onSave?: () => JsonObject;

  constructor(
    readonly id: string,
    readonly kind: string,
    private host: PanelHost,
    state: JsonObject = {},
    given = '',
  ) {
    this.state = state;
    this.given = given;
  }

  setTitle(text: string): void {
    this.title = text;
  }

  /** Shows another panel; its state is merged with `state`. */
  open(kind: string, state?: JsonObject, isNew = false): Panel | undefined {
    return this.host.open(kind, state, isNew);
  }

  close(): void {
    this.host.close(this);
  }

  saved(): JsonObject {
    return this.onSave?.() ?? $state.snapshot(this.state);
  }
}
