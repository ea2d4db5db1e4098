// Polygons and their options as callers give them, checked and made flat for the core.
import { kChoices, type FlatPolygons } from './flat_polygons.js';
import { SoapfilmError, type ErrorCode } from './errors.js';
import {
  choiceOf,
  fieldsOf,
  flagOf,
  guarded,
  kindOf,
  mustBe,
  show,
  type Given,
} from './check.js';
import { flatPositions, flatStarts, flattenLists, indicesOf, type PlaceOf } from './flatten.js';
import { limitsOf } from './options.js';
import type {
  EarcutPolygon,
  PolygonBatch,
  PolygonLike,
  PolygonSet,
  PolygonsLike,
  PolygonsOptions,
} from './types.js';

/**
 * Options for these polygons, checked, without those that were left out.
 * @throws SoapfilmError `bad-option`
 */
export function polygonOptionsOf(options: Given<PolygonsOptions>, polygons: FlatPolygons): PolygonsOptions {
  const checked: Record<string, unknown> = { ...limitsOf(options) };
  for (const [name, value] of Object.entries(options) as [keyof PolygonsOptions, unknown][]) {
    if (name in checked) continue;
    const choices = (kChoices as Partial<Record<string, readonly string[]>>)[name];
    checked[name] = choices ? choiceOf(name, choices, value) : flagOf(name, value);
  }
  checkTogether(polygons, checked);
  return checked;
}

/** Throws for options that do not go together, or not with the input. */
function checkTogether({ polygonStarts, points }: FlatPolygons, options: PolygonsOptions): void {
  const { trace = false, method, repair = 'none' } = options;
  const bad = (text: string): SoapfilmError => new SoapfilmError('bad-option', text);
  if (trace && method === 'trapezoids') throw bad("`trace` records flooding: it does not go with `method: 'trapezoids'`");
  if (trace && polygonStarts.length !== 2) throw bad('`trace` is for one polygon');
  if (points && points.length > 0 && repair !== 'none') throw bad('`repair` does not go with `polygon.points`');
}

const kCode: ErrorCode = 'bad-polygon';
const kForms =
  'an array of rings of points, or { positions, starts } with a Float64Array or Float32Array, or ' +
  '{ coordinates } as earcut takes them';

/**
 * The polygon as flat arrays.
 * @param own whether the arrays must be copies, not views of the caller's
 * @throws SoapfilmError `bad-polygon` (`.loop`, `.vertex`), `bad-starts`, `bad-option`, `too-large`,
 *   `out-of-memory`
 */
export function flattenPolygon(polygon: PolygonLike, own = false): FlatPolygons {
  const name = 'polygon';
  if (isArray(polygon, name)) return flattenPolygons([polygon], name);
  const given = fieldsOf<PolygonSet & EarcutPolygon>(
    isObject(polygon, name, kForms),
    { positions: true, starts: true, coordinates: true, holeIndices: true, dim: true, points: true },
    name,
    kCode,
  );
  const dim = choiceOf(`${name}.dim`, [2, 3] as const, given.dim);
  const positions =
    given.coordinates === undefined
      ? flatPositions(given.positions, dim, own, kCode, `${name}.positions`)
      : coordinatesOf(given.coordinates, dim, `${name}.coordinates`);
  const n = positions.length / dim;
  let ringStarts: Uint32Array = Uint32Array.of(0, n);
  if (given.coordinates !== undefined) ringStarts = holesOf(given.holeIndices, n, `${name}.holeIndices`);
  else if (given.starts !== undefined) ringStarts = flatStarts(given.starts, n, kCode, `${name}.starts`);
  const points =
    given.points === undefined ? undefined : flatPositions(given.points, dim, own, kCode, `${name}.points`);
  return { positions, ringStarts, polygonStarts: Uint32Array.of(0, ringStarts.length - 1), dim, points };
}

/** Many polygons as flat arrays. Throws the errors of `flattenPolygon`, with `.polygon`. */
export function flattenBatch(polygons: PolygonsLike, own = false): FlatPolygons {
  const name = 'polygons';
  if (isArray(polygons, name)) return flattenPolygons(polygons as readonly unknown[], name);
  const forms = 'an array of polygons, or { positions, ringStarts, polygonStarts }';
  const given = fieldsOf<PolygonBatch>(
    isObject(polygons, name, forms),
    { positions: true, ringStarts: true, polygonStarts: true, dim: true },
    name,
    kCode,
  );
  const dim = choiceOf(`${name}.dim`, [2, 3] as const, given.dim);
  const positions = flatPositions(given.positions, dim, own, kCode, `${name}.positions`);
  const n = positions.length / dim;
  const ringStarts = flatStarts(given.ringStarts, n, kCode, `${name}.ringStarts`);
  const last = ringStarts.length - 1;
  const polygonStarts = flatStarts(given.polygonStarts, last, kCode, `${name}.polygonStarts`);
  return { positions, ringStarts, polygonStarts, dim };
}

