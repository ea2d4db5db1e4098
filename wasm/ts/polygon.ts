// triangulatePolygon and triangulatePolygons: polygons in one of their forms, made flat for the core.
import {
  kFloodActionChoices,
  kFloodStepLength,
  kMethodChoices,
  kPolygonFaultLength,
  kRepairChoices,
  packPolygonSettings,
  readFloodStep,
  readPolygonArrays,
  readPolygonFault,
} from './border.js';
import { SoapfilmError, type ErrorPlace } from './errors.js';
import { isList, isNumber } from './loopset.js';
import { ringError } from './messages.js';
import { badOption, checkLimits, checkNames, kPolygonOptions, kPolygonsOptions } from './options.js';
import { callCore, shared } from './runtime.js';
import type {
  EarcutPolygon,
  FloodStep,
  PolygonBatch,
  PolygonLike,
  PolygonOptions,
  PolygonSet,
  PolygonsOptions,
  PolygonsTriangulation,
  PolygonTriangulation,
  Ring,
} from './types.js';

const kOffOn = [false, true];

/** Polygons as the core takes them. */
export interface FlatPolygons {
  readonly positions: Float64Array;
  readonly ringStarts: Uint32Array;
  readonly polygonStarts: Uint32Array;
  readonly dim?: 2 | 3 | undefined;
  readonly points?: Float64Array | undefined;
}

/**
 * Triangulates a polygon with holes, in the plane or in space: the triangles lie inside it and cover
 * it exactly, with all its vertices and no others. O(n log n).
 *
 * @throws SoapfilmError `not-loaded`; `bad-polygon`, `bad-starts`, `bad-option`; `not-finite`,
 *   `degenerate`, `self-intersecting`, `holes-overlap`, `hole-outside`, `nested-hole` with the rings,
 *   vertices and the point at fault, unless `repair` is set; `too-large`, `out-of-memory`,
 *   `time-limit`; `crashed`. The next call works after any of them.
 */
export function triangulatePolygon(
  polygon: PolygonLike,
  options: PolygonOptions = {},
): PolygonTriangulation {
  const { triangles, strips, stripStarts, added, addedOn, trace } = triangulate(
    toFlatPolygon(polygon),
    options,
    false,
  );
  return { triangles, strips, stripStarts, added, addedOn, trace };
}

/**
 * Triangulates many polygons in one call of the core, which is far quicker for small ones.
 *
 * @param polygons flat arrays, or an array of polygons, each an array of rings
 * @throws SoapfilmError as `triangulatePolygon`, for the first invalid polygon, with its number as
 *   `polygon`; nothing for invalid polygons with `skipInvalid`
 */
export function triangulatePolygons(
  polygons: PolygonBatch | readonly (readonly Ring[])[],
  options: PolygonsOptions = {},
): PolygonsTriangulation {
  return triangulate(toFlatPolygons(polygons), options, true);
}

const bad = (message: string, place?: ErrorPlace): SoapfilmError =>
  new SoapfilmError('bad-polygon', message, place);

/**
 * The polygon as flat arrays.
 * @throws SoapfilmError `bad-polygon` (`.loop`, `.vertex`), `bad-starts`
 */
export function toFlatPolygon(polygon: PolygonLike): FlatPolygons {
  const given: unknown = polygon;
  if (isList(given)) return flatten([given]);
  const { starts, coordinates, holeIndices, dim = 2, points, ...set } = (given ?? {}) as Partial<
    PolygonSet & EarcutPolygon
  >;
  const positions = isList(coordinates) ? toNumbers(coordinates) : set.positions;
  const ringStarts = isList(coordinates)
    ? new Uint32Array([0, ...Array.from(holeIndices ?? []), coordinates.length / dim])
    : starts;
  const polygonStarts = Uint32Array.of(0, (ringStarts?.length ?? 1) - 1);
  return check({ positions, ringStarts, polygonStarts, dim, points });
}

function toFlatPolygons(polygons: PolygonBatch | readonly (readonly Ring[])[]): FlatPolygons {
  const given: unknown = polygons;
  return isList(given) ? flatten(given) : check(given ?? {});
}

function toNumbers(list: ArrayLike<number>): Float64Array {
  if (Array.isArray(list) && !list.every(isNumber)) throw bad('`coordinates` must be numbers');
  return new Float64Array(list);
}

/** Flat arrays that fit each other; the core checks that `starts` increase. */
function check(flat: { [K in keyof FlatPolygons]?: FlatPolygons[K] | undefined }): FlatPolygons {
  const { positions, ringStarts, polygonStarts, points, dim = 2 } = flat;
  if (
    !(positions instanceof Float64Array) ||
    !(ringStarts instanceof Uint32Array) ||
    !(polygonStarts instanceof Uint32Array) ||
    !(points === undefined || points instanceof Float64Array)
  ) {
    throw bad(
      'A polygon is an array of rings of points, or a Float64Array `positions` with a Uint32Array ' +
        '`starts`, or `coordinates` as earcut takes them',
    );
  }
  choice('dim', [2, 3], dim);
  if (positions.length % dim !== 0 || (points && points.length % dim !== 0)) {
    throw bad(`There must be ${dim} coordinates for each vertex`);
  }
  for (const [starts, last] of [
    [ringStarts, positions.length / dim],
    [polygonStarts, ringStarts.length - 1],
  ] as const) {
    if (starts.length > 0 && starts[starts.length - 1] === last) continue;
    throw new SoapfilmError('bad-starts', `Starts must end with ${last}`);
  }
  return { positions, ringStarts, polygonStarts, points, dim };
}

