// smoothSurface: surfaces between boundaries for which the answer is known, here and in a worker.
import { load, smoothSurface, spanLoops, type Point, type SmoothSurface } from 'soapfilm';
import { createWorker, type Film } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { errorOf, rejectionOf } from '../support/errors.js';
import { circle } from '../support/generators.ts';
import { openEdges, sheet } from '../support/meshes.ts';

let film: Film;
beforeAll(async () => {
  await load();
  film = await createWorker();
});
afterAll(() => {
  film.dispose();
});

/** A span between two rings of radius 1, that far apart. */
function rings(distance: number, n = 48) {
  const span = spanLoops([circle(n), circle(n, { centre: [0, 0, distance] })]);
  if (!span.found) throw new Error(span.reason);
  return { positions: span.positions, triangles: span.triangles };
}

function pointsFrom({ positions }: SmoothSurface, first: number): Point[] {
  const points: Point[] = [];
  for (let i = 3 * first; i < positions.length; i += 3) points.push([positions[i], positions[i + 1], positions[i + 2]]);
  return points;
}

/** The radius of the waist of the catenoid between two rings of radius 1. */
function waist(distance: number): number {
  let c = 0.9;
  for (let i = 0; i < 200; i++) c = 1 / Math.cosh(distance / 2 / c);
  return c;
}

function expectKeepsBoundary(given: { positions: Float64Array; triangles: Uint32Array }, result: SmoothSurface): void {
  result.boundary.forEach((vertex, i) => {
    expect(result.positions.subarray(3 * i, 3 * i + 3)).toEqual(given.positions.subarray(3 * vertex, 3 * vertex + 3));
  });
  expect(openEdges(result.triangles).length).toBe(openEdges(given.triangles).length);
}

describe('soap films', () => {
  test('two rings: a catenoid, from which no vertex is far', () => {
    const distance = 0.8;
    const given = rings(distance);
    const before = { positions: given.positions.slice(), triangles: given.triangles.slice() };
    const result = smoothSurface(given);
    expect(given).toEqual(before);
    expectKeepsBoundary(given, result);
    expect(result.isMinimal).toBe(true);
    expect(result.collapsed.length).toBe(0);
    const c = waist(distance);
    const inner = pointsFrom(result, result.boundary.length);
    expect(inner.length).toBeGreaterThan(100);
    // A polygon of 48 sides is a little inside of its ring.
    for (const [x, y, z] of inner) expect(Math.abs(Math.hypot(x, y) - c * Math.cosh((z - distance / 2) / c))).toBeLessThan(5e-3);
    const area = Math.PI * c * (distance + c * Math.sinh(distance / c));
    expect(result.area).toBeLessThan(area * 1.001);
    expect(result.area).toBeGreaterThan(area * 0.99);
  });

  test('two rings too far apart: a neck that shrinks to a thread is told', () => {
    const { collapsed } = smoothSurface(rings(1.8));
    expect(collapsed.length).toBeGreaterThan(0);
  });

  test.each(['soap-film', 'thin-plate', 'curvature'] as const)('%s on a flat boundary: is flat', (kind) => {
    const span = spanLoops([circle(30)]);
    if (!span.found) throw new Error(span.reason);
    const result = smoothSurface(span, { kind });
    expectKeepsBoundary(span, result);
    for (const [, , z] of pointsFrom(result, 0)) expect(Math.abs(z)).toBeLessThan(1e-12);
    expect(result.area).toBeCloseTo(15 * Math.sin((2 * Math.PI) / 30), 9);
  });
});

