// An independent check of spans: surfaces of the class, bounded by their loops, at the cost stated.
import { expect } from 'vitest';
import type { LoopSet, NoSpan, Point, Span, SpanOptions } from 'soapfilm';
import { cross, dot, subtract } from './generators.js';

const vertexAt = (positions: Float64Array, v: number): Point => [
  positions[3 * v],
  positions[3 * v + 1],
  positions[3 * v + 2],
];

/** For each directed edge "a b" the apex of the triangle wound a, b, apex. */
function apexes(triangles: Uint32Array): Map<string, number> {
  const map = new Map<string, number>();
  for (let t = 0; t < triangles.length; t += 3) {
    for (let i = 0; i < 3; i++) {
      const edge = `${triangles[t + i]} ${triangles[t + ((i + 1) % 3)]}`;
      expect(map.has(edge), `edge ${edge} used twice in one direction`).toBe(false);
      map.set(edge, triangles[t + ((i + 2) % 3)]);
    }
  }
  return map;
}

/** The next vertex along its loop, for every vertex. */
function successors({ starts, loopVertices }: Span): number[] {
  const next: number[] = [];
  for (let c = 0; c + 1 < starts.length; c++) {
    for (let i = starts[c]; i < starts[c + 1]; i++) {
      const j = i + 1 === starts[c + 1] ? starts[c] : i + 1;
      next[loopVertices[i]] = loopVertices[j];
    }
  }
  return next;
}

/** Manifold, connected, consistently wound, bounded by its loops, n' + 2k - 4 triangles. */
export function expectSurface(span: Span): void {
  const { triangles, starts, loopVertices } = span;
  const n = span.positions.length / 3;
  const k = starts.length - 1;
  const m = triangles.length / 3;
  expect(m).toBe(n + 2 * k - 4);
  expect([...loopVertices].sort((a, b) => a - b)).toEqual(Array.from({ length: n }, (_, v) => v));

  const keys = new Set<string>();
  const valence = new Array<number>(n).fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [...triangles.subarray(t, t + 3)];
    expect(new Set(corners).size).toBe(3);
    keys.add(corners.sort((a, b) => a - b).join(' '));
    for (const v of corners) valence[v]++;
  }
  expect(keys.size, 'distinct triangles').toBe(m);

  const apexOf = apexes(triangles);
  const next = successors(span);
  let interior = 0;
  for (const edge of apexOf.keys()) {
    const [a, b] = edge.split(' ').map(Number);
    const twice = apexOf.has(`${b} ${a}`);
    const onLoop = next[a] === b || next[b] === a;
    expect(twice, `edge ${edge}`).toBe(!onLoop);
    if (twice) interior += 0.5;
  }
  // One fan of triangles around every vertex, from loop edge to loop edge.
  next.forEach((w, v) => {
    const previous = next.indexOf(v);
    const forward = apexOf.has(`${v} ${w}`);
    let at = forward ? w : previous;
    let steps = 0;
    for (let apex = apexOf.get(`${v} ${at}`); apex !== undefined; steps++) {
      if (steps > m) break;
      at = apex;
      apex = apexOf.get(`${v} ${at}`);
    }
    expect([at, steps], `fan around vertex ${v}`).toEqual([forward ? previous : w, valence[v]]);
  });
  expect(n - (interior + n) + m, 'Euler number').toBe(2 - k);

  // Every triangle is reached in splitting order over an edge of an earlier one.
  expect([...span.order].sort((a, b) => a - b)).toEqual(Array.from({ length: m }, (_, t) => t));
  const reached = new Set<string>();
  span.order.forEach((t, i) => {
    let touches = i === 0;
    for (let j = 0; j < 3; j++) {
      const ends = [triangles[3 * t + j], triangles[3 * t + ((j + 1) % 3)]];
      const edge = `${Math.min(...ends)} ${Math.max(...ends)}`;
      touches ||= reached.has(edge);
      reached.add(edge);
    }
    expect(touches, `triangle ${t} in the order`).toBe(true);
  });
}

