// What the page makes of surfaces for itself: points of them, where instances place them, which triangles are of cells, and how far
// triangles are off.
import { load } from 'soapfilm';
import { TrimmedModel, type Model, type NurbsSurface } from 'soapfilm/surfaces';
import { beforeAll, describe, expect, test } from 'vitest';
import { pointOn, stepOn } from '../../web/src/modes/surface/evaluate.ts';
import { facesIn } from '../../web/src/modes/surface/faces.ts';
import { deviations, isOfCell, paint } from '../../web/src/modes/surface/paint.ts';
import { kExamples } from '../../web/src/modes/surface/examples.ts';
import { Random } from '../support/generators.js';

beforeAll(() => load({ parts: ['surfaces'] }));

const kSeed = 20;

/** Of random degrees, knots, poles and weights. */
function randomSurface(random: Random): NurbsSurface {
  const side = () => {
    const degree = 1 + random.below(4);
    const count = degree + 1 + random.below(5);
    const inner = Array.from({ length: count - degree - 1 }, () => random.range(0.01, 0.99));
    if (degree > 1 && inner.length > 1) inner[1] = inner[0];
    inner.sort((a, b) => a - b);
    return { degree, count, knots: [...Array<number>(degree + 1).fill(0), ...inner, ...Array<number>(degree + 1).fill(1)] };
  };
  const [u, v] = [side(), side()];
  const poles = Array.from({ length: u.count * v.count }, () => [random.unit(), random.unit(), random.unit()]);
  const weights = poles.map(() => 0.5 + random.unit());
  return { degreeU: u.degree, degreeV: v.degree, knotsU: u.knots, knotsV: v.knots, countU: u.count, countV: v.count, poles, weights };
}

/** By the recurrence as it is written, of one function after the other. */
function basis(knots: ArrayLike<number | null>, i: number, degree: number, t: number, isLast: boolean): number {
  const k = Array.from(knots, Number);
  if (degree === 0) return (k[i] <= t && t < k[i + 1]) || (isLast && t === k[i + 1] && k[i] < k[i + 1]) ? 1 : 0;
  const part = (width: number, share: number, j: number): number => (width > 0 ? (share / width) * basis(knots, j, degree - 1, t, isLast) : 0);
  return part(k[i + degree] - k[i], t - k[i], i) + part(k[i + degree + 1] - k[i + 1], k[i + degree + 1] - t, i + 1);
}

test(`points of surfaces: as the recurrence of Cox and de Boor has them (seed ${kSeed})`, () => {
  const random = new Random(kSeed);
  for (let round = 0; round < 60; round++) {
    const s = randomSurface(random);
    for (let k = 0; k < 10; k++) {
      const [u, v] = [0, 1].map(() => (k < 2 ? k : random.unit()));
      const sum = [0, 0, 0, 0];
      for (let i = 0; i < s.countU; i++) {
        for (let j = 0; j < s.countV; j++) {
          const w = basis(s.knotsU, i, s.degreeU, u, u === 1) * basis(s.knotsV, j, s.degreeV, v, v === 1) * (s.weights?.[i * s.countV + j] ?? 1);
          for (let axis = 0; axis < 3; axis++) sum[axis] += w * (s.poles[i * s.countV + j][axis] as number);
          sum[3] += w;
        }
      }
      const point = pointOn(s, [u, v]);
      for (let axis = 0; axis < 3; axis++) expect(point[axis]).toBeCloseTo(sum[axis] / sum[3], 12);
    }
  }
});

test('a step in the domain: moves the point by about as much', () => {
  const surface = { degreeU: 1, degreeV: 1, knotsU: [0, 0, 2, 2], knotsV: [0, 0, 4, 4], countU: 2, countV: 2, poles: [[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0]] };
  const [du, dv] = stepOn(surface, [1, 1], [0.1, -0.2, 5]);
  expect(du).toBeCloseTo(0.2, 9);
  expect(dv).toBeCloseTo(-0.8, 9);
});

test('faces of instances: in the order of the mesh, and where it has them', () => {
  const plate = kExamples[1].model();
  const shift = [1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7];
  const columns = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1];
  const model: Model = { ...plate, instances: [{ part: { instances: [{ part: plate, matrix: shift }] }, matrix: columns }] };
  const all = facesIn(model);
  expect(all).toHaveLength(64);
  expect(all[0].place([1, 2, 3])).toEqual([1, 2, 3]);
  expect(all[32].place([1, 2, 3])).toEqual([11, 14, 17]);
});

describe('the examples', () => {
  test.each(kExamples)('$title: nothing is told, and no triangle is off by more than was measured', ({ model: make }) => {
    const model = make();
    const opened = new TrimmedModel(model);
    const mesh = opened.tessellate();
    expect(mesh.reports.filter(({ report }) => report !== 'crossing-samples')).toEqual([]);
    const off = deviations(mesh, model);
    // Which looks at other points; and points are in single precision.
    expect(Math.max(...off)).toBeLessThan(1.02 * mesh.deviation + 1e-5);
    expect(Math.max(...off)).toBeGreaterThan(0.2 * mesh.deviation);
    let cells = 0;
    for (let t = 0; t < mesh.triangles.length / 3; t++) if (isOfCell(mesh, t)) cells++;
    expect(cells).toBeGreaterThan(0);
    expect(cells).toBeLessThan(mesh.triangles.length / 3);
    for (const coloring of ['faces', 'strips', 'cells', 'deviation'] as const) {
      const painted = paint(coloring, mesh, model);
      expect(painted?.tints).toHaveLength(3 * (painted?.triangles.length ?? 0));
      expect(painted?.tints.every((x) => x >= 0 && x <= 1)).toBe(true);
    }
    opened.dispose();
  });

  test('the teapot: patches share their edges', () => {
    const opened = new TrimmedModel(kExamples[1].model());
    const { triangles, same } = opened.tessellate();
    const sides = new Map<string, number>();
    for (let i = 0; i < triangles.length; i++) {
      const [a, b] = [same[triangles[i]], same[triangles[i - (i % 3) + ((i + 1) % 3)]]];
      if (a !== b) sides.set(`${Math.min(a, b)} ${Math.max(a, b)}`, (sides.get(`${Math.min(a, b)} ${Math.max(a, b)}`) ?? 0) + 1);
    }
    // Open at the rim, the lid, the spout, the handle and the windows only.
    const open = [...sides.values()].filter((count) => count === 1).length;
    expect(open).toBeGreaterThan(0);
    expect(open).toBeLessThan(0.15 * sides.size);
    expect([...sides.values()].every((count) => count <= 2)).toBe(true);
    opened.dispose();
  });
});
