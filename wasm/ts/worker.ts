/// <reference lib="esnext.disposable" preserve="true" />
// The entry `soapfilm/worker`: the library's functions in threads of their own.
import { mustBe, optionsOf } from './check.js';
import { compile } from './compile.js';
import { kDispose } from './dispose.js';
import { notLoaded } from './errors.js';
import { flattenLoops } from './flatten.js';
import { Launcher } from './launch.js';
import { callOptionsOf, kLoadOptions, kSpanOptions } from './options.js';
import { Pool } from './pool.js';
import { tellEnd } from './report.js';
import { spanOptionsOf } from './span_input.js';
import type {
  FillOptions,
  FillResult,
  GeoJSONLike,
  GeoJSONTriangulation,
  HoleOptions,
  HoleReport,
  LoadOptions,
  LoopsLike,
  MeshInput,
  NoSpan,
  Part,
  Point2Like,
  PointLike,
  PolygonEdit,
  PolygonLike,
  PolygonOptions,
  PolygonsLike,
  PolygonsOptions,
  PolygonState,
  PolygonsTriangulation,
  PolygonTriangulation,
  SessionFillOptions,
  SmoothOptions,
  SmoothSurface,
  Span,
  SpanOptions,
} from './types.js';
import type { Change, Model, Sampling, Tessellation, TrimmedOptions } from './surface_types.js';

export { SoapfilmError } from './errors.js';

export interface WorkerOptions extends LoadOptions {
  /**
   * Most threads at once for calls. One starts with the pool, others when there is work for them. Default 1.
   * The holes of one mesh are shared out among them, with the same result for any number.
   * Sessions have threads of their own, up to as many again: no call that takes long holds up an edit, and none
   * that is cancelled costs a session. These start when they are needed, and end when they have no session.
   */
  readonly size?: number;
}

/** Options that every asynchronous call has besides those of its function. */
export interface CallOptions {
  /**
   * Ends the work at once. The call fails with `cancelled`, and the error's `cause` is the signal's reason.
   * With `bestSoFar` the call returns the best surface found so far instead, if there is one.
   */
  readonly signal?: AbortSignal;
}

/**
 * A pool of threads. Its functions are those of the package's main entry, but asynchronous. Calls start in
 * order, as threads become free. The input is checked and copied into flat arrays when the call is made;
 * these copies are transferred to the thread; of a mesh whose holes are filled, each thread at work gets one. Results are the caller's own. Errors are those of the
 * synchronous functions, `cancelled`, `disposed`, `crashed`, and `load-failed` if no thread can be started.
 * After any of them but `disposed`, the next call works.
 */
