/** The arrangement on a wide page: dockview, with the page's own tabs, menus and keys. Loaded after the first picture. */
import {
  createDockview,
  type DockviewApi,
  type DockviewGroupPanel,
  type IContentRenderer,
  type ITabRenderer,
} from 'dockview';
import { mount, unmount } from 'svelte';
import { fromDock, toDock } from '../app/dock_grid';
import type { Arrangement } from '../app/layout';
import type { Panel } from '../app/panel.svelte';
import { VIEW_KIND, type Arranger, type Side, type Workbench } from '../app/workbench.svelte';
import { t } from '../texts/language.svelte';
import './dock.css';
import type { Frames } from './frames';
import GroupActions from './GroupActions.svelte';

const DIRECTIONS = {
  center: 'within',
  left: 'left',
  right: 'right',
  top: 'above',
  bottom: 'below',
} as const;
const POSITIONS = { ...DIRECTIONS, center: 'center', top: 'top', bottom: 'bottom' } as const;
/** Smallest panel that still shows something [px]. */
const MIN_WIDTH_PX = 180;
const MIN_HEIGHT_PX = 100;
const FLOATING = { width: 420, height: 320, x: 120, y: 80 };

/** Text of a tab, and a cross for the mouse; keys close with Delete. */
function tabOf(panel: Panel, workbench: Workbench): ITabRenderer {
  const element = document.createElement('div');
  element.className = 'tab';
  const text = document.createElement('span');
  const badge = document.createElement('span');
  badge.className = 'tab-badge';
  const cross = document.createElement('span');
  cross.className = 'tab-close';
  cross.textContent = '×';
  cross.setAttribute('aria-hidden', 'true');
  cross.addEventListener('pointerdown', (event) => event.preventDefault());
  cross.addEventListener('click', (event) => {
    event.stopPropagation();
    workbench.close(panel);
  });
  element.append(text, badge, cross);
  let end = () => {};
  return {
    element,
    init({ api }) {
      end = $effect.root(() => {
        $effect(() => {
          const title = workbench.titleOf(panel);
          text.textContent = title;
          badge.textContent = panel.badge;
          badge.hidden = !panel.badge;
          cross.title = t().dock.close(title);
          if (api.title !== title) api.setTitle(title);
        });
      });
    },
    dispose: () => end(),
  };
}

export class Dock implements Arranger {
  private readonly api: DockviewApi;
  private readonly landmarks = new Map<DockviewGroupPanel, () => void>();
  /** True while panels are moved by the program: closed panels are then not closed by the user. */
  private isLoading = false;

  constructor(
    private readonly element: HTMLElement,
    private readonly workbench: Workbench,
    private readonly frames: Frames,
  ) {
    this.api = createDockview(element, {
      theme: {
        name: 'periplus',
        className: 'dock-theme',
        dndTabIndicator: 'line',
        dndOverlayMounting: 'relative',
      },
      createComponent: ({ id }) => this.content(id),
      createTabComponent: ({ id }) => tabOf(workbench.panel(id)!, workbench),
      defaultTabComponent: 'tab',
      createRightHeaderActionComponent: (group) => this.actions(group),
      disableTabsOverflowList: true,
      scrollbars: 'native',
      noPanelsOverlay: 'emptyGroup',
      floatingGroupBounds: 'boundedWithinViewport',
      announcements: true,
      messages: {
        panelOpened: (title) => t().dock.opened(title),
        panelClosed: (title) => t().dock.closed(title),
        groupMaximized: (title) => t().dock.maximized(title),
        groupRestored: (title) => t().dock.restored(title),
        groupFloated: (title) => t().dock.floated(title),
        groupDocked: (title) => t().dock.docked(title),
        closeTab: (title) => t().dock.close(title),
      },
    });
    const { api } = this;
    api.onDidRemovePanel(({ id }) => {
      const panel = workbench.panel(id);
      if (panel && !this.isLoading) workbench.closed(panel);
    });
    api.onDidActivePanelChange(() => {
      const panel = workbench.panel(api.activePanel?.id ?? '');
      if (panel && !this.isLoading && panel !== workbench.active) workbench.activated(panel);
      if (!this.isLoading) this.describe();
    });
    api.onDidLayoutChange(() => {
      if (this.isLoading) return;
      workbench.arranged(this.arrangement());
      this.describe();
    });
    element.addEventListener('keydown', (event) => this.key(event), true);
  }

  private content(id: string): IContentRenderer {
    const panel = this.workbench.panel(id)!;
    const element = this.frames.of(panel);
    return {
      element,
      init: () => {},
      onShow: () => (panel.isVisible = true),
      onHide: () => (panel.isVisible = false),
    };
  }

