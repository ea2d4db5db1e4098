// The document: commands make the next one of it, and know nothing of what objects are made of.
import { beforeAll, describe, expect, test } from 'vitest';
import * as state from '../../web/src/state/document.ts';
import { dots, dotsItem, type Dots } from '../support/dots_kind.js';

beforeAll(() => {
  state.registerKind(dots);
});

const shapeOf = (group: state.Group, i: number) => group.items[i].shape as Dots;
const place = (item: state.Item, part: number, handle: number | null = null): state.Place => ({ item: item.id, part, handle });

const [a, b] = [dotsItem([1, 2, 3], [4]), dotsItem([5, 6])];
const group: state.Group = { id: state.newId(), mode: 'test', name: 'Test', settings: { size: 1, weights: { area: 2 } }, items: [a, b] };
const apply = (command: Omit<Extract<state.Command, { type: 'move' }>, 'group'> | object, to = group) =>
  state.apply(to, { ...command, group: to.id } as state.Command);

describe('apply', () => {
  test('move: only the objects of the places become others', () => {
    const next = apply({ type: 'move', places: [place(a, 0, 1), place(a, 1)], by: [10, 0, 0] });
    expect(shapeOf(next, 0)).toEqual([[1, 12, 3], [14]]);
    expect(next.items[1]).toBe(b);
    expect(a.shape).toEqual([[1, 2, 3], [4]]);
    expect(next.items[0].id).toBe(a.id);
  });

  test('delete: handles, parts, and an object of which nothing is left', () => {
    expect(shapeOf(apply({ type: 'delete', places: [place(a, 0, 0), place(a, 1)] }), 0)).toEqual([[2, 3]]);
    expect(apply({ type: 'delete', places: [place(b, 0)] }).items).toEqual([a]);
  });

  test('add, reshape, clear, open', () => {
    const c = dotsItem([7]);
    expect(apply({ type: 'add', items: [c] }).items).toEqual([a, b, c]);
    expect(apply({ type: 'reshape', item: b.id, shape: [[0]] }).items).toEqual([a, { ...b, shape: [[0]] }]);
    expect(apply({ type: 'clear' })).toMatchObject({ name: state.kUntitled, items: [], settings: group.settings });
    expect(apply({ type: 'open', name: 'Other', items: [c] })).toEqual({ ...group, name: 'Other', items: [c] });
    expect(apply({ type: 'open', name: 'Other', items: [c], settings: { size: 2 } }).settings).toEqual({ size: 2 });
  });

  test('set: only the settings named', () => {
    expect(apply({ type: 'set', settings: { size: 3 } }).settings).toEqual({ size: 3, weights: { area: 2 } });
  });

  test.each<[string, object]>([
    ['nothing added', { type: 'add', items: [] }],
    ['a move by nothing', { type: 'move', places: [place(a, 0)], by: [0, 0, 0] }],
    ['a move of an object that is gone', { type: 'move', places: [{ item: -1, part: 0, handle: null }], by: [1, 0, 0] }],
    ['nothing deleted', { type: 'delete', places: [] }],
    ['a shape for an object that is gone', { type: 'reshape', item: -1, shape: [[1]] }],
    ['equal settings', { type: 'set', settings: { size: 1, weights: { area: 2 } } }],
  ])('%s: the same group', (_, command) => {
    expect(apply(command)).toBe(group);
  });

  test('an empty group: cleared, it stays the same', () => {
    const empty = { ...group, items: [] };
    expect(apply({ type: 'clear' }, empty)).toBe(empty);
  });
});

test('isNumberedAlike: whether the same numbers stand for the same parts and handles', () => {
  const alike = (command: Parameters<typeof apply>[0]) => state.isNumberedAlike(a.id, group, apply(command));
  expect(alike({ type: 'move', places: [place(a, 0, 1)], by: [1, 0, 0] })).toBe(true);
  expect(alike({ type: 'set', settings: { size: 2 } })).toBe(true);
  expect(alike({ type: 'delete', places: [place(a, 0, 1)] })).toBe(false);
  expect(alike({ type: 'clear' })).toBe(false);
  expect(state.isNumberedAlike(-1, group, group)).toBe(false);
});

test('handlesAt: one, or all of a part', () => {
  expect(state.handlesAt(dots as state.Kind<unknown>, a.shape, place(a, 1, 3))).toEqual([3]);
  expect(state.handlesAt(dots as state.Kind<unknown>, a.shape, place(a, 0))).toEqual([0, 1, 2]);
});

test('isSame: plain data by what is in it', () => {
  expect(state.isSame({ a: [1, { b: null }] }, { a: [1, { b: null }] })).toBe(true);
  expect(state.isSame(NaN, NaN)).toBe(true);
  for (const other of [{ a: 2 }, { b: 1 }, { a: 1, b: 1 }, null, 1, {}]) expect(state.isSame({ a: 1 }, other)).toBe(false);
});

test('boxOfGroup: around all objects', () => {
  expect(state.boxOfGroup(group)).toEqual({ low: [1, 0, 0], high: [6, 0, 0] });
});

test('kindOf: a kind that nobody made known is an error in words', () => {
  expect(() => state.kindOf({ ...a, kind: 'ghost' })).toThrow('no kind of object “ghost”');
});

test('reserveIds: new ids are none of those', () => {
  state.reserveIds({ groups: [{ ...group, id: 5000, items: [{ ...a, id: 7000 }] }] });
  expect(state.newId()).toBe(7001);
});
