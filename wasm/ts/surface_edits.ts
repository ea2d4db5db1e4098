// Arguments of edits of a model.
import { guarded, mustBe } from './check.js';
import type { PoleMove } from './compute_surfaces.js';
import { putPoints } from './flatten.js';
import { positiveOf } from './sampling_input.js';

/** A pole's new place in space. @throws SoapfilmError `bad-option` */
export function poleMoveOf(face: unknown, pole: unknown, at: unknown, weight: unknown): PoleMove {
  const place = [numberOf('face', face), numberOf('pole', pole)];
  return { kind: 'pole', args: [...place, ...finiteOf('at', at, 3), weight === undefined ? 0 : positiveOf('weight', weight)] };
}

/** The new place of a pole of a trimming curve. @throws SoapfilmError `bad-option` */
export function trimMoveOf(face: unknown, loop: unknown, use: unknown, pole: unknown, at: unknown): PoleMove {
  const place = Object.entries({ face, loop, use, pole }).map(([name, value]) => numberOf(name, value));
  return { kind: 'trim', args: [...place, ...finiteOf('at', at, 2)] };
}

/** A number of something. */
function numberOf(name: string, value: unknown): number {
  if (Number.isInteger(value) && (value as number) >= 0 && (value as number) < 2 ** 32 - 1) return value as number;
  throw mustBe('bad-option', name, 'a number of what there is, from 0 on', value);
}

/** A point of two or three finite numbers. */
function finiteOf(name: string, point: unknown, dimension: 2 | 3): number[] {
  const at = new Float64Array(dimension);
  const isPoint = guarded('bad-option', name, () => putPoints([point], 1, dimension, true, at, 0) === 1 && at.every(Number.isFinite));
  if (!isPoint) throw mustBe('bad-option', name, `a point of ${dimension} finite numbers`, point);
  return [...at];
}
