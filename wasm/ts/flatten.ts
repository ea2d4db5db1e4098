// Points and offsets as flat arrays, the only form that the core takes. Callers have them in many forms:
// arrays of triples, typed arrays, objects with x, y and z.
import { SoapfilmError, type ErrorCode, type ErrorPlace } from './errors.js';
import { fieldsOf, guarded, isIndex, kindOf, mustBe, show, viewOf } from './check.js';
import type { LoopsLike, LoopSet } from './types.js';

/** More vertices than fit into WebAssembly's memory. */
const kMostVertices = 2 ** 27;

/** Lists of points, as flat arrays. */
export interface FlatLists {
  /** `[size · n]` */
  readonly positions: Float64Array;
  /** `[k + 1]` where each list begins, in points. */
  readonly starts: Uint32Array;
  /** How many coordinates a point has. */
  readonly size: 2 | 3;
}

/** The place of a list, or of a point in it: in words, and as fields of an error. */
export type PlaceOf = (list: number, vertex?: number) => { readonly text: string; readonly place: ErrorPlace };

const floatsOf = (value: unknown): Float64Array | Float32Array | undefined =>
  viewOf(['Float64Array', 'Float32Array'], value);

/**
 * Copies lists of points into flat arrays. A list is an array of points, each an array of numbers or an
 * object with the fields x, y and z, or it is one Float64Array or Float32Array of all coordinates.
 *
 * @param size how many coordinates a point has; undefined: 2 or 3, as the first point has
 * @param exact whether a point with more of them is an error
 * @throws SoapfilmError `code`, with the place of the first value that is not a list or a point;
 *   `too-large`, `out-of-memory`
 */
export function flattenLists(
  lists: readonly unknown[],
  size: 2 | 3 | undefined,
  exact: boolean,
  code: ErrorCode,
  placeOf: PlaceOf,
): FlatLists {
  let at = 0;
  const fail = (
    vertex: number | undefined,
    what: string,
    cause?: unknown,
    as: ErrorCode = code,
  ): SoapfilmError => {
    const { text, place } = placeOf(at, vertex);
    return new SoapfilmError(as, `${text} ${what}`, place, cause === undefined ? undefined : { cause });
  };
  try {
    const dim = size ?? sizeOf(lists);
    const starts = [0];
    let n = 0;
    for (at = 0; at < lists.length; at++) {
      const count = countOf(lists[at], dim);
      if (!isIndex(count)) throw fail(undefined, `must be an array of points, not ${show(lists[at])}`);
      n += count;
      if (n > kMostVertices) {
        throw fail(undefined, `brings the vertices to more than ${kMostVertices}`, undefined, 'too-large');
      }
      starts.push(n);
    }
    const positions = allocate(dim * n);
    for (at = 0; at + 1 < starts.length; at++) {
      const count = starts[at + 1] - starts[at];
      const put = putPoints(lists[at], count, dim, exact, positions, dim * starts[at]);
      if (put === count) continue;
      throw fail(put, `must be ${dim === 2 ? '[x, y] or { x, y }' : '[x, y, z] or { x, y, z }'} of numbers`);
    }
    return { positions, starts: Uint32Array.from(starts), size: dim };
  } catch (cause) {
    // Getters and proxies may throw anything.
    throw cause instanceof SoapfilmError ? cause : fail(undefined, 'cannot be read', cause);
  }
}

/** How many points a list holds; NaN if it is not a list. */
function countOf(list: unknown, size: number): number {
  return Array.isArray(list) ? list.length : (floatsOf(list)?.length ?? NaN) / size;
}

/** How many coordinates the first point has: 3, or else 2. */
function sizeOf(lists: readonly unknown[]): 2 | 3 {
  const list = lists.find((list) => !Array.isArray(list) || list.length > 0);
  const point: unknown = Array.isArray(list) ? list[0] : undefined;
  if (Array.isArray(point) || isFloats(point)) return (point as readonly unknown[]).length === 3 ? 3 : 2;
  // Objects may have a `length` that means something else, as three's vectors do.
  return (Object(point) as { readonly z?: unknown }).z === undefined ? 2 : 3;
}

function allocate(length: number): Float64Array {
  try {
    return new Float64Array(length);
  } catch (cause) {
    throw new SoapfilmError('out-of-memory', 'The input does not fit into memory', undefined, { cause });
  }
}

function isFloats(value: unknown): boolean {
  const kind = kindOf(value);
  return kind === 'Float64Array' || kind === 'Float32Array';
}

/**
 * Writes the points of a list one after the other into `out`, from index `begin` on. Returns the index of the
 * first value that is not a point, or `count` if all are points. Throws what getters of the points throw.
 */
