import {
  load,
  PolygonSession,
  SoapfilmError,
  spanLoops,
  triangulatePolygon,
  type PolygonEdit,
} from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { errorOf } from '../support/errors.js';
import { Random } from '../support/generators.js';
import { blobRing, flatPolygon, type Point2, type Polygon2 } from '../support/polygons.js';
import {
  boundaryOf,
  sortedTriangles,
  trianglesArea,
  trianglesOfStrips,
} from '../support/triangulation.js';

beforeAll(() => load());

const square = (x: number, y: number, size: number): Point2[] => [
  [x, y],
  [x + size, y],
  [x + size, y + size],
  [x, y + size],
];
const kPolygon: Polygon2 = [square(0, 0, 10), square(2, 2, 2)];

/** What a session has to be at any time: its triangles fill just its rings. */
function expectSound(session: PolygonSession): void {
  const { positions, next, strips, stripStarts, certified } = session.read();
  const { triangles } = session;
  expect(certified).toBe(true);
  const isIsolated = (v: number): boolean => next[v] === 0xffffffff;
  const ringVertices = Array.from(next.keys()).filter((v) => next[v] !== v && !isIsolated(v));
  const rings = new Set(ringVertices.map((v) => `${v} ${next[v]}`));
  expect(boundaryOf(triangles)).toEqual(rings);
  const area = ringVertices.reduce((sum, v) => {
    const w = next[v];
    return sum + (positions[2 * v] * positions[2 * w + 1] - positions[2 * v + 1] * positions[2 * w]) / 2;
  }, 0);
  expect(trianglesArea(positions, triangles)).toBeCloseTo(area, 9);
  for (const v of next.keys()) expect(triangles.includes(v)).toBe(next[v] !== v);
  const drawn = trianglesOfStrips(strips, stripStarts).flat();
  expect(sortedTriangles(drawn)).toEqual(sortedTriangles(triangles));
}

/** Applies an edit to a copy of the triangles, as a reader would. */
function patched(triangles: Uint32Array, edit: PolygonEdit): Uint32Array {
  const all = new Uint32Array(3 * edit.triangleCount);
  all.set(triangles.subarray(0, all.length));
  edit.changed.forEach((t, i) => {
    all.set(edit.triangles.subarray(3 * i, 3 * i + 3), 3 * t);
  });
  return all;
}

