import { beforeEach, describe, expect, test } from 'vitest';
import {
  apply,
  fromLoopSet,
  isReshaped,
  kDefaultSettings,
  kEmptyDocument,
  presetOf,
  spanOptions,
  toLoopSet,
  type Curve,
} from '../../web/src/state/document.ts';
import * as store from '../../web/src/state/store.ts';

const triangle: Curve = [[0, 0, 0], [3, 0, 0], [0, 4, 0]];
const square: Curve = [[0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1]];
const open = (...curves: Curve[]) => {
  store.dispatch({ type: 'open', name: 'Test', curves, settings: kDefaultSettings });
};

describe('apply', () => {
  const document = { ...kEmptyDocument, curves: [triangle, square] };

  test('a moved vertex: only its curve becomes another object', () => {
    const next = apply(document, { type: 'move-vertex', curve: 1, vertex: 2, to: [5, 5, 5] });
    expect(next.curves[0]).toBe(triangle);
    expect(next.curves[1]).toEqual([[0, 0, 1], [2, 0, 1], [5, 5, 5], [0, 2, 1]]);
    expect(square[2]).toEqual([2, 2, 1]);
    expect(isReshaped(document, next)).toBe(true);
  });

  test('commands without effect: the same document', () => {
    expect(apply(document, { type: 'delete-curve', curve: 7 })).toBe(document);
    expect(apply(kEmptyDocument, { type: 'clear' })).toBe(kEmptyDocument);
    const same = { ...kDefaultSettings, weights: { ...kDefaultSettings.weights } };
    expect(apply(document, { type: 'set', settings: same })).toBe(document);
  });

  test('a deleted or added curve: not a reshaped document', () => {
    expect(isReshaped(document, apply(document, { type: 'delete-curve', curve: 0 }))).toBe(false);
    expect(isReshaped(document, apply(document, { type: 'add-curve', points: square }))).toBe(false);
  });
});

test('toLoopSet, fromLoopSet: there and back', () => {
  const set = toLoopSet([triangle, square]);
  expect([...set.starts]).toEqual([0, 3, 7]);
  expect(fromLoopSet(set)).toEqual([triangle, square]);
});

test('spanOptions: relative weights do not depend on the unit of length', () => {
  const settings = { ...kDefaultSettings, weights: { area: 2, perimeter: 3, dihedral: 1 } };
  const optionsOf = (s: number) =>
    spanOptions({ name: '', settings, curves: [triangle.map(([x, y, z]) => [s * x, s * y, s * z] as const)] });
  // The bounding box's diagonal is 5.
  expect(optionsOf(1).weights).toEqual({ area: 2 / 25, perimeter: 3 / 5, dihedral: 1 });
  expect(optionsOf(10).weights).toEqual({ area: 2 / 2500, perimeter: 3 / 50, dihedral: 1 });
});

test('presetOf: knows its presets, and that others are none', () => {
  expect(presetOf(kDefaultSettings.weights)?.id).toBe('smooth');
  expect(presetOf({ area: 0.5, perimeter: 0, dihedral: 1 })).toBeUndefined();
});

describe('history', () => {
  beforeEach(() => {
    open(triangle, square);
    store.forgetHistory();
  });
  const drag = (x: number, gesture: string | null = 'drag') => {
    store.dispatch({ type: 'move-vertex', curve: 0, vertex: 0, to: [x, 0, 0] }, gesture);
  };
  const x = () => store.doc.value.curves[0][0][0];

  test('a gesture: one step, and the next gesture another', () => {
    [1, 2, 3].forEach((to) => { drag(to, 'first'); });
    store.endGesture();
    [4, 5].forEach((to) => { drag(to, 'first'); });
    expect(x()).toBe(5);
    store.undo();
    expect(x()).toBe(3);
    store.undo();
    expect([x(), store.canUndo.value]).toEqual([0, false]);
    store.redo();
    store.redo();
    expect([x(), store.canRedo.value]).toEqual([5, false]);
  });

  test('a cancelled gesture: as if it had not been', () => {
    [1, 2, 3].forEach((to) => { drag(to); });
    store.cancelGesture();
    expect([x(), store.canUndo.value, store.canRedo.value]).toEqual([0, false, false]);
    store.cancelGesture();
    expect(x()).toBe(0);
  });

  test('a change after undo: ends the redo', () => {
    drag(1, null);
    store.undo();
    drag(2, null);
    expect(store.canRedo.value).toBe(false);
  });

  test('many steps: the oldest are forgotten, none of the latest 200', () => {
    for (let i = 1; i <= 250; i++) drag(i, null);
    for (let i = 0; i < 200; i++) store.undo();
    expect([x(), store.canUndo.value]).toEqual([50, false]);
  });

  test('a selection whose vertex is gone: dropped', () => {
    store.selection.value = { curve: 1, vertex: 3 };
    store.dispatch({ type: 'delete-curve', curve: 0 });
    expect(store.selection.value).toBeNull();
    store.undo();
    store.selection.value = { curve: 1, vertex: 3 };
    store.dispatch({ type: 'move-vertex', curve: 1, vertex: 3, to: [9, 9, 9] });
    expect(store.selection.value).toEqual({ curve: 1, vertex: 3 });
  });
});
