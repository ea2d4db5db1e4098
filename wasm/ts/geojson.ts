// triangulateGeoJSON: the polygons of features and geometries, feature by feature.
import { guarded, mustBe, optionsOf } from './check.js';
import { computePolygons } from './compute_polygons.js';
import type { FlatPolygons } from './flat_polygons.js';
import { SoapfilmError } from './errors.js';
import { kPolygonsOptions } from './options.js';
import { flattenPolygons, polygonOptionsOf } from './polygon_input.js';
import type { GeoJSONLike, GeoJSONTriangulation, PolygonsOptions } from './types.js';

/** Types of geometries that have no inside. */
const kThin = /^(Multi)?(Point|LineString)$/;

/**
 * Triangulates all polygons in GeoJSON: Polygon, MultiPolygon, GeometryCollection, Feature or
 * FeatureCollection. Coordinates are taken as they are, in the plane. Points and lines are ignored.
 *
 * @returns the triangles, polygon by polygon and feature by feature, as indices into the `positions` that
 *   come with them
 * @throws SoapfilmError `bad-polygon` for input that is not GeoJSON; else those of `triangulatePolygons`
 */
export function triangulateGeoJSON(
  geojson: GeoJSONLike,
  options: PolygonsOptions = {},
): GeoJSONTriangulation {
  const { flat, featureStarts } = flattenGeoJSON(geojson);
  const checked = polygonOptionsOf(optionsOf(options, kPolygonsOptions), flat);
  return { ...computePolygons(flat, checked, true), positions: flat.positions, featureStarts };
}

/** More geometries than any text holds. Objects that list the same part again and again may exceed it. */
const kMostGeometries = 2 ** 24;

/**
 * The polygons of GeoJSON as flat arrays, and where those of each feature begin.
 * @throws SoapfilmError `bad-polygon`; `too-large`
 */
export function flattenGeoJSON(geojson: GeoJSONLike): { flat: FlatPolygons; featureStarts: Uint32Array } {
  const { polygons, featureStarts } = guarded('bad-polygon', 'geojson', () => collect(geojson));
  return { flat: flattenPolygons(polygons, 'geojson', 2), featureStarts: Uint32Array.from(featureStarts) };
}

function collect(geojson: GeoJSONLike): { polygons: unknown[]; featureStarts: number[] } {
  const { type, features } = readObject(geojson);
  const roots = type === 'FeatureCollection' ? listOf(features, 'geojson.features') : [geojson];
  const polygons: unknown[] = [];
  const featureStarts = [0];
  let count = 0;
  for (let f = 0; f < roots.length; f++) {
    // A stack, the next one last, since collections may be nested to any depth. The open ones are those
    // around the next one: each is also on the stack, below its parts, and is closed when it comes up again.
    const todo: unknown[] = [roots[f]];
    const open = new Set<unknown>();
    while (todo.length > 0) {
      const next = todo.pop();
      if (open.delete(next)) continue;
      if (++count > kMostGeometries) throw tooMany();
      const { type, geometry, geometries, coordinates } = readObject(next);
      if (type === 'Feature' || type === 'GeometryCollection') {
        // Null if the feature has no place.
        const parts =
          type === 'Feature' ? [geometry].filter((part) => part !== null) : listOf(geometries, 'geometries` of `geojson');
        open.add(next);
        todo.push(next);
        if (count + parts.length > kMostGeometries) throw tooMany();
        for (let i = parts.length - 1; i >= 0; i--) {
          if (open.has(parts[i])) {
            throw new SoapfilmError('bad-polygon', `A collection of feature ${f} in \`geojson\` contains itself`);
          }
          todo.push(parts[i]);
        }
      } else if (type === 'Polygon') polygons.push(coordinates);
      else if (type === 'MultiPolygon') {
        const parts = listOf(coordinates, 'coordinates` of `geojson');
        if ((count += parts.length) > kMostGeometries) throw tooMany();
        for (let i = 0; i < parts.length; i++) polygons.push(parts[i]);
      } else if (typeof type !== 'string' || !kThin.test(type)) {
        throw new SoapfilmError('bad-polygon', `Feature ${f} of \`geojson\` has no GeoJSON geometry`);
      }
    }
    featureStarts.push(polygons.length);
  }
  return { polygons, featureStarts };
}

const tooMany = (): SoapfilmError =>
  new SoapfilmError('too-large', `\`geojson\` holds more than ${kMostGeometries} geometries`);

/** The fields of an object that are used here; none if the value is not an object. */
function readObject(value: unknown): Partial<Record<'type' | 'features' | 'geometry' | 'geometries' | 'coordinates', unknown>> {
  return (value ?? {});
}

function listOf(value: unknown, name: string): readonly unknown[] {
  if (Array.isArray(value)) return value;
  throw mustBe('bad-polygon', name, 'an array', value);
}
