import { execFile } from 'node:child_process';
import { cp, mkdtemp, rm, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import {
  load,
  SoapfilmError,
  spanLoops,
  triangulateGeoJSON,
  triangulatePolygon,
  triangulatePolygons,
  type NoSpan,
  type Point,
  type Span,
} from 'soapfilm';
import { createWorker, type Film } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { rejectionOf } from '../support/errors.js';

const run = promisify(execFile);

const ring = (count: number, radius: number, z: number): Point[] =>
  Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * (i + 0.1 * Math.sin(7 * i))) / count;
    return [radius * Math.cos(angle), radius * Math.sin(angle), z + 0.3 * Math.sin(3 * angle)];
  });

/** Quick, and with every array of the result in use. */
const kRings = [ring(12, 2, 0), ring(9, 1, 1)];
/** So much work that it cannot be done within the test. */
const kMuch = [ring(60, 2, 0), ring(60, 1, 1), ring(60, 3, 2), ring(60, 1, 3)];

let film: Film;

beforeAll(async () => {
  await load();
  film = await createWorker({ size: 2 });
});

afterAll(() => {
  film.dispose();
});

const withoutSeconds = (span: Span | NoSpan) => ({ ...span, stats: { ...span.stats, seconds: 0 } });

describe('spanLoops', () => {
  test.each(['delaunay', 'all'] as const)('%s: the same result as at once', async (candidates) => {
    const here = spanLoops(kRings, { candidates });
    const there = await film.spanLoops(kRings, { candidates });
    expect(withoutSeconds(there)).toEqual(withoutSeconds(here));
    expect(here.found).toBe(true);
  });

  test('no triangulation: an answer, not an error', async () => {
    const triangles = new Uint32Array([0, 1, 2]);
    const span = await film.spanLoops(kRings, { candidates: { triangles } });
    expect(span).toMatchObject({ found: false, candidates: 'given' });
    expect(triangles).toEqual(Uint32Array.of(0, 1, 2));
  });

  test('an error: code and place as at once', async () => {
    const bad = kRings.map((loop) => loop.slice());
    bad[1][4] = [0, NaN, 0];
    const error = await rejectionOf(film.spanLoops(bad));
    expect(error).toMatchObject({ code: 'not-finite', loop: 1, vertex: 4 });
    expect(error.message).toContain('oop 1, vertex 4');
  });

  test('many calls at once: each has its own result', async () => {
    const sizes = [3, 4, 5, 6, 7, 8, 9, 10, 11, 12];
    const spans = await Promise.all(sizes.map((n) => film.spanLoops([ring(n, 1, 0)])));
    spans.forEach((span, i) => {
      expect(span.found && span.triangles.length / 3).toBe(sizes[i] - 2);
    });
  });

  test('much work, cancelled once it is under way: cancelled, and the next call works', async () => {
    const controller = new AbortController();
    const onProgress = (): void => {
      controller.abort();
    };
    const options = { candidates: 'all', signal: controller.signal, onProgress } as const;
    expect((await rejectionOf(film.spanLoops(kMuch, options))).code).toBe('cancelled');
    expect((await film.spanLoops(kRings)).found).toBe(true);
  });

  test('much work within maxSeconds: time-limit, and the next call works', async () => {
    const options = { candidates: 'all', maxSeconds: 0.3 } as const;
    expect((await rejectionOf(film.spanLoops(kMuch, options))).code).toBe('time-limit');
    expect((await film.spanLoops(kRings)).found).toBe(true);
  });
});

describe('polygons', () => {
  const square = (x: number, size: number): number[][] => [
    [x, x],
    [x + size, x],
    [x + size, x + size],
    [x, x + size],
  ];
  const good = [square(0, 9), square(2, 3)];
  const bowTie = [[[0, 0], [2, 2], [2, 0], [0, 2]]];

  test('triangulatePolygon: the same result as at once, in arrays of its own', async () => {
    for (const options of [{}, { trace: true, borrow: true }, { output: 'strips', quality: 'delaunay' } as const]) {
      const there = await film.triangulatePolygon(good, options);
      expect(there).toEqual(triangulatePolygon(good, { ...options, borrow: false }));
      expect(there.triangles.byteLength).toBe(there.triangles.buffer.byteLength);
    }
    const flat = { positions: Float64Array.from(good.flat(2)), starts: Uint32Array.of(0, 4, 8) };
    expect(await film.triangulatePolygon(flat)).toEqual(triangulatePolygon(good));
    // Input is copied, not taken away.
    expect(flat.positions.length).toBe(16);
  });

  test('triangulatePolygons, triangulateGeoJSON: the same, their errors still errors', async () => {
    const polygons = [good, bowTie, good];
    const options = { skipInvalid: true };
    const there = await film.triangulatePolygons(polygons, options);
    expect(there).toEqual(triangulatePolygons(polygons, options));
    expect(there.errors[0]).toBeInstanceOf(SoapfilmError);
    expect(there.errors[0]).toMatchObject({ code: 'self-intersecting', polygon: 1, loop: 0, point: [1, 1] });
    const geojson = { type: 'MultiPolygon', coordinates: polygons };
    const found = await film.triangulateGeoJSON(geojson, options);
    expect(found).toEqual(triangulateGeoJSON(geojson, options));
    expect(found.errors[0]).toBeInstanceOf(SoapfilmError);
  });

  test('an error: code, place and point as at once', async () => {
    const error = await rejectionOf(film.triangulatePolygon(bowTie));
    expect(error).toMatchObject({ code: 'self-intersecting', loop: 0, vertex: 0, otherVertex: 2, point: [1, 1] });
    expect((await rejectionOf(film.triangulatePolygons([good, bowTie]))).polygon).toBe(1);
    const signal = AbortSignal.abort();
    expect((await rejectionOf(film.triangulatePolygon(good, { signal }))).code).toBe('cancelled');
    expect((await film.triangulatePolygon(good)).triangles.length).toBe(24);
  });
});

test('createWorker: needs no load, and keeps no process alive', async () => {
  const script = `
    import { createWorker } from 'soapfilm/worker';
    const film = await createWorker();
    const span = await film.spanLoops([[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]]]);
    console.log(span.triangles.length);`;
  const { stdout } = await run(process.execPath, ['--input-type=module', '-e', script]);
  expect(stdout).toBe('6\n');
});

test('createWorker: works without the files of the core and the worker', async () => {
  const dist = path.dirname(createRequire(import.meta.url).resolve('soapfilm/loops.wasm'));
  const copy = await mkdtemp(path.join(tmpdir(), 'soapfilm-'));
  try {
    await cp(dist, copy, { recursive: true });
    for (const name of ['loops.wasm', 'polygons.wasm', 'worker_thread.js', 'worker_thread_node.js']) {
      await rm(path.join(copy, name));
    }
    await writeFile(path.join(copy, 'package.json'), '{ "type": "module" }');
    const entry = pathToFileURL(path.join(copy, 'worker_node.js')).href;
    const script = `
      import { createWorker } from '${entry}';
      const film = await createWorker({ size: 2 });
      const loops = [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]]];
      const spans = await Promise.all([1, 2].map(() => film.spanLoops(loops)));
      console.log(spans.map((span) => span.triangles.length).join());`;
    const { stdout } = await run(process.execPath, ['--input-type=module', '-e', script]);
    expect(stdout).toBe('6,6\n');
  } finally {
    await rm(copy, { recursive: true });
  }
});
