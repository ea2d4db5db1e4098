// What the benchmark measures with: its generators, and how it sums up.
import { describe, expect, test } from 'vitest';
import {
  closedSurface,
  manySaddles,
  meshLoops,
  Random,
  regularSaddles,
  type Loop,
  type Mesh,
} from '../support/generators.js';

interface Report {
  fitPower: (points: readonly [number, number][]) => { exponent: number; factor: number } | null;
  quantile: (values: readonly number[], share: number) => number;
  summary: (
    measured: { seconds: number[]; first?: number } | { problem: string },
  ) => { median: number; first: number; spread: number | null };
  disagreement: (found: { native: object; wasm: object }) => boolean;
}
const report = (await import(new URL('../bench/report.mjs', import.meta.url).href)) as Report;

/** Index of each point of a loop in the mesh, and the mesh's edges. */
function traced(mesh: Mesh, loop: Loop): { vertices: number[]; edges: Set<string> } {
  const edges = new Set<string>();
  mesh.faces.forEach((a, i) => edges.add(`${a} ${mesh.faces[i - (i % 3) + ((i + 1) % 3)]}`));
  return { vertices: loop.map((p) => mesh.positions.indexOf(p)), edges };
}

describe('generators', () => {
  test.each([0, 1, 3])('closed surface of %i divisions: closed, of sphere topology', (levels) => {
    const { positions, faces } = closedSurface(levels, new Random(7));
    const { edges } = traced({ positions, faces }, []);
    expect(faces.length / 3).toBe(20 * 4 ** levels);
    expect(positions.length).toBe(10 * 4 ** levels + 2);
    expect(edges.size).toBe(faces.length);
    for (const edge of edges) expect(edges).toContain(edge.split(' ').reverse().join(' '));
  });

  test.each([1, 2, 3, 4, 5])('mesh loops, seed %i: simple, disjoint, along edges, as long as asked', (seed) => {
    const random = new Random(seed);
    const mesh = closedSurface(3, random);
    const sizes = [10 + random.below(11), 10 + random.below(11), 40];
    const loops = meshLoops(mesh, sizes, random);
    expect(loops.map((loop) => loop.length)).toEqual(sizes);
    const all = loops.map((loop) => traced(mesh, loop));
    const vertices = all.flatMap((loop) => loop.vertices);
    expect(vertices).not.toContain(-1);
    expect(new Set(vertices).size).toBe(vertices.length);
    for (const { vertices: rim, edges } of all) {
      rim.forEach((v, i) => {
        expect(edges).toContain(`${v} ${rim[(i + 1) % rim.length]}`);
      });
    }
  });

  test('mesh loops: an error where there is no room', () => {
    const random = new Random(1);
    expect(() => meshLoops(closedSurface(0, random), [50], random)).toThrow('no room');
  });

  test('saddles: poses depend on neither the vertices nor the number of loops', () => {
    const centre = (loop: Loop): number[] =>
      [0, 1, 2].map((d) => loop.reduce((sum, p) => sum + p[d], 0) / loop.length);
    const few = regularSaddles(2, 8, new Random(1)).map(centre);
    const many = regularSaddles(6, 40, new Random(1)).map(centre);
    few.flat().forEach((value, i) => {
      expect(value).toBeCloseTo(many.flat()[i], 12);
    });
  });

  test.each([8, 12])('many saddles: %i loops, none near another', (k) => {
    const loops = manySaddles(k, 10, new Random(1));
    expect(loops.length).toBe(k);
    const pairs = loops.flatMap((a, i) => loops.slice(i + 1).flatMap((b) => a.flatMap((p) => b.map((q) => [p, q]))));
    const least = Math.min(...pairs.map(([p, q]) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2])));
    expect(least).toBeGreaterThan(0.03);
  });
});

describe('report', () => {
  test('fitted powers: exact on a power law, least squares on two that alternate, none on two points', () => {
    const law = [3, 10, 40, 200].map((n): [number, number] => [n, 5 * n ** 2.5]);
    expect(report.fitPower(law)?.exponent).toBeCloseTo(2.5, 12);
    expect(report.fitPower(law)?.factor).toBeCloseTo(5, 10);
    const noisy = law.map(([n, y], i): [number, number] => [n, i % 3 === 0 ? 2 * y : y]);
    const by = report.fitPower(noisy);
    const error = (exponent: number, factor: number): number =>
      noisy.reduce((sum, [n, y]) => sum + Math.log(y / (factor * n ** exponent)) ** 2, 0);
    if (!by) throw new Error('no fit');
    for (const [e, f] of [[0.01, 1], [-0.01, 1], [0, 1.01], [0, 0.99]]) {
      expect(error(by.exponent, by.factor)).toBeLessThan(error(by.exponent + e, by.factor * f));
    }
    expect(report.fitPower(law.slice(0, 2))).toBeNull();
    expect(report.fitPower([[5, 1], [5, 2], [5, 3]])).toBeNull();
  });

  test('summary: the first run stands apart, and those of the warm-up are left out', () => {
    const { median, first, spread } = report.summary({ seconds: [9, 1, 3, 2, 4, 5] });
    expect([median, first]).toEqual([3, 9]);
    expect(report.summary({ first: 12, seconds: [9, 1] })).toMatchObject({ median: 1, first: 12 });
    expect(report.summary({ problem: 'too long' })).toEqual({ problem: 'too long' });
    expect(spread).toBeCloseTo((4 - 2) / 3, 12);
    expect(report.summary({ seconds: [0.1, 0.15, 0.04, 0.03, 0.02, 0.01, 0.02] }).median).toBe(0.02);
    expect(report.summary({ seconds: [0.1, 0.03, 0.01, 0.02] }).median).toBe(0.02);
    expect(report.summary({ seconds: [9] })).toMatchObject({ median: 9, first: 9, spread: null });
  });

  test('native and WebAssembly: alike up to rounding, unlike beyond it or where one finds none', () => {
    const side = (cost: number, found = true): object => ({ median: 1, cost, found });
    const differ = (a: object, b: object): boolean => report.disagreement({ native: a, wasm: b });
    expect(differ(side(2), side(2 + 1e-13))).toBe(false);
    expect(differ(side(2), side(2 + 1e-6))).toBe(true);
    expect(differ(side(2), side(2, false))).toBe(true);
  });
});