export function putPoints(
  list: unknown,
  count: number,
  size: 2 | 3,
  exact: boolean,
  out: Float64Array,
  begin: number,
): number {
  if (!Array.isArray(list)) {
    const floats = floatsOf(list);
    // Its length may have changed since the points were counted.
    if (floats?.length !== size * count) return 0;
    out.set(floats, begin);
    return count;
  }
  const points = list as readonly unknown[];
  let next = begin;
  for (let i = 0; i < count; i++) {
    const point = points[i];
    let x: unknown;
    let y: unknown;
    let z: unknown = 0;
    if (Array.isArray(point) || isFloats(point)) {
      const numbers = point as readonly unknown[];
      const length = numbers.length;
      if (exact ? length !== size : !(length >= size)) return i;
      x = numbers[0];
      y = numbers[1];
      if (size === 3) z = numbers[2];
    } else if (typeof point === 'object' && point !== null) {
      const fields = point as { readonly x?: unknown; readonly y?: unknown; readonly z?: unknown };
      x = fields.x;
      y = fields.y;
      if (size === 3) z = fields.z;
      else if (exact && fields.z !== undefined) return i;
    } else return i;
    if (typeof x !== 'number' || typeof y !== 'number' || typeof z !== 'number') return i;
    out[next++] = x;
    out[next++] = y;
    if (size === 3) out[next++] = z;
  }
  return count;
}

/**
 * Coordinates that are flat already, as a Float64Array: the caller's memory, or with `own` a copy.
 * @throws SoapfilmError `code`
 */
export function flatPositions(
  value: unknown,
  size: number,
  own: boolean,
  code: ErrorCode,
  name: string,
): Float64Array {
  return guarded(code, name, () => {
    const view = floatsOf(value);
    if (!view || view.length % size !== 0) {
      throw mustBe(code, name, `a Float64Array or Float32Array of ${size} numbers for each vertex`, value);
    }
    return view instanceof Float64Array && !own ? view : new Float64Array(view);
  });
}

/** A copy of a list of whole numbers. Allocates as it reads, since the list's `length` may be false. */
export function indicesOf(list: ArrayLike<unknown>, name: string): Uint32Array {
  const indices: number[] = [];
  for (let i = 0; i < list.length; i++) {
    const index = list[i];
    if (!isIndex(index)) throw mustBe('bad-starts', `${name}[${i}]`, 'a whole number', index);
    indices.push(index);
  }
  return Uint32Array.from(indices);
}

/**
 * A copy of offsets, which must begin with 0, never fall, and end with `last`.
 * @throws SoapfilmError `code` for what is not a list; `bad-starts` (`.loop`) for wrong offsets
 */
export function flatStarts(value: unknown, last: number, code: ErrorCode, name: string): Uint32Array {
  const bad = (text: string, place?: ErrorPlace): SoapfilmError =>
    new SoapfilmError('bad-starts', text, place);
  const starts = guarded(code, name, () => {
    const list = Array.isArray(value) ? (value as readonly unknown[]) : viewOf(['Uint32Array'], value);
    if (!list) throw mustBe(code, name, 'a Uint32Array or an array of whole numbers', value);
    return indicesOf(list, name);
  });
  if (starts.length === 0 || starts[0] !== 0) throw bad(`\`${name}\` must begin with 0`);
  for (let i = 0; i + 1 < starts.length; i++) {
    if (starts[i + 1] < starts[i]) throw bad(`\`${name}\` falls after entry ${i}`, { loop: i });
  }
  const end = starts[starts.length - 1];
  if (end !== last) throw bad(`\`${name}\` must end with ${last}, not with ${end}`);
  return starts;
}

/**
 * Loops in any form, as flat arrays. Checks that `starts` and `positions` fit each other, but does not check
 * the coordinates.
 *
 * @param own whether the arrays must be copies, not views of the caller's
 * @throws SoapfilmError `bad-loops` (`.loop`, `.vertex`), `bad-starts` (`.loop`); `too-large`,
 *   `out-of-memory`
 */
export function flattenLoops(loops: LoopsLike, own = false): LoopSet {
  const code = 'bad-loops';
  if (guarded(code, 'loops', () => Array.isArray(loops))) {
    return flattenLists(loops as readonly unknown[], 3, true, code, placeInLoops);
  }
  const given = fieldsOf<LoopSet>(loops, { positions: true, starts: true }, 'loops', code);
  const positions = flatPositions(given.positions, 3, own, code, 'loops.positions');
  const n = positions.length / 3;
  const starts =
    given.starts === undefined
      ? Uint32Array.of(0, n)
      : flatStarts(given.starts, n, code, 'loops.starts');
  return { positions, starts };
}

function placeInLoops(loop: number, vertex?: number): ReturnType<PlaceOf> {
  return vertex === undefined
    ? { text: `Loop ${loop} of \`loops\``, place: { loop } }
    : { text: `Loop ${loop}, vertex ${vertex} of \`loops\``, place: { loop, vertex } };
}
