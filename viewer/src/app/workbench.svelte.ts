/** The open panels and their arrangement: in tabs and splits on a wide page, one at a time on a narrow one. */
import { t } from '../texts/language.svelte';
import type { App } from './app.svelte';
import {
  insert,
  panelsOf,
  tabsOf,
  tidy,
  type Arrangement,
  type Layout,
  type SavedPanel,
} from './layout';
import { Panel, type JsonObject, type PanelHost } from './panel.svelte';
import type { Viewport, ViewportState } from './viewport.svelte';

/** Kind of the 3D views. */
export const VIEW_KIND = '3d';

export type Side = 'center' | 'left' | 'right' | 'top' | 'bottom';

/** What the workbench knows of the kinds of panels. */
export interface KindFacts {
  id: string;
  title: () => string;
  isMany?: boolean;
  isFirst?: boolean;
  isOffered?: unknown;
  /** True for panels that are placed beside the 3D view, not among the tabs. */
  isLarge?: boolean;
}

/** Shows the arrangement and lets the user change it; without one the workbench changes plain data. */
export interface Arranger {
  load(arrangement: Arrangement): void;
  add(panel: Panel, beside: string | undefined, side: Side): void;
  remove(panel: Panel): void;
  show(panel: Panel): void;
  /** Moves a panel beside another one. */
  move(panel: Panel, beside: string, side: Side): void;
}

/** Widths of the panels at the sides of the first layout [px]. */
const LEFT_PX = 300;
const RIGHT_PX = 320;
const MAX_VIEWS = 6;

export class Workbench implements PanelHost {
  panels: Panel[] = $state.raw([]);
  arrangement: Arrangement = $state.raw({ root: { tabs: [] }, floating: [] });
  active: Panel | undefined = $state.raw();
  /** Increases with each change that is worth saving. */
  version = $state(0);
  /** Opens a file with a layout or with displays; set by the page. */
  openFile?: (name: string, text: string) => Promise<void>;
  private arranger?: Arranger;
  private views = new Map<Panel, Viewport>();
  /** Kinds that were offered in this layout. */
  private offered: string[] = [];
  /** Where new panels go: the tabs used last. */
  private lastTabs = '';

  constructor(
    private app: App,
    private kinds: readonly KindFacts[],
  ) {}

  // Panels.

  kindOf(panel: Panel): KindFacts | undefined {
    return this.kinds.find(({ id }) => id === panel.kind);
  }

  /** Title on the tab: the one given, otherwise that of the kind, numbered from the second on. */
  titleOf(panel: Panel): string {
    if (panel.given || panel.title) return panel.given || panel.title;
    const number = /-(\d+)$/.exec(panel.id)?.[1];
    const title = this.kindOf(panel)?.title() ?? panel.kind;
    return number ? `${title} ${number}` : title;
  }

  panel(id: string): Panel | undefined {
    return this.panels.find((panel) => panel.id === id);
  }

  /** Ids are the kind and a number, so that a reset layout has the ids of the first one. */
  private freeId(kind: string): string {
    for (let number = 1; ; number++) {
      const id = number === 1 ? kind : `${kind}-${number}`;
      if (!this.panel(id)) return id;
    }
  }

  private make(id: string, saved: SavedPanel, isAskedFor = false): Panel {
    const panel = new Panel(id, saved.kind, this, saved.state, saved.title ?? '');
    if (saved.kind === VIEW_KIND) this.addView(panel, saved.state, isAskedFor);
    this.panels = [...this.panels, panel];
    return panel;
  }

  open(kind: string, state: JsonObject = {}, isNew = false): Panel | undefined {
    const facts = this.kinds.find(({ id }) => id === kind);
    if (!facts) {
      this.app.notice('error', t().dock.noPanel(kind));
      return undefined;
    }
    const old = this.panels.filter((panel) => panel.kind === kind);
    if (old.length > 0 && !(facts.isMany && isNew)) {
      const found = old.find((panel) => panel === this.active) ?? old[old.length - 1]!;
      Object.assign(found.state, state);
      this.show(found);
      return found;
    }
    if (kind === VIEW_KIND && old.length >= MAX_VIEWS) {
      this.app.notice('warn', t().dock.mostViews(MAX_VIEWS));
      return undefined;
    }
    const panel = this.make(this.freeId(kind), { kind, state });
    this.place(panel, facts);
    this.show(panel);
    this.changed();
    return panel;
  }

