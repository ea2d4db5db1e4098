import { load, triangulateGeoJSON, type GeoJSONLike } from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { errorOf } from '../support/errors.js';
import { trianglesArea } from '../support/triangulation.js';

beforeAll(() => load());

const ring = (x: number, size: number): number[][] => [
  [x, x],
  [x + size, x],
  [x + size, x + size],
  [x, x + size],
  [x, x],
];
const kPolygon = { type: 'Polygon', coordinates: [ring(0, 9), ring(2, 3)] };
const kMulti = { type: 'MultiPolygon', coordinates: [[ring(0, 1)], [ring(5, 2)]] };
const kLine = { type: 'LineString', coordinates: [[0, 0], [1, 1]] };
const feature = (geometry: object | null) => ({ type: 'Feature', properties: {}, geometry });

/** The areas of each feature's polygons. */
function areas(geojson: GeoJSONLike): number[][] {
  const { positions, triangles, triangleStarts, featureStarts, errors } = triangulateGeoJSON(geojson);
  expect(errors).toEqual([]);
  expect(featureStarts[featureStarts.length - 1]).toBe(triangleStarts.length - 1);
  expect(triangles.length).toBe(3 * triangleStarts[triangleStarts.length - 1]);
  return Array.from({ length: featureStarts.length - 1 }, (_, f) =>
    Array.from({ length: featureStarts[f + 1] - featureStarts[f] }, (_, i) => {
      const p = featureStarts[f] + i;
      return trianglesArea(positions, triangles.subarray(3 * triangleStarts[p], 3 * triangleStarts[p + 1]));
    }),
  );
}

describe('triangulateGeoJSON', () => {
  test('geometries: one feature', () => {
    expect(areas(kPolygon)).toEqual([[72]]);
    expect(areas(kMulti)).toEqual([[1, 4]]);
    expect(areas(kLine)).toEqual([[]]);
    const nested = { type: 'GeometryCollection', geometries: [kLine, { type: 'GeometryCollection', geometries: [kMulti] }, kPolygon] };
    expect(areas(nested)).toEqual([[1, 4, 72]]);
  });

  test('features: polygons by feature, none for those without', () => {
    expect(areas(feature(kPolygon) as GeoJSONLike)).toEqual([[72]]);
    const features = [feature(null), feature(kMulti), feature(kLine), feature(kPolygon)];
    const collection = { type: 'FeatureCollection', features };
    expect(areas(collection)).toEqual([[], [1, 4], [], [72]]);
    expect(areas({ type: 'FeatureCollection', features: [] })).toEqual([]);
    expect(areas({ type: 'Polygon', coordinates: [] })).toEqual([[0]]);
  });

  test('altitudes: are left out', () => {
    const high = { type: 'Polygon', coordinates: [ring(0, 9).map(([x, y], i) => [x, y, 100 * i])] };
    expect(areas(high)).toEqual([[81]]);
    expect(triangulateGeoJSON(high).positions.length).toBe(10);
  });

  test('an invalid polygon: throws with its number, or is skipped', () => {
    const bowTie = { type: 'Polygon', coordinates: [[[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]] };
    const collection = { type: 'FeatureCollection', features: [feature(kMulti), feature(bowTie), feature(kPolygon)] };
    expect(errorOf(() => triangulateGeoJSON(collection))).toMatchObject({
      code: 'self-intersecting',
      polygon: 2,
      point: [1, 1],
    });
    const { triangleStarts, errors } = triangulateGeoJSON(collection, { skipInvalid: true });
    expect(errors.map(({ polygon }) => polygon)).toEqual([2]);
    expect(triangleStarts[2]).toBe(triangleStarts[3]);
    expect(triangulateGeoJSON(collection, { repair: 'nonzero' }).triangleStarts[3]).toBe(triangleStarts[2] + 2);
  });

  test.each([
    [null],
    [undefined],
    ['Polygon'],
    [{}],
    [{ type: 'Circle' }],
    [{ type: 'Polygon' }],
    [{ type: 'Polygon', coordinates: [[[0, 0], [1, 0], null]] }],
    [{ type: 'MultiPolygon', coordinates: 5 }],
    [{ type: 'FeatureCollection' }],
    [{ type: 'FeatureCollection', features: [null] }],
    [{ type: 'Feature' }],
    [{ type: 'GeometryCollection', geometries: [null] }],
  ])('%o: bad-polygon', (geojson) => {
    expect(errorOf(() => triangulateGeoJSON(geojson as unknown as GeoJSONLike)).code).toBe('bad-polygon');
  });

  test('collections nested deep: no stack is exhausted', () => {
    let geojson: object = kPolygon;
    for (let i = 0; i < 100_000; i++) geojson = { type: 'GeometryCollection', geometries: [geojson] };
    expect(areas(geojson as GeoJSONLike)).toEqual([[72]]);
  });
});
