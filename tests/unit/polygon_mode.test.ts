// The mode of polygons: objects and what commands do to them, files, and errors in words.
import { load, SoapfilmError, triangulatePolygons } from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { Content } from '../../web/src/app/content.ts';
import { kExamples } from '../../web/src/modes/polygon/examples.ts';
import { trianglesOfStrips } from '../../web/src/modes/polygon/fill.ts';
import { flatten, hostOf, polygonKind, withHole } from '../../web/src/modes/polygon/polygons.ts';
import { polygonsOf, readPolygons } from '../../web/src/modes/polygon/read.ts';
import { failureOf } from '../../web/src/modes/polygon/wording.ts';
import { writeGeoJSON } from '../../web/src/modes/polygon/write.ts';
import { linesOf, type Lines } from '../../web/src/shapes/lines.ts';
import { newItem, registerKind, type Place } from '../../web/src/state/document.ts';
import { errorOf, rejectionOf } from '../support/errors.js';
import { trianglesOfStrips as listTriangles } from '../support/triangulation.js';

beforeAll(async () => {
  registerKind(polygonKind);
  await load();
});

type List = number[][];
const square = (x: number, y: number, size: number): List => [[x, y], [x + size, y], [x + size, y + size], [x, y + size]];
const kShape = linesOf(2, [square(0, 0, 10), square(2, 2, 2), square(6, 6, 2)]);
const place = (part: number, handle: number | null = null): Place => ({ item: 1, part, handle });

const ringsOf = ({ positions, starts }: Lines): List[] =>
  Array.from({ length: starts.length - 1 }, (_, r) =>
    Array.from({ length: starts[r + 1] - starts[r] }, (_, i) => [...positions.subarray(2 * (starts[r] + i), 2 * (starts[r] + i) + 2)]),
  );

describe('moving', () => {
  const movedBy = (...places: Place[]) => ringsOf(polygonKind.move(kShape, places, [1, 0, 0]));
  test('the outer ring takes its holes with it', () => {
    expect(movedBy(place(0))).toEqual([square(1, 0, 10), square(3, 2, 2), square(7, 6, 2)]);
  });
  test('a hole moves alone, and no vertex twice', () => {
    expect(movedBy(place(1), place(1, 4))).toEqual([square(0, 0, 10), square(3, 2, 2), square(6, 6, 2)]);
  });
});

describe('deleting', () => {
  const left = (...places: Place[]) => {
    const shape = polygonKind.remove(kShape, places);
    return shape && ringsOf(shape);
  };
  test('a hole; the outer ring, and with it the polygon', () => {
    expect(left(place(1))).toEqual([square(0, 0, 10), square(6, 6, 2)]);
    expect(left(place(2), place(0))).toBeNull();
  });
  test('a vertex', () => {
    expect(left(place(1, 5))?.[1]).toEqual([[2, 2], [4, 4], [2, 4]]);
  });
  test('a vertex of a triangle: the ring; of an outer one, the polygon', () => {
    const triangles = linesOf(2, [[[0, 0], [9, 0], [0, 9]], [[1, 1], [2, 1], [1, 2]]]);
    expect(polygonKind.remove(triangles, [place(1, 4)])).toEqual(linesOf(2, [[[0, 0], [9, 0], [0, 9]]]));
    expect(polygonKind.remove(triangles, [place(0, 1)])).toBeNull();
  });
  test('keeps rings with too few vertices that nothing is taken from', () => {
    const shape = linesOf(2, [square(0, 0, 10), [[1, 1], [2, 2]]]);
    expect(polygonKind.remove(shape, [place(0, 0)])).toEqual(linesOf(2, [square(0, 0, 10).slice(1), [[1, 1], [2, 2]]]));
  });
});

describe('drawing', () => {
  const items = [newItem(polygonKind, linesOf(2, [square(20, 0, 5)])), newItem(polygonKind, kShape)];
  test('a ring with a point inside a polygon is for that polygon', () => {
    expect(hostOf(items, [[1, 1, 0], [-5, -5, 0]])).toBe(items[1]);
    expect(hostOf(items, [[21, 1, 0]])).toBe(items[0]);
    expect(hostOf(items, [[15, 1, 0]])).toBeUndefined();
  });
  test('it is the last hole', () => {
    expect(ringsOf(withHole(kShape, [[8, 1, 0], [9, 1, 0], [8, 2, 0]])).at(-1)).toEqual([[8, 1], [9, 1], [8, 2]]);
  });
});

test('flat arrays of all polygons are as the library takes them', () => {
  const items = [newItem(polygonKind, kShape), newItem(polygonKind, linesOf(2, [square(20, 0, 5)]))];
  const flat = flatten(items);
  expect(Array.from(flat.ringStarts)).toEqual([0, 4, 8, 12, 16]);
  expect(Array.from(flat.polygonStarts)).toEqual([0, 3, 4]);
  expect(triangulatePolygons(flat).triangles).toHaveLength(3 * (14 + 2));
});

test('strips as triangles: those that the library lists, each with its strip', () => {
  const { strips, stripStarts } = triangulatePolygons([ringsOf(kShape)], { output: 'strips' });
  const { triangles, stripOf } = trianglesOfStrips(strips, stripStarts);
  const sorted = (corners: ArrayLike<number>) => Array.from(corners).sort((a, b) => a - b);
  const found = Array.from(stripOf, (_, t) => sorted(triangles.subarray(3 * t, 3 * t + 3)));
  expect(found).toEqual(listTriangles(strips, stripStarts).map(sorted));
  expect([...new Set(stripOf)]).toEqual(Array.from({ length: stripStarts.length - 1 }, (_, s) => s));
});