  private place(panel: Panel, facts: KindFacts): void {
    const views = this.panels.filter(({ kind, id }) => kind === VIEW_KIND && id !== panel.id);
    const view = views.find((one) => this.views.get(one) === this.app.active) ?? views[0];
    const { lastTabs } = this;
    const among = tabsOf(this.arrangement.root).find(({ tabs }) => tabs.includes(lastTabs));
    const tabs =
      among ??
      tabsOf(this.arrangement.root).find((one) =>
        one.tabs.some((id) => this.kinds.find((kind) => kind.id === this.panel(id)?.kind)?.isFirst),
      );
    if (facts.isLarge && view) this.put(panel, view.id, 'right');
    else if (tabs) this.put(panel, tabs.tabs[0], 'center');
    else this.put(panel, view?.id ?? panelsOf(this.arrangement.root)[0], 'right');
  }

  /** Adds a tab for a kind that has become useful, once; the user may close it. */
  offer(kind: string): void {
    if (this.offered.includes(kind)) return;
    this.offered = [...this.offered, kind];
    const facts = this.kinds.find(({ id }) => id === kind);
    if (!facts || this.panels.some((panel) => panel.kind === kind)) return;
    const { active } = this;
    const tabs = tabsOf(this.arrangement.root).find((one) => one.tabs.includes(this.lastTabs));
    const shown = this.panel(tabs?.active ?? '');
    this.place(this.make(kind, { kind, state: {} }), facts);
    if (shown) this.show(shown);
    if (active) this.show(active);
    this.changed();
  }

  /** Removes the tab of a kind that has nothing to show any more. It is offered again unless the user closed it. */
  withdraw(kind: string): void {
    const open = this.panels.filter((panel) => panel.kind === kind);
    if (open.length === 0) return;
    this.offered = this.offered.filter((id) => id !== kind);
    for (const panel of open) this.close(panel);
  }

  private put(panel: Panel, beside: string | undefined, side: Side): void {
    if (this.arranger) {
      this.arranger.add(panel, beside, side);
      return;
    }
    const { root } = this.arrangement;
    const placed = beside
      ? insert(root, panel.id, beside, side)
      : { tabs: [panel.id], active: panel.id };
    this.arrangement = { ...this.arrangement, root: placed };
  }

  close(panel: Panel): void {
    if (!this.panels.includes(panel)) return;
    this.arranger?.remove(panel);
    this.closed(panel);
  }

  /** A panel was removed, here or by the arranger. */
  closed(panel: Panel): void {
    if (!this.panels.includes(panel)) return;
    this.panels = this.panels.filter((one) => one !== panel);
    panel.isVisible = false;
    const view = this.views.get(panel);
    this.views.delete(panel);
    if (view) this.app.removeViewport(view);
    if (this.active === panel) this.active = undefined;
    if (!this.arranger) {
      const keep = (id: string) => id !== panel.id;
      const root = tidy(this.arrangement.root, keep) ?? { tabs: [] };
      this.arrangement = { ...this.arrangement, root };
    }
    this.changed();
  }

  show(panel: Panel): void {
    this.arranger?.show(panel);
    if (!this.arranger) {
      const one = tabsOf(this.arrangement.root).find(({ tabs }) => tabs.includes(panel.id));
      if (one) one.active = panel.id;
      this.arrangement = { ...this.arrangement, active: panel.id };
    }
    this.activated(panel);
  }

  /** A panel got the focus, here or by the user. */
  activated(panel: Panel): void {
    this.active = panel;
    const facts = this.kindOf(panel);
    if (facts && !facts.isLarge && facts.id !== 'displays') this.lastTabs = panel.id;
    const view = this.views.get(panel);
    if (view) this.app.active = view;
  }

