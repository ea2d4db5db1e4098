/// <reference lib="esnext.disposable" preserve="true" />
// PolygonSession: a polygon that stays in the core while it is edited.
import {
  kEditActionChoices,
  kEditFactsLength,
  readEditArrays,
  readEditFacts,
  readOpenedArrays,
  readStateArrays,
  Status,
  type ArrayReader,
} from './border.js';
import { kDispose } from './dispose.js';
import { guarded, isIndex, mustBe, optionsOf } from './check.js';
import { SoapfilmError } from './errors.js';
import { putPoints } from './flatten.js';
import { ringError } from './messages.js';
import { limitsOf } from './options.js';
import { flattenPolygon } from './polygon_input.js';
import { kDefaultMemoryBytes, type CoreArgument } from './runtime.js';
import { Session } from './session.js';
import type { Point2Like, PolygonEdit, PolygonLike, PolygonOptions, PolygonState } from './types.js';

const kWatch = { explain: ringError };

const kInsert = kEditActionChoices.indexOf('insert');
const kInsertIsolated = kEditActionChoices.indexOf('insert-isolated');
const kDelete = kEditActionChoices.indexOf('delete');
const kMove = kEditActionChoices.indexOf('move');

/**
 * A triangulated polygon in the plane whose vertices can be inserted, deleted and moved. The work of an edit
 * is in proportion to the triangles around it.
 *
 * Points are `[x, y]`, typed arrays of two numbers, or objects with `x` and `y`. Anything else as a point,
 * and a number that no vertex has, is a `bad-option`.
 *
 * Rings may not touch, and no two vertices may have the same place. Errors have the codes of
 * `triangulatePolygon`, and `repeated-vertex`. An edit that would make the polygon invalid throws, and
 * leaves the polygon as it was. It may leave other triangles, though; the next edit's `changed` then names
 * these too. In errors of edits, `vertex` and `otherVertex` are the session's numbers of vertices.
 *
 * Only a defect of the core can cause `crashed`. The session is then lost, and so are all sessions that share
 * its memory. Sessions share memory only if more than 32 are open, or if the engine has no room for more
 * instances of the core. The error names the lost sessions by their `id`. Using one of them later throws
 * `crashed` again.
 *
 * A session holds memory of the core. `dispose` frees it at once; a session that is no longer referred to is
 * freed in time.
 */
export class PolygonSession {
  readonly #session: Session;
  #triangles: Uint32Array;
  #count: number;
  /** Triangles that refused edits have changed. The next edit that succeeds names them. */
  readonly #untold = new Set<number>();

