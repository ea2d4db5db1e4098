import { load, SoapfilmError, spanLoops, type LoopsLike, type Point, type SpanOptions } from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { countingClock } from '../support/clock.js';
import { errorOf } from '../support/errors.js';
import { circle, loopSet, Random, regularSaddles, type Loop } from '../support/generators.js';
import { expectSpans } from '../support/surface.js';

beforeAll(() => load());

/** Fails with this code and place, and leaves the library in working order. */
function expectError(
  loops: unknown,
  options: unknown,
  code: string,
  place: Partial<SoapfilmError> = {},
): void {
  const error = errorOf(() => spanLoops(loops as LoopsLike, options as SpanOptions));
  expect(error).toBeInstanceOf(SoapfilmError);
  const { loop, vertex, otherLoop, otherVertex } = error;
  expect({ code: error.code, loop, vertex, otherLoop, otherVertex }).toEqual({
    code,
    loop: undefined,
    vertex: undefined,
    otherLoop: undefined,
    otherVertex: undefined,
    ...place,
  });
  expect(error.message).toMatch(/^[A-Z`]/);
  const good = loopSet([circle(7)]);
  expectSpans(spanLoops(good), good);
}

/** Two rings with one vertex of the second replaced. */
function ringsWith(vertex: number, point: Point): Loop[] {
  const second = circle(5, { centre: [0, 0, 1] });
  second[vertex] = point;
  return [circle(6), second];
}

const rings = ringsWith(0, [1, 0, 1]);
const pair = loopSet(rings);

describe('spanLoops, loops at fault', () => {
  test('none: no-loops', () => {
    expectError([], {}, 'no-loops');
    expectError({ positions: new Float64Array(), starts: Uint32Array.of(0) }, {}, 'no-loops');
  });

  test.each([[undefined], [null], [5], ['loops'], [{}], [{ positions: [0, 0, 0], starts: [0, 1] }]])(
    '%o: bad-loops',
    (loops) => {
      expectError(loops, {}, 'bad-loops');
    },
  );

  test('a point that is none: bad-loops with its place', () => {
    expectError([circle(3), 7], {}, 'bad-loops', { loop: 1 });
    expectError([circle(3), [[0, 0]]], {}, 'bad-loops', { loop: 1, vertex: 0 });
    expectError([[...circle(3), [0, 'x', 1]]], {}, 'bad-loops', { loop: 0, vertex: 3 });
  });

  test('starts that do not fit: bad-starts', () => {
    const { positions } = pair;
    const withStarts = (...starts: number[]) => ({ positions, starts: Uint32Array.from(starts) });
    expectError(withStarts(), {}, 'bad-starts');
    expectError(withStarts(1, 6, 11), {}, 'bad-starts');
    expectError(withStarts(0, 6, 10), {}, 'bad-starts');
    expectError(withStarts(0, 6, 5, 11), {}, 'bad-starts', { loop: 1 });
  });

  test.each([NaN, Infinity, -Infinity])('%d as a coordinate: not-finite with its place', (x) => {
    expectError(ringsWith(3, [0, x, 1]), {}, 'not-finite', { loop: 1, vertex: 3 });
  });

  test('two vertices: too-few-vertices with the loop', () => {
    expectError([circle(5), circle(2)], {}, 'too-few-vertices', { loop: 1 });
    expectError([[], circle(5)], {}, 'too-few-vertices', { loop: 0 });
  });

  test('one position twice: repeated-vertex with both places', () => {
    const places = { loop: 0, vertex: 2, otherLoop: 0, otherVertex: 4 };
    const once = circle(6);
    once[4] = once[2];
    expectEitherWay([once], 'repeated-vertex', places);
    const next = circle(6);
    next[3] = next[2];
    expectEitherWay([next], 'repeated-vertex', { ...places, otherVertex: 3 });
    expectEitherWay(ringsWith(1, circle(6)[2]), 'repeated-vertex', {
      ...places,
      otherLoop: 1,
      otherVertex: 1,
    });
  });

  test('loops that cross or touch: loops-intersect with both edges', () => {
    const square: Loop = [
      [0, 0, 0],
      [2, 0, 0],
      [2, 2, 0],
      [0, 2, 0],
    ];
    const piercing: Loop = [
      [1, 0, -1],
      [1, 0, 1],
      [1, -3, 0],
    ];
    const places = { loop: 0, vertex: 0, otherLoop: 1, otherVertex: 0 };
    expectEitherWay([square, piercing], 'loops-intersect', places);
    const touching: Loop = [
      [1, -1, 0],
      [1.5, 0, 0],
      [2, -1, 1],
    ];
    const error = errorOf(() => spanLoops([square, touching]));
    expect(error.code).toBe('loops-intersect');
    const bow: Loop = [
      [0, 0, 0],
      [2, 2, 0],
      [2, 0, 0],
      [0, 2, 0],
    ];
    expectEitherWay([bow], 'loops-intersect', {
      loop: 0,
      vertex: 0,
      otherLoop: 0,
      otherVertex: 2,
    });
    const spike: Loop = [
      [0, 0, 0],
      [3, 0, 0],
      [1, 0, 0],
      [0, 2, 0],
    ];
    expect(errorOf(() => spanLoops([spike])).code).toBe('loops-intersect');
  });
});

/** Like expectError, for errors about a pair, whose two places may come in either order. */
function expectEitherWay(
  loops: Loop[],
  code: string,
  place: { loop: number; vertex: number; otherLoop: number; otherVertex: number },
): void {
  const error = errorOf(() => spanLoops(loops));
  expect(error.code).toBe(code);
  const found = [
    [error.loop, error.vertex],
    [error.otherLoop, error.otherVertex],
  ];
  const wanted = [
    [place.loop, place.vertex],
    [place.otherLoop, place.otherVertex],
  ];
  expect([wanted, [wanted[1], wanted[0]]]).toContainEqual(found);
  for (const index of found.flat()) expect(error.message).toContain(String(index));
}

describe('spanLoops, options at fault', () => {
  const n = pair.positions.length / 3;

  test.each([{}, { area: -1 }, { dihedral: NaN }, { perimeter: Infinity }, { area: 0, dihedral: 0 }])(
    'weights %o: bad-weights',
    (weights) => {
      expectError(rings, { weights }, 'bad-weights');
    },
  );

  test('boundary normals: bad-normals, with the place of one that is none', () => {
    const normals = new Float64Array(3 * n).fill(NaN);
    expectError(rings, { boundaryNormals: normals.subarray(3) }, 'bad-normals');
    expectError(rings, { boundaryNormals: Array.from(normals) }, 'bad-normals');
    const broken = (...values: number[]): Float64Array => {
      const copy = normals.slice();
      copy.set(values, 3 * 8);
      return copy;
    };
    const place = { loop: 1, vertex: 2 };
    expectError(rings, { boundaryNormals: broken(0, 0, 0) }, 'bad-normals', place);
    expectError(rings, { boundaryNormals: broken(1, NaN, 0) }, 'bad-normals', place);
    expectError(rings, { boundaryNormals: broken(1, 0, Infinity) }, 'bad-normals', place);
  });

  test.each([[null], [5], ['sum']])('options %o: bad-option', (options) => {
    expectError(rings, options, 'bad-option');
  });

  test('own candidates: bad-candidates with the index of the triangle', () => {
    const given = (...triangles: number[]) => ({
      candidates: { triangles: Uint32Array.from(triangles) },
    });
    expectError(rings, given(0, 1, 2, 3, 4), 'bad-candidates');
    expectError(rings, given(0, 1, 2, 0, 1, n), 'bad-candidates', { vertex: 1 });
    expectError(rings, given(0, 1, 2, 3, 4, 3), 'bad-candidates', { vertex: 1 });
    const repeated = errorOf(() => spanLoops(rings, given(0, 1, 2, 3, 4, 5, 2, 0, 1)));
    expect(repeated.code).toBe('bad-candidates');
    expect([0, 2]).toContain(repeated.vertex);
    expectError(rings, { candidates: { triangles: [0, 1, 2] } }, 'bad-candidates');
    const weighed = (...weights: number[]) => ({
      candidates: { triangles: Uint32Array.of(0, 1, 2), weights: Float64Array.from(weights) },
    });
    expectError(rings, weighed(1, 2), 'bad-candidates');
    expectError(rings, weighed(NaN), 'bad-candidates', { vertex: 0 });
    const line: Loop = [
      [0, 0, 0],
      [1, 0, 0],
      [2, 0, 0],
      [1, 1, 0],
    ];
    expectError([line], given(0, 1, 3, 0, 1, 2), 'bad-candidates', { vertex: 1 });
  });

  test.each<[unknown]>([
    [{ candidates: 'some' }],
    [{ candidates: 'given' }],
    [{ objective: 'least' }],
    [{ maxSeconds: -1 }],
    [{ maxSeconds: 'long' }],
    [{ maxMemoryBytes: NaN }],
    [{ onProgress: 5 }],
  ])('%o: bad-option', (options) => {
    expectError(rings, options, 'bad-option');
  });
});

describe('spanLoops, limits', () => {
  const heavy = regularSaddles(3, 9, new Random(31));
  const options: SpanOptions = { candidates: 'all', weights: { dihedral: 1 } };

  test('maxSeconds: time-limit soon after, and the next call works', () => {
    const clock = countingClock();
    try {
      expectError(heavy, { ...options, maxSeconds: 0.1 }, 'time-limit');
    } finally {
      clock.restore();
    }
    expect(clock.now()).toBeGreaterThanOrEqual(100);
    expect(clock.now()).toBeLessThan(150);
    expectError(heavy, { ...options, maxSeconds: 0 }, 'time-limit');
  });

  test('maxMemoryBytes: too-large or out-of-memory, and the next call works', () => {
    const good = loopSet(regularSaddles(2, 6, new Random(32)));
    const seen = new Set<string>();
    let solved = 0;
    for (let bytes = 1; bytes < 1e8; bytes *= 3) {
      try {
        const result = spanLoops(good, { ...options, maxMemoryBytes: bytes });
        expectSpans(result, good, options);
        expect(result.stats.peakBytes).toBeLessThanOrEqual(bytes);
        solved++;
      } catch (error) {
        if (!(error instanceof SoapfilmError)) throw error;
        seen.add(error.code);
        expect(solved, 'a larger limit fails no call that a smaller one let through').toBe(0);
      }
    }
    expect(solved).toBeGreaterThan(0);
    expect([...seen].sort()).toEqual(['out-of-memory', 'too-large']);
  });

  test('a listener that throws: the call ends with that error, and the next call works', () => {
    const thrown = new Error('enough');
    let caught: unknown;
    try {
      spanLoops(heavy, {
        ...options,
        onProgress: () => {
          throw thrown;
        },
      });
    } catch (error) {
      caught = error;
    }
    expect(caught).toBe(thrown);
    const good = loopSet([circle(7)]);
    expectSpans(spanLoops(good), good);
  });
});
