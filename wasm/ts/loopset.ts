// Loops in the one form that the core takes.
import { SoapfilmError } from './errors.js';
import type { LoopSet, LoopsLike } from './types.js';

/**
 * The loops as flat arrays: the given ones if they are flat, else new ones. What `starts` and
 * `positions` say of each other is checked; the coordinates are not.
 *
 * @throws SoapfilmError `bad-loops` (`.loop`, `.vertex`), `bad-starts` (`.loop`)
 */
export function toLoopSet(loops: LoopsLike): LoopSet {
  const given: unknown = loops;
  if (isList(given)) return flatten(given);
  if (!isLoopSet(given)) {
    throw new SoapfilmError(
      'bad-loops',
      'Loops are an array of arrays of [x, y, z], or a Float64Array `positions` ' +
        'with a Uint32Array `starts`',
    );
  }
  checkStarts(given);
  return given;
}

function flatten(loops: ArrayLike<unknown>): LoopSet {
  const starts = new Uint32Array(loops.length + 1);
  const coordinates: number[] = [];
  for (let loop = 0; loop < loops.length; loop++) {
    const points = loops[loop];
    if (!isList(points)) {
      throw new SoapfilmError('bad-loops', `Loop ${loop} is not an array of points`, { loop });
    }
    for (let vertex = 0; vertex < points.length; vertex++) {
      const point = points[vertex];
      if (!isList(point) || point.length !== 3 || !Array.prototype.every.call(point, isNumber)) {
        throw new SoapfilmError(
          'bad-loops',
          `Loop ${loop}, vertex ${vertex} is not an array of three numbers`,
          { loop, vertex },
        );
      }
      coordinates.push(point[0] as number, point[1] as number, point[2] as number);
    }
    starts[loop + 1] = coordinates.length / 3;
  }
  return { positions: new Float64Array(coordinates), starts };
}

function checkStarts({ positions, starts }: LoopSet): void {
  if (positions.length % 3 !== 0) {
    throw new SoapfilmError('bad-loops', '`positions` must hold three numbers for each vertex');
  }
  if (starts.length === 0 || starts[0] !== 0) {
    throw new SoapfilmError('bad-starts', '`starts` must begin with 0');
  }
  for (let loop = 0; loop + 1 < starts.length; loop++) {
    if (starts[loop + 1] < starts[loop]) {
      throw new SoapfilmError('bad-starts', `\`starts\` falls at loop ${loop}`, { loop });
    }
  }
  const last = starts[starts.length - 1];
  const count = positions.length / 3;
  if (last !== count) {
    throw new SoapfilmError(
      'bad-starts',
      `\`starts\` must end with the number of vertices, ${count}, not with ${last}`,
    );
  }
}

export const isNumber = (value: unknown): boolean => typeof value === 'number';

export const isList = (value: unknown): value is ArrayLike<unknown> =>
  Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));

function isLoopSet(value: unknown): value is LoopSet {
  if (typeof value !== 'object' || value === null) return false;
  const { positions, starts } = value as Partial<Record<keyof LoopSet, unknown>>;
  return positions instanceof Float64Array && starts instanceof Uint32Array;
}
