// spanLoops: options turned into the core's settings, the core's arrays into a Span.
import {
  kInsertedPlaceLength,
  kObjectiveChoices,
  kSpaceChoices,
  packSpanSettings,
  readInsertedPlace,
  readSpanArrays,
  readSpanNumbers,
  type SpanArrays,
} from './border.js';
import { optionsOf } from './check.js';
import { flattenLoops } from './flatten.js';
import { kDefaultMemoryBytes, kSpanOptions } from './options.js';
import { tellEnd } from './report.js';
import { callCore, shared } from './runtime.js';
import { spanOptionsOf } from './span_input.js';
import type { LoopSet, LoopsLike, NoSpan, Span, SpanOptions, SpaceUsed } from './types.js';

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
  const span = computeSpan(input, checked);
  tellEnd(span, checked.onProgress);
  return span;
}

/** `spanLoops` of what has been checked, but for the last call of `onProgress`. */
export function computeSpan(input: LoopSet, options: SpanOptions): Span | NoSpan {
  const { onProgress, onBest, maxSeconds, bestSoFar, boundaryNormals, candidates, startFrom: start } = options;
  const list = typeof candidates === 'object' ? candidates : undefined;
  const started = performance.now();
  const { found, arrays } = callCore(
    shared.loops,
    'sf_span_loops',
    [
      input.positions,
      input.starts,
      input.starts.length - 1,
      boundaryNormals ?? null,
      list?.triangles ?? null,
      list ? list.triangles.length / 3 : 0,
      list?.weights ?? null,
      start ?? null,
      start ? start.length / 3 : 0,
      settings(options),
    ],
    readSpanArrays,
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
  return readSpan(arrays, started);
}

function readSpan(arrays: SpanArrays, started: number): Span {
  const { positions, triangles, starts, loopVertices, order } = arrays;
  const { insertedPlaces, insertedParameters } = arrays;
  const numbers = readSpanNumbers(arrays.numbers);
  const { cost, lowerBound, area, perimeter, dihedral, worstDihedral } = numbers;
  const { candidates, domains, minimalSets, peakBytes } = numbers;
  const seconds = (performance.now() - started) / 1000;
  return {
    found: true,
    positions,
    triangles,
    starts,
    loopVertices,
    inserted: Array.from(insertedParameters, (parameter, i) => ({
      ...readInsertedPlace(insertedPlaces, kInsertedPlaceLength * i),
      parameter,
    })),
    cost,
    terms: { area, perimeter, dihedral, worstDihedral },
    lowerBound,
    optimal: numbers.optimal !== 0,
    candidates: kSpaceChoices[numbers.space] as SpaceUsed,
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
  return packSpanSettings({
    areaWeight: area,
    perimeterWeight: perimeter,
    dihedralWeight: dihedral,
    objective: kObjectiveChoices.indexOf(objective),
    space: kSpaceChoices.indexOf(typeof candidates === 'object' ? 'given' : candidates),
    maxBytes: maxMemoryBytes ?? kDefaultMemoryBytes,
    bestSoFar: Number(bestSoFar),
  });
}
