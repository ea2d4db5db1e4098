// Arguments of every kind in every place: what is wrong is an error that names it, and does no other harm.
import {
  fillHoles,
  findHoles,
  formatObj,
  load,
  PolygonSession,
  smoothSurface,
  SoapfilmError,
  spanLoops,
  triangulateGeoJSON,
  triangulatePolygon,
  triangulatePolygons,
  type LoopsLike,
} from 'soapfilm';
import { TrimmedModel } from 'soapfilm/surfaces';
import { createWorker, type Film, type PolygonSessionHandle, type TrimmedModelHandle } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import {
  fileSlots,
  functionSlots,
  kPlate,
  kTwoHoles,
  kValues,
  loadSlots,
  modelFileSlots,
  modelSlots,
  sessionSlots,
  type Functions,
  type Kind,
  type Slot,
} from '../support/arguments.js';
import { errorOf } from '../support/errors.js';

const kSquare = [[0, 0], [10, 0], [10, 10], [0, 10]];
const kSurface = { positions: new Float64Array(9), triangles: Uint32Array.of(0, 1, 2) };
const kLoop = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]];

let film: Film;
/** Open throughout: whatever is called, it stays as it is. */
let bystander: PolygonSession;
let before: ReturnType<PolygonSession['read']>;

beforeAll(async () => {
  await load();
  film = await createWorker();
  bystander = new PolygonSession([kSquare, [[2, 2], [4, 2], [3, 4]]]);
  before = bystander.read();
});
afterAll(() => {
  film.dispose();
});

interface Disposable {
  dispose?: () => void;
}

/** What comes of a call: its error, or nothing. */
async function outcomeOf(call: () => unknown): Promise<unknown> {
  try {
    const result = (await call()) as Disposable | undefined;
    result?.dispose?.();
    return undefined;
  } catch (error) {
    return error;
  }
}

/** Puts every kind of value in a place, and sees what comes of it. */
async function tryAll({ call, valid, names, codes }: Slot): Promise<void> {
  for (const kind of Object.keys(kValues) as Kind[]) {
    const value: unknown = kValues[kind]();
    const error = await outcomeOf(() => call(value));
    if (valid.includes(kind)) {
      expect(error, `${kind} is valid here`).toBeUndefined();
    } else {
      if (!(error instanceof SoapfilmError)) {
        expect.fail(`${kind}: ${error instanceof Error ? error.stack : 'no error'}`);
      }
      expect(codes, `${kind}: ${error.message}`).toContain(error.code);
      expect(error.message, kind).toMatch(names);
    }
    // Nothing is lost, and what comes next works.
    expect(bystander.read(), kind).toEqual(before);
    expect(bystander.move(0, [0, 0]).vertex, kind).toBe(0);
  }
  expect(spanLoops([kLoop]).found).toBe(true);
  expect(triangulatePolygon([kSquare]).triangles.length).toBe(6);
  expect(fillHoles(kTwoHoles).closed).toBe(true);
}

const here: Functions = { spanLoops, triangulatePolygon, triangulatePolygons, triangulateGeoJSON, findHoles, fillHoles, smoothSurface };
const there: Pick<Film, keyof Functions> = {
  spanLoops: (loops, options) => film.spanLoops(loops, options),
  triangulatePolygon: (polygon, options) => film.triangulatePolygon(polygon, options),
  triangulatePolygons: (polygons, options) => film.triangulatePolygons(polygons, options),
  triangulateGeoJSON: (geojson, options) => film.triangulateGeoJSON(geojson, options),
  findHoles: (mesh, options) => film.findHoles(mesh, options),
  fillHoles: (mesh, options) => film.fillHoles(mesh, options),
  smoothSurface: (surface, options) => film.smoothSurface(surface, options),
};

const openHere = (polygon: unknown, options?: unknown): PolygonSession =>
  new PolygonSession(polygon as never, options as never);
const openThere = (polygon: unknown, options?: unknown): Promise<PolygonSessionHandle> =>
  film.createPolygonSession(polygon as never, options as never);

const modelHere = (model: unknown, options?: unknown): TrimmedModel => new TrimmedModel(model as never, options as never);
const modelThere = (model: unknown, options?: unknown): Promise<TrimmedModelHandle> =>
  film.createTrimmedModel(model as never, options as never);

const titled = (slots: readonly Slot[]): [string, Slot][] => slots.map((slot) => [slot.title, slot]);

