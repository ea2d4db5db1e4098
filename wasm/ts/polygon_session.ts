/// <reference lib="esnext.disposable" preserve="true" />
// PolygonSession: a polygon that stays in the core while it is edited.
import { kDispose } from './dispose.js';
import { optionsOf } from './check.js';
import { PolygonEditor } from './compute_edits.js';
import { checkEdit, editedPolygonOf, editOf, kNoPoint, kSessionOptions, type SessionOptions } from './polygon_edits.js';
import type { Point2Like, PolygonEdit, PolygonLike, PolygonOptions, PolygonState } from './types.js';

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
  readonly #editor: PolygonEditor;

  /**
   * Vertices are numbered as in the input, and isolated `points` after them. Rings run in the directions
   * of `PolygonState.next`.
   */
  constructor(polygon: PolygonLike, options: Pick<PolygonOptions, 'maxMemoryBytes'> = {}) {
    const given = optionsOf<SessionOptions>(options, kSessionOptions);
    this.#editor = new PolygonEditor(editedPolygonOf(polygon, given));
  }

  /** The number by which errors name the session: 1 for the first that is opened in this thread or from it. */
  get id(): number {
    return this.#editor.id;
  }

  /** `[3m]` the triangles, counter-clockwise. */
  get triangles(): Uint32Array {
    return this.#editor.triangles();
  }

  /** Inserts a vertex into a ring, between `before` and the next one. */
  insert(before: number, point: Point2Like): PolygonEdit {
    return this.#edit('insert', before, point);
  }

  /** Inserts an isolated vertex inside the polygon. */
  insertPoint(point: Point2Like): PolygonEdit {
    return this.#edit('insert-isolated', 0, point);
  }

  /** Deletes a vertex. A vertex inserted later may get its number. A ring must keep 3 vertices. */
  delete(vertex: number): PolygonEdit {
    return this.#edit('delete', vertex, kNoPoint);
  }

  /** Moves a vertex of a ring, or an isolated one. */
  move(vertex: number, point: Point2Like): PolygonEdit {
    return this.#edit('move', vertex, point);
  }

  /** All that the session holds besides the triangles, in time proportional to the polygon's size. */
  read(): PolygonState {
    return this.#editor.read();
  }

  /** Frees the session's memory. Any other use of it afterwards throws `disposed`. */
  dispose(): void {
    this.#editor.dispose();
  }

  [kDispose](): void {
    this.dispose();
  }

  #edit(...args: Parameters<typeof checkEdit>): PolygonEdit {
    this.#editor.alive();
    const checked = checkEdit(...args);
    return editOf(this.#editor.edit(...checked), checked);
  }
}