describe('options', () => {
  test('density and maxNewVertices: how many vertices there are', () => {
    const given = rings(0.8);
    const count = (options: object): number => smoothSurface(given, options).positions.length / 3;
    expect(count({ density: 0 })).toBe(96);
    expect(count({ maxNewVertices: 50 })).toBeLessThanOrEqual(146);
    expect(count({ density: 2 })).toBeGreaterThan(count({ density: 1 }));
  });

  test('in a worker: the same, and it can be cancelled', async () => {
    const given = rings(0.8);
    expect(await film.smoothSurface(given, { kind: 'thin-plate' })).toEqual(smoothSurface(given, { kind: 'thin-plate' }));
    expect(await film.smoothSurface(given)).toEqual(smoothSurface(given));
    const signal = AbortSignal.abort();
    expect((await rejectionOf(film.smoothSurface(given, { signal }))).code).toBe('cancelled');
    expect((await film.smoothSurface(given)).isMinimal).toBe(true);
  });

  test('maxSeconds 0, little memory: errors, and the next call works', () => {
    const given = rings(0.8, 96);
    expect(errorOf(() => smoothSurface(given, { maxSeconds: 0, density: 4 })).code).toBe('time-limit');
    expect(['too-large', 'out-of-memory']).toContain(errorOf(() => smoothSurface(given, { maxMemoryBytes: 1000 })).code);
    expect(smoothSurface(rings(0.8)).isMinimal).toBe(true);
  });

  test('what is no surface with one orientation: bad-mesh, with a face, and an edge where one is at fault', async () => {
    const { positions, triangles } = rings(0.8);
    const [a, b, c] = triangles;
    for (const wrong of [[a, b, c], [a, c, b], [a, b, b]]) {
      const error = errorOf(() => smoothSurface({ positions, triangles: Uint32Array.from([...triangles, ...wrong]) }));
      expect(error.code).toBe('bad-mesh');
      expect(error.face).toBeTypeOf('number');
    }
    // A third face at an edge inside.
    const isInside = ([p, q]: number[]): boolean => !openEdges(triangles).some((edge) => edge === `${p} ${q}` || edge === `${q} ${p}`);
    const inside = [[a, b], [b, c]].find(isInside) ?? [c, a];
    const three = { positions: Float64Array.of(...positions, 9, 9, 9), triangles: Uint32Array.of(...triangles, ...inside, positions.length / 3) };
    const error = errorOf(() => smoothSurface(three));
    const ends = [...inside].sort((x, y) => x - y);
    expect(error).toMatchObject({ code: 'bad-mesh', edgeVertices: ends });
    expect(error.vertex).toBeUndefined();
    expect(error.message).toContain(`Face ${error.face} `);
    expect(error.message).toContain(`between vertices ${ends[0]} and ${ends[1]}`);
    expect(await rejectionOf(film.smoothSurface(three))).toEqual(error);
    expect(errorOf(() => smoothSurface({ positions: positions.map((x, i) => (i === 9 ? NaN : x)), triangles }))).toMatchObject({ code: 'not-finite', vertex: 3 });
  });
});

describe('fixed vertices', () => {
  test('stay where they are, and are told; the surface goes through them', () => {
    const { positions, faces } = sheet(8, () => 0);
    const middle = 4 * 9 + 4;
    const lifted = positions.map((x, i) => (i === 3 * middle + 2 ? 0.3 : x));
    const mesh = { positions: lifted, faces };
    for (const kind of ['soap-film', 'thin-plate', 'curvature'] as const) {
      const surface = smoothSurface(mesh, { kind, fixed: [middle, 0] });
      expect(surface.fixed).toEqual(Uint32Array.of(middle));
      expect(surface.boundary.length).toBe(32);
      expect(surface.positions.subarray(3 * 32, 3 * 33)).toEqual(lifted.subarray(3 * middle, 3 * middle + 3));
      expect(surface.triangles).toContain(32);
      expect(smoothSurface(mesh, { kind, fixed: Uint32Array.of(middle, 0) })).toEqual(surface);
    }
    expect(smoothSurface(mesh).fixed.length).toBe(0);
  });

  test('a number that is none, or twice: bad-option with its place', () => {
    const { positions, faces } = sheet(3, () => 0);
    const messageOf = (fixed: number[] | Uint32Array): string => {
      const error = errorOf(() => smoothSurface({ positions, faces }, { fixed }));
      expect(error.code).toBe('bad-option');
      return error.message;
    };
    expect(messageOf([1, 16])).toContain('`fixed[1]` is vertex 16, and there are 16');
    expect(messageOf(Uint32Array.of(16))).toContain('`fixed[0]`');
    expect(messageOf([0, 1.5])).toContain('`fixed[1]`');
    expect(messageOf([5, 5])).toContain('twice');
    expect(messageOf(Uint32Array.of(5, 5))).toContain('twice');
  });
});

