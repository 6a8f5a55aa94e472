/** Names of parameters in the protocol: node, dot, name. */

export interface Range {
  from: number;
  to: number;
  step: number;
}

/** Splits "/demo/amcl.laser.max" into "/demo/amcl" and "laser.max": no node name has a dot. */
export function splitName(full: string): { node: string; name: string } {
  const dot = full.indexOf('.');
  return dot < 0
    ? { node: '', name: full }
    : { node: full.slice(0, dot), name: full.slice(dot + 1) };
}
