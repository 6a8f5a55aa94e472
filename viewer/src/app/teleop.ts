/** Keys of teleop_twist_keyboard and the velocities that they command. */

/** Fractions of the maximum speeds: linear x, y, z and angular z. */
export const MOVES: Record<string, [number, number, number, number]> = {
  i: [1, 0, 0, 0],
  o: [1, 0, 0, -1],
  j: [0, 0, 0, 1],
  l: [0, 0, 0, -1],
  u: [1, 0, 0, 1],
  ',': [-1, 0, 0, 0],
  '.': [-1, 0, 0, 1],
  m: [-1, 0, 0, -1],
  O: [1, -1, 0, 0],
  I: [1, 0, 0, 0],
  J: [0, 1, 0, 0],
  L: [0, -1, 0, 0],
  U: [1, 1, 0, 0],
  '<': [-1, 0, 0, 0],
  '>': [-1, -1, 0, 0],
  M: [-1, 1, 0, 0],
  t: [0, 0, 1, 0],
  b: [0, 0, -1, 0],
};

/** Factors of the linear speed [m/s] and of the angular speed [rad/s]. */
export const SPEEDS: Record<string, [number, number]> = {
  q: [1.1, 1.1],
  z: [0.9, 0.9],
  w: [1.1, 1],
  x: [0.9, 1],
  e: [1, 1.1],
  c: [1, 0.9],
};

export interface Speeds {
  linearMS: number;
  angularRadS: number;
}

export const FIRST_SPEEDS: Speeds = { linearMS: 0.5, angularRadS: 1 };

export interface Twist {
  linear: { x: number; y: number; z: number };
  angular: { x: number; y: number; z: number };
}

export function twist(move: readonly number[], speeds: Speeds): Twist {
  const [x = 0, y = 0, z = 0, turn = 0] = move;
  const { linearMS, angularRadS } = speeds;
  return {
    linear: { x: x * linearMS, y: y * linearMS, z: z * linearMS },
    angular: { x: 0, y: 0, z: turn * angularRadS },
  };
}

export function faster(key: string, speeds: Speeds): Speeds {
  const [linear = 1, angular = 1] = SPEEDS[key] ?? [];
  return { linearMS: speeds.linearMS * linear, angularRadS: speeds.angularRadS * angular };
}

const NAMED: Record<string, number> = {
  Escape: 16777216,
  Tab: 16777217,
  Backspace: 16777219,
  Enter: 16777220,
  Insert: 16777222,
  Delete: 16777223,
  Home: 16777232,
  End: 16777233,
  ArrowLeft: 16777234,
  ArrowUp: 16777235,
  ArrowRight: 16777236,
  ArrowDown: 16777237,
  PageUp: 16777238,
  PageDown: 16777239,
  Shift: 16777248,
  Control: 16777249,
  Meta: 16777250,
  Alt: 16777251,
  CapsLock: 16777252,
  F1: 16777264,
};

/** Qt key code that Gazebo's Key Publisher sends for a key of the browser. */
export function qtCode(key: string): number | undefined {
  if (NAMED[key] !== undefined) return NAMED[key];
  const f = /^F(\d+)$/.exec(key);
  if (f) return NAMED.F1! + Number(f[1]) - 1;
  if ([...key].length !== 1) return undefined;
  return key.toUpperCase().codePointAt(0);
}