describe('in this thread', () => {
  test.each(titled(functionSlots(here)))('%s: every kind of value', (_, slot) => tryAll(slot));
  test.each(titled(sessionSlots(openHere)))('%s: every kind of value', (_, slot) => tryAll(slot));
  test.each(titled(fileSlots()))('%s: every kind of value', (_, slot) => tryAll(slot));
  test.each(titled(modelSlots(modelHere)))('%s: every kind of value', (_, slot) => tryAll(slot));
  test.each(titled(modelFileSlots()))('%s: every kind of value', (_, slot) => tryAll(slot));
});

describe('in a worker', () => {
  const signal = { signal: ['missing'] } as const;
  const slots = [...functionSlots(there, signal), ...sessionSlots(openThere, signal)];
  test.each(titled(slots))('%s: every kind of value', async (_, slot) => {
    await tryAll(slot);
    expect((await film.spanLoops([kLoop])).found).toBe(true);
  });

  // Models have a thread each, and are checked by the same code as here.
  const ofModels = modelSlots(modelThere, signal).filter(({ title }) => /: (model|signal|weight|camera|skipInvalid)$/.test(title));
  test.each(titled(ofModels))('%s: every kind of value', (_, slot) => tryAll(slot));
});

describe('loading', () => {
  test.each(titled(loadSlots()))('%s: every kind of value', (_, slot) => tryAll(slot));
});

test('numbers of vertices that there are not: are refused, with the one that stands for none', () => {
  const session = new PolygonSession({ positions: Float64Array.from(kSquare.flat()), points: Float64Array.of(5, 5) });
  const { next } = session.read();
  expect(next[4]).toBe(0xffffffff);
  for (const vertex of [next[4], 5, 0xfffffffc, 0xfffffffe]) {
    for (const edit of [
      () => session.move(vertex, [5, 6]),
      () => session.delete(vertex),
      () => session.insert(vertex, [5, 6]),
    ]) {
      const error = errorOf(edit);
      expect(error.code).toBe('bad-option');
      expect(error.message).toMatch(new RegExp(`^\`(vertex|before)\` .*\\b${vertex}\\b`));
    }
  }
  expect(session.read().next).toEqual(next);
  session.dispose();
});

test('a session that is disposed of: whatever is asked of it is disposed', () => {
  const session = new PolygonSession([kSquare]);
  session.dispose();
  session.dispose();
  for (const use of [
    () => session.triangles,
    () => session.read(),
    () => session.insert(0, [5, 1]),
    () => session.insertPoint([5, 5]),
    () => session.delete(0),
    () => session.move(0, [1, 1]),
  ]) {
    expect(errorOf(use).code).toBe('disposed');
  }
  expect(bystander.read()).toEqual(before);
});

const kSpanNames = [
  'maxMemoryBytes', 'maxSeconds', 'weights', 'objective', 'candidates', 'boundaryNormals', 'bestSoFar', 'onBest',
  'startFrom', 'onProgress',
];
const kPolygonNames = [
  'maxMemoryBytes', 'maxSeconds', 'method', 'output', 'quality', 'verify', 'repair', 'trace', 'borrow',
];
const kFillNames = [
  'maxMemoryBytes', 'maxSeconds', 'weld', 'weights', 'candidates', 'fairness', 'density', 'maxNewVertices', 'creases', 'holes', 'groups',
  'perHole', 'fillOpenRims', 'maxVertices', 'maxLength', 'output', 'onProgress', 'maxSecondsPerHole',
];
const kSamplingNames = ['tolerance', 'relative', 'angle', 'camera', 'aspect', 'maxTriangles', 'maxSeconds', 'maxMemoryBytes', 'onProgress'];
const readers: [string, readonly string[], (options: object) => unknown][] = [
  ['spanLoops', kSpanNames, (options) => spanLoops([kLoop], options)],
  ['film.spanLoops', [...kSpanNames, 'signal'], (options) => film.spanLoops([kLoop], options)],
  ['triangulatePolygon', kPolygonNames, (options) => triangulatePolygon([kSquare], options)],
  ['film.triangulatePolygons', [...kPolygonNames, 'skipInvalid', 'signal'], (options) => film.triangulatePolygons([[kSquare]], options)],
  ['PolygonSession', ['maxMemoryBytes'], (options) => new PolygonSession([kSquare], options)],
  ['film.createPolygonSession', ['maxMemoryBytes', 'signal'], (options) => film.createPolygonSession([kSquare], options)],
  ['findHoles', ['maxMemoryBytes', 'maxSeconds', 'weld'], (options) => findHoles(kTwoHoles, options)],
  ['fillHoles', kFillNames, (options) => fillHoles(kTwoHoles, options)],
  ['film.fillHoles', [...kFillNames, 'signal'], (options) => film.fillHoles(kTwoHoles, options)],
  ['smoothSurface', ['maxMemoryBytes', 'maxSeconds', 'kind', 'density', 'maxNewVertices', 'fixed', 'boundaryNormals'], (options) => smoothSurface(kTwoHoles, options)],
  ['TrimmedModel', ['skipInvalid', 'maxMemoryBytes'], (options) => new TrimmedModel(kPlate, options)],
  ['film.createTrimmedModel', ['skipInvalid', 'maxMemoryBytes', 'signal'], (options) => film.createTrimmedModel(kPlate, options)],
  ['tessellate', kSamplingNames, (options) => new TrimmedModel(kPlate).tessellate(options)],
  ['update', kSamplingNames, (options) => new TrimmedModel(kPlate).update(options)],
  ['load', ['parts', 'wasm', 'checks'], (options) => load(options)],
  ['createWorker', ['parts', 'wasm', 'checks', 'size'], (options) => createWorker(options)],
  ['formatObj', ['name', 'precision'], (options) => formatObj(kSurface, options)],
];
test.each(readers)('%s: an option that cannot be read is bad-option and named', async (_, names, call) => {
  for (const option of names) {
    const reason = new Error('unreadable');
    const options = Object.defineProperty({}, option, {
      enumerable: true,
      get: () => {
        throw reason;
      },
    });
    const error = await outcomeOf(() => call(options));
    expect(error).toBeInstanceOf(SoapfilmError);
    expect(error).toMatchObject({ code: 'bad-option', cause: reason });
    expect((error as SoapfilmError).message).toContain(`\`${option}\``);
  }
});

