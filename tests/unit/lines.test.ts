// Closed lines in flat arrays.
import { describe, expect, test } from 'vitest';
import * as lines from '../../web/src/shapes/lines.ts';
import { kNoBox } from '../../web/src/shapes/vec.ts';

const triangle = [[0, 0, 0], [3, 0, 0], [0, 4, 0]];
const square = [[0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1]];
const both = lines.linesOf(3, [triangle, square]);
const flat = lines.linesOf(2, [triangle]);

test('linesOf: the points of all lines, one after the other; of plane ones x and y', () => {
  expect([...both.starts]).toEqual([0, 3, 7]);
  expect([...both.positions]).toEqual([...triangle, ...square].flat());
  expect([...flat.positions]).toEqual([0, 0, 3, 0, 0, 4]);
  expect(lines.pointAt(flat, 2)).toEqual([0, 4, 0]);
  expect([lines.lineCount(both), lines.pointCount(both)]).toEqual([2, 7]);
});

test('nextPoint, lineOf: each line is closed in itself', () => {
  expect([0, 1, 2].map((i) => lines.nextPoint(both, 0, i))).toEqual([1, 2, 0]);
  expect(lines.nextPoint(both, 1, 6)).toBe(3);
  expect([0, 2, 3, 6].map((i) => lines.lineOf(both, i))).toEqual([0, 0, 1, 1]);
});

test('moved: only the points asked for, and not those of the lines it began with', () => {
  const next = lines.moved(both, [1, 6], [1, 2, 3]);
  expect([lines.pointAt(next, 1), lines.pointAt(next, 6), lines.pointAt(next, 0)]).toEqual([[4, 2, 3], [1, 4, 4], [0, 0, 0]]);
  expect(lines.pointAt(both, 1)).toEqual([3, 0, 0]);
  expect([...lines.moved(flat, [0], [1, 2, 3]).positions]).toEqual([1, 2, 3, 0, 0, 4]);
});

test('without: a line that would keep fewer than three points goes as a whole; with the first all go', () => {
  const none = new Set<number>();
  const fewer = lines.without(both, new Set([0, 4]), none);
  expect(fewer).toBeNull();
  const shorter = lines.without(both, new Set([4]), none);
  expect(shorter && [...shorter.starts]).toEqual([0, 3, 6]);
  expect(shorter && lines.pointAt(shorter, 4)).toEqual([2, 2, 1]);
  expect(lines.without(both, new Set([3, 4]), none)?.starts).toEqual(new Uint32Array([0, 3]));
  expect(lines.without(both, none, new Set([1]))?.starts).toEqual(new Uint32Array([0, 3]));
  expect(lines.without(both, none, new Set([0]))).toBeNull();
});

test('boxOfLines: the least box; of nothing none', () => {
  expect(lines.boxOfLines(both)).toEqual({ low: [0, 0, 0], high: [3, 4, 1] });
  expect(lines.boxOfLines(flat)).toEqual({ low: [0, 0, 0], high: [3, 4, 0] });
  expect(lines.boxOfLines(lines.linesOf(3, []))).toEqual(kNoBox);
});

describe('readLines', () => {
  test('what was saved: the same again', () => {
    expect(lines.readLines(3, structuredClone(both))).toEqual(both);
    expect(lines.readLines(2, structuredClone(flat))).toEqual(flat);
  });
  test.each<[string, unknown]>([
    ['nothing', undefined],
    ['text', 'lines'],
    ['plain arrays', { positions: [...both.positions], starts: [...both.starts] }],
    ['no lines', { positions: new Float64Array(), starts: new Uint32Array([0]) }],
    ['a first line that does not begin with the first point', { ...both, starts: new Uint32Array([1, 3, 7]) }],
    ['a line of no points', { ...both, starts: new Uint32Array([0, 0, 7]) }],
    ['fewer coordinates than points', { ...both, positions: both.positions.slice(1) }],
    ['the other dimension', flat],
    ['a coordinate that is no number', { ...both, positions: both.positions.map((x) => (x === 4 ? NaN : x)) }],
  ])('%s: not lines', (_, saved) => {
    expect(lines.readLines(3, saved)).toBeNull();
  });
});
