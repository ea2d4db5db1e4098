// The core's parts: each loaded by itself, in this thread and in workers.
import { readFile } from 'node:fs/promises';
import { createServer, type Server } from 'node:http';
import { createRequire } from 'node:module';
import type { AddressInfo } from 'node:net';
import {
  fillHoles,
  findHoles,
  load,
  MeshSession,
  PolygonSession,
  smoothSurface,
  spanLoops,
  triangulateGeoJSON,
  triangulatePolygon,
  triangulatePolygons,
  type LoadOptions,
  type LoopsLike,
} from 'soapfilm';
import { TrimmedModel, TrimmedSurface } from 'soapfilm/surfaces';
import { createWorker } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { errorOf, rejectionOf } from '../support/errors.js';
import { box, plate } from '../support/models.js';

const kLoops: LoopsLike = [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]]];
const kSquare = [[[0, 0], [1, 0], [1, 1], [0, 1]]];
const kGeoJSON = { type: 'Polygon', coordinates: kSquare };

const onPolygons: [string, () => unknown][] = [
  ['triangulatePolygon', () => triangulatePolygon(kSquare)],
  ['triangulatePolygons', () => triangulatePolygons([kSquare])],
  ['triangulateGeoJSON', () => triangulateGeoJSON(kGeoJSON)],
  ['PolygonSession', () => new PolygonSession(kSquare)],
];

const kMesh = { positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1), faces: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2) };
const onMeshes: [string, () => unknown][] = [
  ['findHoles', () => findHoles(kMesh)],
  ['fillHoles', () => fillHoles(kMesh)],
  ['MeshSession', () => new MeshSession(kMesh)],
  ['smoothSurface', () => smoothSurface(kMesh)],
];

const onSurfaces: [string, () => unknown][] = [
  ['TrimmedModel', () => new TrimmedModel(box())],
  ['TrimmedSurface', () => new TrimmedSurface(plate())],
];

/** Serves the package's modules and takes note of what it is asked for. */
let server: Server;
let address: string;
const asked: string[] = [];

beforeAll(async () => {
  const resolve = createRequire(import.meta.url).resolve;
  server = createServer((request, response) => {
    const name = (request.url ?? '').slice(1);
    asked.push(name);
    if (!name.endsWith('.wasm')) response.writeHead(404).end();
    else {
      const type = { 'content-type': 'application/wasm' };
      void readFile(resolve(`soapfilm/${name}`)).then((data) => response.writeHead(200, type).end(data));
    }
  });
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
  address = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
});
afterAll(() => {
  server.close();
});

const wasm = () => ({
  loops: new URL(`${address}/loops.wasm`),
  polygons: new URL(`${address}/polygons.wasm`),
  meshes: new URL(`${address}/meshes.wasm`),
  surfaces: new URL(`${address}/surfaces.wasm`),
});

// In this order: what is loaded stays so.
describe('load', () => {
  const bad: [string, object | string, string][] = [
    ['a part that there is none of', { parts: ['polygon'] }, '`parts` must be one of'],
    ['no part', { parts: [] }, '`parts` must be one of'],
    ['a part that is not in an array', { parts: 'loops' }, '`parts` must be one of'],
    ['a misspelt option', { part: ['loops'] }, '`part` is not an option'],
    ['a source for no part', { wasm: { loops: 'x', polygon: 'y' } }, '`wasm.polygon` is not an option'],
    ['text', 'loops.wasm', 'must be an object'],
  ];
  test.each(bad)('%s: bad-option, and nothing is loaded', async (_, options, message) => {
    for (const call of [load, createWorker]) {
      const error = await rejectionOf(call(options as LoadOptions));
      expect(error.code).toBe('bad-option');
      expect(error.message).toContain(message);
    }
    expect(errorOf(() => triangulatePolygon(kSquare)).message).toContain('`await load()`');
  });

  test('one part: is fetched, and its functions work; the others say which part they need', async () => {
    await load({ parts: ['loops'], wasm: wasm() });
    expect(asked).toEqual(['loops.wasm']);
    expect(spanLoops(kLoops)).toMatchObject({ found: true, optimal: true });
    for (const [part, calls] of [['polygons', onPolygons], ['meshes', onMeshes], ['surfaces', onSurfaces]] as const) {
      for (const [, call] of calls) {
        const error = errorOf(call);
        expect(error.code).toBe('not-loaded');
        expect(error.message).toMatch(new RegExp(`'${part}'.*\`parts\`.*\`load\``));
      }
    }
  });

  test('a part that is not there: load-failed, with its name', async () => {
    for (const wasm of [`${address}/none`, { polygons: `${address}/none` }]) {
      const error = await rejectionOf(load({ parts: ['polygons'], wasm }));
      expect(error.code).toBe('load-failed');
      expect(error.message).toMatch(/polygons.*404/);
    }
    expect(errorOf(onPolygons[0][1]).code).toBe('not-loaded');
  });

  test('all parts, later: only what is missing is fetched', async () => {
    asked.length = 0;
    await Promise.all([load({ wasm: wasm() }), load({ parts: ['polygons'] }), load()]);
    expect(asked.sort()).toEqual(['meshes.wasm', 'polygons.wasm', 'surfaces.wasm']);
    expect(spanLoops(kLoops).found).toBe(true);
  });

  test.each([...onPolygons, ...onMeshes, ...onSurfaces])('%s: works with all parts', (_, call) => {
    expect(call()).toBeDefined();
  });

  test('a borrowed triangulation: a call of the other part leaves it alone', () => {
    const own = triangulatePolygon(kSquare).triangles;
    const { triangles } = triangulatePolygon(kSquare, { borrow: true });
    spanLoops(kLoops);
    expect(triangles).toEqual(own);
  });
});

describe('createWorker', () => {
  test('needs of what is loaded nothing more', async () => {
    asked.length = 0;
    const film = await createWorker({ wasm: wasm() });
    expect((await film.spanLoops(kLoops)).found).toBe(true);
    film.dispose();
    expect(asked).toEqual([]);
  });

  test('one part: the functions of the others are rejected, and say which part they need', async () => {
    const film = await createWorker({ parts: ['polygons'] });
    expect((await film.triangulatePolygon(kSquare)).triangles).toHaveLength(6);
    const error = await rejectionOf(film.spanLoops(kLoops));
    expect(error.code).toBe('not-loaded');
    expect(error.message).toMatch(/'loops'.*`parts`.*`createWorker`/);
    expect((await rejectionOf(film.fillHoles(kMesh))).message).toMatch(/'meshes'.*`parts`.*`createWorker`/);
    expect((await rejectionOf(film.createTrimmedModel(box()))).message).toMatch(/'surfaces'.*`parts`.*`createWorker`/);
    expect((await film.triangulateGeoJSON(kGeoJSON)).triangles).toHaveLength(6);
    film.dispose();
  });
});
