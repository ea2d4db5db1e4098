// From a freehand stroke to a closed curve of evenly spaced vertices, all in plane coordinates.
import type { Point2 } from './plane.ts';

export interface StrokeOptions {
  /** Vertices of the curve, at least 3. */
  readonly count: number;
  /** 0 follows the hand, 1 leaves only the broad shape. */
  readonly smoothing: number;
  /** A stroke whose extent is below this is a slip, in plane units. */
  readonly leastExtent: number;
}

export type ClosedStroke =
  | { readonly points: readonly Point2[] }
  | { readonly problem: 'short' | 'straight' };

const kSamples = 360;
/** Share of the stroke, at either end, in which an overshoot past the start is looked for. */
const kOverlapShare = 0.2;
/** Width over length of the bounding box below which a stroke counts as a straight line. */
const kLeastWidth = 0.02;

/**
 * Closes a stroke into a smooth curve whose `count` vertices lie evenly along it.
 * Deterministic; O(samples²) for the overlap, samples fixed.
 */
export function closeStroke(stroke: readonly Point2[], options: StrokeOptions): ClosedStroke {
  const [long, wide] = extents(stroke);
  if (stroke.length < 3 || long < options.leastExtent) return { problem: 'short' };
  if (wide < kLeastWidth * long) return { problem: 'straight' };
  const even = resample(stroke, kSamples, false);
  const dense = resample(trimOverlap(even), kSamples, true);
  return { points: resample(smoothClosed(dense, options.smoothing), options.count, true) };
}

/** Points evenly spaced by arc length along an open path (both ends kept) or a closed one. */
export function resample(path: readonly Point2[], count: number, closed: boolean): Point2[] {
  const at = (i: number) => path[i % path.length];
  const segments = closed ? path.length : path.length - 1;
  const reach = [0];
  for (let i = 0; i < segments; i++) reach.push(reach[i] + distance(at(i), at(i + 1)));
  const step = reach[segments] / (closed ? count : count - 1);
  const result: Point2[] = [];
  for (let i = 0, s = 0; i < count; i++) {
    const goal = Math.min(i * step, reach[segments]);
    while (s < segments - 1 && reach[s + 1] < goal) s++;
    const share = (goal - reach[s]) / (reach[s + 1] - reach[s] || 1);
    result.push(mix(at(s), at(s + 1), share));
  }
  return result;
}

/**
 * Smooths a closed path of evenly spaced points by a Gaussian whose width grows with `amount`
 * (0 to 1), adding back the smoothed residual once so that the curve hardly shrinks.
 */
export function smoothClosed(path: readonly Point2[], amount: number): Point2[] {
  const sigma = amount * 0.045 * path.length;
  if (sigma < 0.3) return [...path];
  const once = blur(path, sigma);
  const residual = path.map((p, i): Point2 => [p[0] - once[i][0], p[1] - once[i][1]]);
  const back = blur(residual, sigma);
  return once.map((p, i): Point2 => [p[0] + back[i][0], p[1] + back[i][1]]);
}

function blur(path: readonly Point2[], sigma: number): Point2[] {
  const radius = Math.min(Math.ceil(3 * sigma), path.length >> 1);
  const kernel = Array.from({ length: 2 * radius + 1 }, (_, i) =>
    Math.exp(-0.5 * ((i - radius) / sigma) ** 2),
  );
  const total = kernel.reduce((sum, w) => sum + w, 0);
  return path.map((_, i): Point2 => {
    let u = 0;
    let v = 0;
    kernel.forEach((weight, k) => {
      const p = path[(i + k - radius + path.length) % path.length];
      u += weight * p[0];
      v += weight * p[1];
    });
    return [u / total, v / total];
  });
}

/** Cuts both ends where the hand ran past its start: there the two ends come closest. */
function trimOverlap(path: readonly Point2[]): readonly Point2[] {
  const window = Math.floor(kOverlapShare * path.length);
  const last = path.length - 1;
  const step = distance(path[0], path[1]);
  let best = distance(path[0], path[last]);
  let [from, to] = [0, last];
  for (let i = 0; i < window; i++) {
    for (let j = last - window; j <= last; j++) {
      const price = distance(path[i], path[j]) + 0.2 * step * (i + last - j);
      if (price < best) [best, from, to] = [price, i, j];
    }
  }
  return path.slice(from, to + 1);
}

/** Length and width of the stroke along its principal axes. */
function extents(stroke: readonly Point2[]): [long: number, wide: number] {
  const n = stroke.length || 1;
  const mean = stroke.reduce((m, p) => [m[0] + p[0] / n, m[1] + p[1] / n], [0, 0]);
  let [uu, uv, vv] = [0, 0, 0];
  for (const [u, v] of stroke) {
    uu += (u - mean[0]) ** 2;
    uv += (u - mean[0]) * (v - mean[1]);
    vv += (v - mean[1]) ** 2;
  }
  const angle = Math.atan2(2 * uv, uu - vv) / 2;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const along = stroke.map(([u, v]) => c * u + s * v);
  const across = stroke.map(([u, v]) => c * v - s * u);
  const span = (values: number[]) =>
    values.reduce((a, b) => Math.max(a, b), -Infinity) - values.reduce((a, b) => Math.min(a, b), Infinity);
  const [a, b] = [span(along), span(across)];
  return [Math.max(a, b, 0), Math.max(Math.min(a, b), 0)];
}

const distance = (a: Point2, b: Point2): number => Math.hypot(a[0] - b[0], a[1] - b[1]);
const mix = (a: Point2, b: Point2, t: number): Point2 => [
  a[0] + t * (b[0] - a[0]),
  a[1] + t * (b[1] - a[1]),
];
