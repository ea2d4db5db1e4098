// smoothSurface: surfaces between boundaries for which the answer is known, here and in a worker.
import { load, smoothSurface, spanLoops, type Point, type SmoothSurface } from 'soapfilm';
import { createWorker, type Film } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { errorOf, rejectionOf } from '../support/errors.js';
import { circle } from '../support/generators.ts';
import { openEdges } from '../support/meshes.ts';

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

  test('what is no surface with one orientation: bad-mesh, with a face', () => {
    const { positions, triangles } = rings(0.8);
    const [a, b, c] = triangles;
    for (const wrong of [[a, b, c], [a, c, b], [a, b, b]]) {
      const error = errorOf(() => smoothSurface({ positions, triangles: Uint32Array.from([...triangles, ...wrong]) }));
      expect(error.code).toBe('bad-mesh');
      expect(error.face).toBeTypeOf('number');
    }
    expect(errorOf(() => smoothSurface({ positions: positions.map((x, i) => (i === 9 ? NaN : x)), triangles }))).toMatchObject({ code: 'not-finite', vertex: 3 });
  });
});
