// Checks of triangulations of polygons, exact for coordinates that are small integers.
import { expect } from 'vitest';
import { polygonArea, type Polygon2 } from './polygons.ts';

const cross = (p: Float64Array, a: number, b: number, c: number): number =>
  (p[2 * b] - p[2 * a]) * (p[2 * c + 1] - p[2 * a + 1]) -
  (p[2 * b + 1] - p[2 * a + 1]) * (p[2 * c] - p[2 * a]);

/** The sum of the triangles' signed areas. */
export function trianglesArea(positions: Float64Array, triangles: Uint32Array): number {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    sum += cross(positions, triangles[t], triangles[t + 1], triangles[t + 2]) / 2;
  }
  return sum;
}

/** Edges a > b of triangles that no other triangle has the other way round, as `a b`. */
export function boundaryOf(triangles: Uint32Array): Set<string> {
  const edges = new Set<string>();
  for (let h = 0; h < triangles.length; h++) {
    const [a, b] = [triangles[h], triangles[h - (h % 3) + ((h + 1) % 3)]];
    if (!edges.delete(`${b} ${a}`)) edges.add(`${a} ${b}`);
  }
  return edges;
}

/**
 * Expects what a triangulation of a valid polygon whose rings do not touch has to be: n + 2 holes - 2
 * triangles, none turned over, whose boundary is that of the polygon and whose areas sum to its own.
 */
export function expectTriangulates(
  polygon: Polygon2,
  positions: Float64Array,
  triangles: Uint32Array,
  first = 0,
): void {
  const n = polygon.flat().length;
  expect(triangles.length / 3).toBe(n + 2 * (polygon.length - 1) - 2);
  for (let t = 0; t < triangles.length; t += 3) {
    expect(cross(positions, triangles[t], triangles[t + 1], triangles[t + 2])).toBeGreaterThan(0);
  }
  expect(trianglesArea(positions, triangles)).toBeCloseTo(polygonArea(polygon), 6);
  const boundary = boundaryOf(triangles);
  let start = first;
  for (const ring of polygon) {
    for (let i = 0; i < ring.length; i++) {
      const [a, b] = [start + i, start + ((i + 1) % ring.length)];
      expect(boundary.has(`${a} ${b}`) !== boundary.has(`${b} ${a}`)).toBe(true);
    }
    start += ring.length;
  }
  expect(boundary.size).toBe(n);
}

/** The triangles that strips stand for, as OpenGL draws them; degenerate ones left out. */
export function trianglesOfStrips(strips: Uint32Array, starts: Uint32Array): number[][] {
  const found: number[][] = [];
  for (let s = 0; s + 1 < starts.length; s++) {
    for (let i = starts[s]; i + 2 < starts[s + 1]; i++) {
      const [a, b, c] = strips.subarray(i, i + 3);
      if (a === b || b === c || a === c) continue;
      found.push((i - starts[s]) % 2 === 0 ? [a, b, c] : [b, a, c]);
    }
  }
  return found;
}

/** Triangles in an order of their own, each beginning at its lowest vertex: for comparing sets. */
export function sortedTriangles(triangles: Iterable<number>): string[] {
  const all = Array.from(triangles);
  return Array.from({ length: all.length / 3 }, (_, t) => {
    const [a, b, c] = all.slice(3 * t, 3 * t + 3);
    if (a < b && a < c) return `${a} ${b} ${c}`;
    return b < c ? `${b} ${c} ${a}` : `${c} ${a} ${b}`;
  }).sort();
}
