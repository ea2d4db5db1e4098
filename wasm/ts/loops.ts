// spanLoops: options checked and turned into the core's settings, the core's arrays into a Span.
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
import { SoapfilmError } from './errors.js';
import { toLoopSet } from './loopset.js';
import {
  badOption,
  checkLimits,
  checkNames,
  kCandidateList,
  kSpanOptions,
  kWeights,
} from './options.js';
import { tellEnd } from './report.js';
import { callCore, shared } from './runtime.js';
import type {
  CandidateList,
  LoopSet,
  LoopsLike,
  NoSpan,
  Span,
  SpanOptions,
  SpaceUsed,
  Weights,
} from './types.js';

/**
 * Spans one or more closed 3D loops with a triangulated surface of least cost: of all surfaces made
 * of candidate triangles that are manifold, connected, orientable, and have the topology of a
 * sphere with k holes (Zou, Ju, Carr 2013). Synchronous; the worker of `soapfilm/worker` offers
 * the same without blocking.
 *
 * @param loops flat arrays, or one array of points a loop; their directions matter only to
 *   `boundaryNormals`
 * @returns the surface, m = n' + 2k - 4 triangles; `found: false` where the candidate space holds
 *   none, which is an ordinary outcome for Delaunay candidates of contorted loops
 * @throws SoapfilmError `not-loaded`; `no-loops`, `bad-loops`, `bad-starts`, `not-finite`,
 *   `too-few-vertices`, `repeated-vertex`, `loops-intersect` with the loop and vertex at fault;
 *   `bad-weights`, `bad-normals`, `bad-candidates`, `bad-option`; `too-large`, `out-of-memory`,
 *   `time-limit`; `crashed`. The next call works after any of them.
 */
export function spanLoops(loops: LoopsLike, options: SpanOptions = {}): Span | NoSpan {
  const span = computeSpan(loops, options);
  tellEnd(span, options.onProgress);
  return span;
}

/** `spanLoops`, but for the last call of `onProgress`. */
export function computeSpan(loops: LoopsLike, options: SpanOptions = {}): Span | NoSpan {
  const input = toLoopSet(loops);
  checkNames(options, kSpanOptions);
  const maxBytes = checkLimits(options);
  const { onProgress, onBest, maxSeconds, bestSoFar = false } = options;
  checkCalls(options);
  const list = typeof options.candidates === 'object' ? checkList(options.candidates) : undefined;
  const start = checkStart(options.startFrom);
  const started = performance.now();
  const { found, arrays } = callCore(
    shared.loops,
    'sf_span_loops',
    [
      input.positions,
      input.starts,
      input.starts.length - 1,
      checkNormals(options.boundaryNormals, input),
      list?.triangles ?? null,
      list ? list.triangles.length / 3 : 0,
      list?.weights ?? null,
      start,
      start ? start.length / 3 : 0,
      settings(options, maxBytes),
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

function settings(
  { weights, objective = 'sum', candidates, bestSoFar = false }: SpanOptions,
  maxBytes: number,
) {
  const space = typeof candidates === 'object' ? 'given' : (candidates ?? 'auto');
  const spaceIndex = kSpaceChoices.indexOf(space);
  const objectiveIndex = kObjectiveChoices.indexOf(objective);
  if (objectiveIndex < 0) throw badOption('objective', kObjectiveChoices);
  if (spaceIndex < 0 || candidates === ('given' as string)) {
    throw badOption('candidates', kSpaceChoices.slice(0, 4), ', or { triangles }');
  }
  // NaN: the core sets the default from the size of the loops.
  if (weights) checkNames(weights, kWeights, 'weights.');
  const { area = 0, perimeter = 0, dihedral = 0 } = weights ?? { area: NaN, dihedral: 1 };
  if (weights) checkWeights({ area, perimeter, dihedral });
  return packSpanSettings({
    areaWeight: area,
    perimeterWeight: perimeter,
    dihedralWeight: dihedral,
    objective: objectiveIndex,
    space: spaceIndex,
    maxBytes,
    bestSoFar: Number(bestSoFar),
  });
}

function checkWeights(weights: Required<Weights>): void {
  for (const [name, value] of Object.entries(weights)) {
    if (!Number.isFinite(value) || value < 0) {
      throw new SoapfilmError(
        'bad-weights',
        `The weight of \`${name}\` must be a finite number and not negative, not ${String(value)}`,
      );
    }
  }
}

function checkCalls(options: SpanOptions): void {
  const { bestSoFar } = options;
  if (bestSoFar !== undefined && typeof bestSoFar !== 'boolean') {
    throw new SoapfilmError('bad-option', '`bestSoFar` must be true or false');
  }
  for (const name of ['onProgress', 'onBest'] as const) {
    if (options[name] !== undefined && typeof options[name] !== 'function') {
      throw new SoapfilmError('bad-option', `\`${name}\` must be a function`);
    }
  }
}

function checkStart(start: Uint32Array | undefined): Uint32Array | null {
  if (start === undefined) return null;
  if (!(start instanceof Uint32Array) || start.length % 3 !== 0) {
    throw new SoapfilmError(
      'bad-option',
      '`startFrom` must be a Uint32Array of three indices for each triangle',
    );
  }
  return start;
}

function checkList(list: CandidateList | null): CandidateList {
  const bad = (message: string) => new SoapfilmError('bad-candidates', message);
  const { triangles, weights } = list ?? {};
  if (list) checkNames(list, kCandidateList, 'candidates.');
  if (!(triangles instanceof Uint32Array) || triangles.length % 3 !== 0) {
    throw bad('`candidates.triangles` must be a Uint32Array of three indices for each triangle');
  }
  if (weights === undefined) return { triangles };
  if (!(weights instanceof Float64Array) || 3 * weights.length !== triangles.length) {
    throw bad('`candidates.weights` must be a Float64Array of one number for each triangle');
  }
  return { triangles, weights };
}

function checkNormals(normals: Float64Array | undefined, input: LoopSet): Float64Array | null {
  if (normals === undefined) return null;
  if (!(normals instanceof Float64Array) || normals.length !== input.positions.length) {
    throw new SoapfilmError(
      'bad-normals',
      `\`boundaryNormals\` must be a Float64Array of ${input.positions.length} numbers, ` +
        'three for each vertex',
    );
  }
  return normals;
}
