// The functions for polygons of `soapfilm/worker`.
import { optionsOf } from './check.js';
import type { FlatPolygons } from './flat_polygons.js';
import { flattenGeoJSON } from './geojson.js';
import { kPolygonOptions, kPolygonsOptions, signalOf } from './options.js';
import { flattenBatch, flattenPolygon, polygonOptionsOf } from './polygon_input.js';
import type { Pool } from './pool.js';
import { unpackErrors } from './protocol.js';
import type { PolygonOptions, PolygonsOptions, PolygonsTriangulation, PolygonTriangulation } from './types.js';
import type { CallOptions, Film } from './worker.js';

/** Calls that check and flatten here, and have the pool compute. */
export function polygonCalls(
  pool: Pool,
): Pick<Film, 'triangulatePolygon' | 'triangulatePolygons' | 'triangulateGeoJSON'> {
  const several = async <T extends PolygonsTriangulation>(
    flat: FlatPolygons,
    options: PolygonsOptions & CallOptions = {},
  ): Promise<T> => {
    const { signal, ...given } = optionsOf<PolygonsOptions & CallOptions>(options, { ...kPolygonsOptions, signal: true });
    const watch = { signal: signalOf(signal) };
    return unpackErrors((await pool.call('triangulatePolygons', [flat, polygonOptionsOf(given, flat)], watch)) as T);
  };
  return {
    async triangulatePolygon(polygon, options = {}) {
      const flat = flattenPolygon(polygon, true);
      const { signal, ...given } = optionsOf<PolygonOptions & CallOptions>(options, { ...kPolygonOptions, signal: true });
      const watch = { signal: signalOf(signal) };
      const result = await pool.call('triangulatePolygon', [flat, polygonOptionsOf(given, flat)], watch);
      return result as PolygonTriangulation;
    },
    triangulatePolygons: async (polygons, options) => several(flattenBatch(polygons, true), options),
    triangulateGeoJSON: async (geojson, options) => {
      const { flat, featureStarts } = flattenGeoJSON(geojson);
      // A copy, since `flat.positions` is transferred to the thread.
      const positions = flat.positions.slice();
      return { ...(await several(flat, options)), positions, featureStarts };
    },
  };
}
