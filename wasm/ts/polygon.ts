// triangulatePolygon and triangulatePolygons: polygons in one of their forms, checked and made flat.
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
 * @throws SoapfilmError `not-loaded`; `bad-polygon`, `bad-starts`, `bad-option`; `not-finite`,
 *   `degenerate`, `self-intersecting`, `holes-overlap`, `hole-outside`, `nested-hole` with the rings,
 *   vertices and the point at fault, unless `repair` is set; `too-large`, `out-of-memory`,
 *   `time-limit`; `crashed`. The next call works after any of them.
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
 * @throws SoapfilmError as `triangulatePolygon`, for the first invalid polygon, with its number as
 *   `polygon`; nothing for invalid polygons with `skipInvalid`
 */
export function triangulatePolygons(
  polygons: PolygonsLike,
  options: PolygonsOptions = {},
): PolygonsTriangulation {
  const flat = flattenBatch(polygons);
  return computePolygons(flat, polygonOptionsOf(optionsOf(options, kPolygonsOptions), flat), true);
}
