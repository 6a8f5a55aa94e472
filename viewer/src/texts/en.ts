/**
 * All texts of the page, in English. A translation is a file beside this one with the same keys; a text with
 * values is a function, so that a language can order them. Names of ROS, RViz and Nav2 (topics, types, options of
 * displays, parameters) are not translated.
 */
export const en = {
  language: {
    /** Name of this language in itself. */
    name: 'English',
    choose: 'Language',
  },
  /** Titles of panels. */
  panels: {
    drive: 'Drive',
    navigate: 'Navigate',
    world: 'World',
    topics: 'Topics',
    nodes: 'Nodes',
    parameters: 'Parameters',
    services: 'Services',
    plot: 'Plot',
    log: 'Log',
  },
};

export type Texts = typeof en;
