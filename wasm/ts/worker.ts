/// <reference lib="esnext.disposable" preserve="true" />
// The entry `soapfilm/worker`: the library's functions in threads of their own.
import { mustBe, optionsOf } from './check.js';
import { compile } from './compile.js';
import { kDispose } from './dispose.js';
import { notLoaded } from './errors.js';
import { flattenLoops } from './flatten.js';
import { kLoadOptions, kSpanOptions, signalOf } from './options.js';
import { Pool } from './pool.js';
import { tellEnd } from './report.js';
import { spanOptionsOf } from './span_input.js';
import type {
  GeoJSONLike,
  GeoJSONTriangulation,
  LoadOptions,
  LoopsLike,
  NoSpan,
  PolygonLike,
  PolygonOptions,
  PolygonsLike,
  PolygonsOptions,
  PolygonsTriangulation,
  PolygonTriangulation,
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
 * threads become free. Input is checked and copied into flat arrays when the call is made, and those are
 * handed over to the thread; results are the caller's own. Errors are those of the synchronous functions,
 * and `cancelled`, `disposed`, `crashed`; after any of them but `disposed` the next call works.
 */
export interface Film {
  /** Its listeners are called in this thread. */
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
  /** Ends all threads; calls under way, and later ones, are rejected with `disposed`. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/**
 * Starts a pool. Needs no `load()`, and shares what either compiles with it.
 * @throws SoapfilmError `load-failed`, `bad-option`
 */
export async function createWorker(options: WorkerOptions = {}): Promise<Film> {
  const { size = 1, ...given } = optionsOf<WorkerOptions>(options, { ...kLoadOptions, size: true });
  if (typeof size !== 'number' || !Number.isInteger(size) || size < 1) {
    throw mustBe('bad-option', 'size', 'a whole number of threads, at least 1', size);
  }
  const modules = await compile(given as LoadOptions);
  const pool = new Pool(modules, size);
  await pool.start();
  const dispose = (): void => {
    pool.dispose();
  };
  // Who asks for loops alone does not fetch what is for polygons.
  const polygons = modules.polygons
    ? (await import('./worker_polygons.js')).polygonCalls(pool)
    : { triangulatePolygon: missing, triangulatePolygons: missing, triangulateGeoJSON: missing };
  return {
    async spanLoops(loops, options = {}) {
      const input = flattenLoops(loops, true);
      const { signal, ...given } = optionsOf<SpanOptions & CallOptions>(options, { ...kSpanOptions, signal: true });
      const { onProgress, onBest, ...rest } = spanOptionsOf(given, input, true);
      // What is proven after the last surface was heard of holds for it as well, unless that is about another
      // space, in which no surface is known that costs as little.
      let [best, bound] = [Infinity, 0];
      const watch = {
        signal: signalOf(signal),
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
      let span = (await pool.call('spanLoops', [input, rest], watch)) as Span | NoSpan;
      if (span.found && !span.optimal && span.lowerBound < bound) {
        span = { ...span, lowerBound: Math.min(bound, span.cost) };
      }
      tellEnd(span, onProgress);
      return span;
    },
    ...polygons,
    dispose,
    [kDispose]: dispose,
  };
}

const missing = (): Promise<never> => Promise.reject(notLoaded('polygons'));
