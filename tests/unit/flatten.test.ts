// The forms in which loops and polygons may come: each gives what flat arrays give, here and in a worker.
import { Worker } from 'node:worker_threads';
import { runInNewContext } from 'node:vm';
import {
  formatLoops,
  load,
  PolygonSession,
  spanLoops,
  triangulateGeoJSON,
  triangulatePolygon,
  triangulatePolygons,
  type LoopsLike,
  type NoSpan,
  type PolygonLike,
  type Span,
} from 'soapfilm';
import { createWorker, type Film } from 'soapfilm/worker';
import { Vector2, Vector3 } from 'three';
import { afterAll, afterEach, beforeAll, describe, expect, test, vi } from 'vitest';

let film: Film;
beforeAll(async () => {
  await load();
  film = await createWorker();
});
afterAll(() => {
  film.dispose();
});

// Numbers that Float32Array holds exactly.
const ring = (count: number, z: number): number[][] =>
  Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * i) / count;
    return [Math.cos(angle), Math.sin(angle), z + 0.25 * Math.cos(3 * angle)].map(Math.fround);
  });
const kLoops = [ring(6, 0), ring(5, 1)];
const kFlat = { positions: Float64Array.from(kLoops.flat(2)), starts: Uint32Array.of(0, 6, 11) };

class Points extends Array<readonly number[]> {}
class Named extends Float64Array {
  override get length(): number {
    return 1e6;
  }
}

const shared = (view: Float64Array): Float64Array => {
  const copy = new Float64Array(new SharedArrayBuffer(view.byteLength));
  copy.set(view);
  return copy;
};
const resizable = (view: Float64Array): Float64Array => {
  const Buffer = ArrayBuffer as new (bytes: number, options: object) => ArrayBuffer;
  const copy = new Float64Array(new Buffer(view.byteLength, { maxByteLength: 2 * view.byteLength }));
  copy.set(view);
  return copy;
};
const elsewhere = (code: string, values: unknown): unknown => runInNewContext(code, { values });
const frozen = <T extends object>(list: T): T => {
  for (const item of Object.values(list)) if (typeof item === 'object' && item !== null) frozen(item as object);
  return Object.freeze(list);
};

const kMany: [string, LoopsLike][] = [
  ['arrays of numbers', kLoops],
  ['frozen arrays', frozen(kLoops.map((loop) => loop.map((point) => point.slice())))],
  ['heirs of Array', kLoops.map((loop) => Points.from(loop))],
  ['objects with x, y and z', kLoops.map((loop) => loop.map(([x, y, z]) => ({ x, y, z })))],
  ["three's vectors", kLoops.map((loop) => loop.map(([x, y, z]) => new Vector3(x, y, z)))],
  ['a Float64Array a point', kLoops.map((loop) => loop.map((point) => Float64Array.from(point)))],
  ['a Float32Array a point', kLoops.map((loop) => loop.map((point) => Float32Array.from(point)))],
  ['a Float64Array a loop', kLoops.map((loop) => Float64Array.from(loop.flat()))],
  ['a Float32Array a loop', kLoops.map((loop) => Float32Array.from(loop.flat()))],
  ['all of these together', [[...kLoops[0].slice(0, 5), new Vector3(...kLoops[0][5])], Float32Array.from(kLoops[1].flat())]],
  ['flat arrays', kFlat],
  ['a flat Float32Array', { ...kFlat, positions: Float32Array.from(kFlat.positions) }],
  ['starts as an array', { ...kFlat, starts: [0, 6, 11] }],
  ['part of a larger buffer', { ...kFlat, positions: Float64Array.of(9, 9, 9, ...kFlat.positions, 9).subarray(3, 36) }],
  ['shared memory', { ...kFlat, positions: shared(kFlat.positions) }],
  ['resizable memory', { ...kFlat, positions: resizable(kFlat.positions) }],
  ['arrays of another window', elsewhere('values.map((loop) => loop.map((point) => Array.from(point)))', kLoops) as LoopsLike],
  ['typed arrays of another window', { ...kFlat, positions: elsewhere('Float64Array.from(values)', kFlat.positions) as Float64Array }],
  ['an array that hides its length', { ...kFlat, positions: new Named(kFlat.positions) }],
];

const withoutSeconds = (span: Span | NoSpan) => ({ ...span, stats: { ...span.stats, seconds: 0 } });

describe('loops', () => {
  test.each(kMany)('%s: as flat arrays, here and in a worker, and the caller keeps his', async (_, loops) => {
    const expected = withoutSeconds(spanLoops({ positions: kFlat.positions.slice(), starts: kFlat.starts.slice() }));
    expect(expected.found).toBe(true);
    const copy = formatLoops(loops);
    expect(withoutSeconds(spanLoops(loops))).toEqual(expected);
    expect(withoutSeconds(await film.spanLoops(loops))).toEqual(expected);
    expect(formatLoops(loops)).toBe(copy);
    expect(copy).toBe(formatLoops(kFlat));
  });

  test('without starts: one loop', () => {
    const positions = Float64Array.from(kLoops[0].flat());
    expect(withoutSeconds(spanLoops({ positions }))).toEqual(withoutSeconds(spanLoops([kLoops[0]])));
  });
});