test('points that cannot be read: an error with their list', () => {
  const reason = new Error('unreadable');
  const point = Object.defineProperty({ y: 1, z: 1 }, 'x', {
    get: () => {
      throw reason;
    },
  });
  const loops = [kLoop, [...kLoop, point]] as unknown as LoopsLike;
  expect(errorOf(() => spanLoops(loops))).toMatchObject({ code: 'bad-loops', loop: 1, cause: reason });
});

test('calls from within a listener: bad-option, whatever is called, and the work goes on', () => {
  let refused = 0;
  const ring = (n: number, z: number) =>
    Array.from({ length: n }, (_, i) => [Math.cos((2 * Math.PI * i) / n), Math.sin((2 * Math.PI * i) / n), z]);
  const span = spanLoops([ring(12, 0), ring(12, 1)], {
    bestSoFar: true,
    onBest: () => {
      for (const call of [
        () => spanLoops([kLoop]),
        () => triangulatePolygon([kSquare]),
        () => bystander.move(0, [1, 1]),
        () => bystander.read(),
        () => new PolygonSession([kSquare]),
        () => findHoles(kTwoHoles),
        () => fillHoles(kTwoHoles),
      ]) {
        expect(errorOf(call).code).toBe('bad-option');
        refused++;
      }
    },
  });
  expect(span.found).toBe(true);
  expect(refused).toBeGreaterThan(0);
  expect(bystander.read()).toEqual(before);
});

