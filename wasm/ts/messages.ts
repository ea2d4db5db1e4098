// Errors for the core's statuses: the code of each, and a message that names the place at fault.
import { Status, type Place } from './border.js';
import { SoapfilmError, type ErrorCode, type ErrorPlace } from './errors.js';

/** Names of the statuses that are errors. `Stopped` is not: a caller asked for that. */
type Failure = Exclude<keyof typeof Status, 'Ok' | 'NotFound' | 'Stopped'>;

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

const table: Readonly<Record<Failure, readonly [ErrorCode, (place: ErrorPlace) => string]>> = {
  NoLoops: ['no-loops', () => 'there is no loop to span'],
  BadStarts: [
    'bad-starts',
    (place) =>
      place.loop === undefined
        ? '`starts` must increase from 0 to the number of vertices'
        : `\`starts\` must increase from 0 to the number of vertices; it does not at loop ${place.loop}`,
  ],
  NotFinite: ['not-finite', (place) => `${first(place)} has a coordinate that is NaN, infinite or beyond 1e150`],
  TooFewVertices: [
    'too-few-vertices',
    (place) => `${at(place.loop, undefined)} has fewer than the 3 vertices that a loop needs`,
  ],
  RepeatedVertex: ['repeated-vertex', (place) => `${first(place)} lies exactly where ${second(place)} does`],
  LoopsIntersect: [
    'loops-intersect',
    (place) =>
      `the edge from ${first(place)} meets the edge from ${second(place)}: ` +
      'loop edges may not cross, touch or overlap',
  ],
  BadNormals: [
    'bad-normals',
    (place) =>
      place.edgeVertices === undefined
        ? `the boundary normal of ${first(place)} is zero, infinite or NaN in part`
        : `boundary normal ${place.edge}, of the edge between vertices ${place.edgeVertices.join(' and ')}, ` +
          'is zero, infinite, NaN in part or along the edge',
  ],
  BadWeights: ['bad-weights', () => 'weights must be finite and not negative, and at least one positive'],
  BadCandidates: [
    'bad-candidates',
    (place) =>
      `${candidate(place)} has an index out of range, is listed twice, is collinear, ` +
      'or has a weight that is not finite',
  ],
  TooLarge: ['too-large', () => 'the work is predicted to exceed the memory limit (`maxMemoryBytes`)'],
  OutOfMemory: ['out-of-memory', () => 'the work reached the memory limit (`maxMemoryBytes`)'],
  BadOption: ['bad-option', () => 'an option is outside its range'],
  SelfIntersecting: [
    'self-intersecting',
    (place) => `the edge from ${first(place)} crosses or overlaps the edge from ${second(place)}`,
  ],
  HoleOutside: [
    'hole-outside',
    (place) =>
      place.otherLoop === undefined
        ? `${place.loop === 0 ? 'a hole' : `${at(place.loop, undefined)}, a hole,`} is not inside the outer ring`
        : `the edge from ${first(place)}, of a hole, crosses or overlaps the edge from ` +
          `${second(place)} of the outer ring`,
  ],
  HolesOverlap: [
    'holes-overlap',
    (place) =>
      `the edge from ${first(place)} crosses or overlaps the edge from ${second(place)}: ` +
      'holes may touch, but not overlap',
  ],
  NestedHole: [
    'nested-hole',
    (place) =>
      `${at(place.loop, undefined)}, a hole, lies inside ${at(place.otherLoop, undefined)}, another hole`,
  ],
  DegeneratePolygon: [
    'degenerate',
    (place) =>
      place.vertex === undefined
        ? `${at(place.loop, undefined)} has fewer than the 3 distinct points that a ring needs`
        : `the edges at ${first(place)} leave it in one direction, as a spike`,
  ],
  BadMesh: ['bad-mesh', ({ face }) => `face ${face} has a vertex that is not there`],
  BadSurface: [
    'bad-mesh',
    ({ face, edgeVertices }) =>
      edgeVertices === undefined
        ? `face ${face} keeps the surface from being manifold, of one orientation and with a boundary in each part`
        : `face ${face} keeps the surface from being manifold and of one orientation: ` +
          `at its edge between vertices ${edgeVertices.join(' and ')}, not two faces meet that run alike`,
  ],
  BadNormalCount: [
    'bad-normals',
    (place) => `\`boundaryNormals\` must have ${3 * (place.vertex ?? 0)} numbers, three for each edge of the boundary`,
  ],
};

const byStatus = new Map<number, (typeof table)[Failure]>(
  Object.entries(table).map(([name, entry]) => [Status[name as Failure], entry]),
);

/**
 * The error for a failed call.
 * @param noun the word for a loop in the message
 * @param more further fields of the place
 */
export function statusError(
  status: number,
  { loop, vertex, otherLoop, otherVertex }: Place,
  noun = 'loop',
  more: ErrorPlace = {},
): SoapfilmError {
  const place: ErrorPlace = {
    ...more,
    ...(loop !== kNone && { loop }),
    ...(vertex !== kNone && { vertex }),
    ...(otherLoop !== kNone && { otherLoop }),
    ...(otherVertex !== kNone && { otherVertex }),
  };
  const entry = byStatus.get(status);
  if (!entry) return new SoapfilmError('crashed', `the core ended with unknown status ${status}`);
  const text = entry[1](place).replace(/\bloop (?=\d)/g, `${noun} `);
  return new SoapfilmError(entry[0], text[0].toUpperCase() + text.slice(1), place);
}

/** The error for a polygon, whose loops are called rings. */
export function ringError(status: number, where: Place, more?: ErrorPlace): SoapfilmError {
  return statusError(status, where, 'ring', more);
}

/** The error for a mesh, of which a vertex, a face or an edge is at fault. */
export function meshError(status: number, where: Place): SoapfilmError {
  const { vertex, otherLoop, otherVertex } = where;
  const more: ErrorPlace = {
    ...((status === Status.BadMesh || status === Status.BadSurface) && { face: vertex }),
    ...(status === Status.BadNormals && { edge: vertex }),
    ...(otherVertex !== kNone && { edgeVertices: [otherLoop, otherVertex] as const }),
  };
  if (Object.keys(more).length === 0) return statusError(status, where);
  return statusError(status, { loop: kNone, vertex: kNone, otherLoop: kNone, otherVertex: kNone }, 'loop', more);
}