const isArray = (value: unknown, name: string): boolean => guarded(kCode, name, () => Array.isArray(value));

function isObject(value: unknown, name: string, forms: string): unknown {
  if (typeof value === 'object' && value !== null && kindOf(value) === undefined) return value;
  throw mustBe(kCode, name, forms, value);
}

/**
 * Polygons given as arrays of rings, as flat arrays.
 * @param name of the argument; for 'polygon', a single one, errors have no `.polygon`
 * @param size how many coordinates to take of each point; by default as many as the first point has,
 *   and then no point may have more
 */
export function flattenPolygons(
  polygons: readonly unknown[],
  name: 'polygon' | 'polygons' | 'geojson',
  size?: 2,
): FlatPolygons {
  const polygonStarts = [0];
  const rings: unknown[] = [];
  const placeIn = (polygon: number, loop: number, vertex?: number): ReturnType<PlaceOf> => {
    const place = { ...(name !== 'polygon' && { polygon }), loop, ...(vertex !== undefined && { vertex }) };
    const words = [`ring ${loop}`, ...(vertex === undefined ? [] : [`vertex ${vertex}`])];
    if (name !== 'polygon') words.unshift(`polygon ${polygon}`);
    const text = `${words.join(', ')} of \`${name}\``;
    return { text: text[0].toUpperCase() + text.slice(1), place };
  };
  const placeOf: PlaceOf = (ring, vertex) => {
    let polygon = polygonStarts.length - 1;
    while (polygonStarts[polygon] > ring) polygon--;
    return placeIn(polygon, ring - polygonStarts[polygon], vertex);
  };
  guarded(kCode, name, () => {
    for (let p = 0; p < polygons.length; p++) {
      const polygon = polygons[p];
      if (!Array.isArray(polygon)) {
        throw new SoapfilmError(kCode, `Polygon ${p} of \`${name}\` must be an array of rings`, { polygon: p });
      }
      for (let r = 0; r < polygon.length; r++) {
        const ring: unknown = polygon[r];
        if (Array.isArray(ring) || kindOf(ring) !== undefined) rings.push(ring);
        else {
          const { text, place } = placeIn(p, r);
          throw new SoapfilmError(kCode, `${text} must be an array of points, not ${show(ring)}`, place);
        }
      }
      polygonStarts.push(rings.length);
    }
  });
  const flat = flattenLists(rings, size, size === undefined, kCode, placeOf);
  return {
    positions: flat.positions,
    ringStarts: flat.starts,
    polygonStarts: Uint32Array.from(polygonStarts),
    dim: flat.size,
  };
}

/** A copy of earcut's coordinates, which may be any list of numbers. */
function coordinatesOf(list: unknown, dim: number, name: string): Float64Array {
  return guarded(kCode, name, () => {
    const numbers = numbersOf(list, name);
    const { length } = numbers;
    for (let i = 0; i < length; i++) {
      if (typeof numbers[i] !== 'number') throw mustBe(kCode, `${name}[${i}]`, 'a number', numbers[i]);
    }
    if (length % dim === 0) return new Float64Array(numbers as ArrayLike<number>);
    throw mustBe(kCode, name, `${dim} numbers for each vertex`, list);
  });
}

/** The offsets of rings, from the first vertices of holes. */
function holesOf(list: unknown, n: number, name: string): Uint32Array {
  if (list === undefined || list === null) return Uint32Array.of(0, n);
  const holes = guarded(kCode, name, () => indicesOf(numbersOf(list, name), name));
  return flatStarts([0, ...holes, n], n, kCode, name);
}

function numbersOf(list: unknown, name: string): ArrayLike<unknown> {
  if (Array.isArray(list)) return list as readonly unknown[];
  const kind = kindOf(list);
  if (kind !== undefined && !kind.startsWith('Big')) {
    // Throws if the buffer is detached. Our callers check everything else that they read.
    Uint8Array.prototype.keys.call(list as Uint8Array);
    return list as ArrayLike<unknown>;
  }
  throw mustBe(kCode, name, 'an array of numbers', list);
}