  move(panel: Panel, beside: string, side: Side): void {
    this.arranger?.move(panel, beside, side);
  }

  // 3D views.

  viewOf(panel: Panel): Viewport {
    return this.views.get(panel)!;
  }

  panelOf(view: Viewport): Panel | undefined {
    return [...this.views].find(([, one]) => one.id === view.id)?.[0];
  }

  private addView(panel: Panel, state: JsonObject, isAskedFor: boolean): void {
    const shown = new Set([...this.views.values()].map(({ id }) => id));
    const free = this.app.viewports.find(({ id }) => !shown.has(id));
    const view = free ?? this.app.addViewport();
    this.views.set(panel, view);
    panel.onSave = () => view.snapshot() as unknown as JsonObject;
    if (Object.keys(state).length === 0) return;
    view.restore(state as Partial<ViewportState>, isAskedFor);
  }

  /** Gives each 3D view that has no panel one: another part of the page added it. */
  showViews(): void {
    // A page without 3D views still has one for what panels ask of it.
    if (this.app.viewports.length <= 1) return;
    for (const view of this.app.viewports) {
      if (!this.panelOf(view)) this.open(VIEW_KIND, {}, true);
    }
  }

  // Layouts.

  /** The first layout: displays at the left, the 3D view, tabs at the right. */
  first(widthPx: number): Layout {
    const tabs = this.kinds
      .filter(({ isFirst, isOffered }) => isFirst && !isOffered)
      .map(({ id }) => id);
    const ids = ['displays', VIEW_KIND, ...tabs];
    const [left, right] = [LEFT_PX / widthPx, RIGHT_PX / widthPx];
    return {
      panels: Object.fromEntries(ids.map((id) => [id, { kind: id, state: {} }])),
      root: {
        split: 'row',
        sizes: [left, 1 - left - right, right],
        children: [
          { tabs: ['displays'], active: 'displays' },
          { tabs: [VIEW_KIND], active: VIEW_KIND },
          { tabs, active: tabs[0] },
        ],
      },
      floating: [],
      active: VIEW_KIND,
      offered: [],
    };
  }

  save(): Layout {
    const panels = Object.fromEntries(
      this.panels.map((panel): [string, SavedPanel] => [
        panel.id,
        { kind: panel.kind, title: panel.given, state: panel.saved() },
      ]),
    );
    const { saved: robot } = this.app.robots;
    return { panels, ...this.arrangement, active: this.active?.id, offered: this.offered, robot };
  }

  /**
   * Shows a layout. 3D views with the same ids go on, other panels are created again. A layout that the user
   * `isAskedFor` is not replaced by the file of a launch file.
   */
  restore(layout: Layout, isAskedFor = false): void {
    const old = this.panels;
    const { arranger } = this;
    // Meanwhile the arranger would report each panel as closed by the user.
    this.arranger = undefined;
    for (const panel of old) {
      const saved = layout.panels[panel.id];
      const goesOn = panel.kind === VIEW_KIND && saved?.kind === VIEW_KIND;
      if (!goesOn) this.closed(panel);
      else {
        panel.given = saved.title ?? '';
        this.viewOf(panel).restore(saved.state as Partial<ViewportState>, isAskedFor);
      }
    }
    for (const [id, saved] of Object.entries(layout.panels)) {
      if (!this.panel(id)) this.make(id, saved, isAskedFor);
    }
    const { root, floating, active } = layout;
    this.offered = layout.offered ?? [];
    this.app.robots.restore(layout.robot);
    this.arrangement = { root, floating, active };
    this.arranger = arranger;
    arranger?.load(this.arrangement);
    const focused = this.panel(active ?? '') ?? this.panels.find((p) => p.kind === VIEW_KIND);
    if (focused) this.activated(focused);
    this.changed();
  }

  use(arranger: Arranger | undefined): void {
    this.arranger = arranger;
    arranger?.load(this.arrangement);
  }

  /** The user changed the arrangement. */
  arranged(arrangement: Arrangement): void {
    this.arrangement = arrangement;
    this.changed();
  }

  changed(): void {
    this.version++;
  }
}