describe('boundary normals', () => {
  const kSpheres = [30, 75, 90].map((degrees) => {
    const angle = (degrees * Math.PI) / 180;
    return { radius: 1 / Math.sin(angle), depth: 1 / Math.tan(angle) };
  });
  const n = 64;
  const loop = circle(n);
  /** The normals of the sphere below the unit circle in the middle of each edge from a vertex to the next. */
  const normalsOf = (depth: number): Float64Array =>
    Float64Array.from(loop.flatMap(([x, y], i) => [(x + loop[(i + 1) % n][0]) / 2, (y + loop[(i + 1) % n][1]) / 2, depth]));
  const off = (surface: SmoothSurface, radius: number, depth: number): number =>
    Math.max(...pointsFrom(surface, surface.boundary.length).map(([x, y, z]) => Math.abs(Math.hypot(x, y, z + depth) / radius - 1)));

  test.each(kSpheres)('of a sphere of radius $radius: a span of the circle becomes its cap', ({ radius, depth }) => {
    const boundaryNormals = normalsOf(depth);
    // The same list for both.
    const span = spanLoops([loop], { boundaryNormals });
    if (!span.found) throw new Error(span.reason);
    const turned = { positions: span.positions, faces: span.triangles.slice().reverse() };
    for (const kind of ['thin-plate', 'curvature'] as const) {
      for (const given of [span, turned]) {
        const cap = smoothSurface(given, { kind, boundaryNormals });
        expect(cap.positions.length / 3).toBeGreaterThan(400);
        expect(off(cap, radius, depth)).toBeLessThan(1e-3);
      }
    }
  });

  test('of a plane: flat; without any known: as without the option; in a worker: the same', async () => {
    const span = spanLoops([loop]);
    if (!span.found) throw new Error(span.reason);
    const up = Float64Array.from(loop.flatMap(() => [0, 0, 5]));
    const unknown = new Float64Array(3 * n).fill(NaN);
    for (const kind of ['thin-plate', 'curvature'] as const) {
      const flat = smoothSurface(span, { kind, boundaryNormals: up });
      for (const [, , z] of pointsFrom(flat, 0)) expect(Math.abs(z)).toBeLessThan(1e-12);
      expect(smoothSurface(span, { kind, boundaryNormals: unknown })).toEqual(smoothSurface(span, { kind }));
      const boundaryNormals = normalsOf(0.5);
      const before = boundaryNormals.slice();
      expect(await film.smoothSurface(span, { kind, boundaryNormals, fixed: [3] })).toEqual(smoothSurface(span, { kind, boundaryNormals, fixed: [3] }));
      expect(boundaryNormals).toEqual(before);
    }
  });

  test('several loops in order of their least vertex, whichever way their triangles run', () => {
    const height = 1.2;
    const given = rings(height, 60);
    // Out of the tube along the first ring; the second runs against the same surface.
    const direction = (ring: number): number => {
      const at = given.triangles.findIndex((v, i) => v === 60 * ring && given.triangles[3 * Math.floor(i / 3) + ((i + 1) % 3)] === 60 * ring + 1);
      return at < 0 ? -1 : 1;
    };
    expect(direction(0)).toBe(-direction(1));
    const normals = [0, 1].flatMap((ring) =>
      circle(60).flatMap(([x, y], i) => {
        const [p, q] = circle(60)[(i + 1) % 60];
        const sign = direction(0) === direction(ring) ? 1 : -1;
        return [(sign * (x + p)) / 2, (sign * (y + q)) / 2, 0];
      }),
    );
    const straight = smoothSurface(given, { kind: 'curvature', boundaryNormals: Float64Array.from(normals) });
    const most = Math.max(...pointsFrom(straight, straight.boundary.length).map(([x, y]) => Math.abs(Math.hypot(x, y) - 1)));
    expect(most).toBeLessThan(5e-3);
  });

  test('what is wrong with them is told, with the edge', () => {
    const span = spanLoops([loop]);
    if (!span.found) throw new Error(span.reason);
    const up = loop.flatMap(() => [0, 0, 1]);
    const smooth = (normals: unknown, kind = 'thin-plate') =>
      errorOf(() => smoothSurface(span, { kind, boundaryNormals: normals } as object));
    expect(smooth(Float64Array.from(up), 'soap-film')).toMatchObject({ code: 'bad-option' });
    expect(smooth(Float64Array.from(up), 'soap-film').message).toContain('`boundaryNormals`');
    for (const wrong of [up, Float32Array.from(up), Float64Array.from(up.slice(1)), Float64Array.from(up.slice(3))]) {
      expect(smooth(wrong).code).toBe('bad-normals');
      expect(smooth(wrong).message).toContain('`boundaryNormals`');
    }
    expect(smooth(Float64Array.from(up.slice(3))).message).toContain(`${3 * n} numbers`);
    for (const [x, y, z] of [[0, 0, 0], [Infinity, 0, 1], [NaN, 0, 1], loop[3].map((c, k) => c - loop[2][k])]) {
      const normals = Float64Array.from(up);
      normals.set([x, y, z], 6);
      const error = smooth(normals);
      expect(error).toMatchObject({ code: 'bad-normals', edge: 2, edgeVertices: [2, 3] });
      expect(error.vertex).toBeUndefined();
      expect(error.message).toContain('oundary normal 2, of the edge between vertices 2 and 3');
    }
  });
});