describe('polygons', () => {
  const kRings = [[[0, 0], [8, 0], [8, 6], [0, 6]], [[2, 2], [3, 4], [5, 3]]];
  const kPositions = Float64Array.from(kRings.flat(2));
  const forms: [string, PolygonLike][] = [
    ['objects with x and y', kRings.map((points) => points.map(([x, y]) => ({ x, y })))],
    ["three's vectors", kRings.map((points) => points.map(([x, y]) => new Vector2(x, y)))],
    ['a Float32Array a point', kRings.map((points) => points.map((point) => Float32Array.from(point)))],
    ['a Float64Array a ring', kRings.map((points) => Float64Array.from(points.flat()))],
    ['frozen arrays', frozen(kRings.map((points) => points.map((point) => point.slice())))],
    ['a flat Float32Array', { positions: Float32Array.from(kPositions), starts: [0, 4, 7] }],
    ['as earcut takes it', { coordinates: Int16Array.from(kPositions), holeIndices: Uint8Array.of(4) }],
  ];
  test.each(forms)('%s: as arrays of numbers, here and in a worker', async (_, polygon) => {
    const { triangles } = triangulatePolygon(kRings);
    expect(triangulatePolygon(polygon).triangles).toEqual(triangles);
    expect((await film.triangulatePolygon(polygon)).triangles).toEqual(triangles);
    if (!Array.isArray(polygon)) return;
    expect(triangulatePolygons([polygon, kRings]).triangles.subarray(0, triangles.length)).toEqual(triangles);
  });

  test("in space, three's vectors: as arrays of numbers", () => {
    const inSpace = kRings.map((points) => points.map(([x, y]) => [x, y, x + y]));
    const vectors = inSpace.map((points) => points.map((point) => new Vector3(...point)));
    expect(triangulatePolygon(vectors).triangles).toEqual(triangulatePolygon(inSpace).triangles);
  });

  test('isolated points, as Float32Array: as of Float64Array', async () => {
    const points = Float32Array.of(1, 1, 6, 5);
    const { triangles } = triangulatePolygon({ positions: kPositions, starts: [0, 4, 7], points: Float64Array.from(points) });
    const polygon = { positions: kPositions, starts: [0, 4, 7], points };
    expect(triangulatePolygon(polygon).triangles).toEqual(triangles);
    expect((await film.triangulatePolygon(polygon)).triangles).toEqual(triangles);
    expect(points.length).toBe(4);
  });

  test('points of edits: arrays of any kind, and objects', () => {
    const session = new PolygonSession(kRings);
    for (const point of [[1, 0.5], Float64Array.of(1, 0.5), Float32Array.of(1, 0.5), { x: 1, y: 0.5 }, new Vector2(1, 0.5)]) {
      session.move(0, [0, 0]);
      session.move(0, point);
      expect(Array.from(session.read().positions.subarray(0, 2))).toEqual([1, 0.5]);
    }
    session.dispose();
  });
});

describe('in a worker', () => {
  interface Sent {
    readonly message: unknown;
    readonly transfer: readonly unknown[];
  }
  const sent: Sent[] = [];
  afterEach(() => {
    vi.restoreAllMocks();
    sent.length = 0;
  });

  /** What is in a message: its typed arrays, and how many other values. */
  function contents(value: unknown, arrays: ArrayBufferView[] = [], count = { others: 0 }) {
    if (ArrayBuffer.isView(value)) arrays.push(value);
    else if (typeof value === 'object' && value !== null) {
      for (const item of Object.values(value)) contents(item, arrays, count);
    } else count.others++;
    return { arrays, others: count.others };
  }

  const many = ring(500, 0);
  const square = [[0, 0], [9, 0], [9, 9], [0, 9]];
  const squares = Array.from({ length: 200 }, (_, i) => [square.map(([x, y]) => [x + 10 * i, y])]);
  const normals = new Float64Array(1500).fill(NaN);
  const startFrom = Uint32Array.of(0, 1, 2);
  const candidates = { triangles: Uint32Array.of(0, 1, 2), weights: Float64Array.of(1) };
  const calls: [string, () => Promise<unknown>][] = [
    ['spanLoops, nested', () => film.spanLoops([many], { boundaryNormals: normals, startFrom, candidates })],
    ['spanLoops, flat', () => film.spanLoops({ positions: Float64Array.from(many.flat()), starts: [0, 500] }, { candidates: 'delaunay' })],
    ['triangulatePolygon', () => film.triangulatePolygon([many.map(([x, y]) => [x, y])])],
    ['triangulatePolygons', () => film.triangulatePolygons(squares)],
    ['triangulateGeoJSON', () => film.triangulateGeoJSON({ type: 'MultiPolygon', coordinates: squares })],
  ];
  test.each(calls)('%s: only flat arrays cross, all of them handed over', async (_, call) => {
    // eslint-disable-next-line @typescript-eslint/unbound-method -- called as a method below
    const { postMessage } = Worker.prototype;
    vi.spyOn(Worker.prototype, 'postMessage').mockImplementation(function (this: Worker, message: unknown, transfer) {
      const { arrays, others } = contents(message);
      const buffers = arrays.map(({ buffer }) => buffer);
      expect(arrays.every((array) => array.byteLength === array.buffer.byteLength)).toBe(true);
      expect(new Set(transfer)).toEqual(new Set(buffers));
      expect(new Set(buffers).size).toBe(buffers.length);
      expect(others).toBeLessThan(20);
      sent.push({ message, transfer: transfer ?? [] });
      postMessage.call(this, message, transfer);
      expect(arrays.every(({ byteLength }) => byteLength === 0)).toBe(true);
    });
    await call();
    expect(sent.length).toBe(1);
    expect(normals.length + startFrom.length + candidates.triangles.length + candidates.weights.length).toBe(1507);
  });

  test('triangulateGeoJSON: the positions of the result are those of the call at once', async () => {
    const geojson = { type: 'MultiPolygon', coordinates: squares };
    expect(await film.triangulateGeoJSON(geojson)).toEqual(triangulateGeoJSON(geojson));
  });
});
