/** Names of parameters as the protocol writes them: node, dot, name. */

export interface Range {
  from: number;
  to: number;
  step: number;
}

/** "/demo/amcl.laser.max" is "laser.max" of "/demo/amcl": no node has a dot in its name. */
export function splitName(full: string): { node: string; name: string } {
  const dot = full.indexOf('.');
  return dot < 0
    ? { node: '', name: full }
    : { node: full.slice(0, dot), name: full.slice(dot + 1) };
}
