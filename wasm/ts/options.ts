// What the options of all functions have in common.
import { SoapfilmError } from './errors.js';
import type {
  CandidateList,
  LoadOptions,
  Part,
  PolygonOptions,
  PolygonsOptions,
  SpanOptions,
  Weights,
} from './types.js';

/** What the core may use unless told otherwise; WebAssembly memory ends at 4 GiB. */
const kDefaultMemoryBytes = 3 * 2 ** 30;

export const kParts: readonly Part[] = ['loops', 'polygons'];

/** The names of all options of a kind; the compiler sees to it that none is missing. */
type Names<T> = Readonly<Record<keyof T, true>>;

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

export interface Limits {
  readonly maxMemoryBytes?: number;
  readonly maxSeconds?: number;
}

/**
 * Checks that options are an object without other fields than the named ones: a misspelt option would
 * go unnoticed.
 * @param path of the option that they are the fields of, if they are, and a full stop
 * @throws SoapfilmError `bad-option`
 */
export function checkNames(options: unknown, names: Readonly<Record<string, true>>, path = ''): void {
  if (typeof options !== 'object' || options === null) {
    throw new SoapfilmError('bad-option', `\`${path.slice(0, -1) || 'options'}\` must be an object`);
  }
  const unknown = Object.keys(options).find((name) => !Object.hasOwn(names, name));
  if (unknown === undefined) return;
  const list = Object.keys(names).join(', ');
  throw new SoapfilmError('bad-option', `\`${path}${unknown}\` is not an option here; there are ${list}`);
}

/**
 * Checks the limits that every function has, and returns how many bytes the core may use.
 * @throws SoapfilmError `bad-option`
 */
export function checkLimits({ maxMemoryBytes, maxSeconds }: Limits): number {
  for (const [name, value] of Object.entries({ maxMemoryBytes, maxSeconds })) {
    if (value === undefined || (typeof value === 'number' && value >= 0)) continue;
    throw new SoapfilmError('bad-option', `\`${name}\` must be a number and not negative`);
  }
  return maxMemoryBytes ?? kDefaultMemoryBytes;
}

/** The error for an option that is none of the choices. */
export function badOption(name: string, choices: readonly unknown[], more = ''): SoapfilmError {
  const list = choices.map((c) => (typeof c === 'string' ? `'${c}'` : String(c))).join(', ');
  return new SoapfilmError('bad-option', `\`${name}\` must be one of ${list}${more}`);
}
