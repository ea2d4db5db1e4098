// What triangulating comes to, all polygons together: by one call of the library, or with other triangles in the
// place of one polygon's.
import type { SoapfilmError } from 'soapfilm';
import type { Film } from 'soapfilm/worker';
import { flatten, type PolygonGroup } from './polygons.ts';

/** Triangles of all polygons, and what is wrong with those that have none. */
export interface Triangulation {
  /** The polygons and settings that it is of. */
  readonly of: PolygonGroup;
  /** `[2n]` the rings' vertices one after the other, then those that repair added. */
  readonly positions: Float64Array;
  readonly added: number;
  readonly triangles: Uint32Array;
  /** `[polygons + 1]` where each polygon's triangles begin, counted in triangles. */
  readonly triangleStarts: Uint32Array;
  readonly strips: Uint32Array;
  readonly stripStarts: Uint32Array;
  readonly errors: readonly SoapfilmError[];
  readonly seconds: number;
  /** Whether it stands in, during a gesture, for what the settings ask for. */
  readonly isPassing: boolean;
}

/** What of the library triangulates. */
export type Triangulator = Pick<Film, 'triangulatePolygons'>;

export const nothingOf = (of: PolygonGroup): Triangulation => ({
  of,
  positions: new Float64Array(),
  added: 0,
  triangles: new Uint32Array(),
  triangleStarts: new Uint32Array(1),
  strips: new Uint32Array(),
  stripStarts: new Uint32Array(1),
  errors: [],
  seconds: 0,
  isPassing: false,
});

/** Triangulates all polygons of a group that are valid. */
export async function triangulateAll(film: Triangulator, of: PolygonGroup, signal: AbortSignal): Promise<Triangulation> {
  const flat = flatten(of.items);
  const since = performance.now();
  const found = await film.triangulatePolygons(flat, { ...of.settings, skipInvalid: true, signal });
  const seconds = (performance.now() - since) / 1000;
  const { added, triangles, triangleStarts, strips, stripStarts, errors } = found;
  return {
    of,
    positions: added.length > 0 ? joined(flat.positions, added) : flat.positions,
    added: added.length / 2,
    triangles,
    triangleStarts,
    strips,
    stripStarts,
    errors,
    seconds,
    isPassing: false,
  };
}

/** What one polygon has: its triangles, by its own numbers of vertices, or an error. */
export interface OfOnePolygon {
  readonly triangles: Uint32Array;
  readonly errors: readonly SoapfilmError[];
}

/**
 * A triangulation with other triangles for one polygon.
 *
 * @param before without strips or added vertices
 * @param of the polygons now: as in `before`, but for the places of that polygon's vertices
 */
export function withPolygon(before: Triangulation, of: PolygonGroup, polygon: number, one: OfOnePolygon, seconds: number): Triangulation {
  const { positions, ringStarts, polygonStarts } = flatten(of.items);
  const first = ringStarts[polygonStarts[polygon]];
  const [from, to] = [3 * before.triangleStarts[polygon], 3 * before.triangleStarts[polygon + 1]];
  const triangles = new Uint32Array(before.triangles.length - (to - from) + one.triangles.length);
  triangles.set(before.triangles.subarray(0, from));
  for (let i = 0; i < one.triangles.length; i++) triangles[from + i] = first + one.triangles[i];
  triangles.set(before.triangles.subarray(to), from + one.triangles.length);
  const more = (one.triangles.length - (to - from)) / 3;
  const triangleStarts = before.triangleStarts.map((start, p) => (p > polygon ? start + more : start));
  const others = before.errors.filter((error) => error.polygon !== polygon);
  return { ...before, of, positions, triangles, triangleStarts, errors: [...others, ...one.errors], seconds, isPassing: true };
}

function joined(a: Float64Array, b: Float64Array): Float64Array {
  const all = new Float64Array(a.length + b.length);
  all.set(a);
  all.set(b, a.length);
  return all;
}
