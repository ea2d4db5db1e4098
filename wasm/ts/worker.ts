/// <reference lib="esnext.disposable" preserve="true" />
// The entry `soapfilm/worker`: the library's functions in threads of their own.
import { SoapfilmError } from './errors.js';
import { kDispose } from './dispose.js';
import { compile } from './compile.js';
import { checkNames, kLoadOptions, kPolygonOptions, kPolygonsOptions, kSpanOptions } from './options.js';
import { Pool } from './pool.js';
import { tellEnd } from './report.js';
import { unpackErrors, type Calls } from './protocol.js';
import type {
  GeoJSONLike,
  GeoJSONTriangulation,
  LoadOptions,
  LoopsLike,
  NoSpan,
  PolygonBatch,
  PolygonLike,
  PolygonOptions,
  PolygonsOptions,
  PolygonsTriangulation,
  PolygonTriangulation,
  Ring,
  Span,
  SpanOptions,
} from './types.js';

export { SoapfilmError } from './errors.js';

export interface WorkerOptions extends LoadOptions {
  /** Threads at most, each started when there is work for it. Default 1. */
  readonly size?: number;
}

/** What every asynchronous call takes besides the options of its function. */
export interface CallOptions {
  /**
   * Ends the work at once with `cancelled`; the signal's reason is the error's `cause`. With
   * `bestSoFar` it ends with the best surface found until then, if there is one.
   */
  readonly signal?: AbortSignal;
}

/**
 * A pool of threads. Its functions are like those of the package's main entry. Calls start in order as
 * threads become free. Input is copied when the call is made; results are the caller's own. Errors are those of the synchronous functions, and
 * `cancelled`, `disposed`, `crashed`; after any of them but `disposed` the next call works.
 */
export interface Film {
  /** Its listeners are called in this thread. */
  spanLoops(loops: LoopsLike, options?: SpanOptions & CallOptions): Promise<Span | NoSpan>;
  triangulatePolygon(
    polygon: PolygonLike,
    options?: PolygonOptions & CallOptions,
  ): Promise<PolygonTriangulation>;
  triangulatePolygons(
    polygons: PolygonBatch | readonly (readonly Ring[])[],
    options?: PolygonsOptions & CallOptions,
  ): Promise<PolygonsTriangulation>;
  triangulateGeoJSON(
    geojson: GeoJSONLike,
    options?: PolygonsOptions & CallOptions,
  ): Promise<GeoJSONTriangulation>;
  /** Ends all threads; calls under way, and later ones, are rejected with `disposed`. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/**
 * Starts a pool. Needs no `load()`, and shares what either compiles with it.
 * @throws SoapfilmError `load-failed`, `bad-option`
 */
export async function createWorker(options: WorkerOptions = {}): Promise<Film> {
  checkNames(options, { ...kLoadOptions, size: true });
  const { size = 1 } = options;
  if (!Number.isInteger(size) || size < 1) {
    throw new SoapfilmError('bad-option', '`size` is a whole number of threads, at least 1');
  }
  const pool = new Pool(await compile(options), size);
  await pool.start();
  const dispose = (): void => {
    pool.dispose();
  };
  const several =
    <T extends PolygonsTriangulation>(name: 'triangulatePolygons' | 'triangulateGeoJSON') =>
    async (input: Parameters<Calls[typeof name]>[0], options: PolygonsOptions & CallOptions = {}) => {
      checkNames(options, { ...kPolygonsOptions, signal: true });
      const { signal, ...rest } = options;
      const call = [input, rest] as Parameters<Calls[typeof name]>;
      return unpackErrors((await pool.call(name, call, { signal })) as T);
    };
  return {
    async spanLoops(loops, options = {}) {
      checkNames(options, { ...kSpanOptions, signal: true });
      const { signal, onProgress, onBest, ...rest } = options;
      // What is proven after the last surface was heard of holds for it as well.
      let bound = 0;
      const watch = {
        signal,
        onProgress:
          onProgress || rest.bestSoFar
            ? (fraction: number, cost: number, lowerBound: number) => {
                bound = lowerBound;
                onProgress?.(fraction, cost, lowerBound);
              }
            : undefined,
        onBest: (value: unknown) => {
          bound = 0;
          onBest?.(value as Span);
        },
        keepsBest: rest.bestSoFar,
      };
      let span = (await pool.call('spanLoops', [loops, rest], watch)) as Span | NoSpan;
      if (span.found && !span.optimal && span.lowerBound < bound) {
        span = { ...span, lowerBound: Math.min(bound, span.cost) };
      }
      tellEnd(span, onProgress);
      return span;
    },
    async triangulatePolygon(polygon, options = {}) {
      checkNames(options, { ...kPolygonOptions, signal: true });
      const { signal, ...rest } = options;
      const result = await pool.call('triangulatePolygon', [polygon, rest], { signal });
      return result as PolygonTriangulation;
    },
    triangulatePolygons: several<PolygonsTriangulation>('triangulatePolygons'),
    triangulateGeoJSON: several<GeoJSONTriangulation>('triangulateGeoJSON'),
    dispose,
    [kDispose]: dispose,
  };
}