/**
 * Flat arrays of nested ones.
 * @param dim how many coordinates to take of each point; default: as many as the first has
 */
export function flatten(polygons: ArrayLike<unknown>, dim?: 2 | 3): FlatPolygons {
  const ringStarts = [0];
  const polygonStarts = [0];
  const rings: ArrayLike<unknown>[] = [];
  const placeOf = (ring: number): { polygon?: number; loop: number } => {
    let polygon = polygonStarts.length - 1;
    while (polygonStarts[polygon] > ring) polygon--;
    const loop = ring - polygonStarts[polygon];
    return polygons.length > 1 ? { polygon, loop } : { loop };
  };
  let n = 0;
  for (let p = 0; p < polygons.length; p++) {
    const polygon = polygons[p];
    if (!isList(polygon)) throw bad(`Polygon ${p} is not an array of rings`, { polygon: p });
    for (let r = 0; r < polygon.length; r++) {
      const ring = polygon[r];
      if (!isList(ring)) throw bad(`Ring ${r} is not an array of points`, placeOf(rings.length));
      rings.push(ring);
      ringStarts.push((n += ring.length));
    }
    polygonStarts.push(rings.length);
  }
  const isExact = dim === undefined;
  const first = rings.find((ring) => ring.length > 0)?.[0];
  const size = dim ?? (isList(first) && first.length === 3 ? 3 : 2);
  const positions = new Float64Array(size * n);
  let next = 0;
  rings.forEach((ring, r) => {
    for (let vertex = 0; vertex < ring.length; vertex++) {
      const point = ring[vertex];
      let fits = isList(point) && (isExact ? point.length === size : point.length >= size);
      for (let k = 0; fits && k < size; k++) {
        const x = (point as ArrayLike<unknown>)[k];
        fits = typeof x === 'number';
        positions[next++] = x as number;
      }
      if (fits) continue;
      const place = { ...placeOf(r), vertex };
      throw bad(`Ring ${place.loop}, vertex ${vertex} is not an array of ${size} numbers`, place);
    }
  });
  return {
    positions,
    ringStarts: Uint32Array.from(ringStarts),
    polygonStarts: Uint32Array.from(polygonStarts),
    dim: size,
  };
}

/** Which of the choices an option is; the first if it is left out. */
function choice(name: string, choices: readonly unknown[], value: unknown): number {
  const index = value === undefined ? 0 : choices.indexOf(value);
  if (index < 0) throw badOption(name, choices);
  return index;
}

/** Triangulates; the error of the first invalid polygon is thrown unless these are skipped. */
export function triangulate(
  polygons: FlatPolygons,
  options: PolygonsOptions,
  several: boolean,
): PolygonsTriangulation {
  checkNames(options, several ? kPolygonsOptions : kPolygonOptions);
  const maxBytes = checkLimits(options);
  const { method, repair, quality, output, verify, trace, borrow, maxSeconds } = options;
  const { skipInvalid = false } = options;
  const { positions, ringStarts, polygonStarts, points, dim = 2 } = polygons;
  choice('borrow', kOffOn, borrow);
  choice('skipInvalid', kOffOn, skipInvalid);
  const settings = packPolygonSettings({
    dimension: dim,
    method: choice('method', kMethodChoices, method),
    repair: choice('repair', kRepairChoices, repair),
    delaunay: choice('quality', ['fast', 'delaunay'], quality),
    strips: choice('output', ['triangles', 'strips'], output),
    verify: choice('verify', kOffOn, verify),
    trace: choice('trace', kOffOn, trace),
    maxBytes,
  });
  const { arrays } = callCore(
    shared.polygons,
    'sf_triangulate_polygons',
    [
      positions,
      ringStarts,
      ringStarts.length - 1,
      polygonStarts,
      polygonStarts.length - 1,
      points ?? null,
      points ? points.length / dim : 0,
      settings,
    ],
    readPolygonArrays,
    { maxSeconds, borrows: borrow, explain: ringError },
  );
  const { triangles, triangleStarts, strips, stripStarts, polygonStrips, added, addedOn } = arrays;
  const { faults, faultPoints } = arrays;
  const errors: SoapfilmError[] = [];
  for (let i = 0; kPolygonFaultLength * i < faults.length; i++) {
    const fault = readPolygonFault(faults, kPolygonFaultLength * i);
    const point = Array.from(faultPoints.subarray(dim * i, dim * i + dim));
    const error = ringError(fault.status, fault, {
      ...(several && { polygon: fault.polygon }),
      ...(!Number.isNaN(point[0]) && { point }),
    });
    if (!skipInvalid) throw error;
    errors.push(error);
  }
  return {
    triangles,
    strips,
    stripStarts,
    added,
    addedOn,
    trace: readTrace(arrays.trace),
    triangleStarts,
    polygonStrips,
    errors,
  };
}

function readTrace(steps: Uint32Array): FloodStep[] {
  return Array.from({ length: steps.length / kFloodStepLength }, (_, i) => {
    const { action, ...step } = readFloodStep(steps, kFloodStepLength * i);
    return { action: kFloodActionChoices[action], ...step };
  });
}