describe('meshes with faults', () => {
  const faulty = (change: (positions: Float64Array, faces: Uint32Array) => void) => {
    const [positions, faces] = [kTwoHoles.positions.slice(), kTwoHoles.faces.slice()];
    change(positions, faces);
    return { positions, faces };
  };
  const faults: [string, ReturnType<typeof faulty>, object][] = [
    ['NaN', faulty((p) => (p[4] = NaN)), { code: 'not-finite', vertex: 1 }],
    ['infinity', faulty((p) => (p[21] = -Infinity)), { code: 'not-finite', vertex: 7 }],
    ['a coordinate beyond 1e150', faulty((p) => (p[0] = 1e151)), { code: 'not-finite', vertex: 0 }],
    ['a vertex that is not there', faulty((_, f) => (f[7] = 8)), { code: 'bad-mesh', face: 2 }],
    ['the largest number', faulty((_, f) => (f[17] = 0xffffffff)), { code: 'bad-mesh', face: 5 }],
  ];
  test.each(faults)('%s: an error with the place', async (_, mesh, error) => {
    const { positions, faces } = mesh;
    for (const given of [mesh, { positions, triangles: faces }]) {
      expect(errorOf(() => findHoles(given))).toMatchObject(error);
      expect(errorOf(() => fillHoles(given))).toMatchObject(error);
      expect(await outcomeOf(() => film.findHoles(given))).toMatchObject(error);
      expect(await outcomeOf(() => film.fillHoles(given))).toMatchObject(error);
    }
    expect(findHoles(kTwoHoles).groups.length).toBe(2);
  });

  test.each([4, 7])('arrays of %i numbers: bad-mesh, none of threes', (length) => {
    for (const call of [findHoles, fillHoles]) {
      expect(errorOf(() => call({ ...kTwoHoles, positions: new Float64Array(length) })).code).toBe('bad-mesh');
      expect(errorOf(() => call({ ...kTwoHoles, faces: new Uint32Array(length) })).code).toBe('bad-mesh');
    }
  });

  const beyond: [string, object][] = [
    ['holes', { holes: [2] }],
    ['holes', { holes: [0, 0] }],
    ['groups', { groups: [[0], [2]] }],
    ['groups', { groups: [[0], [1, 0]] }],
    ['perHole', { perHole: { 2: {} } }],
    ['perHole', { perHole: { first: {} } }],
    ['perHole', { perHole: { '-1': {} } }],
    ['perHole[__proto__]', { perHole: JSON.parse('{ "__proto__": {} }') as object }],
    ['perHole[1].weights.angle', { perHole: { 1: { weights: { angle: 1 } } } }],
    ['perHole', { perHole: { 0: { fair: 1 } } }],
    ['density', { density: 101 }],
    ['fairness', { fairness: 3 }],
    ['creases', { creases: 181 }],
    ['weld', { weld: -1 }],
    ['weld', { weld: Infinity }],
  ];
  test.each(beyond)('%s, %o: bad-option', async (name, options) => {
    for (const error of [
      await outcomeOf(() => fillHoles(kTwoHoles, options)),
      await outcomeOf(() => film.fillHoles(kTwoHoles, options)),
    ]) {
      expect(error).toMatchObject({ code: 'bad-option' });
      expect((error as SoapfilmError).message).toContain(name);
    }
  });

  test('weights of one hole: an error names it', () => {
    const error = errorOf(() => fillHoles(kTwoHoles, { perHole: { 1: { weights: { area: -1 } } } }));
    expect(error).toMatchObject({ code: 'bad-weights' });
    expect(error.message).toContain('perHole[1].weights.area');
  });

  test.each([Float32Array, Float64Array])('%o: given back in its kind, and left as it is', async (Kind) => {
    const given = { positions: Kind.from(kTwoHoles.positions), faces: kTwoHoles.faces.slice() };
    const here = fillHoles(given);
    expect(here.mesh.positions).toBeInstanceOf(Kind);
    expect(await film.fillHoles(given)).toEqual(here);
    expect(given).toEqual({ positions: Kind.from(kTwoHoles.positions), faces: kTwoHoles.faces });
  });

  test('shared memory: is read like any other, and not taken away', async () => {
    const positions = new Float64Array(new SharedArrayBuffer(kTwoHoles.positions.byteLength));
    const faces = new Uint32Array(new SharedArrayBuffer(kTwoHoles.faces.byteLength));
    positions.set(kTwoHoles.positions);
    faces.set(kTwoHoles.faces);
    expect(fillHoles({ positions, faces })).toEqual(fillHoles(kTwoHoles));
    expect(await film.fillHoles({ positions, faces })).toEqual(fillHoles(kTwoHoles));
    expect([...faces]).toEqual([...kTwoHoles.faces]);
  });
});

describe('GeoJSON that contains itself', () => {
  interface Collection {
    type: string;
    geometries: unknown[];
  }
  const collection = (...geometries: unknown[]): Collection => ({ type: 'GeometryCollection', geometries });

  test('at once, or by way of others: bad-polygon', async () => {
    const self = collection();
    self.geometries.push({ type: 'Polygon', coordinates: [kSquare] }, self);
    const [a, b] = [collection(), collection()];
    a.geometries.push(b);
    b.geometries.push(collection(a));
    const feature: { type: string; geometry?: unknown } = { type: 'Feature' };
    feature.geometry = collection(feature);
    for (const geojson of [self, a, feature, { type: 'FeatureCollection', features: [self] }]) {
      for (const call of [() => triangulateGeoJSON(geojson), () => film.triangulateGeoJSON(geojson)]) {
        const error = await outcomeOf(call);
        expect(error).toMatchObject({ code: 'bad-polygon' });
        expect((error as SoapfilmError).message).toMatch(/`geojson` contains itself/);
      }
    }
  });

  test('one geometry in many places: is triangulated in each', () => {
    const polygon = collection({ type: 'Polygon', coordinates: [kSquare] });
    const twice = collection(polygon, polygon, collection(polygon));
    expect(triangulateGeoJSON(collection(twice, polygon)).triangles.length).toBe(4 * 6);
  });

  test('one in so many places that there is no end: too-large', () => {
    let geojson = collection();
    for (let i = 0; i < 60; i++) geojson = collection(geojson, geojson);
    expect(errorOf(() => triangulateGeoJSON(geojson)).code).toBe('too-large');
  });
});
