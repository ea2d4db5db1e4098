// spanLoops, once its arguments are checked: makes the core's settings from them, and a Span from the core's
// arrays. Threads need only this half.
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
import { coreWeights } from './core_weights.js';
import { callCore, kDefaultMemoryBytes, shared } from './runtime.js';
import type { LoopSet, NoSpan, Span, SpanOptions, SpaceUsed } from './types.js';

/** `spanLoops` for checked arguments, without the last call of `onProgress`. */
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
  return packSpanSettings({
    ...coreWeights(weights),
    objective: kObjectiveChoices.indexOf(objective),
    space: kSpaceChoices.indexOf(typeof candidates === 'object' ? 'given' : candidates),
    maxBytes: maxMemoryBytes ?? kDefaultMemoryBytes,
    bestSoFar: Number(bestSoFar),
  });
}
