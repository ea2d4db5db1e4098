/// <reference lib="esnext.disposable" preserve="true" />
// PolygonSession: a polygon that stays in the core while it is edited.
import { kDispose } from './dispose.js';
import { guarded, isIndex, mustBe, optionsOf } from './check.js';
import { SoapfilmError } from './errors.js';
import { putPoints } from './flatten.js';
import { ringError } from './messages.js';
import { kDefaultMemoryBytes, limitsOf } from './options.js';
import { flattenPolygon } from './polygon_input.js';
import { callCore, Home, type Arrays, type CoreArgument } from './runtime.js';
import type { Point2Like, PolygonEdit, PolygonLike, PolygonOptions, PolygonState } from './types.js';

/** Where sessions live: apart from other calls, which may end with an instance that has to be dropped. */
let home = new Home('polygons');
let open = 0;

/** The order of the actions of `sf_session_edit`. */
const kInsert = 0;
const kInsertIsolated = 1;
const kDelete = 2;
const kMove = 3;

/** How many numbers `sf_session_edit` tells before those of the triangles. */
const kFacts = 7;

type Types = Parameters<typeof callCore>[3];

/**
 * A triangulated polygon in the plane whose vertices can be inserted, deleted and moved; the work is in
 * proportion to the triangles around the edit. Holds memory of the core until it is disposed of.
 *
 * Points are `[x, y]`, typed arrays of two numbers, or objects with `x` and `y`. Numbers of no vertex, and points
 * that are none, are `bad-option`.
 * Rings may not touch, and no two vertices have one place: codes are those of `triangulatePolygon`,
 * and `repeated-vertex`. An edit that would make the polygon invalid throws and leaves the polygon as it
 * was, if perhaps with other triangles, which the next edit's `changed` then names as well. `vertex`
 * and `otherVertex` of its error are numbers of vertices as everywhere in a session. After `crashed`, which
 * only a defect of the core can bring about, all sessions are lost, and say so when they are used.
 */
export class PolygonSession {
  readonly #home: Home;
  #number: number | undefined;
  #triangles: Uint32Array;
  #count: number;
  /** Triangles that edits have changed which were refused: the next one's to tell. */
  readonly #untold = new Set<number>();

  /**
   * Vertices are numbered as in the input, isolated `points` after them; the directions of its rings
   * are those of `PolygonState.next`.
   */
  constructor(polygon: PolygonLike, options: Pick<PolygonOptions, 'maxMemoryBytes'> = {}) {
    const limits = limitsOf(optionsOf(options, { maxMemoryBytes: true }));
    const { positions, ringStarts, points, dim } = flattenPolygon(polygon);
    if (dim === 3) {
      throw new SoapfilmError('bad-polygon', '`polygon` must have two dimensions: sessions are in the plane');
    }
    if (home.lost) [home, open] = [new Home('polygons'), 0];
    this.#home = home;
    const [[number], triangles] = this.#call(
      'sf_session_open',
      [
        positions,
        ringStarts,
        ringStarts.length - 1,
        points ?? null,
        points ? points.length / 2 : 0,
        limits.maxMemoryBytes ?? kDefaultMemoryBytes,
      ],
      [Uint32Array, Uint32Array],
    );
    this.#number = number;
    this.#triangles = triangles;
    this.#count = triangles.length;
    open++;
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

  /** Deletes a vertex; its number may be given to one inserted later. A ring keeps 3 vertices. */
  delete(vertex: number): PolygonEdit {
    return this.#edit(kDelete, 'vertex', vertex, kOrigin);
  }

  /** Moves a vertex of a ring, or an isolated one. */
  move(vertex: number, point: Point2Like): PolygonEdit {
    return this.#edit(kMove, 'vertex', vertex, point);
  }

  /** All that the session holds besides the triangles, in time proportional to the polygon's size. */
  read(): PolygonState {
    const [positions, next, strips, stripStarts, certified] = this.#call(
      'sf_session_read',
      [this.#alive()],
      [Float64Array, Uint32Array, Uint32Array, Uint32Array, Uint32Array],
    );
    return { positions, next, strips, stripStarts, certified: certified[0] === 1 };
  }

  /** Frees the session's memory. Any other use of it afterwards throws `disposed`. */
  dispose(): void {
    if (this.#number === undefined) return;
    const number = this.#number;
    this.#number = undefined;
    if (this.#home.lost) return;
    // Memory of instances never shrinks: the last session takes its instance along.
    if (--open === 0) home = new Home('polygons');
    else this.#call('sf_session_close', [number], []);
  }

  [kDispose](): void {
    this.dispose();
  }

  #alive(): number {
    if (this.#number !== undefined) return this.#number;
    throw new SoapfilmError('disposed', 'The session is disposed of');
  }

  #call<const T extends Types>(name: string, args: readonly CoreArgument[], types: T): Arrays<T> {
    return callCore(this.#home, name, args, types, { explain: ringError }).arrays;
  }

  /** @param role what the vertex is called */
  #edit(action: number, role: string, vertex: number, point: Point2Like): PolygonEdit {
    this.#alive();
    if (!isIndex(vertex)) throw mustBe('bad-option', role, 'the number of a vertex', vertex);
    const [x, y] = coordinatesOf(point);
    const [told] = this.#call(
      'sf_session_edit',
      [this.#alive(), action, vertex, x, y],
      [Uint32Array],
    );
    const triangleCount = told[1];
    const status = told[2];
    const count = (told.length - kFacts) / 4;
    // Views of one buffer, which is theirs alone: copies would take a tenth of the time of an edit.
    let changed = told.subarray(kFacts, kFacts + count);
    let triangles = told.subarray(kFacts + count);
    this.#count = 3 * triangleCount;
    if (this.#triangles.length < this.#count) {
      const larger = new Uint32Array(2 * this.#count);
      larger.set(this.#triangles);
      this.#triangles = larger;
    }
    for (let i = 0; i < count; i++) {
      const t = changed[i];
      for (let k = 0; k < 3; k++) this.#triangles[3 * t + k] = triangles[3 * i + k];
      if (status !== 0) this.#untold.add(t);
    }
    if (status !== 0) throw refusal(status, told.subarray(3, kFacts), role, vertex);
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
    return { vertex: told[0], triangleCount, changed, triangles };
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

/** The error for an edit that was refused, in words of its arguments where they are at fault. */
function refusal(status: number, where: Uint32Array, role: string, vertex: number): SoapfilmError {
  const error = ringError(status, where);
  const { code, loop, vertex: culprit } = error;
  if (code === 'bad-option') {
    const what = role === 'before' ? 'a vertex of a ring' : 'a vertex';
    return new SoapfilmError(code, `\`${role}\` must be the number of ${what}, and ${vertex} is none`);
  }
  if (code !== 'not-finite') return error;
  const place = { ...(loop !== undefined && { loop }), ...(culprit !== undefined && { vertex: culprit }) };
  return new SoapfilmError(code, '`point` has a coordinate that is NaN, infinite or beyond 1e150', place);
}
