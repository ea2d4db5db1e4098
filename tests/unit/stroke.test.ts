import { describe, expect, test } from 'vitest';
import { closeStroke, resample, smoothClosed } from '../../web/src/shapes/stroke.ts';
import type { Point2 } from '../../web/src/shapes/plane.ts';

const circle = (count: number, from = 0, to = 2 * Math.PI, wobble = 0): Point2[] =>
  Array.from({ length: count }, (_, i): Point2 => {
    const t = from + ((to - from) * i) / count;
    const r = 1 + wobble * Math.sin(40 * t);
    return [r * Math.cos(t), r * Math.sin(t)];
  });
const gaps = (points: readonly Point2[]) =>
  points.map((p, i) => {
    const q = points[(i + 1) % points.length];
    return Math.hypot(p[0] - q[0], p[1] - q[1]);
  });
const radii = (points: readonly Point2[]) => points.map(([u, v]) => Math.hypot(u, v));
const curveOf = (stroke: readonly Point2[], count = 24, smoothing = 0.4) => {
  const outcome = closeStroke(stroke, { count, smoothing, leastExtent: 0.1 });
  if (!('points' in outcome)) throw new Error(outcome.problem);
  return outcome.points;
};

describe('closeStroke', () => {
  test.each([3, 4, 24, 100, 500])('%i vertices: as many as asked for, evenly spaced', (count) => {
    const points = curveOf(circle(90), count);
    expect(points).toHaveLength(count);
    const edges = gaps(points);
    expect(Math.max(...edges) / Math.min(...edges)).toBeLessThan(1.05);
  });

  test.each([0, 0.3, 0.6, 1])('smoothing %d: a circle keeps its size within 2 %%', (smoothing) => {
    for (const r of radii(curveOf(circle(90), 60, smoothing))) {
      expect(r).toBeGreaterThan(0.98);
      expect(r).toBeLessThan(1.02);
    }
  });

  test('a trembling hand: more smoothing leaves less tremor', () => {
    const tremor = (smoothing: number) => {
      const r = radii(curveOf(circle(400, 0, 2 * Math.PI, 0.05), 120, smoothing));
      return Math.max(...r) - Math.min(...r);
    };
    expect(tremor(0)).toBeGreaterThan(0.06);
    expect(tremor(0.5)).toBeLessThan(0.01);
  });

  test('an overshoot past the start: cut off, not folded into the curve', () => {
    const spiral = circle(130, 0, 2.25 * Math.PI).map(
      ([u, v], i): Point2 => [u * (1 + i * 2e-4), v * (1 + i * 2e-4)],
    );
    const points = curveOf(spiral, 48, 0.2);
    const turns = points.reduce((sum, p, i) => {
      const q = points[(i + 1) % points.length];
      return sum + Math.atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]);
    }, 0);
    expect(turns).toBeCloseTo(2 * Math.PI, 6);
    // Once round, and no vertex goes back on the way.
    points.forEach((p, i) => {
      const q = points[(i + 1) % points.length];
      expect(p[0] * q[1] - p[1] * q[0]).toBeGreaterThan(0);
    });
  });

  test('an open arc: its ends are joined', () => {
    const points = curveOf(circle(60, 0, 1.5 * Math.PI), 24, 0);
    expect(Math.max(...gaps(points)) / Math.min(...gaps(points))).toBeLessThan(1.3);
  });

  test('direction: the curve runs as the hand did', () => {
    const area = (points: readonly Point2[]) =>
      points.reduce((sum, p, i) => {
        const q = points[(i + 1) % points.length];
        return sum + p[0] * q[1] - p[1] * q[0];
      }, 0);
    expect(area(curveOf(circle(90)))).toBeGreaterThan(0);
    expect(area(curveOf(circle(90).reverse()))).toBeLessThan(0);
  });

  test.each<[string, Point2[], 'short' | 'straight']>([
    ['no point', [], 'short'],
    ['a click', [[0, 0]], 'short'],
    ['a twitch', circle(20).map(([u, v]): Point2 => [u * 0.01, v * 0.01]), 'short'],
    ['a point pressed for long', Array.from({ length: 30 }, (): Point2 => [1, 1]), 'short'],
    ['there and back on a line', [0, 1, 2, 3, 2, 1].map((u): Point2 => [u, 0.5 * u]), 'straight'],
  ])('%s: refused as %s', (_, stroke, problem) => {
    expect(closeStroke(stroke, { count: 24, smoothing: 0.4, leastExtent: 0.1 })).toEqual({ problem });
  });

  test('scale: the curve of a stroke a million times larger is that much larger', () => {
    const large = circle(90, 0, 2 * Math.PI, 0.1).map(([u, v]): Point2 => [1e6 * u, 1e6 * v]);
    const small = curveOf(circle(90, 0, 2 * Math.PI, 0.1));
    curveOf(large).forEach(([u, v], i) => {
      expect(u / 1e6).toBeCloseTo(small[i][0], 9);
      expect(v / 1e6).toBeCloseTo(small[i][1], 9);
    });
  });
});

describe('resample', () => {
  test('an open path: keeps both ends', () => {
    const path: Point2[] = [[0, 0], [1, 0], [1, 3]];
    expect(resample(path, 5, false)).toEqual([[0, 0], [1, 0], [1, 1], [1, 2], [1, 3]]);
  });

  test('a closed path: begins at its first point and leaves room for the last edge', () => {
    const square: Point2[] = [[0, 0], [1, 0], [1, 1], [0, 1]];
    expect(resample(square, 8, true)).toEqual([[0, 0], [0.5, 0], [1, 0], [1, 0.5], [1, 1], [0.5, 1], [0, 1], [0, 0.5]]);
  });

  test('repeated points: do not disturb the spacing', () => {
    const path: Point2[] = [[0, 0], [0, 0], [2, 0], [2, 0], [4, 0]];
    expect(resample(path, 3, false)).toEqual([[0, 0], [2, 0], [4, 0]]);
  });
});

test('smoothClosed: the centroid stays', () => {
  const path = circle(200, 0, 2 * Math.PI, 0.2).map(([u, v]): Point2 => [u + 3, v - 1]);
  const mean = (points: readonly Point2[]) => points.reduce((m, p) => [m[0] + p[0] / points.length, m[1] + p[1] / points.length], [0, 0]);
  const [before, after] = [mean(path), mean(smoothClosed(path, 0.7))];
  expect(after[0]).toBeCloseTo(before[0], 9);
  expect(after[1]).toBeCloseTo(before[1], 9);
});