  private actions(group: DockviewGroupPanel) {
    const element = document.createElement('div');
    element.className = 'group-actions';
    let mounted: Record<string, unknown> | undefined;
    return {
      element,
      init: () => {
        mounted = mount(GroupActions, {
          target: element,
          props: { workbench: this.workbench, dock: this, group },
        });
      },
      dispose: () => {
        if (mounted) void unmount(mounted);
      },
    };
  }

  // Arranger.

  arrangement(): Arrangement {
    return fromDock(this.api.toJSON(), this.workbench.active?.id);
  }

  load(arrangement: Arrangement): void {
    this.isLoading = true;
    try {
      const { width, height } = this.element.getBoundingClientRect();
      const titles = Object.fromEntries(
        this.workbench.panels.map((panel) => [panel.id, this.workbench.titleOf(panel)]),
      );
      this.api.fromJSON(toDock(arrangement, titles, width, height));
      for (const group of this.api.groups) this.limit(group);
      const active = this.api.getPanel(arrangement.active ?? '');
      active?.api.setActive();
    } finally {
      this.isLoading = false;
    }
    this.frames.keep(this.workbench.panels);
    this.describe();
  }

  private limit(group: DockviewGroupPanel): void {
    group.api.setConstraints({ minimumWidth: MIN_WIDTH_PX, minimumHeight: MIN_HEIGHT_PX });
  }

  add(panel: Panel, beside: string | undefined, side: Side): void {
    const options = { id: panel.id, component: 'panel', title: this.workbench.titleOf(panel) };
    const known = beside && this.api.getPanel(beside) ? beside : this.api.panels[0]?.id;
    const added = this.api.addPanel(
      known
        ? { ...options, position: { referencePanel: known, direction: DIRECTIONS[side] } }
        : options,
    );
    this.limit(added.group);
  }

  remove(panel: Panel): void {
    const found = this.api.getPanel(panel.id);
    if (found) this.api.removePanel(found);
    queueMicrotask(() => this.frames.keep(this.workbench.panels));
  }

  show(panel: Panel): void {
    const found = this.api.getPanel(panel.id);
    if (!found) return;
    if (!found.group.api.isVisible) found.group.api.setVisible(true);
    found.api.setActive();
  }

  move(panel: Panel, beside: string, side: Side): void {
    const [from, to] = [this.api.getPanel(panel.id), this.api.getPanel(beside)];
    if (!from || !to) return;
    from.api.moveTo({ group: to.group, position: POSITIONS[side] as never });
    this.limit(from.group);
  }

  // Commands of the menu of each group.

  float(panel: Panel): void {
    const found = this.api.getPanel(panel.id);
    if (found) this.api.addFloatingGroup(found, { ...FLOATING });
  }

  isFloating(panel: Panel): boolean {
    return this.api.getPanel(panel.id)?.api.location.type === 'floating';
  }

  /** Puts a floating panel back beside the others. */
  dock(panel: Panel): void {
    const target = this.api.groups.find((group) => group.api.location.type === 'grid');
    const found = this.api.getPanel(panel.id);
    if (found && target) found.api.moveTo({ group: target, position: 'right' });
  }

  isMaximized(panel: Panel): boolean {
    return this.api.getPanel(panel.id)?.api.isMaximized() ?? false;
  }

  toggleMaximized(panel: Panel): void {
    const found = this.api.getPanel(panel.id);
    if (!found) return;
    if (found.api.isMaximized()) found.api.exitMaximized();
    else found.api.maximize();
  }

  /** Moves a panel to the tabs of the next group. */
  toNextGroup(panel: Panel): void {
    const groups = this.groups();
    const found = this.api.getPanel(panel.id);
    const at = groups.findIndex((group) => group === found?.group);
    const next = groups[(at + 1) % groups.length];
    if (found && next && next !== found.group)
      found.api.moveTo({ group: next, position: 'center' });
  }

  /** Moves a tab among the tabs of its group. */
  shift(panel: Panel, by: -1 | 1): void {
    const found = this.api.getPanel(panel.id);
    if (!found) return;
    const { group } = found;
    const index = group.panels.indexOf(found) + by;
    if (index < 0 || index >= group.panels.length) return;
    found.api.moveTo({ group, position: 'center', index });
  }

