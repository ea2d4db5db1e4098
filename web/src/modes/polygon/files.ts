// Polygons from files, and a few to begin with.
import { parseLoops, SoapfilmError } from 'soapfilm';
import type { Point2 } from '../shapes/plane.ts';
import { countOf, readFile } from './files.ts';
import { history, selectedRing, type Polygon, type Ring } from './polygon.ts';

/** A view of the whole is wanted. */
type Framer = () => void;
let frame: Framer = () => undefined;
export function onFrame(framer: Framer): void {
  frame = framer;
}

/** Opens GeoJSON, or loops as `.curve`, JSON or OBJ: these are seen from above, as one polygon. */
export const openPolygonFile = (file: File): Promise<void> =>
  readFile(file, (bytes, name) => {
    const polygons = polygonsOfGeoJSON(bytes) ?? [ringsOfLoops(bytes)];
    open(name, polygons);
    return countOf(polygons.length, 'polygon');
  });

function open(name: string, polygons: readonly Polygon[]): void {
  selectedRing.value = null;
  history.dispatch({ type: 'open', name, polygons });
  frame();
}

/** Null for anything but GeoJSON. */
function polygonsOfGeoJSON(bytes: Uint8Array): Polygon[] | null {
  let found: unknown;
  try {
    found = JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    return null;
  }
  if (typeof found !== 'object' || found === null || !('type' in found)) return null;
  const polygons: Polygon[] = [];
  collect(found, polygons);
  if (polygons.length === 0) throw new SoapfilmError('bad-file', 'it has no polygons');
  return polygons;
}

/** Adds the polygons of a geometry, a feature, or a collection. */
function collect(geoJSON: unknown, polygons: Polygon[]): void {
  const { type, features, geometry, geometries, coordinates } = (geoJSON ?? {}) as Record<string, unknown>;
  const add = (list: unknown): void => {
    const rings = listOf(list).map(ringOf);
    // GeoJSON has empty geometries.
    if (rings.length > 0) polygons.push(rings);
  };
  if (type === 'FeatureCollection') for (const feature of listOf(features)) collect(feature, polygons);
  if (type === 'GeometryCollection') for (const part of listOf(geometries)) collect(part, polygons);
  if (type === 'Feature') collect(geometry, polygons);
  if (type === 'Polygon') add(coordinates);
  if (type === 'MultiPolygon') listOf(coordinates).forEach(add);
}

function listOf(value: unknown): readonly unknown[] {
  if (Array.isArray(value)) return value;
  throw new SoapfilmError('bad-file', 'a list is missing in its GeoJSON');
}

/** The points of a ring, without the end that repeats the beginning. */
function ringOf(ring: unknown): Ring {
  const points = listOf(ring).map((point): Point2 => {
    const [x, y] = listOf(point);
    if (typeof x === 'number' && typeof y === 'number') return [x, y];
    throw new SoapfilmError('bad-file', 'a coordinate in its GeoJSON is not a number');
  });
  if (points.length === 0) throw new SoapfilmError('bad-file', 'a ring in its GeoJSON has no points');
  const [first, last] = [points[0], points[points.length - 1]];
  return first[0] === last[0] && first[1] === last[1] ? points.slice(0, -1) : points;
}

function ringsOfLoops(bytes: Uint8Array): Polygon {
  const { positions, starts } = parseLoops(bytes);
  if (starts.length < 2) throw new SoapfilmError('bad-file', 'it has no loops');
  return Array.from({ length: starts.length - 1 }, (_, r) =>
    Array.from({ length: starts[r + 1] - starts[r] }, (_, i): Point2 => {
      const at = 3 * (starts[r] + i);
      return [positions[at], positions[at + 1]];
    }),
  );
}

export interface PolygonExample {
  readonly title: string;
  readonly polygons: () => readonly Polygon[];
}

const circle = (x: number, y: number, radius: number, count: number, wave = 0, waves = 1): Ring =>
  Array.from({ length: count }, (_, i): Point2 => {
    const angle = (2 * Math.PI * i) / count;
    const r = radius * (1 + wave * Math.cos(waves * angle));
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  });

/** Teeth from below and above that reach between each other. */
function combs(teeth: number): Ring {
  const below = Array.from({ length: teeth }, (_, i): Point2[] => [[i - 0.1, 0], [i, 3.4], [i + 0.1, 0]]);
  const above = Array.from({ length: teeth }, (_, i): Point2[] => [[i + 0.6, 4], [i + 0.5, 0.6], [i + 0.4, 4]]);
  return [[-0.7, 0], ...below.flat(), [teeth, 0], [teeth, 4], ...above.reverse().flat(), [-0.7, 4]];
}

export const kPolygonExamples: readonly PolygonExample[] = [
  {
    title: 'Pond with islands',
    polygons: () => [
      [
        circle(0, 0, 5, 72, 0.16, 5),
        circle(-1.9, 1.1, 0.9, 20, 0.2, 3),
        circle(1.6, 1.9, 0.7, 18),
        circle(0.7, -1.7, 1.3, 28, 0.15, 4),
      ],
    ],
  },
  { title: 'Interleaved combs', polygons: () => [[combs(9)]] },
  {
    title: 'Plate with holes',
    polygons: () => [
      [
        [[0, 0], [10, 0], [10, 6], [7, 6], [7, 5], [0, 5]],
        ...[1, 2, 3, 4, 5, 6].flatMap((i) => [circle(1.4 * i, 1.4, 0.45, 16), circle(1.4 * i - 0.3, 3.4, 0.45, 6)]),
      ],
    ],
  },
  {
    title: 'Crossing star',
    polygons: () => [[Array.from({ length: 7 }, (_, i): Point2 => [Math.sin((6 * Math.PI * i) / 7), Math.cos((6 * Math.PI * i) / 7)])]],
  },
];

export function openPolygonExample(example: PolygonExample): void {
  open(example.title, example.polygons());
}
