// triangulatePolygon and triangulatePolygons: check the polygons, make them flat, and triangulate them.
import { optionsOf } from './check.js';
import { computePolygons, triangulationOfOne } from './compute_polygons.js';
import { kPolygonOptions, kPolygonsOptions } from './options.js';
import { flattenBatch, flattenPolygon, polygonOptionsOf } from './polygon_input.js';
import type {
  PolygonLike,
  PolygonOptions,
  PolygonsLike,
  PolygonsOptions,
  PolygonsTriangulation,
  PolygonTriangulation,
} from './types.js';

/**
 * Triangulates a polygon with holes, in the plane or in space: the triangles lie inside it and cover
 * it exactly, with all its vertices and no others. O(n log n).
 *
 * @throws SoapfilmError `not-loaded`; `bad-polygon`, `bad-starts`, `bad-option`; with the rings, the vertices
 *   and the point at fault `not-finite` and, unless `repair` is set, `degenerate`, `self-intersecting`,
 *   `holes-overlap`, `hole-outside`, `nested-hole`; `too-large`, `out-of-memory`, `time-limit`; `crashed`.
 *   The next call works after any of them.
 */
export function triangulatePolygon(
  polygon: PolygonLike,
  options: PolygonOptions = {},
): PolygonTriangulation {
  const flat = flattenPolygon(polygon);
  const checked = polygonOptionsOf(optionsOf<PolygonOptions>(options, kPolygonOptions), flat);
  return triangulationOfOne(computePolygons(flat, checked, false));
}

/**
 * Triangulates many polygons in one call of the core, which is far quicker for small ones.
 *
 * @param polygons flat arrays, or an array of polygons, each an array of rings
 * @throws SoapfilmError those of `triangulatePolygon`. The error of the first invalid polygon has its number
 *   as `.polygon`; with `skipInvalid`, invalid polygons do not throw
 */
export function triangulatePolygons(
  polygons: PolygonsLike,
  options: PolygonsOptions = {},
): PolygonsTriangulation {
  const flat = flattenBatch(polygons);
  return computePolygons(flat, polygonOptionsOf(optionsOf(options, kPolygonsOptions), flat), true);
}
