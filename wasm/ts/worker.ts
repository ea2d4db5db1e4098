/// <reference lib="esnext.disposable" preserve="true" />
// The entry `soapfilm/worker`: the library's functions in threads of their own.
import { guarded, mustBe, optionsOf } from './check.js';
import { kDispose } from './dispose.js';
import { compile } from './compile.js';
import type { FlatPolygons } from './flat_polygons.js';
import { flattenLoops } from './flatten.js';
import { flattenGeoJSON } from './geojson.js';
import { kLoadOptions, kPolygonOptions, kPolygonsOptions, kSpanOptions } from './options.js';
import { flattenBatch, flattenPolygon, polygonOptionsOf } from './polygon_input.js';
import { Pool } from './pool.js';
import { unpackErrors } from './protocol.js';
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
  const pool = new Pool(await compile(given as LoadOptions), size);
  await pool.start();
  const dispose = (): void => {
    pool.dispose();
  };
  const several = async <T extends PolygonsTriangulation>(
    flat: FlatPolygons,
    options: PolygonsOptions & CallOptions = {},
  ): Promise<T> => {
    const { signal, ...given } = optionsOf<PolygonsOptions & CallOptions>(options, { ...kPolygonsOptions, signal: true });
    const watch = { signal: signalOf(signal) };
    return unpackErrors((await pool.call('triangulatePolygons', [flat, polygonOptionsOf(given, flat)], watch)) as T);
  };
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
      // The thread's copy is handed over.
      const positions = flat.positions.slice();
      return { ...(await several(flat, options)), positions, featureStarts };
    },
    dispose,
    [kDispose]: dispose,
  };
}

function signalOf(signal: unknown): AbortSignal | undefined {
  if (signal === undefined) return undefined;
  // Heirs of the prototype that are none throw here.
  const isSignal = (): boolean => signal instanceof AbortSignal && typeof signal.aborted === 'boolean';
  if (guarded('bad-option', 'signal', isSignal)) return signal as AbortSignal;
  throw mustBe('bad-option', 'signal', 'an AbortSignal', signal);
}
