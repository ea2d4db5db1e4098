// Arrays lent by the core: what becomes of them with the next call, and how `checks` shows it.
import {
  load,
  PolygonSession,
  spanLoops,
  triangulateGeoJSON,
  triangulatePolygon,
  triangulatePolygons,
} from 'soapfilm';
import { createWorker } from 'soapfilm/worker';
import { afterEach, beforeAll, describe, expect, test } from 'vitest';
import { errorOf, rejectionOf } from '../support/errors.js';

const kSquare = [[[0, 0], [1, 0], [1, 1], [0, 1]]];
const kStar = [[[0, 0], [4, 0], [1, 3], [2, -1], [3, 3]]];
const kGeoJSON = { type: 'Polygon', coordinates: kSquare };
const kOptions = { output: 'strips', borrow: true } as const;

type Arrays = Record<string, Float64Array | Uint32Array>;
function arraysOf(result: object): Arrays {
  const entries = Object.entries(result) as [string, Arrays[string]][];
  return Object.fromEntries(entries.filter(([, value]) => ArrayBuffer.isView(value)));
}
const lengthsOf = (result: object): number[] => Object.values(arraysOf(result)).map(({ length }) => length);

const lenders: [string, (options: object) => object][] = [
  ['triangulatePolygon', (options) => triangulatePolygon(kSquare, options)],
  ['triangulatePolygon with repair', (options) => triangulatePolygon(kStar, { ...options, repair: 'nonzero' })],
  ['triangulatePolygons', (options) => triangulatePolygons([kSquare, kSquare], options)],
];

beforeAll(() => load());

describe('borrowed arrays', () => {
  test.each(lenders)('%s: hold what one\'s own do, without copies', (_, call) => {
    const own = arraysOf(call({ output: 'strips' }));
    const lent = arraysOf(call(kOptions));
    expect(lent).toEqual(own);
    expect(lent.triangles.buffer.byteLength).toBeGreaterThan(own.triangles.buffer.byteLength);
    expect(lent.triangles.buffer).toBe(lent.strips.buffer);
  });
});

describe('checks', () => {
  beforeAll(() => load({ parts: ['polygons'], checks: true }));
  afterEach(() => load({ checks: true }));

  test.each(lenders)('%s: the next call of its kind leaves nothing in what was lent', (_, call) => {
    const own = arraysOf(call({ output: 'strips' }));
    const next: [string, () => unknown][] = [
      ['triangulatePolygon', () => triangulatePolygon(kSquare)],
      ['triangulatePolygons', () => triangulatePolygons([kSquare], { borrow: true })],
      ['triangulateGeoJSON', () => triangulateGeoJSON(kGeoJSON)],
      ['one that fails', () => errorOf(() => triangulatePolygon(kStar))],
    ];
    for (const [name, use] of next) {
      const lent = call(kOptions);
      expect(arraysOf(lent)).toEqual(own);
      expect(arraysOf(lent)).toEqual(own);
      use();
      expect([name, ...lengthsOf(lent)]).toEqual([name, ...Object.keys(own).map(() => 0)]);
    }
  });

  test('a call that is refused, of the other part, of a session: what was lent stays', () => {
    const session = new PolygonSession(kSquare);
    const lent = triangulatePolygon(kSquare, kOptions);
    const before = lengthsOf(lent);
    spanLoops([[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]]]);
    session.move(0, [-1, -1]);
    errorOf(() => triangulatePolygon(kSquare, { quality: 'best' } as never));
    expect(lengthsOf(lent)).toEqual(before);
    session.dispose();
  });

  test('one\'s own arrays: stay', () => {
    const own = triangulatePolygon(kSquare);
    const before = lengthsOf(own);
    triangulatePolygon(kSquare, kOptions);
    triangulatePolygon(kSquare, kOptions);
    expect(lengthsOf(own)).toEqual(before);
  });

  test('a load that does not speak of them: changes nothing; `false` ends them', async () => {
    await load();
    const lent = triangulatePolygon(kSquare, kOptions);
    triangulatePolygon(kSquare);
    expect(lent.triangles).toHaveLength(0);
    await load({ checks: false });
    const { triangles } = triangulatePolygon(kSquare, kOptions);
    triangulatePolygon(kSquare);
    expect(triangles).toHaveLength(6);
  });

  test('neither true nor false: bad-option; a worker takes them and lends nothing', async () => {
    for (const start of [load, createWorker]) {
      const error = await rejectionOf(start({ checks: 1 } as never));
      expect(error.code).toBe('bad-option');
      expect(error.message).toContain('`checks`');
    }
    const film = await createWorker({ parts: ['polygons'], checks: true });
    const first = await film.triangulatePolygon(kSquare, { borrow: true });
    await film.triangulatePolygon(kSquare);
    expect(first.triangles).toHaveLength(6);
    film.dispose();
  });
});
