// Options under names that there are none of: misspelt, they would go unnoticed.
import {
  formatObj,
  load,
  parseLoops,
  PolygonSession,
  spanLoops,
  triangulateGeoJSON,
  triangulatePolygon,
  triangulatePolygons,
  type LoopsLike,
} from 'soapfilm';
import { createWorker, type Film } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { errorOf, rejectionOf } from '../support/errors.js';

const kLoops: LoopsLike = [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]]];
const kSquare = [[[0, 0], [1, 0], [1, 1], [0, 1]]];
const kGeoJSON = { type: 'Polygon', coordinates: kSquare };
const kSurface = { positions: new Float64Array(9), triangles: Uint32Array.of(0, 1, 2) };

let film: Film;
beforeAll(async () => {
  await load();
  film = await createWorker();
});
afterAll(() => {
  film.dispose();
});

const calls: [string, (options: unknown) => unknown][] = [
  ['spanLoops', (options) => spanLoops(kLoops, options as never)],
  ['triangulatePolygon', (options) => triangulatePolygon(kSquare, options as never)],
  ['triangulatePolygons', (options) => triangulatePolygons([kSquare], options as never)],
  ['triangulateGeoJSON', (options) => triangulateGeoJSON(kGeoJSON, options as never)],
  ['PolygonSession', (options) => new PolygonSession(kSquare, options as never)],
  ['parseLoops', (options) => parseLoops('1\n3\n3\n0 0 0\n1 0 0\n0 1 0\n', options as never)],
  ['formatObj', (options) => formatObj(kSurface, options as never)],
];

const awaited: [string, (options: unknown) => Promise<unknown>][] = [
  ['spanLoops', (options) => film.spanLoops(kLoops, options as never)],
  ['triangulatePolygon', (options) => film.triangulatePolygon(kSquare, options as never)],
  ['triangulatePolygons', (options) => film.triangulatePolygons([kSquare], options as never)],
  ['triangulateGeoJSON', (options) => film.triangulateGeoJSON(kGeoJSON, options as never)],
];

describe('in this thread', () => {
  test.each(calls)('%s: an unknown option is bad-option and named, whatever its value', (_, call) => {
    expect(call({})).toBeDefined();
    for (const value of ['all', undefined]) {
      const error = errorOf(() => call({ space: value }));
      expect(error.code).toBe('bad-option');
      expect(error.message).toMatch(/^`space` is not an option here; there are \w+/);
    }
  });

  test.each(calls)('%s: options that are not an object are bad-option', (_, call) => {
    for (const options of [null, 7, 'all']) {
      expect(errorOf(() => call(options)).code).toBe('bad-option');
    }
  });

  const nested: [string, object, string][] = [
    ['weights', { weights: { area: 1, volume: 1 } }, '`weights.volume`'],
    ['candidates', { candidates: { triangles: new Uint32Array(0), weight: 1 } }, '`candidates.weight`'],
  ];
  test.each(nested)('%s: an unknown field is bad-option and named', (_, options, name) => {
    const error = errorOf(() => spanLoops(kLoops, options));
    expect(error.code).toBe('bad-option');
    expect(error.message).toContain(`${name} is not an option here`);
  });

  test('an option of another function: bad-option', () => {
    const error = errorOf(() => triangulatePolygon(kSquare, { skipInvalid: true } as never));
    expect(error.message).toContain('`skipInvalid`');
    expect(errorOf(() => new PolygonSession(kSquare, { maxSeconds: 1 } as never)).message).toContain('`maxSeconds`');
  });
});

describe('in a worker', () => {
  test.each(awaited)('%s: an unknown option is bad-option and named', async (_, call) => {
    expect(await call({})).toBeDefined();
    for (const [name, value] of [['singal', AbortSignal.timeout(1000)], ['onBset', () => 1]] as const) {
      const error = await rejectionOf(call({ [name]: value }));
      expect(error.code).toBe('bad-option');
      expect(error.message).toContain(`\`${name}\` is not an option here`);
      expect(error.message).toContain('signal');
    }
    expect((await rejectionOf(call(null))).code).toBe('bad-option');
  });

  test('createWorker: an unknown option is bad-option and named', async () => {
    const error = await rejectionOf(createWorker({ threads: 2 } as never));
    expect(error.message).toContain('`threads` is not an option here; there are parts, wasm, checks, size');
  });
});
