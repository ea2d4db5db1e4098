// What the statuses of the core mean: their codes, and messages in words that name the culprit.
import { SoapfilmError, type ErrorCode, type ErrorPlace } from './errors.js';

/** Status values of `src/base/status.h` that the runtime tells apart. */
export const kOk = 0;
export const kNotFound = 1;
export const kStopped = 13;

const kNone = 0xffffffff;

/** "loop 2, vertex 5", as far as known; indices count from 0, as in the API. */
function at(loop: number | undefined, vertex: number | undefined): string {
  if (loop === undefined) return vertex === undefined ? 'the input' : `vertex ${vertex}`;
  return vertex === undefined ? `loop ${loop}` : `loop ${loop}, vertex ${vertex}`;
}

const first = (place: ErrorPlace): string => at(place.loop, place.vertex);
const second = (place: ErrorPlace): string =>
  place.otherLoop === undefined && place.otherVertex === undefined
    ? 'another vertex'
    : at(place.otherLoop, place.otherVertex);
const candidate = (place: ErrorPlace): string =>
  place.vertex === undefined ? 'a candidate' : `candidate ${place.vertex}`;

const table: Readonly<Record<number, readonly [ErrorCode, (place: ErrorPlace) => string]>> = {
  2: ['no-loops', () => 'there is no loop to span'],
  3: [
    'bad-starts',
    (place) =>
      place.loop === undefined
        ? '`starts` must increase from 0 to the number of vertices'
        : `\`starts\` must increase from 0 to the number of vertices; it does not at loop ${place.loop}`,
  ],
  4: ['not-finite', (place) => `${first(place)} has a coordinate that is NaN, infinite or beyond 1e150`],
  5: [
    'too-few-vertices',
    (place) => `${at(place.loop, undefined)} has fewer than the 3 vertices that a loop needs`,
  ],
  6: ['repeated-vertex', (place) => `${first(place)} lies exactly where ${second(place)} does`],
  7: [
    'loops-intersect',
    (place) =>
      `the edge from ${first(place)} meets the edge from ${second(place)}: ` +
      'loop edges may not cross, touch or overlap',
  ],
  8: [
    'bad-normals',
    (place) => `the boundary normal of ${first(place)} is zero, infinite or NaN in part`,
  ],
  9: ['bad-weights', () => 'weights must be finite and not negative, and at least one positive'],
  10: [
    'bad-candidates',
    (place) =>
      `${candidate(place)} has an index out of range, is listed twice, is collinear, ` +
      'or has a weight that is not finite',
  ],
  11: ['too-large', () => 'the work is predicted to exceed the memory limit (`maxMemoryBytes`)'],
  12: ['out-of-memory', () => 'the work reached the memory limit (`maxMemoryBytes`)'],
  14: ['bad-option', () => 'an option is outside its range'],
  15: [
    'self-intersecting',
    (place) => `the edge from ${first(place)} crosses or overlaps the edge from ${second(place)}`,
  ],
  16: [
    'hole-outside',
    (place) =>
      place.otherLoop === undefined
        ? `${place.loop === 0 ? 'a hole' : `${at(place.loop, undefined)}, a hole,`} is not inside the outer ring`
        : `the edge from ${first(place)}, of a hole, crosses or overlaps the edge from ` +
          `${second(place)} of the outer ring`,
  ],
  17: [
    'holes-overlap',
    (place) =>
      `the edge from ${first(place)} crosses or overlaps the edge from ${second(place)}: ` +
      'holes may touch, but not overlap',
  ],
  18: [
    'nested-hole',
    (place) =>
      `${at(place.loop, undefined)}, a hole, lies inside ${at(place.otherLoop, undefined)}, another hole`,
  ],
  19: [
    'degenerate',
    (place) =>
      place.vertex === undefined
        ? `${at(place.loop, undefined)} has fewer than the 3 distinct points that a ring needs`
        : `the edges at ${first(place)} leave it in one direction, as a spike`,
  ],
};

/**
 * The error for a failed call.
 * @param where `[4]` loop, vertex, other loop, other vertex, or 0xFFFFFFFF where there is none
 * @param noun what loops are called
 * @param more what else is known of the place
 */
export function statusError(
  status: number,
  where: ArrayLike<number>,
  noun = 'loop',
  more: ErrorPlace = {},
): SoapfilmError {
  const place: ErrorPlace = {
    ...more,
    ...(where[0] !== kNone && { loop: where[0] }),
    ...(where[1] !== kNone && { vertex: where[1] }),
    ...(where[2] !== kNone && { otherLoop: where[2] }),
    ...(where[3] !== kNone && { otherVertex: where[3] }),
  };
  const entry = Object.hasOwn(table, status) ? table[status] : undefined;
  if (!entry) return new SoapfilmError('crashed', `the core ended with unknown status ${status}`);
  const text = entry[1](place).replace(/\bloop (?=\d)/g, `${noun} `);
  return new SoapfilmError(entry[0], text[0].toUpperCase() + text.slice(1), place);
}

/** The error for a polygon: its loops are rings. */
export function ringError(
  status: number,
  where: ArrayLike<number>,
  more?: ErrorPlace,
): SoapfilmError {
  return statusError(status, where, 'ring', more);
}
