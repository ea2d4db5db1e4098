// What callers ask of a session on a polygon, checked for the core, and the answers in the callers' words.
// Both are the same for sessions in this thread and in others.
import { kEditActionChoices } from './border.js';
import { guarded, isIndex, mustBe, type Given, type Names } from './check.js';
import type { EditAnswer, EditedPolygon } from './compute_edits.js';
import { SoapfilmError } from './errors.js';
import { putPoints } from './flatten.js';
import { limitsOf } from './options.js';
import { flattenPolygon } from './polygon_input.js';
import type { PolygonEdit, PolygonLike, PolygonOptions } from './types.js';

export type SessionOptions = Pick<PolygonOptions, 'maxMemoryBytes'>;

export const kSessionOptions: Names<SessionOptions> = { maxMemoryBytes: true };

/**
 * A polygon for a session, checked and flat.
 * @param own whether the arrays must be copies, not views of the caller's
 * @throws SoapfilmError those of `flattenPolygon`; `bad-polygon` for one in space
 */
export function editedPolygonOf(polygon: PolygonLike, options: Given<SessionOptions>, own = false): EditedPolygon {
  const { maxMemoryBytes } = limitsOf(options);
  const { positions, ringStarts, points, dim } = flattenPolygon(polygon, own);
  if (dim === 3) {
    throw new SoapfilmError('bad-polygon', '`polygon` must have two dimensions: sessions are in the plane');
  }
  return { positions, ringStarts, points, maxMemoryBytes };
}

/** An edit as the core takes it. */
export type CheckedEdit = readonly [action: number, vertex: number, x: number, y: number];

type EditAction = (typeof kEditActionChoices)[number];

/** For edits that have no point. */
export const kNoPoint: readonly [number, number] = [0, 0];

/** @throws SoapfilmError `bad-option` */
export function checkEdit(action: EditAction, vertex: unknown, point: unknown): CheckedEdit {
  if (!isIndex(vertex)) throw mustBe('bad-option', roleIn(action), 'the number of a vertex', vertex);
  const [x, y] = coordinatesOf(point);
  return [kEditActionChoices.indexOf(action), vertex, x, y];
}

/**
 * The edit, if it was done.
 * @throws SoapfilmError why it was refused
 */
export function editOf({ edit, errors }: EditAnswer, [action, vertex]: CheckedEdit): PolygonEdit {
  if (edit) return edit;
  throw refusal(errors[0], kEditActionChoices[action], vertex);
}

/** An edit's name for the vertex that it is about. */
const roleIn = (action: EditAction): string => (action === 'insert' ? 'before' : 'vertex');

/** The two coordinates of a point. */
function coordinatesOf(point: unknown): Float64Array {
  const xy = new Float64Array(2);
  const put = guarded('bad-option', 'point', () => putPoints([point], 1, 2, true, xy, 0));
  if (put === 1) return xy;
  throw mustBe('bad-option', 'point', '[x, y] or { x, y } of numbers', point);
}

/** The error for a refused edit; it names the argument, if one is at fault. */
function refusal(error: SoapfilmError, action: EditAction, vertex: number): SoapfilmError {
  const { code, loop, vertex: culprit } = error;
  if (code === 'bad-option') {
    const what = action === 'insert' ? 'a vertex of a ring' : 'a vertex';
    return new SoapfilmError(code, `\`${roleIn(action)}\` must be the number of ${what}, and ${vertex} is none`);
  }
  if (code !== 'not-finite') return error;
  const place = { ...(loop !== undefined && { loop }), ...(culprit !== undefined && { vertex: culprit }) };
  return new SoapfilmError(code, '`point` has a coordinate that is NaN, infinite or beyond 1e150', place);
}