/** The terms of a span, recomputed; boundary normals as in the options of the call. */
export function measure(span: Span, inputSize: number, boundaryNormals?: Float64Array) {
  const at = (v: number): Point => vertexAt(span.positions, v);
  const normal = (a: number, b: number, c: number): Point =>
    cross(subtract(at(b), at(a)), subtract(at(c), at(a)));
  const terms = { area: 0, perimeter: 0, dihedral: 0, worstDihedral: 0 };
  const addAngle = (p: Point, q: Point): void => {
    const angle = Math.atan2(Math.hypot(...cross(p, q)), dot(p, q));
    terms.dihedral += angle;
    terms.worstDihedral = Math.max(terms.worstDihedral, angle);
  };
  const { triangles } = span;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = triangles.subarray(t, t + 3);
    terms.area += Math.hypot(...normal(a, b, c)) / 2;
    for (const [p, q] of [
      [a, b],
      [b, c],
      [c, a],
    ]) {
      terms.perimeter += Math.hypot(...subtract(at(p), at(q)));
    }
  }
  const apexOf = apexes(triangles);
  for (const [edge, c] of apexOf) {
    const [a, b] = edge.split(' ').map(Number);
    const d = apexOf.get(`${b} ${a}`);
    if (d !== undefined && a < b) addAngle(normal(a, b, c), normal(b, a, d));
  }
  if (!boundaryNormals) return terms;
  const next = successors(span);
  let edge = 0;
  for (const v of span.loopVertices) {
    if (v < inputSize) edge = v;
    const face = vertexAt(boundaryNormals, edge);
    if (Number.isNaN(face[0])) continue;
    const apex = apexOf.get(`${v} ${next[v]}`) ?? apexOf.get(`${next[v]} ${v}`) ?? -1;
    addAngle(normal(v, next[v], apex), face);
  }
  return terms;
}

/** The result is a span: a surface of the class over these loops, at the cost it states. */
export function expectSpans(
  result: Span | NoSpan,
  input: LoopSet,
  options: SpanOptions = {},
): asserts result is Span {
  expect(result).toMatchObject({ found: true });
  if (!result.found) return;
  const span = result;
  const n = input.positions.length / 3;
  expect(span.positions.subarray(0, 3 * n)).toEqual(input.positions);
  expect(span.inserted.length).toBe(span.positions.length / 3 - n);
  expect(span.starts.length).toBe(input.starts.length);
  span.inserted.forEach(({ loop, edge, parameter }, i) => {
    const first = input.starts[loop];
    const size = input.starts[loop + 1] - first;
    const a = vertexAt(input.positions, first + edge);
    const b = vertexAt(input.positions, first + ((edge + 1) % size));
    const p = vertexAt(span.positions, n + i);
    expect(parameter).toBeGreaterThan(0);
    expect(parameter).toBeLessThan(1);
    for (let axis = 0; axis < 3; axis++) {
      expect(p[axis]).toBeCloseTo(a[axis] + parameter * (b[axis] - a[axis]), 9);
    }
  });
  expectSurface(span);

  const terms = measure(span, n, options.boundaryNormals);
  for (const [name, value] of Object.entries(terms)) {
    expectClose(span.terms[name as keyof typeof terms], value, name);
  }
  expect(span.lowerBound).toBeLessThanOrEqual(span.cost);
  if (options.objective === 'worst-dihedral') expectClose(span.cost, terms.worstDihedral, 'cost');
  else if (options.weights && typeof options.candidates !== 'object') {
    const { area = 0, perimeter = 0, dihedral = 0 } = options.weights;
    const sum = area * terms.area + perimeter * terms.perimeter + dihedral * terms.dihedral;
    expectClose(span.cost, sum, 'cost');
  }
}

/** Equal but for rounding: to 1e-9, or to `tolerance`, of the value and at least of 1. */
export function expectClose(actual: number, value: number, what: string, tolerance = 1e-9): void {
  const error = Math.abs(actual - value) / Math.max(1, Math.abs(value));
  expect(error, `${what}: ${actual}, not ${value}`).toBeLessThanOrEqual(tolerance);
}
