// Polygons from files, and a few to begin with.
import { parseLoops, SoapfilmError } from 'soapfilm';
import type { Point2 } from '../shapes/plane.ts';
import { history, type Polygon, type Ring } from './polygon.ts';
import { say } from './store.ts';

const kMaxBytes = 64 * 2 ** 20;

/** A view of the whole is wanted. */
type Framer = () => void;
let frame: Framer = () => undefined;
export function onFrame(framer: Framer): void {
  frame = framer;
}

/** Opens GeoJSON, or loops as `.curve`, JSON or OBJ: these are seen from above, as one polygon. */
export async function openPolygonFile(file: File): Promise<void> {
  try {
    if (file.size > kMaxBytes) throw new Error('it is too large');
    const bytes = new Uint8Array(await file.arrayBuffer());
    const polygons = polygonsOfGeoJSON(bytes) ?? [ringsOfLoops(bytes)];
    const stem = file.name.replace(/\.[^.]*$/, '');
    history.dispatch({ type: 'open', name: stem, polygons });
    frame();
    say(`Opened “${file.name}”: ${polygons.length.toLocaleString('en')} polygons.`);
  } catch (error) {
    say(`Could not open “${file.name}”: ${error instanceof Error ? error.message : 'unreadable'}`, 'error');
  }
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
  const todo: unknown[] = [found];
  while (todo.length > 0) {
    const { type, features, geometry, geometries, coordinates } = (todo.pop() ?? {}) as Record<string, unknown>;
    if (type === 'FeatureCollection') todo.push(...[...(features as unknown[])].reverse());
    if (type === 'GeometryCollection') todo.push(...[...(geometries as unknown[])].reverse());
    if (type === 'Feature') todo.push(geometry);
    if (type === 'Polygon') polygons.push(polygonOf(coordinates));
    if (type === 'MultiPolygon') polygons.push(...(coordinates as unknown[]).map(polygonOf));
  }
  if (polygons.length === 0) throw new Error('it has no polygons');
  return polygons;
}

/** Rings of points, without the end that repeats the beginning. */
function polygonOf(rings: unknown): Polygon {
  return (rings as number[][][]).map((ring) => {
    const points = ring.map(([x, y]): Point2 => [x, y]);
    const [first, last] = [points[0], points[points.length - 1]];
    return first[0] === last[0] && first[1] === last[1] ? points.slice(0, -1) : points;
  });
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
  history.dispatch({ type: 'open', name: example.title, polygons: example.polygons() });
  frame();
}
