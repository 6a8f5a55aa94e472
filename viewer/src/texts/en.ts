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
  expression: {
    tooLong: (most: number) => `the expression is longer than ${most} characters`,
    tooDeep: 'the expression is nested too deeply',
    unexpected: (text: string) => `unexpected "${text}"`,
    topicForm: 'a topic is written as /topic:field',
    missingValue: (before: string) =>
      before ? `a value is missing before "${before}"` : 'a value is missing before the end',
    missingBracket: (before: string) =>
      before ? `")" is missing before "${before}"` : '")" is missing before the end',
    noTopic: (name: string) => `"${name}" has no topic: write /topic:${name}`,
    noFunction: (name: string, all: string) => `there is no function "${name}"; there are ${all}`,
    arity: (name: string, wanted: string, count: number) =>
      `${name} takes ${wanted} value(s), not ${count}`,
  },
  plot: {
    tools: 'Plots',
    hold: 'Pause',
    resume: 'Continue',
    fit: 'Follow',
    statistics: 'Statistics',
    addTime: 'Plot over time',
    addXY: 'X-Y plot',
    span: 'Seconds shown',
    timeFrom: 'Time',
    header: 'of the header',
    receive: 'of reception',
    help: 'Drag fields here from the panel Messages. Drag in a plot to zoom, Shift-drag or one finger to pan, double click to follow again. Arrow keys move the cursor.',
    nothingToSave: 'There is nothing to save: no curve has a value in the visible span.',
    reduced: (points: number) =>
      `More than ${points} messages: the smallest and largest values of equal spans are shown. Zoom in for all.`,
    timePlot: 'Plot over time',
    xyPlot: 'X-Y plot',
    timeAxis: (offsetS: number) => (offsetS ? `time − ${offsetS} [s]` : 'time [s]'),
    zoomIn: 'Zoom in',
    zoomOut: 'Zoom out',
    reset: 'Show everything',
    removePlot: 'Remove the plot',
    cursor: 'Time cursor of the plot',
    empty: 'No curves yet: choose a field, enter an expression, or drop a field here.',
    mean: 'mean',
    show: (label: string) => `Show ${label}`,
    removeCurve: (label: string) => `Remove ${label}`,
    waitingForY: (x: string) => `x is ${x}. Drop the field for y.`,
    addCurve: 'Add a curve',
    topic: 'Topic to plot',
    field: 'Field to plot',
    chooseTopic: 'Select a topic…',
    chooseField: 'Select a field…',
    expression: 'Expression',
    add: 'Plot',
    relativeTo: 'Names relative to',
    noField: 'the expression has no field of a topic',
    problem: (message: string, position: number) => `Position ${position}: ${message}.`,
  },
  messages: {
    topic: 'Topic',
    choose: 'Select a topic…',
    absent: 'no publisher',
    help: 'Shows the fields of each message as a tree. Changed values are marked. Drag a number into a plot, or press Enter on it.',
    hold: 'Pause',
    resume: 'Continue',
    pin: 'Compare with this',
    pinHelp: 'Compares the following messages with the present one instead of the one before',
    copyAll: 'Copy message',
    none: 'No message received yet.',
    comparedWith: (timeS: string) =>
      timeS ? `Compared with the message of ${timeS} s.` : 'Compared with the chosen message.',
    tree: (topic: string) => `Fields of ${topic}`,
    page: (range: string, count: number) => `${range} of ${count}`,
    changed: 'changed',
    added: 'added',
    removed: 'removed',
    plot: 'Plot this',
    copyPath: 'Copy path',
    copyValue: 'Copy value',
    copied: (what: string) => `Copied ${what}.`,
    copyFailed: 'The browser did not allow copying. Open the page by HTTPS or on localhost.',
  },
  topics: {
    search: (count: number) => `Search ${count} topics`,
    searchLabel: 'Search topics',
    ends: (publishers: number, subscribers: number) =>
      `${publishers} publishers, ${subscribers} subscribers`,
    noPublisher: 'no publisher',
    from: (nodes: string) => `from ${nodes}`,
    to: (nodes: string) => `to ${nodes}`,
    showAs: (display: string) => `Show as ${display}`,
    nothing: 'No topic matches.',
  },
  /** Titles of further panels. */
  panelNames: {
    messages: 'Messages',
    graph: 'Node graph',
    transforms: 'Transforms',
    diagnostics: 'Diagnostics',
    states: 'States',
    actions: 'Actions',
    parameterSets: 'Parameter sets',
    joints: 'Joints',
    table: 'Table',
    publish: 'Publish',
  },
};

export type Texts = typeof en;
