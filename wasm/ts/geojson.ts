// triangulateGeoJSON: the polygons of features and geometries, feature by feature.
import { SoapfilmError } from './errors.js';
import { isList } from './loopset.js';
import { flatten, triangulate } from './polygon.js';
import type { GeoJSONLike, GeoJSONTriangulation, PolygonsOptions } from './types.js';

/** Types of geometries that have no inside. */
const kThin = /^(Multi)?(Point|LineString)$/;

/**
 * Triangulates all polygons in GeoJSON: Polygon, MultiPolygon, GeometryCollection, Feature or
 * FeatureCollection. Coordinates are taken as they are, in the plane; points and lines are passed over.
 *
 * @returns the triangles, polygon by polygon and feature by feature, with the `positions` that they
 *   are indices into
 * @throws SoapfilmError `bad-polygon` for what is no GeoJSON; else as `triangulatePolygons`
 */
export function triangulateGeoJSON(
  geojson: GeoJSONLike,
  options: PolygonsOptions = {},
): GeoJSONTriangulation {
  const { polygons, featureStarts } = collect(geojson);
  const flat = flatten(polygons, 2);
  return { ...triangulate(flat, options, true), positions: flat.positions, featureStarts };
}

function collect(geojson: unknown): { polygons: unknown[]; featureStarts: Uint32Array } {
  const { type, features } = (geojson ?? {}) as { type?: unknown; features?: unknown };
  const roots = type === 'FeatureCollection' ? list(features, 'features') : [geojson];
  const polygons: unknown[] = [];
  const featureStarts = new Uint32Array(roots.length + 1);
  for (let f = 0; f < roots.length; f++) {
    // The next is at the end: collections may be nested to any depth.
    const todo: unknown[] = [roots[f]];
    while (todo.length > 0) {
      const next = todo.pop();
      const { type, geometry, geometries, coordinates } = (next ?? {}) as Record<string, unknown>;
      if (type === 'Feature') {
        // Null where a feature has no place.
        if (geometry !== null) todo.push(geometry);
      } else if (type === 'GeometryCollection') {
        const parts = list(geometries, 'geometries');
        for (let i = parts.length - 1; i >= 0; i--) todo.push(parts[i]);
      } else if (type === 'Polygon') polygons.push(coordinates);
      else if (type === 'MultiPolygon') {
        const parts = list(coordinates, 'coordinates');
        for (let i = 0; i < parts.length; i++) polygons.push(parts[i]);
      } else if (typeof type !== 'string' || !kThin.test(type)) {
        throw new SoapfilmError('bad-polygon', `Feature ${f} has no GeoJSON geometry`);
      }
    }
    featureStarts[f + 1] = polygons.length;
  }
  return { polygons, featureStarts };
}

function list(value: unknown, name: string): ArrayLike<unknown> {
  if (isList(value)) return value;
  throw new SoapfilmError('bad-polygon', `\`${name}\` must be an array`);
}
