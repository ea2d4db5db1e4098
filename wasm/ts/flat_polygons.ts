// What checking and computing share for polygons.
import { kMethodChoices, kRepairChoices } from './border.js';

/** Polygons as the core takes them. */
export interface FlatPolygons {
  readonly positions: Float64Array;
  readonly ringStarts: Uint32Array;
  readonly polygonStarts: Uint32Array;
  readonly dim: 2 | 3;
  readonly points?: Float64Array | undefined;
}

/** The choices of each option, the default first, in the order of the core's numbers. */
export const kChoices = {
  method: kMethodChoices,
  repair: kRepairChoices,
  quality: ['fast', 'delaunay'],
  output: ['triangles', 'strips'],
} as const;
