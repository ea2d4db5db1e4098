// spanLoops: options turned into the core's settings, the core's arrays into a Span.
import { optionsOf } from './check.js';
import { flattenLoops } from './flatten.js';
import { kDefaultMemoryBytes, kSpanOptions } from './options.js';
import { kObjectives, kSpaces, spanOptionsOf } from './span_input.js';
import { callCore, shared, type Arrays } from './runtime.js';
import type { LoopsLike, NoSpan, Span, SpanOptions, SpaceUsed } from './types.js';

/**
 * Spans one or more closed 3D loops with a triangulated surface of least cost: of all surfaces made
 * of candidate triangles that are manifold, connected, orientable, and have the topology of a
 * sphere with k holes (Zou, Ju, Carr 2013). Synchronous; the worker of `soapfilm/worker` offers
 * the same without blocking.
 *
 * @param loops flat arrays, or one list of points a loop; their directions matter only to
 *   `boundaryNormals`. They are read when the call begins, and left as they are
 * @returns the surface, m = n' + 2k - 4 triangles; `found: false` where the candidate space holds
 *   none, which is an ordinary outcome for Delaunay candidates of contorted loops
 * @throws SoapfilmError `not-loaded`; `no-loops`, `bad-loops`, `bad-starts`, `not-finite`,
 *   `too-few-vertices`, `repeated-vertex`, `loops-intersect` with the loop and vertex at fault;
 *   `bad-weights`, `bad-normals`, `bad-candidates`, `bad-option`; `too-large`, `out-of-memory`,
 *   `time-limit`; `crashed`. The next call works after any of them.
 */
export function spanLoops(loops: LoopsLike, options: SpanOptions = {}): Span | NoSpan {
  const input = flattenLoops(loops);
  const checked = spanOptionsOf(optionsOf(options, kSpanOptions), input, false);
  const { onProgress, onBest, maxSeconds, bestSoFar, candidates, startFrom: start } = checked;
  const list = typeof candidates === 'object' ? candidates : undefined;
  const started = performance.now();
  const { found, arrays } = callCore(
    shared.loops,
    'sf_span_loops',
    [
      input.positions,
      input.starts,
      input.starts.length - 1,
      checked.boundaryNormals ?? null,
      list?.triangles ?? null,
      list ? list.triangles.length / 3 : 0,
      list?.weights ?? null,
      start ?? null,
      start ? start.length / 3 : 0,
      settings(checked),
    ],
    kResultTypes,
    {
      onProgress,
      maxSeconds,
      keepsResult: bestSoFar,
      onResult:
        onBest &&
        ((partial) => {
          onBest(readSpan(partial, started));
        }),
    },
  );
  if (!found) {
    const { candidates, stats } = readSpan(arrays, started);
    return { found, reason: noSpanReason(candidates), candidates, stats };
  }
  const span = readSpan(arrays, started);
  onProgress?.(1, span.cost, span.lowerBound);
  return span;
}

/** The arrays of a result of `sf_span_loops`. */
const kResultTypes = [
  Float64Array,
  Uint32Array,
  Uint32Array,
  Uint32Array,
  Uint32Array,
  Float64Array,
  Uint32Array,
  Float64Array,
] as const;

function readSpan(arrays: Arrays<typeof kResultTypes>, started: number): Span {
  const [positions, triangles, order, starts, loopVertices, numbers, places, parameters] = arrays;
  const [
    ,
    space,
    cost,
    lowerBound,
    optimal,
    area,
    perimeter,
    dihedral,
    worstDihedral,
    ,
    candidates,
    domains,
    minimalSets,
    peakBytes,
  ] = numbers;
  const seconds = (performance.now() - started) / 1000;
  return {
    found: true,
    positions,
    triangles,
    starts,
    loopVertices,
    inserted: Array.from(parameters, (parameter, i) => ({
      loop: places[2 * i],
      edge: places[2 * i + 1],
      parameter,
    })),
    cost,
    terms: { area, perimeter, dihedral, worstDihedral },
    lowerBound,
    optimal: optimal !== 0,
    candidates: kSpaces[space] as SpaceUsed,
    order,
    stats: { candidates, domains, minimalSets, seconds, peakBytes },
  };
}

function noSpanReason(space: SpaceUsed): string {
  const wider: Record<SpaceUsed, string> = {
    all: 'No manifold surface spans these loops, whichever triangles it uses',
    delaunay: "The Delaunay facets hold no manifold surface; 'near' or 'all' may hold one",
    near: "Triangles between near vertices hold no manifold surface; 'all' may hold one",
    given: 'The given candidates hold no manifold surface',
  };
  return wider[space];
}

function settings({ weights, objective = 'sum', candidates = 'auto', bestSoFar, maxMemoryBytes }: SpanOptions) {
  // NaN: the core sets the default from the size of the loops.
  const { area = 0, perimeter = 0, dihedral = 0 } = weights ?? { area: NaN, dihedral: 1 };
  return Float64Array.of(
    area,
    perimeter,
    dihedral,
    kObjectives.indexOf(objective),
    kSpaces.indexOf(typeof candidates === 'object' ? 'given' : candidates),
    maxMemoryBytes ?? kDefaultMemoryBytes,
    Number(bestSoFar),
  );
}
