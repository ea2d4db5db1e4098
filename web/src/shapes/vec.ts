// Small vector arithmetic on plain triples, for what must not depend on the renderer.
import type { Point } from 'soapfilm';

export type { Point };

export const add = (a: Point, b: Point): Point => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Point, s: number): Point => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const length = (a: Point): number => Math.hypot(a[0], a[1], a[2]);
export const normalize = (a: Point): Point => scale(a, 1 / (length(a) || 1));

/** Less than the largest number by enough for a few factors more. */
const kLargest = 2 ** 1000;

/** A box along the axes; one of no points has its `low` above its `high`. */
export interface Box {
  readonly low: Point;
  readonly high: Point;
}

export const kNoBox: Box = { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };

/** The least box around points `[dim n]`; those of the plane lie at z = 0. */
export function boxOfPoints(positions: Float32Array | Float64Array, dim: 2 | 3): Box {
  let [lowX, lowY, lowZ, highX, highY, highZ] = [...kNoBox.low, ...kNoBox.high];
  for (let at = 0; at < positions.length; at += dim) {
    const [x, y, z] = [positions[at], positions[at + 1], dim === 3 ? positions[at + 2] : 0];
    if (x < lowX) lowX = x;
    if (x > highX) highX = x;
    if (y < lowY) lowY = y;
    if (y > highY) highY = y;
    if (z < lowZ) lowZ = z;
    if (z > highZ) highZ = z;
  }
  return { low: [lowX, lowY, lowZ], high: [highX, highY, highZ] };
}

/** The least box around all boxes. */
export function unionOf(boxes: Iterable<Box>): Box {
  const [low, high] = [[...kNoBox.low], [...kNoBox.high]];
  for (const box of boxes) {
    for (let axis = 0; axis < 3; axis++) {
      low[axis] = Math.min(low[axis], box.low[axis]);
      high[axis] = Math.max(high[axis], box.high[axis]);
    }
  }
  return { low: low as [number, number, number], high: high as [number, number, number] };
}

export interface Bounds {
  readonly center: Point;
  /** Length of the bounding box's diagonal; 0 for one point and for none. */
  readonly diagonal: number;
}

/** A box by its centre and diagonal; centre 0 where there are no points. */
export function boundsOf({ low, high }: Box): Bounds {
  if (!(low[0] <= high[0])) return { center: [0, 0, 0], diagonal: 0 };
  return {
    // Halved first, since the sum of the largest numbers is infinite.
    center: [low[0] / 2 + high[0] / 2, low[1] / 2 + high[1] / 2, low[2] / 2 + high[2] / 2],
    diagonal: Math.min(Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]), kLargest),
  };
}