describe('PolygonSession', () => {
  test('edits one by one: what they change, and what is left', () => {
    const session = new PolygonSession(kPolygon);
    expect(session.triangles.length / 3).toBe(8);
    expectSound(session);
    const inserted = session.insert(1, [12, 5]);
    expect(inserted).toMatchObject({ vertex: 8, triangleCount: 9 });
    const isolated = session.insertPoint([7, 7]);
    expect(isolated).toMatchObject({ vertex: 9, triangleCount: 11 });
    expectSound(session);
    expect(session.move(4, [1, 1]).triangleCount).toBe(11);
    expect(session.move(9, [8, 2]).vertex).toBe(9);
    expectSound(session);
    expect(session.delete(8).triangleCount).toBe(10);
    expect(session.delete(9).triangleCount).toBe(8);
    const { positions, next } = session.read();
    expect(Array.from(positions.subarray(8, 10))).toEqual([1, 1]);
    expect(Array.from(next.subarray(0, 4))).toEqual([1, 2, 3, 0]);
    expectSound(session);
    session.dispose();
  });

  test('random edits: sound after each, and a reader that applies the changes keeps up', () => {
    const seed = 31;
    const random = new Random(seed);
    const ring = blobRing(40, random);
    const points = Float64Array.of(0.1, 0.05, -0.2, 0.1);
    const session = new PolygonSession({ ...flatPolygon([ring]), points });
    let { triangles } = session;
    let refused = 0;
    for (let i = 0; i < 400; i++) {
      const { positions, next } = session.read();
      const v = random.below(next.length);
      const at: [number, number] = [
        positions[2 * v] + random.range(-0.2, 0.2),
        positions[2 * v + 1] + random.range(-0.2, 0.2),
      ];
      try {
        const edit = [
          () => session.move(v, at),
          () => session.insert(v, at),
          () => session.delete(v),
          () => session.insertPoint(at),
        ][random.below(4)]();
        triangles = patched(triangles, edit);
      } catch (error) {
        if (!(error instanceof SoapfilmError)) throw error;
        expect(['self-intersecting', 'hole-outside', 'degenerate', 'repeated-vertex', 'bad-option']).toContain(error.code);
        refused++;
        continue;
      }
      expect(session.triangles).toEqual(triangles);
      if (i % 10 === 0) expectSound(session);
    }
    expect(refused).toBeGreaterThan(10);
    expect(refused).toBeLessThan(390);
    session.dispose();
  });

  test('edits that would make the polygon invalid: are refused, and change nothing', () => {
    const session = new PolygonSession(kPolygon);
    const before = session.read();
    const cases: [() => unknown, object][] = [
      [() => session.move(5, [20, 3]), { code: 'hole-outside', vertex: 5 }],
      [() => session.move(0, [6, 6]), { code: 'hole-outside', vertex: 0 }],
      [() => session.move(0, [11, 9]), { code: 'self-intersecting', loop: 0, vertex: 0, otherLoop: 0 }],
      [() => session.insertPoint([3, 3]), { code: 'hole-outside' }],
      [() => session.insertPoint([30, 3]), { code: 'hole-outside' }],
      [() => session.move(4, [0, 0]), { code: 'repeated-vertex', vertex: 4, otherVertex: 0 }],
      [() => session.move(4, [NaN, 0]), { code: 'not-finite', vertex: 4 }],
      [() => session.delete(77), { code: 'bad-option' }],
      [() => session.move(-1, [0, 0]), { code: 'bad-option' }],
      [() => session.insert(0.5, [0, 0]), { code: 'bad-option' }],
    ];
    for (const [edit, expected] of cases) {
      const error = errorOf(edit);
      expect(error).toMatchObject(expected);
      expect(error.message).not.toMatch(/loop/i);
      const { positions, next } = session.read();
      // A number that was tried out may be left over, out of use.
      expect(positions.subarray(0, 16)).toEqual(before.positions);
      expect(next.subarray(0, 8)).toEqual(before.next);
      expectSound(session);
    }
    session.dispose();
  });

  test('polygons that cannot have one: errors as of triangulatePolygon', () => {
    const bowTie: Polygon2 = [[[0, 0], [2, 2], [2, 0], [0, 2]]];
    expect(errorOf(() => new PolygonSession(bowTie))).toMatchObject({ code: 'self-intersecting', loop: 0 });
    expect(errorOf(() => new PolygonSession([square(0, 0, 4), square(8, 0, 2)])).code).toBe('hole-outside');
    expect(errorOf(() => new PolygonSession([])).code).toBe('bad-starts');
    expect(errorOf(() => new PolygonSession([[[0, 0, 0], [1, 0, 0], [1, 1, 0]]])).code).toBe('bad-polygon');
    expect(errorOf(() => new PolygonSession(kPolygon, { maxMemoryBytes: 10 })).code).toBe('out-of-memory');
    expect(errorOf(() => new PolygonSession(kPolygon, { maxMemoryBytes: -1 })).code).toBe('bad-option');
  });

  test('several at once: each for itself, until it is disposed of', () => {
    const sessions = [0, 1, 2].map((i) => new PolygonSession([square(i, i, 4 + i)]));
    sessions.forEach((session, i) => session.insertPoint([i + 1, i + 2]));
    sessions[1].dispose();
    sessions[1].dispose();
    for (const use of [
      () => sessions[1].read(),
      () => sessions[1].move(0, [0, 0]),
      () => sessions[1].delete(0),
    ]) {
      expect(errorOf(use).code).toBe('disposed');
    }
    for (const i of [0, 2]) expectSound(sessions[i]);
    const late = new PolygonSession(kPolygon);
    expectSound(late);
    for (const session of [sessions[0], sessions[2], late]) session[Symbol.dispose]();
    const again = new PolygonSession(kPolygon);
    expectSound(again);
    again.dispose();
  });

  test('other calls of the library: neither disturb a session nor are disturbed', () => {
    const session = new PolygonSession(kPolygon);
    const ring = Array.from({ length: 20 }, (_, i) => [Math.cos(i / 3.2), Math.sin(i / 3.2), i / 20] as const);
    for (let i = 0; i < 20; i++) {
      session.move(4, [1 + i / 40, 1 + i / 50]);
      const { triangles } = triangulatePolygon(kPolygon, { borrow: true });
      expect(trianglesArea(flatPolygon(kPolygon).positions, triangles)).toBe(96);
      session.insertPoint([5 + i / 10, 6 + i / 9]);
      if (i % 10 === 0) expect(spanLoops([ring]).found).toBe(true);
    }
    expectSound(session);
    session.dispose();
  });
});