export interface Film {
  /** The listeners are called in the caller's thread. */
  spanLoops(loops: LoopsLike, options?: SpanOptions & CallOptions): Promise<Span | NoSpan>;
  triangulatePolygon(
    polygon: PolygonLike,
    options?: PolygonOptions & CallOptions,
  ): Promise<PolygonTriangulation>;
  triangulatePolygons(
    polygons: PolygonsLike,
    options?: PolygonsOptions & CallOptions,
  ): Promise<PolygonsTriangulation>;
  triangulateGeoJSON(
    geojson: GeoJSONLike,
    options?: PolygonsOptions & CallOptions,
  ): Promise<GeoJSONTriangulation>;
  /**
   * Opens a session on a polygon in a thread, the one with the fewest sessions, and keeps it there. `signal` ends
   * the opening only.
   */
  createPolygonSession(
    polygon: PolygonLike,
    options?: Pick<PolygonOptions, 'maxMemoryBytes'> & CallOptions,
  ): Promise<PolygonSessionHandle>;
  findHoles(mesh: MeshInput, options?: HoleOptions & CallOptions): Promise<HoleReport>;
  /** `onProgress` is called in the caller's thread. */
  fillHoles(mesh: MeshInput, options?: FillOptions & CallOptions): Promise<FillResult>;
  /**
   * Opens a mesh whose holes are to be filled in several calls. `signal` and `maxSeconds` are for the opening only.
   */
  createMeshSession(mesh: MeshInput, options?: HoleOptions & CallOptions): Promise<MeshSessionHandle>;
  smoothSurface(surface: MeshInput, options?: SmoothOptions & CallOptions): Promise<SmoothSurface>;
  /** Opens a trimmed model in a thread of its own. `signal` ends the opening only. */
  createTrimmedModel(model: Model, options?: TrimmedOptions & CallOptions): Promise<TrimmedModelHandle>;
  /** Ends all threads. Calls under way and later calls fail with `disposed`, and so do those of sessions. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/**
 * A `PolygonSession` of the package's main entry that lives in a thread. What it is asked is done there in the
 * order of the calls; you need not wait for one to make the next. Arguments are read when the call is made. Errors
 * are those of `PolygonSession`: a refused edit rejects, and the edits after it are done.
 *
 * A session uses little of a thread, and many share one. Each is done with before the next, so an edit waits if a
 * large polygon is just being opened in the same thread. If a thread fails, all its sessions are lost, and reject
 * with `crashed`; sessions in other threads live on.
 *
 * A session holds memory of its thread. `dispose` frees it; a session that is no longer referred to is freed in
 * time. Open sessions keep Node's process alive only while something is under way.
 */
export interface PolygonSessionHandle {
  /** The number by which errors name the session: 1 for the first that is opened in this thread or from it. */
  readonly id: number;
  /** `[3m]` the triangles, counter-clockwise, once all edits before are done. Asked for at each reading. */
  readonly triangles: Promise<Uint32Array>;
  /** Inserts a vertex into a ring, between `before` and the next one. */
  insert(before: number, point: Point2Like): Promise<PolygonEdit>;
  /** Inserts an isolated vertex inside the polygon. */
  insertPoint(point: Point2Like): Promise<PolygonEdit>;
  /** Deletes a vertex. A vertex inserted later may get its number. A ring must keep 3 vertices. */
  delete(vertex: number): Promise<PolygonEdit>;
  /** Moves a vertex of a ring, or an isolated one. */
  move(vertex: number, point: Point2Like): Promise<PolygonEdit>;
  /** All that the session holds besides the triangles, in time proportional to the polygon's size. */
  read(): Promise<PolygonState>;
  /** Ends the session. Calls before still get their answers; later ones fail with `disposed`. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/**
 * A `MeshSession` of the package's main entry whose mesh is open in the pool's threads: in one, and in as many as its
 * holes are shared out among. A call may be cancelled by its `signal`; it then ends its thread, and so does one that
 * crashes, but the session goes on: the next call opens the mesh anew, from a copy that the session keeps.
 *
 * A thread has one mesh open at a time, so calls of several sessions that take turns in one thread open theirs anew
 * each time. `dispose` frees the memory; a session that is no longer referred to is freed in time.
 */
export interface MeshSessionHandle {
  /** The number by which errors name the session: 1 for the first session that is opened in this thread or from it. */
  readonly id: number;
  /** What `findHoles` finds. */
  readonly report: HoleReport;
  /** As `fillHoles` of the pool. */
  fillHoles(options?: SessionFillOptions & CallOptions): Promise<FillResult>;
  /** Ends the session. Calls before still get their answers; later ones fail with `disposed`. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/**
 * A `TrimmedModel` of the entry `soapfilm/surfaces` that lives in a thread of its own. Calls are done in their order; you need not
 * wait for one to make the next. A call may be cancelled by its `signal`; it then ends the thread, and so does one that crashes,
 * but the model goes on: the next call opens it anew, with all poles that were moved, and the next update makes all of the mesh.
 *
 * It holds memory and a thread. `dispose` frees both; a model that is no longer referred to is freed in time. Open models keep
 * Node's process alive only while something is under way.
 */
export interface TrimmedModelHandle {
  /** The number by which errors name it: 1 for the first session that is opened in this thread or from it. */
  readonly id: number;
  tessellate(sampling?: Sampling & CallOptions): Promise<Tessellation>;
  /** As of `TrimmedModel`: from update to update it writes to the same arrays. */
  update(sampling?: Sampling & CallOptions): Promise<Change>;
  movePole(face: number, pole: number, at: PointLike, weight?: number): Promise<void>;
  moveTrim(face: number, loop: number, use: number, pole: number, at: Point2Like): Promise<void>;
  /** Ends it. Calls before still get their answers; later ones fail with `disposed`. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/**
 * Starts a pool. It needs no `load()`. A part that `load` or a pool has compiled is not compiled again.
 * @throws SoapfilmError `load-failed`, `bad-option`
 */
export async function createWorker(options: WorkerOptions = {}): Promise<Film> {
  const { size = 1, ...given } = optionsOf<WorkerOptions>(options, { ...kLoadOptions, size: true });
  if (typeof size !== 'number' || !Number.isInteger(size) || size < 1) {
    throw mustBe('bad-option', 'size', 'a whole number of threads, at least 1', size);
  }
  const modules = await compile(given as LoadOptions);
  const pool = new Pool(new Launcher(modules), size);
  await pool.start();
  const dispose = (): void => {
    pool.dispose();
  };
  // Who asks for loops alone does not fetch what is for polygons.
  const polygons = modules.polygons
    ? (await import('./worker_polygons.js')).polygonCalls(pool)
    : missing('polygons', 'triangulatePolygon', 'triangulatePolygons', 'triangulateGeoJSON', 'createPolygonSession');
  const meshes = modules.meshes
    ? (await import('./worker_meshes.js')).meshCalls(pool)
    : missing('meshes', 'findHoles', 'fillHoles', 'createMeshSession', 'smoothSurface');
  const surfaces = modules.surfaces
    ? (await import('./worker_surfaces.js')).surfaceCalls(pool, modules.surfaces)
    : missing('surfaces', 'createTrimmedModel');
  return {
    async spanLoops(loops, options = {}) {
      const input = flattenLoops(loops, true);
      const [given, signal] = callOptionsOf(options, kSpanOptions);
      const { onProgress, onBest, ...rest } = spanOptionsOf(given, input, true);
      // A bound that is proven after the latest surface came holds for that surface too, unless the bound is
      // about another space: in that one, the best cost known is higher.
      let [best, bound] = [Infinity, 0];
      const watch = {
        signal,
        onProgress:
          onProgress || rest.bestSoFar
            ? (fraction: number, cost: number, lowerBound: number) => {
                bound = cost <= best * (1 + 1e-9) ? lowerBound : 0;
                onProgress?.(fraction, cost, lowerBound);
              }
            : undefined,
        onBest: (value: unknown) => {
          [best, bound] = [(value as Span).cost, 0];
          onBest?.(value as Span);
        },
        keepsBest: rest.bestSoFar,
      };
      let span = await pool.call('spanLoops', [input, rest], watch);
      if (span.found && !span.optimal && span.lowerBound < bound) {
        span = { ...span, lowerBound: Math.min(bound, span.cost) };
      }
      tellEnd(span, onProgress);
      return span;
    },
    ...polygons,
    ...meshes,
    ...surfaces,
    dispose,
    [kDispose]: dispose,
  };
}

/** Functions that say which part they lack. */
function missing<N extends keyof Film>(part: Part, ...names: N[]): Record<N, () => Promise<never>> {
  const fail = (): Promise<never> => Promise.reject(notLoaded(part));
  return Object.fromEntries(names.map((name) => [name, fail])) as Record<N, typeof fail>;
}
