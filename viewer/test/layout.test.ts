import { describe, expect, test } from 'vitest';
import { fromDock, toDock } from '../src/app/dock_grid';
import { insert, readLayout, tidy, writeLayout, type Layout, type Place } from '../src/app/layout';
import { linkOf, sharedIn } from '../src/app/layout_link';
import { LayoutStore, type Store } from '../src/app/layout_store';

const tabs = (...ids: string[]): Place => ({ tabs: ids, active: ids[0] });
const row = (sizes: number[], ...children: Place[]): Place => ({ split: 'row', sizes, children });
const column = (sizes: number[], ...children: Place[]): Place => ({
  split: 'column',
  sizes,
  children,
});
const all = () => true;

const LAYOUT: Layout = {
  panels: {
    a: { kind: '3d', title: '', state: { fixedFrame: 'map' } },
    b: { kind: 'plot', title: 'Speed', state: {} },
    c: { kind: 'of a later version', title: '', state: { kept: [1, 2] } },
  },
  root: row([0.75, 0.25], tabs('a'), column([0.5, 0.5], tabs('b'), tabs('c'))),
  floating: [],
  active: 'b',
  offered: [],
  robot: '/r1',
};

describe('arrangements', () => {
  test('empty tabs vanish, and splits of one direction become one', () => {
    const place = row([1, 1], tabs('a'), row([1, 3], tabs('b'), column([1, 1], tabs('c'), tabs())));
    expect(tidy(place, all)).toEqual(row([0.5, 0.125, 0.375], tabs('a'), tabs('b'), tabs('c')));
    expect(tidy(place, (id) => id === 'c')).toEqual(tabs('c'));
    expect(tidy(place, () => false)).toBeUndefined();
  });

  test('a panel is placed in tabs or in a split', () => {
    expect(insert(tabs('a'), 'b', 'a', 'center')).toEqual({ tabs: ['a', 'b'], active: 'b' });
    expect(insert(tabs('a'), 'b', 'a', 'left')).toEqual(row([0.5, 0.5], tabs('b'), tabs('a')));
    expect(insert(tabs('a'), 'b', 'a', 'bottom')).toEqual(column([0.5, 0.5], tabs('a'), tabs('b')));
  });

  test('dockview gets it in pixels and gives it back', () => {
    const dock = toDock(LAYOUT, { a: 'A', b: 'B', c: 'C' }, 1000, 600);
    expect(dock.grid.orientation).toBe('HORIZONTAL');
    const [first, second] = dock.grid.root.data as { size: number; data: { size: number }[] }[];
    expect([first!.size, second!.size]).toEqual([750, 250]);
    expect(second!.data.map(({ size }) => size)).toEqual([300, 300]);
    expect(fromDock(dock, 'b')).toEqual({ root: LAYOUT.root, floating: [], active: 'b' });
  });

  test('floating windows keep their place', () => {
    const floating = [{ root: tabs('b'), x: 0.25, y: 0.5, width: 0.5, height: 0.25 }];
    const dock = toDock({ root: tabs('a'), floating }, { a: 'A', b: 'B' }, 800, 400);
    expect(dock.floatingGroups![0]!.position).toEqual({
      left: 200,
      top: 200,
      width: 400,
      height: 100,
    });
    expect(fromDock(dock).floating).toEqual(floating);
  });
});

describe('layout files', () => {
  const parse = (layout: unknown) => readLayout(JSON.parse(JSON.stringify(layout)));

  test('are read as they were written, with panels of later versions', () => {
    expect(parse(writeLayout(LAYOUT))).toEqual(LAYOUT);
  });

  test('a panel without a place is put in the first tabs, one with two is in the first', () => {
    const file = writeLayout({ ...LAYOUT, root: row([1, 1], tabs('a'), tabs('a', 'b')) });
    expect(parse(file).root).toEqual(row([0.5, 0.5], { tabs: ['a', 'c'], active: 'a' }, tabs('b')));
  });

  test('errors name the reason', () => {
    expect(() => readLayout({})).toThrow('has no "format"');
    expect(() => parse({ ...writeLayout(LAYOUT), version: 9 })).toThrow('has version 9');
    expect(() => parse({ ...writeLayout(LAYOUT), panels: { a: {} } })).toThrow('has no "kind"');
    let deep: unknown = tabs('a');
    for (let i = 0; i < 30; i++) deep = { split: 'row', children: [deep] };
    expect(() => parse({ ...writeLayout(LAYOUT), root: deep })).toThrow('nested more than 20');
  });
});

describe('named layouts', () => {
  function memory(limit = Infinity): Store {
    const kept = new Map<string, string>();
    return {
      getItem: (key) => kept.get(key) ?? null,
      removeItem: (key) => void kept.delete(key),
      setItem: (key, value) => {
        if (value.length > limit) throw new Error('full');
        kept.set(key, value);
      },
    };
  }

  test('are kept, renamed and deleted', () => {
    const store = new LayoutStore(memory());
    expect(store.set('b', LAYOUT)).toBe(true);
    store.set('a', LAYOUT);
    expect(store.names()).toEqual(['a', 'b']);
    expect(store.rename('a', 'b')).toBe(false);
    expect(store.rename('a', 'c')).toBe(true);
    expect(store.get('c')).toEqual(LAYOUT);
    store.delete('b');
    expect(store.names()).toEqual(['c']);
  });

  test('a full or missing storage is reported', () => {
    expect(new LayoutStore(memory(10)).set('a', LAYOUT)).toBe(false);
    expect(new LayoutStore(undefined).set('a', LAYOUT)).toBe(false);
    expect(new LayoutStore(undefined).last()).toBeUndefined();
  });
});

describe('links', () => {
  test('hold the layout and the time, and never a token', async () => {
    const link = await linkOf('http://robot:8765/?token=secret&ws=ws://b/#old', {
      layout: LAYOUT,
      timeS: 12.5,
    });
    expect(link).toMatch(/^http:\/\/robot:8765\/\?ws=ws%3A%2F%2Fb%2F#view=[\w-]+&t=12\.5$/);
    expect(await sharedIn(new URL(link).hash)).toEqual({ layout: LAYOUT, timeS: 12.5 });
  });

  test('other hashes hold no layout; broken ones are refused', async () => {
    expect(await sharedIn('#building')).toBeUndefined();
    expect(await sharedIn('')).toBeUndefined();
    await expect(sharedIn('#view=AAAA')).rejects.toThrow();
  });

  test('a link that unpacks to too much is refused', async () => {
    const state = { text: 'x'.repeat(2_000_000) };
    const layout: Layout = { ...LAYOUT, panels: { a: { kind: '3d', state } }, root: tabs('a') };
    const packed = new Blob([JSON.stringify(writeLayout(layout))])
      .stream()
      .pipeThrough(new CompressionStream('deflate-raw'));
    const bytes = Buffer.from(await new Response(packed).arrayBuffer()).toString('base64url');
    await expect(sharedIn(`#view=${bytes}`)).rejects.toThrow('larger than 1 MB');
  });
});
