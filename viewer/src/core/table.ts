/** Rows of a table from messages: the elements of an array, or chosen fields of each message. */

export type Cell = number | string | boolean | undefined;

const MAX_COLUMNS = 40;

/** Value of a cell: objects are written as JSON. */
export function cellOf(value: unknown): Cell {
  switch (typeof value) {
    case 'number':
    case 'string':
    case 'boolean':
      return value;
    case 'bigint':
      return Number(value);
    case 'undefined':
      return undefined;
    default:
      if (value === null) return undefined;
      if (ArrayBuffer.isView(value)) return `[${(value as Uint8Array).length}]`;
      return Array.isArray(value) ? `[${value.length}]` : JSON.stringify(value).slice(0, 200);
  }
}

/** Columns of the elements of an array: the fields of objects, also nested ones; "value" for plain elements. */
export function columnsOf(list: ArrayLike<unknown>): string[] {
  const first = list[0];
  if (typeof first !== 'object' || first === null) return ['value'];
  const out: string[] = [];
  const visit = (value: object, prefix: string) => {
    for (const [key, inner] of Object.entries(value)) {
      const path = prefix ? `${prefix}.${key}` : key;
      const isObject = typeof inner === 'object' && inner !== null;
      if (isObject && !Array.isArray(inner) && !ArrayBuffer.isView(inner)) visit(inner, path);
      else if (out.length < MAX_COLUMNS) out.push(path);
    }
  };
  visit(first, '');
  return out;
}

/** Paths of the arrays of a message. */
export function arraysOf(value: unknown, prefix = '', depth = 0): string[] {
  if (Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView))) {
    return [prefix];
  }
  if (typeof value !== 'object' || value === null || depth > 6) return [];
  return Object.entries(value).flatMap(([key, inner]) =>
    arraysOf(inner, prefix ? `${prefix}.${key}` : key, depth + 1),
  );
}

/** Rows sorted by a column; numbers by size, before texts. Rows without a value are last. */
export function sorted<R extends { cells: Cell[] }>(
  rows: readonly R[],
  column: number,
  isDown: boolean,
): R[] {
  const sign = isDown ? -1 : 1;
  return [...rows].sort((a, b) => {
    const [x, y] = [a.cells[column], b.cells[column]];
    const isEmpty = (one: Cell) => one === undefined || Number.isNaN(one);
    if (isEmpty(x) || isEmpty(y)) return Number(isEmpty(x)) - Number(isEmpty(y));
    if (typeof x === 'number' && typeof y === 'number') return sign * (x - y);
    if (typeof x === 'number') return -sign;
    if (typeof y === 'number') return sign;
    return sign * String(x).localeCompare(String(y), 'en');
  });
}
