/** Reader of unified diffs, for their display. */

export interface DiffLine {
  kind: 'added' | 'removed' | 'same' | 'gap';
  text: string;
  /** Numbers of the line in the old and in the new text, from 1. */
  before?: number;
  after?: number;
}

const HUNK = /^@@ -(\d+)(?:,\d+)? \+(\d+)(?:,\d+)? @@/;

export function diffLines(diff: string): DiffLine[] {
  const out: DiffLine[] = [];
  let before = 0;
  let after = 0;
  for (const line of diff.split('\n')) {
    const hunk = HUNK.exec(line);
    if (hunk) {
      before = Number(hunk[1]);
      after = Number(hunk[2]);
      if (out.length > 0) out.push({ kind: 'gap', text: '' });
      continue;
    }
    // The names of the files are before the first hunk.
    if (after === 0 && before === 0) continue;
    const text = line.slice(1);
    if (line.startsWith('+')) out.push({ kind: 'added', text, after: after++ });
    else if (line.startsWith('-')) out.push({ kind: 'removed', text, before: before++ });
    else if (line.startsWith(' ')) {
      out.push({ kind: 'same', text, before: before++, after: after++ });
    }
  }
  return out;
}
