/** All kinds of panels. An entry is one line; the component gets `PanelProps`. */
import type { Component } from 'svelte';
import type { App } from '../app/app.svelte';
import type { Driver } from '../app/driver.svelte';
import type { Panel } from '../app/panel.svelte';
import type { Tools } from '../app/tools.svelte';
import { t } from '../texts/language.svelte';
import DisplaysPanel from './DisplaysPanel.svelte';
import DrivePanel from './DrivePanel.svelte';
import type { IconName } from './icons';
import StageView from './StageView.svelte';

export interface PanelProps {
  app: App;
  tools: Tools;
  driver: Driver;
  panel: Panel;
}

export interface PanelKind {
  /** Name in saved layouts; never changed. */
  id: string;
  title: () => string;
  icon: IconName;
  /** Loaded when first shown. */
  load?: () => Promise<{ default: Component<PanelProps> }>;
  /** Instead of `load`: part of the first picture. */
  component?: Component<PanelProps>;
  /** True if several may be open. */
  isMany?: boolean;
  /** True for a panel that is open in the first layout, as a tab on the right. */
  isFirst?: boolean;
  /** True for a panel without padding and own scrolling, such as a 3D view. */
  isBare?: boolean;
  /** True for a panel that works on while it is behind another one; others start again when they are shown. */
  isKept?: boolean;
  /** True for a panel that is placed beside the 3D view, not among the tabs at the right. */
  isLarge?: boolean;
  /** False while the panel has nothing to show; it is then not offered. */
  isOffered?: (app: App) => boolean;
}

/** Panels that work on an open recording. */
const isReplay = (app: App) => app.replay !== undefined;

const kinds: PanelKind[] = [
  // prettier-ignore
  { id: '3d', title: () => t().panels.view, icon: 'cube', isMany: true, isBare: true, isKept: true, isLarge: true, component: StageView },
  // prettier-ignore
  { id: 'displays', title: () => t().panels.displays, icon: 'left', isBare: true, component: DisplaysPanel },
  // prettier-ignore
  { id: 'image', title: () => t().panels.image, icon: 'image', isMany: true, isBare: true, isLarge: true, load: () => import('./ImagePanel.svelte') },
  // prettier-ignore
  { id: 'drive', title: () => t().panels.drive, icon: 'move', isFirst: true, component: DrivePanel },
  // prettier-ignore
  { id: 'navigate', title: () => t().panels.navigate, icon: 'goal', isFirst: true, load: () => import('./NavigatePanel.svelte') },
  // prettier-ignore
  { id: 'world', title: () => t().panels.world, icon: 'house', isFirst: true, load: () => import('./SimPanel.svelte') },
  // prettier-ignore
  { id: 'topics', title: () => t().panels.topics, icon: 'list', isFirst: true, load: () => import('./TopicsPanel.svelte') },
  // prettier-ignore
  { id: 'messages', title: () => t().panelNames.messages, icon: 'lines', isFirst: true, isMany: true, load: () => import('./MessagesPanel.svelte') },
  // prettier-ignore
  { id: 'nodes', title: () => t().panels.nodes, icon: 'graph', isFirst: true, load: () => import('./NodesPanel.svelte') },
  // prettier-ignore
  { id: 'parameters', title: () => t().panels.parameters, icon: 'sliders', isFirst: true, load: () => import('./ParametersPanel.svelte') },
  // prettier-ignore
  { id: 'services', title: () => t().panels.services, icon: 'play', isFirst: true, load: () => import('./ServicesPanel.svelte') },
  // prettier-ignore
  { id: 'plot', title: () => t().panels.plot, icon: 'plot', isFirst: true, isMany: true, isKept: true, load: () => import('./PlotPanel.svelte') },
  // prettier-ignore
  { id: 'log', title: () => t().panels.log, icon: 'lines', isFirst: true, load: () => import('./LogPanel.svelte') },
  // prettier-ignore
  { id: 'recordings', title: () => t().recordings.title, icon: 'record', isFirst: true, load: () => import('./RecordingsPanel.svelte') },
  // prettier-ignore
  { id: 'marks', title: () => t().marks.title, icon: 'goal', isFirst: true, isOffered: isReplay, load: () => import('./MarksPanel.svelte') },
  // prettier-ignore
  { id: 'compare', title: () => t().recordings.comparison, icon: 'compare', isFirst: true, isOffered: isReplay, load: () => import('./ComparePanel.svelte') },
  // prettier-ignore
  { id: 'rerun', title: () => t().rerun.title, icon: 'reset', isFirst: true, isOffered: isReplay, load: () => import('./RerunPanel.svelte') },
  // prettier-ignore
  { id: 'transforms', title: () => t().panelNames.transforms, icon: 'frames', isMany: true, load: () => import('./TransformsPanel.svelte') },
  // prettier-ignore
  { id: 'diagnostics', title: () => t().panelNames.diagnostics, icon: 'pulse', load: () => import('./DiagnosticsPanel.svelte') },
  // prettier-ignore
  { id: 'states', title: () => t().panelNames.states, icon: 'bands', isMany: true, isKept: true, load: () => import('./StatesPanel.svelte') },
  // prettier-ignore
  { id: 'graph', isLarge: true, title: () => t().panelNames.graph, icon: 'graph', load: () => import('./GraphPanel.svelte') },
  // prettier-ignore
  { id: 'actions', title: () => t().panelNames.actions, icon: 'goal', load: () => import('./ActionsPanel.svelte') },
  // prettier-ignore
  { id: 'publish', title: () => t().publish.title, icon: 'send', isMany: true, isKept: true, load: () => import('./PublishPanel.svelte') },
  // prettier-ignore
  { id: 'parameterSets', title: () => t().panelNames.parameterSets, icon: 'save', load: () => import('./ParameterSetsPanel.svelte') },
  // prettier-ignore
  { id: 'joints', title: () => t().panelNames.joints, icon: 'joint', isKept: true, load: () => import('./JointsPanel.svelte') },
  // prettier-ignore
  { id: 'handles', title: () => t().handles.title, icon: 'move', load: () => import('./HandlesPanel.svelte') },
  // prettier-ignore
  { id: 'table', title: () => t().panelNames.table, icon: 'table', isMany: true, load: () => import('./TablePanel.svelte') },
];

export const PANEL_KINDS: readonly PanelKind[] = kinds;

/** Adds a kind of a page with more than this one; call it before the page is shown. */
export const offerPanel = (kind: PanelKind): void => void kinds.push(kind);

export const panelKind = (id: string): PanelKind | undefined =>
  PANEL_KINDS.find((kind) => kind.id === id);
