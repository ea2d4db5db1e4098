// The names of all options, and those checks that functions share: limits, and signals.
import { amountOf, guarded, mustBe, optionsOf, type Given, type Names } from './check.js';
import type {
  CandidateList,
  FillOptions,
  HoleFillOptions,
  HoleOptions,
  LoadOptions,
  Part,
  PolygonOptions,
  PolygonsOptions,
  SessionFillOptions,
  SmoothOptions,
  SpanOptions,
  Weights,
} from './types.js';

export const kPartNames: Names<Record<Part, unknown>> = { loops: true, polygons: true, meshes: true, surfaces: true };

export const kParts = Object.keys(kPartNames) as readonly Part[];

export const kLoadOptions: Names<LoadOptions> = { parts: true, wasm: true, checks: true };

const kLimits: Names<Limits> = { maxMemoryBytes: true, maxSeconds: true };

export const kSpanOptions: Names<SpanOptions> = {
  ...kLimits,
  weights: true,
  objective: true,
  candidates: true,
  boundaryNormals: true,
  bestSoFar: true,
  onBest: true,
  startFrom: true,
  onProgress: true,
};

export const kWeights: Names<Weights> = { area: true, perimeter: true, dihedral: true };

export const kCandidateList: Names<CandidateList> = { triangles: true, weights: true };

export const kPolygonOptions: Names<PolygonOptions> = {
  ...kLimits,
  method: true,
  output: true,
  quality: true,
  verify: true,
  repair: true,
  trace: true,
  borrow: true,
};

export const kPolygonsOptions: Names<PolygonsOptions> = { ...kPolygonOptions, skipInvalid: true };

export const kHoleFillOptions: Names<HoleFillOptions> = {
  weights: true,
  candidates: true,
  fairness: true,
  density: true,
  maxNewVertices: true,
  creases: true,
};

export const kHoleOptions: Names<HoleOptions> = { ...kLimits, weld: true, onProgress: true };

export const kSmoothOptions: Names<SmoothOptions> = {
  ...kLimits,
  kind: true,
  density: true,
  maxNewVertices: true,
  fixed: true,
  boundaryNormals: true,
  onProgress: true,
};

export const kSessionFillOptions: Names<SessionFillOptions> = {
  ...kLimits,
  ...kHoleFillOptions,
  holes: true,
  groups: true,
  perHole: true,
  fillOpenRims: true,
  maxVertices: true,
  maxLength: true,
  output: true,
  onProgress: true,
  maxSecondsPerHole: true,
};

export const kFillOptions: Names<FillOptions> = { ...kHoleOptions, ...kSessionFillOptions };

export interface Limits {
  readonly maxMemoryBytes?: number;
  readonly maxSeconds?: number;
}

/**
 * The limits among the options, checked, without those that were left out.
 * @throws SoapfilmError `bad-option`
 */
export function limitsOf({ maxMemoryBytes, maxSeconds }: Given<Limits>): Limits {
  return {
    ...(maxMemoryBytes !== undefined && { maxMemoryBytes: amountOf('maxMemoryBytes', maxMemoryBytes) }),
    ...(maxSeconds !== undefined && { maxSeconds: amountOf('maxSeconds', maxSeconds) }),
  };
}

/** The options of an asynchronous call, read, and apart from them its signal, checked. */
export function callOptionsOf<T extends object>(
  options: unknown,
  names: Names<T>,
): readonly [given: Given<T>, signal: AbortSignal | undefined] {
  const all: Names<Record<string, unknown>> = { ...names, signal: true };
  const { signal, ...given } = optionsOf(options, all);
  return [given as Given<T>, signalOf(signal)];
}

function signalOf(signal: unknown): AbortSignal | undefined {
  if (signal === undefined) return undefined;
  // Objects that only inherit from the prototype throw here.
  const isSignal = (): boolean => signal instanceof AbortSignal && typeof signal.aborted === 'boolean';
  if (guarded('bad-option', 'signal', isSignal)) return signal as AbortSignal;
  throw mustBe('bad-option', 'signal', 'an AbortSignal', signal);
}
