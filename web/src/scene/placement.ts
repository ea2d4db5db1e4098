// Where the world lies in the scene. The graphics card counts in single precision, so what is drawn
// is moved to the origin and brought near size 1; outside this directory all points are the world's.
import type { Bounds, Point } from '../shapes/vec.ts';

/** The scene's origin and unit, in the world. */
export interface Placement {
  readonly center: Point;
  /** A power of two. */
  readonly unit: number;
}

export const kIdentity: Placement = { center: [0, 0, 0], unit: 1 };

/** How far size and distance may stray, as a factor, before the world is placed anew. */
const kStray = 16;

/** The placement that suits bounds: the present one while it does. */
export function placementFor({ center, diagonal }: Bounds, present: Placement): Placement {
  const unit = diagonal > 0 ? 2 ** Math.round(Math.log2(diagonal / 2)) : 1;
  const away = Math.max(...center.map((x, axis) => Math.abs(x - present.center[axis])));
  const isNear = away <= kStray * unit && away <= kStray * present.unit;
  if (isNear && unit <= kStray * present.unit && present.unit <= kStray * unit) return present;
  const isNearOrigin = Math.max(...center.map(Math.abs)) <= kStray * unit;
  return { center: isNearOrigin ? [0, 0, 0] : center, unit };
}

export const toScene = ({ center, unit }: Placement, point: Point): Point => [
  (point[0] - center[0]) / unit,
  (point[1] - center[1]) / unit,
  (point[2] - center[2]) / unit,
];

/** Points `[3n]`. */
export function allToScene({ center, unit }: Placement, positions: Float32Array): Float32Array {
  const all = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    all[i] = (positions[i] - center[0]) / unit;
    all[i + 1] = (positions[i + 1] - center[1]) / unit;
    all[i + 2] = (positions[i + 2] - center[2]) / unit;
  }
  return all;
}

export const toWorld = ({ center, unit }: Placement, point: Point): Point => [
  point[0] * unit + center[0],
  point[1] * unit + center[1],
  point[2] * unit + center[2],
];