  /**
   * Vertices are numbered as in the input, and isolated `points` after them. Rings run in the directions
   * of `PolygonState.next`.
   */
  constructor(polygon: PolygonLike, options: Pick<PolygonOptions, 'maxMemoryBytes'> = {}) {
    const limits = limitsOf(optionsOf(options, { maxMemoryBytes: true }));
    const { positions, ringStarts, points, dim } = flattenPolygon(polygon);
    if (dim === 3) {
      throw new SoapfilmError('bad-polygon', '`polygon` must have two dimensions: sessions are in the plane');
    }
    this.#session = new Session('polygons', 'sf_session_close');
    const { triangles } = this.#session.open(
      this,
      'sf_session_open',
      [
        positions,
        ringStarts,
        ringStarts.length - 1,
        points ?? null,
        points ? points.length / 2 : 0,
        limits.maxMemoryBytes ?? kDefaultMemoryBytes,
      ],
      readOpenedArrays,
      ({ session }) => session[0],
      kWatch,
    );
    this.#triangles = triangles;
    this.#count = triangles.length;
  }

  /** The number by which errors name the session: 1 for the first in this thread. */
  get id(): number {
    return this.#session.id;
  }

  /** `[3m]` the triangles, counter-clockwise. */
  get triangles(): Uint32Array {
    this.#alive();
    return this.#triangles.slice(0, this.#count);
  }

  /** Inserts a vertex into a ring, between `before` and the next one. */
  insert(before: number, point: Point2Like): PolygonEdit {
    return this.#edit(kInsert, 'before', before, point);
  }

  /** Inserts an isolated vertex inside the polygon. */
  insertPoint(point: Point2Like): PolygonEdit {
    return this.#edit(kInsertIsolated, '', 0, point);
  }

  /** Deletes a vertex. A vertex inserted later may get its number. A ring must keep 3 vertices. */
  delete(vertex: number): PolygonEdit {
    return this.#edit(kDelete, 'vertex', vertex, kOrigin);
  }

  /** Moves a vertex of a ring, or an isolated one. */
  move(vertex: number, point: Point2Like): PolygonEdit {
    return this.#edit(kMove, 'vertex', vertex, point);
  }

  /** All that the session holds besides the triangles, in time proportional to the polygon's size. */
  read(): PolygonState {
    const { certified, ...state } = this.#call('sf_session_read', [this.#alive()], readStateArrays);
    return { ...state, certified: certified[0] === 1 };
  }

  /** Frees the session's memory. Any other use of it afterwards throws `disposed`. */
  dispose(): void {
    this.#session.dispose();
  }

  [kDispose](): void {
    this.dispose();
  }

  #alive(): number {
    return this.#session.number;
  }

  #call<T>(name: string, args: readonly CoreArgument[], read: (array: ArrayReader) => T): T {
    return this.#session.call(name, args, read, kWatch);
  }

  /** @param role the argument's name for the vertex */
  #edit(action: number, role: string, vertex: number, point: Point2Like): PolygonEdit {
    this.#alive();
    if (!isIndex(vertex)) throw mustBe('bad-option', role, 'the number of a vertex', vertex);
    const [x, y] = coordinatesOf(point);
    const { edit } = this.#call(
      'sf_session_edit',
      [this.#alive(), action, vertex, x, y],
      readEditArrays,
    );
    const facts = readEditFacts(edit);
    const { triangleCount, status } = facts;
    const count = (edit.length - kEditFactsLength) / 4;
    // Views of one buffer that nothing else uses: copies would take a tenth of the time of an edit.
    let changed = edit.subarray(kEditFactsLength, kEditFactsLength + count);
    let triangles = edit.subarray(kEditFactsLength + count);
    this.#count = 3 * triangleCount;
    if (this.#triangles.length < this.#count) {
      const larger = new Uint32Array(2 * this.#count);
      larger.set(this.#triangles);
      this.#triangles = larger;
    }
    for (let i = 0; i < count; i++) {
      const t = changed[i];
      for (let k = 0; k < 3; k++) this.#triangles[3 * t + k] = triangles[3 * i + k];
      if (status !== Status.Ok) this.#untold.add(t);
    }
    if (status !== Status.Ok) {
      throw refusal(ringError(status, { ...facts, vertex: facts.atVertex }), role, vertex);
    }
    if (this.#untold.size > 0) {
      const names = new Set([...this.#untold, ...changed]);
      changed = Uint32Array.from(names)
        .filter((t) => t < triangleCount)
        .sort();
      triangles = new Uint32Array(3 * changed.length);
      let at = 0;
      for (const t of changed) for (let k = 0; k < 3; k++) triangles[at++] = this.#triangles[3 * t + k];
      this.#untold.clear();
    }
    return { vertex: facts.vertex, triangleCount, changed, triangles };
  }
}

const kOrigin = [0, 0];

/** The two coordinates of a point. */
function coordinatesOf(point: unknown): Float64Array {
  const xy = new Float64Array(2);
  const put = guarded('bad-option', 'point', () => putPoints([point], 1, 2, true, xy, 0));
  if (put === 1) return xy;
  throw mustBe('bad-option', 'point', '[x, y] or { x, y } of numbers', point);
}

/** The error for a refused edit; it names the argument, if one is at fault. */
function refusal(error: SoapfilmError, role: string, vertex: number): SoapfilmError {
  const { code, loop, vertex: culprit } = error;
  if (code === 'bad-option') {
    const what = role === 'before' ? 'a vertex of a ring' : 'a vertex';
    return new SoapfilmError(code, `\`${role}\` must be the number of ${what}, and ${vertex} is none`);
  }
  if (code !== 'not-finite') return error;
  const place = { ...(loop !== undefined && { loop }), ...(culprit !== undefined && { vertex: culprit }) };
  return new SoapfilmError(code, '`point` has a coordinate that is NaN, infinite or beyond 1e150', place);
}
