// That WebAssembly gives what the native core does, to the last bit: tests/cpp/polygon_abi_test.cpp
// checks the same file.
import { readFileSync } from 'node:fs';
import { load, triangulatePolygon, triangulatePolygons, type PolygonOptions } from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { Random } from '../support/generators.js';
import {
  combRing,
  doubleCombRing,
  flatPolygon,
  garbage,
  interleavedCombRing,
  partitionRing,
  staircaseRing,
  zigzagRing,
  type Polygon2,
} from '../support/polygons.js';

beforeAll(() => load());

const kMake: Record<string, (n: number, random: Random) => Polygon2> = {
  partition: (n, random) => [partitionRing(n, random)],
  comb: (n, random) => [combRing(n, random)],
  'double comb': (n, random) => [doubleCombRing(n, random)],
  'interleaved comb': (n, random) => [interleavedCombRing(n, random)],
  staircase: (n) => [staircaseRing(n)],
  zigzag: (n, random) => [zigzagRing(n, random)],
  garbage: (n, random) => garbage(3, n, 0, random),
  'lattice garbage': (n, random) => garbage(2, n, 6, random),
};

/** FNV-1a over the bytes of arrays. */
function hash(...arrays: readonly (Uint32Array | Float64Array)[]): string {
  let value = 2166136261;
  for (const { buffer, byteOffset, byteLength } of arrays) {
    for (const byte of new Uint8Array(buffer, byteOffset, byteLength)) {
      value = Math.imul(value ^ byte, 16777619);
    }
  }
  return (value >>> 0).toString(16).padStart(8, '0');
}

function checksum(polygon: Polygon2, options: PolygonOptions): string {
  const found = triangulatePolygons([polygon], options);
  const { triangles, triangleStarts, strips, stripStarts, polygonStrips, added, addedOn } = found;
  const alone = triangulatePolygon(polygon, options);
  expect(alone.triangles).toEqual(triangles);
  return hash(triangles, triangleStarts, strips, stripStarts, polygonStrips, added, addedOn);
}

const rows = readFileSync(new URL('../fixtures/polygon_checksums.csv', import.meta.url), 'utf8')
  .split('\n')
  .filter((line) => line !== '' && !line.startsWith('#') && !line.startsWith('family,'));

describe('polygons: as native', () => {
  test.each(rows)('%s', (row) => {
    const [family, n, seed] = row.split(',');
    const polygon = kMake[family](Number(n), new Random(Number(seed)));
    const repair = family.includes('garbage') ? 'even-odd' : 'none';
    const columns = [
      family,
      n,
      seed,
      hash(flatPolygon(polygon).positions),
      checksum(polygon, { repair }),
      checksum(polygon, { repair, quality: 'delaunay', verify: true }),
      checksum(polygon, { repair, method: 'trapezoids' }),
      checksum(polygon, { repair, method: 'trapezoids', quality: 'delaunay' }),
      checksum(polygon, { repair, method: 'trapezoids', output: 'strips' }),
      checksum(polygon, { repair: 'nonzero' }),
    ];
    expect(columns.join()).toBe(row);
  });

  test('the table: is there', () => {
    expect(rows.length).toBeGreaterThan(30);
  });
});
