import { readFileSync } from 'node:fs';
import {
  load,
  parseLoops,
  spanLoops,
  type LoopSet,
  type Point,
  type Span,
  type SpanOptions,
} from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import {
  circle,
  loopSet,
  monkeySaddle,
  noisyCircle,
  Random,
  randomLoops,
  regularSaddles,
  type Loop,
} from '../support/generators.js';
import { expectClose, expectSpans } from '../support/surface.js';

beforeAll(() => load());

/** The span of loops, checked. */
function span(loops: readonly Loop[], options: SpanOptions = {}): Span {
  const input = loopSet(loops);
  const result = spanLoops(input, options);
  expectSpans(result, input, options);
  return result;
}

/** Every triple of n vertices. */
function triples(n: number): Uint32Array {
  const list: number[] = [];
  for (let a = 0; a < n; a++) {
    for (let b = 0; b < a; b++) for (let c = 0; c < b; c++) list.push(a, b, c);
  }
  return Uint32Array.from(list);
}

const cases: [string, Loop[]][] = [
  ['one triangle', [circle(3)]],
  ['one loop', [circle(12)]],
  ['a monkey saddle', [monkeySaddle(30)]],
  ['a noisy loop', [noisyCircle(40, 0.1, new Random(1))]],
  ['two facing loops', [circle(12), circle(9, { centre: [0, 0, 1] })]],
  ['an outer loop and an island', [circle(24, { r: 4 }), circle(6)]],
  ['two saddles', regularSaddles(2, 10, new Random(2))],
  ['three saddles', regularSaddles(3, 8, new Random(3))],
  ['six saddles', regularSaddles(6, 6, new Random(4))],
  ['random loops', randomLoops([4, 5], 1, new Random(5))],
];

