// Polygons from files: GeoJSON, or loops, which are seen from above as one polygon.
import { SoapfilmError } from 'soapfilm';
import type { Content } from '../../app/content.ts';
import type { ReadFile } from '../../app/mode.ts';
import type { Lines } from '../../shapes/lines.ts';
import { newItem } from '../../state/document.ts';
import { polygonKind } from './polygons.ts';

/** @throws SoapfilmError `bad-file` */
export async function readPolygons(kind: string, content: Content): Promise<ReadFile> {
  if (kind === 'geojson') return { items: polygonsOf(content.json).map((lines) => newItem(polygonKind, lines)) };
  const { parseLoops } = await import('../../app/formats.ts');
  const { positions, starts, name } = parseLoops(content.text);
  if (starts.length < 2) throw bad('it has no loops');
  const n = positions.length / 3;
  const flat = new Float64Array(2 * n);
  for (let i = 0; i < n; i++) {
    flat[2 * i] = positions[3 * i];
    flat[2 * i + 1] = positions[3 * i + 1];
  }
  const lines: Lines = { dim: 2, positions: flat, starts: Uint32Array.from(starts) };
  return { items: [newItem(polygonKind, lines)], ...(name !== undefined && { name }) };
}

const bad = (reason: string): SoapfilmError => new SoapfilmError('bad-file', reason);

/** The polygons in GeoJSON, in order. */
export function polygonsOf(geoJSON: unknown): Lines[] {
  const polygons: Lines[] = [];
  // The next one last, since collections may be nested to any depth.
  const todo: unknown[] = [geoJSON];
  while (todo.length > 0) {
    const { type, features, geometry, geometries, coordinates } = (todo.pop() ?? {}) as Record<string, unknown>;
    if (type === 'FeatureCollection') putReversed(todo, listOf(features));
    else if (type === 'GeometryCollection') putReversed(todo, listOf(geometries));
    else if (type === 'Feature') todo.push(geometry);
    else if (type === 'Polygon') add(polygons, coordinates);
    else if (type === 'MultiPolygon') for (const each of listOf(coordinates)) add(polygons, each);
  }
  if (polygons.length === 0) throw bad('it has no polygons');
  return polygons;
}

function putReversed(todo: unknown[], list: readonly unknown[]): void {
  for (let i = list.length - 1; i >= 0; i--) todo.push(list[i]);
}

function add(polygons: Lines[], coordinates: unknown): void {
  const rings = listOf(coordinates).map(listOf);
  // GeoJSON has empty geometries.
  if (rings.length === 0) return;
  const starts = new Uint32Array(rings.length + 1);
  rings.forEach((ring, r) => (starts[r + 1] = starts[r] + lengthOf(ring)));
  const positions = new Float64Array(2 * starts[rings.length]);
  let at = 0;
  rings.forEach((ring, r) => {
    for (let i = 0; i < starts[r + 1] - starts[r]; i++) {
      const point = listOf(ring[i]);
      positions[at++] = numberOf(point[0]);
      positions[at++] = numberOf(point[1]);
    }
  });
  polygons.push({ dim: 2, positions, starts });
}

/** The points of a ring, without the end that repeats the beginning. */
function lengthOf(ring: readonly unknown[]): number {
  if (ring.length === 0) throw bad('a ring in its GeoJSON has no points');
  const [first, last] = [listOf(ring[0]), listOf(ring[ring.length - 1])];
  first.slice(0, 2).forEach(numberOf);
  return first[0] === last[0] && first[1] === last[1] ? ring.length - 1 : ring.length;
}

function listOf(value: unknown): readonly unknown[] {
  if (Array.isArray(value)) return value;
  throw bad('a list is missing in its GeoJSON');
}

function numberOf(value: unknown): number {
  if (Number.isFinite(value)) return value as number;
  throw bad('a coordinate in its GeoJSON is not a number');
}