  /** Groups from left to right and top to bottom. */
  private groups(): DockviewGroupPanel[] {
    const boxes = this.api.groups
      .filter((group) => group.api.isVisible)
      .map((group) => ({ group, box: group.element.getBoundingClientRect() }));
    return boxes.sort((a, b) => a.box.x - b.box.x || a.box.y - b.box.y).map(({ group }) => group);
  }

  // Side panels as a whole: for the buttons of the top bar.

  private sides(): DockviewGroupPanel[] {
    return this.api.groups.filter(
      (group) =>
        group.api.location.type === 'grid' &&
        !group.panels.some(({ id }) => {
          const kind = this.workbench.panel(id)?.kind;
          return kind === VIEW_KIND || kind === 'displays' || kind === 'image';
        }),
    );
  }

  areSidesVisible(): boolean {
    return this.sides().some((group) => group.api.isVisible);
  }

  showSides(isVisible: boolean): void {
    for (const group of this.sides()) group.api.setVisible(isVisible);
  }

  // Keys and names.

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.key === 'F6') {
      this.focusGroup(event.shiftKey ? -1 : 1, target);
      event.preventDefault();
      event.stopPropagation();
      return;
    }
    if (target.getAttribute('role') !== 'tab') return;
    const panel = this.workbench.panel(target.dataset.tabPanelId ?? '');
    if (!panel) return;
    const isDelete = event.key === 'Delete' && !event.ctrlKey && !event.altKey;
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (isDelete) this.closeByKey(panel);
    else if (by && event.ctrlKey && event.shiftKey) this.shift(panel, by as -1 | 1);
    else if (by) this.activateTab(panel, by);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Arrow keys on a tab show the next panel of the group. */
  private activateTab(panel: Panel, by: number): void {
    const group = this.api.getPanel(panel.id)?.group;
    if (!group) return;
    const at = group.panels.findIndex(({ id }) => id === panel.id);
    const next = group.panels[(at + by + group.panels.length) % group.panels.length]!;
    next.api.setActive();
    this.focusTab(next.id);
  }

  private closeByKey(panel: Panel): void {
    const group = this.api.getPanel(panel.id)?.group;
    this.workbench.close(panel);
    const next = group && this.api.groups.includes(group) ? group : this.groups()[0];
    if (next?.activePanel) this.focusTab(next.activePanel.id);
  }

  focusTab(id: string): void {
    this.element.querySelector<HTMLElement>(`[data-tab-panel-id="${CSS.escape(id)}"]`)?.focus();
  }

  /** Moves the focus to the selected tab of the next group. */
  private focusGroup(by: number, from: HTMLElement): void {
    const groups = this.groups();
    if (groups.length === 0) return;
    const at = groups.findIndex(({ element }) => element.contains(from));
    const next = groups[(at + by + groups.length) % groups.length]!;
    if (!next.activePanel) return;
    next.activePanel.api.setActive();
    this.focusTab(next.activePanel.id);
  }

  /** Names groups, tabs and their bodies for screen readers and tests. */
  private describe(): void {
    let sides = 0;
    for (const group of this.groups()) {
      const kinds = group.panels.map(({ id }) => this.workbench.panel(id)?.kind);
      const titles = group.panels.map(({ title }) => title).join(', ');
      const hasView = kinds.some((kind) => kind === VIEW_KIND || kind === 'image');
      const first = ++sides === 1 ? t().dock.panels : t().dock.panelsNumbered(sides);
      let name = first;
      if (kinds.includes('displays')) [name, sides] = [t().panels.displays, sides - 1];
      else if (hasView) [name, sides] = [titles, sides - 1];
      const { element } = group;
      if (hasView) element.removeAttribute('role');
      else element.setAttribute('role', 'complementary');
      if (hasView) element.removeAttribute('aria-label');
      else element.setAttribute('aria-label', name);
      const list = element.querySelector('[role=tablist]');
      list?.setAttribute('aria-label', name);
      for (const tab of element.querySelectorAll<HTMLElement>('[role=tab]')) {
        tab.id = `tab-${tab.dataset.tabPanelId}`;
        tab.setAttribute('aria-keyshortcuts', 'Delete');
      }
      const body = element.querySelector('[role=tabpanel]');
      const active = group.activePanel?.id;
      if (body && active) {
        body.id = `panel-${active}`;
        body.setAttribute('aria-labelledby', `tab-${active}`);
        for (const tab of element.querySelectorAll('[role=tab]')) {
          if (tab.getAttribute('aria-selected') === 'true')
            tab.setAttribute('aria-controls', body.id);
          else tab.removeAttribute('aria-controls');
        }
      }
    }
  }

  dispose(): void {
    this.isLoading = true;
    this.api.dispose();
  }
}