describe('spanLoops', () => {
  test.each(cases)('%s: manifold, bounded by its loops, n + 2k - 4 triangles', (_, loops) => {
    expect(span(loops).optimal).toBe(true);
  });

  test.each<SpanOptions>([
    { weights: { area: 1 } },
    { weights: { perimeter: 1 } },
    { weights: { dihedral: 1 } },
    { weights: { area: 1, perimeter: 0.5, dihedral: 0.2 } },
    { weights: { dihedral: 1 }, objective: 'worst-dihedral' },
    { weights: { area: 1 }, objective: 'worst-dihedral' },
  ])('%o: costs what its terms say, in every space', (options) => {
    const random = new Random(6);
    for (const candidates of ['auto', 'all', 'delaunay', 'near'] as const) {
      const result = span(regularSaddles(2, 7, random), { ...options, candidates });
      expect(result.optimal).toBe(true);
      if (candidates !== 'auto') expect(result.candidates).toBe(candidates);
    }
  });

  test('wider spaces: never cost more', () => {
    const loops = regularSaddles(2, 9, new Random(7));
    const weights = { area: 1, dihedral: 0.1 };
    const [delaunay, near, all] = (['delaunay', 'near', 'all'] as const).map(
      (candidates) => span(loops, { weights, candidates }).cost,
    );
    expect(near).toBeLessThanOrEqual(delaunay * (1 + 1e-9));
    expect(all).toBeLessThanOrEqual(near * (1 + 1e-9));
  });

  test('nested arrays: the same span as flat arrays', () => {
    const loops = regularSaddles(2, 8, new Random(8));
    const nested = spanLoops(loops) as Span;
    const flat = spanLoops(loopSet(loops)) as Span;
    expect(nested.cost).toBe(flat.cost);
    expect(nested.triangles).toEqual(flat.triangles);
    expect(nested.positions).toEqual(flat.positions);
  });

  test('input arrays: left as they were', () => {
    const input = loopSet(regularSaddles(2, 8, new Random(9)));
    const copy: LoopSet = { positions: input.positions.slice(), starts: input.starts.slice() };
    spanLoops(input);
    expect(input).toEqual(copy);
  });

  test('the same call again: the same answer', () => {
    const loops = regularSaddles(3, 6, new Random(10));
    const first = span(loops);
    span([circle(5)]);
    const second = span(loops);
    expect({ ...second, stats: first.stats }).toEqual(first);
  });

  test('default weights: flat loops are filled flat, once', () => {
    const weights = span([circle(24, { r: 4 }), circle(12)], { candidates: 'delaunay' });
    const ring = 12 * 16 * Math.sin(Math.PI / 12) - 6 * Math.sin(Math.PI / 6);
    expectClose(weights.terms.area, ring, 'area');
    expectClose(weights.terms.dihedral, 0, 'dihedral');
  });

  test('default weights: dihedral 1, area a thousandth of the squared diagonal', () => {
    const loops = [monkeySaddle(20)];
    const { cost, terms } = span(loops);
    const corners = [0, 1, 2].map((axis) => {
      const values = loops[0].map((p) => p[axis]);
      return Math.max(...values) - Math.min(...values);
    });
    expectClose(cost, terms.dihedral + (1e-3 / Math.hypot(...corners) ** 2) * terms.area, 'cost');
  });

  test('own candidates: all triples give the optimum of the space of all', () => {
    const loops = randomLoops([4, 5], 1, new Random(11));
    const weights = { dihedral: 1, area: 1 };
    const all = span(loops, { weights, candidates: 'all' });
    const own = span(loops, { weights, candidates: { triangles: triples(9) } });
    expect(own.candidates).toBe('given');
    expectClose(own.cost, all.cost, 'cost');
  });

  test('own candidates: their own weights are added and steer the choice', () => {
    const square: Point[] = [
      [0, 0, 0],
      [1, 0, 0],
      [1, 1, 0],
      [0, 1, 0],
    ];
    const triangles = Uint32Array.of(0, 1, 2, 0, 2, 3, 0, 1, 3, 1, 2, 3);
    const solve = (...values: number[]): Span =>
      span([square], {
        weights: { area: 1 },
        candidates: { triangles, weights: Float64Array.from(values) },
      });
    const first = solve(1, 1, 3, 3);
    expectClose(first.cost, 3, 'cost');
    expect([...first.triangles].filter((v) => v === 0).length).toBe(2);
    const second = solve(3, 3, 1, 1.5);
    expectClose(second.cost, 3.5, 'cost');
    expect([...second.triangles].filter((v) => v === 0).length).toBe(1);
  });

  test('own candidates that hold no surface: found is false, with a reason', () => {
    const result = spanLoops([circle(5)], { candidates: { triangles: Uint32Array.of(0, 1, 2) } });
    expect(result).toMatchObject({ found: false, candidates: 'given' });
    expect((result as { reason: string }).reason).toMatch(/candidates/);
    expect(result.stats.candidates).toBe(1);
  });

  test('boundary normals: the face across an edge decides which diagonal is cheaper', () => {
    // A square with one corner lifted: at edge 0-1 the boundary triangle is level with diagonal
    // 1-3 and tilted with diagonal 0-2.
    const loop: Point[] = [
      [0, 0, 0],
      [2, 0, 0],
      [2, 2, 1],
      [0, 2, 0],
    ];
    const options = (normal: Point): SpanOptions => ({
      weights: { dihedral: 1 },
      candidates: 'all',
      boundaryNormals: Float64Array.from([...normal, ...new Array<number>(9).fill(NaN)]),
    });
    const has = ({ triangles }: Span, a: number, b: number): boolean =>
      [0, 3].every((t) => [a, b].every((v) => triangles.subarray(t, t + 3).includes(v)));
    const level = span([loop], options([0, 0, 1]));
    expect(has(level, 1, 3)).toBe(true);
    const tilted = span([loop], options([0, -1, 2]));
    expect(has(tilted, 0, 2)).toBe(true);
    expect(tilted.terms.dihedral).toBeLessThan(span([loop], options([0, 1, -2])).terms.dihedral);
    const none = span([loop], options([NaN, NaN, NaN]));
    expect(none.cost).toBe(span([loop], { weights: { dihedral: 1 }, candidates: 'all' }).cost);
  });

  test('worst-dihedral: the largest angle is not above that of the least sum', () => {
    const loops = regularSaddles(2, 9, new Random(12));
    const sum = span(loops, { weights: { dihedral: 1 }, candidates: 'all' });
    const worst = span(loops, {
      weights: { dihedral: 1 },
      objective: 'worst-dihedral',
      candidates: 'all',
    });
    expect(worst.cost).toBe(worst.terms.worstDihedral);
    expect(worst.cost).toBeLessThanOrEqual(sum.terms.worstDihedral);
    expect(worst.terms.dihedral).toBeGreaterThanOrEqual(sum.terms.dihedral * (1 - 1e-12));
  });

  test('edge protection: inserted vertices lie on their edges and bound the surface', () => {
    const file = new URL('../fixtures/curves/bunny1_008.curve', import.meta.url);
    const input = parseLoops(readFileSync(file, 'utf8'));
    const options: SpanOptions = { candidates: 'delaunay', weights: { dihedral: 1 } };
    const result = spanLoops(input, options);
    expectSpans(result, input, options);
    expect(result.inserted.length).toBeGreaterThan(0);
    const { positions, starts } = input;
    expect(result.loopVertices.filter((v) => v < positions.length / 3).length).toBe(starts[1]);
  });

  test('progress: rises from 0 to 1 at most, its bound never over the optimum', () => {
    const seen: [number, number, number][] = [];
    const result = span(regularSaddles(2, 20, new Random(13)), {
      weights: { dihedral: 1 },
      candidates: 'all',
      onProgress: (...report) => seen.push(report),
    });
    expect(seen.length).toBeGreaterThan(2);
    seen.forEach(([fraction, best, bound], i) => {
      expect(fraction).toBeGreaterThanOrEqual(i > 0 ? seen[i - 1][0] : 0);
      expect(fraction).toBeLessThanOrEqual(1);
      expect(best).toBeGreaterThanOrEqual(result.cost * (1 - 1e-9));
      expect(bound).toBeLessThanOrEqual(result.cost * (1 + 1e-9));
    });
    expect(seen[seen.length - 1]).toEqual([1, result.cost, result.lowerBound]);
  });

  test('stats: count what was done', () => {
    const { stats } = span([circle(10)], { candidates: 'all', weights: { area: 1 } });
    expect(stats.candidates).toBe(120);
    expect(stats.seconds).toBeGreaterThan(0);
    expect(stats.peakBytes).toBeGreaterThan(0);
  });
});