const contentOf = (text: string): Content => new Content(new TextEncoder().encode(text), 'file');

describe('files', () => {
  const closed = (ring: List): List => [...ring, ring[0]];
  test('GeoJSON: all its polygons, in order, without the points that close them', () => {
    const geometries = [
      { type: 'Point', coordinates: [0, 0] },
      { type: 'Polygon', coordinates: [closed(square(0, 0, 1))] },
    ];
    const file = {
      type: 'FeatureCollection',
      features: [
        { type: 'Feature', geometry: { type: 'GeometryCollection', geometries } },
        { type: 'Feature', geometry: null },
        { type: 'Feature', geometry: { type: 'MultiPolygon', coordinates: [[closed(square(2, 0, 1))], [], [square(4, 0, 1)]] } },
      ],
    };
    expect(polygonsOf(file).map(ringsOf)).toEqual([[square(0, 0, 1)], [square(2, 0, 1)], [square(4, 0, 1)]]);
  });

  test('a ring of too few points stays, and the library says so', () => {
    const [shape] = polygonsOf({ type: 'Polygon', coordinates: [closed(square(0, 0, 9)), [[1, 1], [2, 2], [1, 1]], [[3, 3]]] });
    expect(Array.from(shape.starts)).toEqual([0, 4, 6, 6]);
    const { errors } = triangulatePolygons(flatten([newItem(polygonKind, shape)]), { skipInvalid: true });
    expect(errors.map(({ code, loop }) => [code, loop])).toEqual([['degenerate', 1]]);
  });

  const broken: [unknown, string][] = [
    [{ type: 'Point', coordinates: [0, 0] }, 'it has no polygons'],
    [{ type: 'Polygon', coordinates: [] }, 'it has no polygons'],
    [{ type: 'Polygon', coordinates: 5 }, 'a list is missing in its GeoJSON'],
    [{ type: 'FeatureCollection' }, 'a list is missing in its GeoJSON'],
    [{ type: 'Polygon', coordinates: [[]] }, 'a ring in its GeoJSON has no points'],
    [{ type: 'Polygon', coordinates: [[['a', 'b']]] }, 'a coordinate in its GeoJSON is not a number'],
    [{ type: 'Polygon', coordinates: [[[0, 0], [1, Infinity], [1, 1]]] }, 'a coordinate in its GeoJSON is not a number'],
  ];
  test.each(broken)('%j: %s', (file, reason) => {
    const error = errorOf(() => polygonsOf(file));
    expect([error.code, error.message]).toEqual(['bad-file', reason]);
  });

  test('loops: seen from above, as one polygon', async () => {
    const loops = JSON.stringify({ name: 'Two', loops: [square(0, 0, 9).map((p, i) => [...p, i]), square(1, 1, 2).map((p) => [...p, 7])] });
    const { items, name } = await readPolygons('loops-json', contentOf(loops));
    expect(name).toBe('Two');
    expect(items.map(({ shape }) => ringsOf(shape as Lines))).toEqual([[square(0, 0, 9), square(1, 1, 2)]]);
    expect((await rejectionOf(readPolygons('curve', contentOf('1 9\n2')))).code).toBe('bad-file');
  });

  test('what is written as GeoJSON is read again', () => {
    const shapes = [kShape, linesOf(2, [square(20, 0.1, 5)])];
    expect(polygonsOf(JSON.parse(writeGeoJSON(shapes, 'a "name"')))).toEqual(shapes);
  });
});

describe('errors', () => {
  const items = [newItem(polygonKind, kShape), newItem(polygonKind, kShape)];
  const failure = (code: SoapfilmError['code'], where: ConstructorParameters<typeof SoapfilmError>[2]) =>
    failureOf(new SoapfilmError(code, 'In the words of the library', where), items);

  test('a crossing: both edges, by the handles of the polygon, and its point', () => {
    expect(failure('self-intersecting', { polygon: 1, loop: 1, vertex: 0, otherLoop: 1, otherVertex: 2, point: [3, 4] })).toEqual({
      code: 'self-intersecting',
      message: 'Polygon 2: hole 1 crosses or overlaps itself.',
      faults: [4, 6].map((handle) => ({ place: { item: items[1].id, part: 1, handle }, isEdge: true })),
      point: [3, 4, 0],
    });
  });
  test('a hole inside another: both, as wholes', () => {
    expect(failure('nested-hole', { polygon: 0, loop: 2, otherLoop: 1 })).toMatchObject({
      message: 'Polygon 1: hole 2 lies inside hole 1.',
      faults: [{ place: { part: 2, handle: null }, isEdge: false }, { place: { part: 1, handle: null }, isEdge: false }],
    });
  });
  test('a spike: its vertex', () => {
    expect(failure('degenerate', { polygon: 0, loop: 0, vertex: 3 }).faults).toEqual([
      { place: { item: items[0].id, part: 0, handle: 3 }, isEdge: false },
    ]);
  });
  test('anything else: in the words of the library', () => {
    expect(failure('too-large', { polygon: 0 }).message).toBe('Polygon 1: In the words of the library');
  });
  test('of a single polygon: without its number', () => {
    const error = new SoapfilmError('hole-outside', '', { polygon: 0, loop: 1 });
    expect(failureOf(error, items.slice(0, 1)).message).toBe('Hole 1 is not inside the outer ring.');
  });
});

test('the examples: all but the last are valid', () => {
  const counts = kExamples.map(({ shape }) => triangulatePolygons(flatten([newItem(polygonKind, shape())]), { skipInvalid: true }).errors.length);
  expect(counts).toEqual([0, 0, 0, 1]);
});
