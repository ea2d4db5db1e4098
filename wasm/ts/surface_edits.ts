// Arguments of edits of a model.
import { guarded, mustBe } from './check.js';
import { putPoints } from './flatten.js';
import type { PointLike } from './types.js';

/** A number of something. @throws SoapfilmError `bad-option` */
export function numberOf(name: string, value: unknown): number {
  if (Number.isInteger(value) && (value as number) >= 0 && (value as number) < 2 ** 32 - 1) return value as number;
  throw mustBe('bad-option', name, 'a number of what there is, from 0 on', value);
}

/** A point of two or three finite numbers. @throws SoapfilmError `bad-option` */
export function finiteOf(name: string, point: PointLike, dimension: 2 | 3): number[] {
  const at = new Float64Array(dimension);
  const isPoint = guarded('bad-option', name, () => putPoints([point], 1, dimension, true, at, 0) === 1 && at.every(Number.isFinite));
  if (!isPoint) throw mustBe('bad-option', name, `a point of ${dimension} finite numbers`, point);
  return [...at];
}
