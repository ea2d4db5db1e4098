// Options of spanLoops as callers give them, checked.
import { kObjectiveChoices, kSpaceChoices } from './border.js';
import { arrayOf, choiceOf, flagOf, functionOf, mustBe, optionsOf, type Given } from './check.js';
import { kCandidateList, kWeights, limitsOf } from './options.js';
import type { CandidateList, LoopSet, SpanOptions, Weights } from './types.js';

/**
 * The options, checked, without those that were left out.
 * @param own whether arrays must be copies, not views of the caller's
 * @throws SoapfilmError `bad-weights`, `bad-normals`, `bad-candidates`, `bad-option`
 */
export function spanOptionsOf(given: Given<SpanOptions>, input: LoopSet, own: boolean): SpanOptions {
  const { weights, objective, candidates, boundaryNormals, bestSoFar, onBest, startFrom, onProgress } = given;
  const n = input.positions.length;
  const isTriples = (length: number): boolean => length % 3 === 0;
  const checked: { -readonly [K in keyof SpanOptions]: unknown } = limitsOf(given);
  if (weights !== undefined) checked.weights = weightsOf(weights);
  checked.objective = choiceOf('objective', kObjectiveChoices, objective);
  checked.candidates =
    typeof candidates === 'object'
      ? candidatesOf(candidates, own)
      : choiceOf('candidates', kSpaceChoices.slice(0, 4), candidates, ', or { triangles }');
  if (boundaryNormals !== undefined) {
    const what = `${n} numbers, three for each vertex`;
    checked.boundaryNormals = arrayOf(
      'Float64Array', boundaryNormals, own, 'bad-normals', 'boundaryNormals', what, (length) => length === n,
    );
  }
  if (startFrom !== undefined) {
    checked.startFrom = arrayOf(
      'Uint32Array', startFrom, own, 'bad-option', 'startFrom', 'three indices for each triangle', isTriples,
    );
  }
  checked.bestSoFar = flagOf('bestSoFar', bestSoFar);
  for (const [name, listener] of Object.entries({ onBest, onProgress })) {
    const known = functionOf(name, listener);
    if (known !== undefined) checked[name as 'onBest' | 'onProgress'] = known;
  }
  return checked as SpanOptions;
}

/** @param name of the option, for messages */
export function weightsOf(given: unknown, name = 'weights'): Weights {
  const weights = optionsOf(given, kWeights, name, 'bad-weights');
  for (const [key, value] of Object.entries(weights)) {
    if (typeof value === 'number' && Number.isFinite(value) && value >= 0) continue;
    throw mustBe('bad-weights', `${name}.${key}`, 'a finite number and not negative', value);
  }
  return weights as Weights;
}

function candidatesOf(given: unknown, own: boolean): CandidateList {
  const code = 'bad-candidates';
  const { triangles: listed, weights } = optionsOf(given, kCandidateList, 'candidates', code);
  const triangles = arrayOf(
    'Uint32Array', listed, own, code, 'candidates.triangles', 'three indices for each triangle',
    (length) => length % 3 === 0,
  );
  if (weights === undefined) return { triangles };
  const fits = (length: number): boolean => 3 * length === triangles.length;
  const what = 'one number for each triangle';
  return {
    triangles,
    weights: arrayOf('Float64Array', weights, own, code, 'candidates.weights', what, fits),
  };
}
