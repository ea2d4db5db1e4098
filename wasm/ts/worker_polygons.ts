// The functions for polygons of `soapfilm/worker`.
import type { PolygonEditor } from './compute_edits.js';
import { kDispose } from './dispose.js';
import type { FlatPolygons } from './flat_polygons.js';
import { flattenGeoJSON } from './geojson.js';
import { callOptionsOf, kPolygonOptions, kPolygonsOptions } from './options.js';
import { checkEdit, editedPolygonOf, editOf, kNoPoint, kSessionOptions } from './polygon_edits.js';
import { flattenBatch, flattenPolygon, polygonOptionsOf } from './polygon_input.js';
import type { Pool } from './pool.js';
import { unpackErrors } from './protocol.js';
import { SessionThreads, type RemoteSession } from './session_threads.js';
import type { Point2Like, PolygonEdit, PolygonsOptions, PolygonState, PolygonsTriangulation } from './types.js';
import type { CallOptions, Film, PolygonSessionHandle } from './worker.js';

type PolygonCalls =
  | 'triangulatePolygon'
  | 'triangulatePolygons'
  | 'triangulateGeoJSON'
  | 'createPolygonSession';

/** Calls that check and flatten here, and have the pool compute. */
export function polygonCalls(pool: Pool): Pick<Film, PolygonCalls> {
  const sessions = new SessionThreads(pool);
  const several = async (
    flat: FlatPolygons,
    options: PolygonsOptions & CallOptions = {},
  ): Promise<PolygonsTriangulation> => {
    const [given, signal] = callOptionsOf(options, kPolygonsOptions);
    return unpackErrors(await pool.call('triangulatePolygons', [flat, polygonOptionsOf(given, flat)], { signal }));
  };
  return {
    async triangulatePolygon(polygon, options = {}) {
      const flat = flattenPolygon(polygon, true);
      const [given, signal] = callOptionsOf(options, kPolygonOptions);
      return pool.call('triangulatePolygon', [flat, polygonOptionsOf(given, flat)], { signal });
    },
    triangulatePolygons: async (polygons, options) => several(flattenBatch(polygons, true), options),
    triangulateGeoJSON: async (geojson, options) => {
      const { flat, featureStarts } = flattenGeoJSON(geojson);
      // A copy, since `flat.positions` is transferred to the thread.
      const positions = flat.positions.slice();
      return { ...(await several(flat, options)), positions, featureStarts };
    },
    async createPolygonSession(polygon, options = {}) {
      const [given, signal] = callOptionsOf(options, kSessionOptions);
      const session = await sessions.open('polygon', editedPolygonOf(polygon, given, true), signal);
      const handle = new PolygonHandle(session);
      sessions.freeWith(handle, session);
      return handle;
    },
  };
}

/** A PolygonSession whose core's half is in a thread. */
class PolygonHandle implements PolygonSessionHandle {
  readonly #session: RemoteSession<PolygonEditor>;

  constructor(session: RemoteSession<PolygonEditor>) {
    this.#session = session;
  }

  get id(): number {
    return this.#session.id;
  }

  get triangles(): Promise<Uint32Array> {
    return this.#session.call('triangles');
  }

  insert(before: number, point: Point2Like): Promise<PolygonEdit> {
    return this.#edit('insert', before, point);
  }

  insertPoint(point: Point2Like): Promise<PolygonEdit> {
    return this.#edit('insert-isolated', 0, point);
  }

  delete(vertex: number): Promise<PolygonEdit> {
    return this.#edit('delete', vertex, kNoPoint);
  }

  move(vertex: number, point: Point2Like): Promise<PolygonEdit> {
    return this.#edit('move', vertex, point);
  }

  read(): Promise<PolygonState> {
    return this.#session.call('read');
  }

  dispose(): void {
    this.#session.dispose();
  }

  [kDispose](): void {
    this.dispose();
  }

  async #edit(...args: Parameters<typeof checkEdit>): Promise<PolygonEdit> {
    this.#session.alive();
    const checked = checkEdit(...args);
    return editOf(unpackErrors(await this.#session.call('edit', ...checked)), checked);
  }
}
