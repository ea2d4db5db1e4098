// Sessions on meshes: what they fill is what fillHoles fills, however often, here and in a pool.
import { fillHoles, findHoles, load, MeshSession, type FillOptions, type FillResult, type MeshInput, type SessionFillOptions } from 'soapfilm';
import { createWorker, type Film, type MeshSessionHandle } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { errorOf, rejectionOf } from '../support/errors.js';
import { cut, sphere, torus, type Mesh } from '../support/meshes.js';

let film: Film;
beforeAll(async () => {
  await load();
  film = await createWorker({ size: 2 });
});
afterAll(() => {
  film.dispose();
});

const kSphere = cut(sphere(10), ([x, y, z]) => z > 0.85 || x > 0.9 || y < -0.9);
const kTorus = cut(torus(36, 16), ([x, y]) => x > 1.1 || y > 1.1);
/** As a file would have it: no face shares a vertex with another. */
const kSoup: Mesh = {
  positions: Float64Array.from([...kSphere.faces].flatMap((v) => [...kSphere.positions.subarray(3 * v, 3 * v + 3)])),
  faces: kSphere.faces.map((_, i) => i),
};

interface AnySession {
  fill: (options?: SessionFillOptions) => FillResult | Promise<FillResult>;
  session: MeshSession | MeshSessionHandle;
}

const kinds: [string, (mesh: MeshInput, weld?: number) => Promise<AnySession>][] = [
  [
    'here',
    (mesh, weld) => {
      const session = new MeshSession(mesh, weld === undefined ? {} : { weld });
      return Promise.resolve({ session, fill: (options) => session.fillHoles(options) });
    },
  ],
  [
    'in a pool',
    async (mesh, weld) => {
      const session = await film.createMeshSession(mesh, weld === undefined ? {} : { weld });
      return { session, fill: (options) => session.fillHoles(options) };
    },
  ],
];

describe.each(kinds)('%s', (_, open) => {
  test('its report and fillings are those of findHoles and fillHoles', async () => {
    const { session, fill } = await open(kSphere);
    expect(session.report).toEqual(findHoles(kSphere));
    const each: FillOptions[] = [{}, { holes: [1] }, { fairness: 0 }, { holes: [2, 0], output: 'patches' }, { groups: [[0], [2]] }, {}];
    for (const options of each) expect(await fill(options)).toEqual(fillHoles(kSphere, options));
    session.dispose();
  });

  test('several at a time, in turns', async () => {
    const [a, b] = [await open(kSphere), await open(kTorus)];
    for (let i = 0; i < 3; i++) {
      expect(await a.fill({ holes: [i] })).toEqual(fillHoles(kSphere, { holes: [i] }));
      expect(await b.fill({ holes: [i % 2] })).toEqual(fillHoles(kTorus, { holes: [i % 2] }));
    }
    a.session.dispose();
    expect(await b.fill()).toEqual(fillHoles(kTorus));
    b.session.dispose();
  });

  test('welded when it is opened', async () => {
    const { session, fill } = await open(kSoup, 0);
    expect(session.report).toEqual(findHoles(kSoup, { weld: 0 }));
    expect(await fill()).toEqual(fillHoles(kSoup, { weld: 0 }));
    const weld = { weld: 0 } as SessionFillOptions;
    expect(await rejectionOf((async () => fill(weld))())).toMatchObject({ code: 'bad-option' });
    session.dispose();
  });

  test('the mesh that it was given may change afterwards', async () => {
    const mesh = { positions: kSphere.positions.slice(), faces: kSphere.faces.slice() };
    const { session, fill } = await open(mesh);
    mesh.positions.fill(0);
    mesh.faces.fill(0);
    expect(await fill()).toEqual(fillHoles(kSphere));
    session.dispose();
  });

  test('an error of a call leaves it as it was', async () => {
    const { session, fill } = await open(kSphere);
    const failing: [SessionFillOptions, string][] = [
      [{ holes: [99] }, 'bad-option'],
      [{ maxSeconds: 0 }, 'time-limit'],
      [{ maxMemoryBytes: 1000 }, 'out-of-memory'],
    ];
    for (const [options, code] of failing) {
      expect(await rejectionOf((async () => fill(options))())).toMatchObject({ code });
      expect(await fill()).toEqual(fillHoles(kSphere));
    }
    session.dispose();
  });

  test('disposed of: disposed, whatever is asked for', async () => {
    const { session, fill } = await open(kSphere);
    session.dispose();
    session.dispose();
    for (const options of [{}, { holes: [] }]) {
      const error = await rejectionOf((async () => fill(options))());
      expect(error).toMatchObject({ code: 'disposed' });
      expect((error as Error).message).toContain(`Session ${session.id}`);
    }
  });

  test('what is no mesh: the errors of findHoles', async () => {
    const broken = { positions: kSphere.positions, faces: Uint32Array.of(0, 1, 999_999) };
    expect(await rejectionOf((async () => open(broken))())).toMatchObject({ code: 'bad-mesh', face: 0 });
  });

  test('a mesh without faces has no holes', async () => {
    const { session, fill } = await open({ positions: new Float64Array(), faces: new Uint32Array() });
    expect(session.report.groups).toEqual([]);
    expect((await fill()).holes).toEqual([]);
    session.dispose();
  });
});

