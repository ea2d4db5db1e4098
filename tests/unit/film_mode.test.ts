// The mode of films: its group as the library's input, and errors in its words.
import { SoapfilmError } from 'soapfilm';
import { describe, expect, test } from 'vitest';
import { kCurve } from '../../web/src/modes/film/curve.ts';
import {
  curveOf,
  curvesOf,
  fromLoopSet,
  isReshaped,
  kDefaultSettings,
  listOf,
  presetOf,
  spanOptions,
  toLoopSet,
  type FilmGroup,
} from '../../web/src/modes/film/settings.ts';
import { describeFailure } from '../../web/src/modes/film/wording.ts';
import { apply, newItem, registerKind } from '../../web/src/state/document.ts';

registerKind(kCurve);

const triangle = [[0, 0, 0], [3, 0, 0], [0, 4, 0]];
const square = [[0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1]];
const film = (curves: number[][][], settings = kDefaultSettings): FilmGroup => ({
  id: 1,
  mode: 'film',
  name: 'Test',
  settings,
  items: curves.map((points) => newItem(kCurve, curveOf(points))),
});
const two = film([triangle, square]);
const [first, second] = two.items;
const after = (command: Parameters<typeof apply>[1]) => apply(two, command) as FilmGroup;

test('toLoopSet, fromLoopSet: there and back', () => {
  const set = toLoopSet(curvesOf(two));
  expect([...set.starts]).toEqual([0, 3, 7]);
  expect(fromLoopSet(set).map(listOf)).toEqual([triangle, square]);
});

test('spanOptions: relative weights do not depend on the unit of length', () => {
  const settings = { ...kDefaultSettings, weights: { area: 2, perimeter: 3, dihedral: 1 } };
  const optionsOf = (s: number) => spanOptions(film([triangle.map((point) => point.map((x) => s * x))], settings));
  // The bounding box's diagonal is 5.
  expect(optionsOf(1).weights).toEqual({ area: 2 / 25, perimeter: 3 / 5, dihedral: 1 });
  expect(optionsOf(10).weights).toEqual({ area: 2 / 2500, perimeter: 3 / 50, dihedral: 1 });
});

test('presetOf: knows its presets, and that others are none', () => {
  expect(presetOf({ ...kDefaultSettings.weights })?.id).toBe('smooth');
  expect(presetOf({ area: 0.5, perimeter: 0, dihedral: 1 })).toBeUndefined();
});

describe('isReshaped', () => {
  test('a moved vertex or curve: only places differ', () => {
    const vertex = { item: second.id, part: 0, handle: 2 };
    const next = after({ type: 'move', group: 1, places: [vertex], by: [3, 3, 4] });
    expect(curvesOf(next).map(listOf)).toEqual([triangle, [[0, 0, 1], [2, 0, 1], [5, 5, 5], [0, 2, 1]]]);
    expect(next.items[0]).toBe(first);
    expect(isReshaped(two, next)).toBe(true);
    const whole = { item: first.id, part: 0, handle: null };
    expect(isReshaped(two, after({ type: 'move', group: 1, places: [whole], by: [0, 0, 1] }))).toBe(true);
  });

  test('more or fewer vertices, curves, other settings: not only places', () => {
    const vertex = { item: second.id, part: 0, handle: 2 };
    expect(isReshaped(two, after({ type: 'delete', group: 1, places: [vertex] }))).toBe(false);
    expect(isReshaped(two, after({ type: 'delete', group: 1, places: [{ ...vertex, handle: null }] }))).toBe(false);
    expect(isReshaped(two, after({ type: 'add', group: 1, items: [newItem(kCurve, curveOf(square))] }))).toBe(false);
    expect(isReshaped(two, after({ type: 'set', group: 1, settings: { candidates: 'near' } }))).toBe(false);
  });
});

describe('describeFailure: curves and vertices count from 1, places are the document’s', () => {
  const failure = (code: 'loops-intersect' | 'repeated-vertex' | 'too-large', place = {}) =>
    describeFailure(new SoapfilmError(code, 'the library’s words', place), two);

  test('curves that cross: the edges of both', () => {
    const { message, faults, point } = failure('loops-intersect', { loop: 0, vertex: 1, otherLoop: 1, otherVertex: 3 });
    expect(message).toBe('Curves 1 and 2 cross or touch. A surface needs curves that do not.');
    expect(faults).toEqual([
      { place: { item: first.id, part: 0, handle: 1 }, isEdge: true },
      { place: { item: second.id, part: 0, handle: 3 }, isEdge: true },
    ]);
    expect(point).toEqual([3, 0, 0]);
  });

  test('two vertices in one place: both, in words', () => {
    const { message, faults } = failure('repeated-vertex', { loop: 1, vertex: 0, otherLoop: 1, otherVertex: 2 });
    expect(message).toContain('vertex 1 of curve 2 and vertex 3 of curve 2');
    expect(faults.map(({ isEdge }) => isEdge)).toEqual([false, false]);
  });

  test('places that the film does not have, and errors of no kind: words alone', () => {
    expect(failure('loops-intersect', { loop: 5, vertex: 1 }).faults).toEqual([]);
    expect(failure('too-large').message).toContain('too many for the memory');
    expect(describeFailure(new Error('no'), two)).toEqual({ code: 'crashed', message: 'no', faults: [] });
  });
});
