import type { Texts } from './en';

export const de: Texts = {
  language: {
    name: 'Deutsch',
    choose: 'Sprache',
  },
  panels: {
    drive: 'Fahren',
    navigate: 'Navigieren',
    world: 'Welt',
    topics: 'Topics',
    nodes: 'Nodes',
    parameters: 'Parameter',
    services: 'Services',
    plot: 'Kurven',
    log: 'Protokoll',
  },
};