describe('in a pool', () => {
  test('a call that is cancelled while it runs, and the next one', async () => {
    // Takes seconds: all triples of a large rim.
    const large = cut(sphere(40), ([, , z]) => z > 0);
    const session = await film.createMeshSession(large);
    const slow: SessionFillOptions = { candidates: 'all', fillOpenRims: true };
    const ends = new AbortController();
    const call = session.fillHoles({
      ...slow,
      signal: ends.signal,
      onProgress: () => {
        ends.abort();
      },
    });
    expect(await rejectionOf(call)).toMatchObject({ code: 'cancelled' });
    expect(await rejectionOf(session.fillHoles({ ...slow, signal: AbortSignal.abort() }))).toMatchObject({ code: 'cancelled' });
    expect(await session.fillHoles()).toEqual(fillHoles(large));
    session.dispose();
  });

  test('calls that are made before the one before is done', async () => {
    const session = await film.createMeshSession(kSphere);
    const all = await Promise.all([0, 1, 2].map((hole) => session.fillHoles({ holes: [hole] })));
    all.forEach((result, hole) => {
      expect(result).toEqual(fillHoles(kSphere, { holes: [hole] }));
    });
    session.dispose();
  });

  test('disposed of under way: calls before still get their answers', async () => {
    const session = await film.createMeshSession(kSphere);
    const call = session.fillHoles();
    session.dispose();
    expect(await call).toEqual(fillHoles(kSphere));
  });

  test('without the part for meshes: not-loaded', async () => {
    const other = await createWorker({ parts: ['loops'] });
    expect(await rejectionOf(other.createMeshSession(kSphere))).toMatchObject({ code: 'not-loaded' });
    other.dispose();
  });
});

test('what a caller does to a report is no matter to the session', () => {
  const session = new MeshSession(kSphere);
  for (const { vertices } of session.report.loops) structuredClone(vertices, { transfer: [vertices.buffer as ArrayBuffer] });
  expect(session.fillHoles({ maxVertices: 1000 })).toEqual(fillHoles(kSphere, { maxVertices: 1000 }));
  session.dispose();
});

test('memory does not grow with the fillings of a session, nor with sessions', () => {
  const fill = (session: MeshSession): number => {
    session.fillHoles({ output: 'patches' });
    return process.memoryUsage().rss;
  };
  const session = new MeshSession(kTorus);
  for (let i = 0; i < 20; i++) fill(session);
  const before = fill(session);
  for (let i = 0; i < 100; i++) fill(session);
  // A filling takes 8 MB in the core.
  expect(fill(session) - before).toBeLessThan(100e6);
  session.dispose();
  for (let i = 0; i < 100; i++) {
    const short = new MeshSession(kTorus);
    short.dispose();
  }
  expect(errorOf(() => session.report).code).toBe('disposed');
});
