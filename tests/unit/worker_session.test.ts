// Sessions in a pool: the same as those here, in the order of the calls.
import { execFile } from 'node:child_process';
import { promisify } from 'node:util';
import { load, PolygonSession, SoapfilmError, type PolygonEdit, type PolygonSet } from 'soapfilm';
import { createWorker, type Film, type PolygonSessionHandle } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { rejectionOf } from '../support/errors.js';
import { Random } from '../support/generators.js';
import { blobRing, flatPolygon, type Point2, type Polygon2 } from '../support/polygons.js';

const square = (x: number, y: number, size: number): Point2[] => [
  [x, y],
  [x + size, y],
  [x + size, y + size],
  [x, y + size],
];
const kPolygon: Polygon2 = [square(0, 0, 10), square(2, 2, 2)];

let film: Film;

beforeAll(async () => {
  await load();
  film = await createWorker();
});
afterAll(() => {
  film.dispose();
});

/** All that can be seen of an edit or of its error. */
function seen(outcome: unknown): unknown {
  if (!(outcome instanceof SoapfilmError)) return outcome;
  const { code, message, loop, vertex, otherLoop, otherVertex, point } = outcome;
  return { code, message, loop, vertex, otherLoop, otherVertex, point };
}
const outcomeOf = (promise: Promise<unknown>): Promise<unknown> => promise.then(seen, seen);
function outcomeHere(call: () => unknown): unknown {
  try {
    return seen(call());
  } catch (error) {
    return seen(error);
  }
}

/** An edit that both can do. */
type Edit = <S extends PolygonSession | PolygonSessionHandle>(session: S) => ReturnType<S['move']>;

function randomEdit(random: Random, count: number, positions: Float64Array): Edit {
  // Now and then a vertex that there is not.
  const v = random.below(count + 2);
  const w = random.below(count);
  const at: Point2 = [
    positions[2 * w] + random.range(-0.2, 0.2),
    positions[2 * w + 1] + random.range(-0.2, 0.2),
  ];
  const choice = random.below(4);
  return ((session: PolygonSession) =>
    [
      () => session.move(v, at),
      () => session.insert(v, at),
      () => session.delete(v),
      () => session.insertPoint(at),
    ][choice]()) as unknown as Edit;
}

describe('edits', () => {
  test.each([7, 8, 9])('random ones, seed %i, none waited for: the same as at once, refused ones too', async (seed) => {
    const random = new Random(seed);
    const polygon = { ...flatPolygon([blobRing(40, random)]), points: Float64Array.of(0.1, 0.05, -0.2, 0.1) };
    const here = new PolygonSession(polygon);
    const there = await film.createPolygonSession(polygon);
    const expected: unknown[] = [];
    const found: Promise<unknown>[] = [];
    const note = (one: unknown, other: Promise<unknown>): void => {
      expected.push(one);
      found.push(other);
    };
    let refused = 0;
    for (let i = 0; i < 400; i++) {
      const { positions, next } = here.read();
      const edit = randomEdit(random, next.length, positions);
      const outcome = outcomeHere(() => edit(here));
      note(outcome, outcomeOf(edit(there)));
      if ('code' in (outcome as object)) refused++;
      if (i % 20 === 0) note(here.triangles, there.triangles);
      if (i % 50 === 0) note(here.read(), there.read());
    }
    note(here.triangles, there.triangles);
    note(here.read(), there.read());
    expect(await Promise.all(found)).toEqual(expected);
    expect(refused).toBeGreaterThan(10);
    expect(refused).toBeLessThan(390);
    here.dispose();
    there.dispose();
  });

  test('of two sessions in one thread, in turns: neither disturbs the other', async () => {
    const sessions = [await film.createPolygonSession(kPolygon), await film.createPolygonSession([square(0, 0, 4)])];
    const twins = [new PolygonSession(kPolygon), new PolygonSession([square(0, 0, 4)])];
    const random = new Random(5);
    const expected: PolygonEdit[] = [];
    const found: Promise<PolygonEdit>[] = [];
    for (let i = 0; i < 100; i++) {
      const k = random.below(2);
      const at: Point2 = [random.range(0.1, 1.5), random.range(0.1, 1.5)];
      expected.push(twins[k].insertPoint(at));
      found.push(sessions[k].insertPoint(at));
    }
    expect(await Promise.all(found)).toEqual(expected);
    expect(await Promise.all(sessions.map((session) => session.triangles))).toEqual(
      twins.map((session) => session.triangles),
    );
    for (const session of [...sessions, ...twins]) session.dispose();
  });

  test('beside a span that takes long, in a pool of one: are done; its cancelling costs no session', async () => {
    const session = await film.createPolygonSession(kPolygon);
    const controller = new AbortController();
    const ring = (n: number, z: number) =>
      Array.from({ length: n }, (_, i) => [Math.cos((2 * Math.PI * i) / n), Math.sin((2 * Math.PI * i) / n), z]);
    const loops = [ring(60, 0), ring(60, 1), ring(60, 2), ring(60, 3)];
    let ended = false;
    const span = rejectionOf(film.spanLoops(loops, { candidates: 'all', signal: controller.signal })).finally(() => {
      ended = true;
    });
    const late = await film.createPolygonSession(kPolygon);
    for (const one of [session, late]) expect((await one.insertPoint([7, 7])).triangleCount).toBe(10);
    expect(ended).toBe(false);
    controller.abort();
    expect((await span).code).toBe('cancelled');
    expect((await session.move(0, [0, 1])).vertex).toBe(0);
    session.dispose();
    late.dispose();
  });
});

describe('arguments', () => {
  test('wrong ones: the same errors, in the same words', async () => {
    const here = new PolygonSession(kPolygon);
    const there = await film.createPolygonSession(kPolygon);
    const cases: ((session: PolygonSession) => unknown)[] = [
      (s) => s.move(NaN, [0, 0]),
      (s) => s.move(-1, [0, 0]),
      (s) => s.move(99, [0, 0]),
      (s) => s.move('0' as never, [0, 0]),
      (s) => s.move(0, [NaN, 0]),
      (s) => s.move(4, [1e200, 0]),
      (s) => s.move(0, undefined as never),
      (s) => s.move(0, ['0', 1] as never),
      (s) => s.insert(0.5, [0, 0]),
      (s) => s.insert(99, [5, 0]),
      (s) => s.insert(0, { x: 1 } as never),
      (s) => s.insertPoint([1, 2, 3] as never),
      (s) => s.insertPoint([NaN, 2]),
      (s) => s.insertPoint([3, 3]),
      (s) => s.delete(77),
      (s) => s.delete(undefined as never),
    ];
    for (const use of cases) {
      const expected = outcomeHere(() => use(here));
      expect(expected).toHaveProperty('code');
      expect(await outcomeOf(use(there as never) as Promise<unknown>)).toEqual(expected);
    }
    const inputs: [unknown, object?][] = [
      [null],
      [[]],
      [[[[0, 0], [2, 2], [2, 0], [0, 2]]]],
      [[[[0, 0, 0], [1, 0, 0], [1, 1, 0]]]],
      [[[[0, 0], [1, NaN], [1, 1]]]],
      [[square(0, 0, 4), square(8, 0, 2)]],
      [kPolygon, { maxMemoryBytes: 10 }],
      [kPolygon, { maxMemoryBytes: '10' }],
    ];
    for (const [polygon, options] of inputs) {
      const expected = outcomeHere(() => new PolygonSession(polygon as never, options));
      expect(expected).toHaveProperty('code');
      expect(await outcomeOf(film.createPolygonSession(polygon as never, options))).toEqual(expected);
    }
    expect(await there.triangles).toEqual(here.triangles);
    here.dispose();
    there.dispose();
  });

  test('the input: neither changed nor taken, and read when the call is made', async () => {
    const polygon: PolygonSet = { ...flatPolygon(kPolygon), points: Float64Array.of(7, 7) };
    const before = structuredClone(polygon);
    const opening = film.createPolygonSession(polygon);
    expect(polygon).toEqual(before);
    polygon.positions.fill(NaN);
    const session = await opening;
    const point: [number, number] = [8, 8];
    const edit = session.move(8, point);
    point[0] = NaN;
    expect((await edit).vertex).toBe(8);
    const { positions } = await session.read();
    expect(Array.from(positions.subarray(0, 18))).toEqual([...before.positions, 8, 8]);
    session.dispose();
  });

  test('the results: arrays of their own', async () => {
    const session = await film.createPolygonSession(kPolygon);
    const [one, two] = await Promise.all([session.triangles, session.triangles]);
    one.fill(0);
    const edit = await session.move(4, [1, 1]);
    edit.triangles.fill(0);
    edit.changed.fill(0);
    const state = await session.read();
    state.next.fill(0);
    state.positions.fill(0);
    const here = new PolygonSession(kPolygon);
    expect(two).toEqual(here.triangles);
    here.move(4, [1, 1]);
    expect(await session.triangles).toEqual(here.triangles);
    expect(await session.read()).toEqual(here.read());
    session.dispose();
    here.dispose();
  });
});

describe('dispose', () => {
  test('of a session: calls before are answered, those after it are disposed, in the same words', async () => {
    const session = await film.createPolygonSession(kPolygon);
    const other = await film.createPolygonSession(kPolygon);
    const refused = rejectionOf(session.insertPoint([3, 3]));
    const before = [session.insertPoint([7, 7]), session.triangles];
    session.dispose();
    session.dispose();
    session[Symbol.dispose]();
    for (const use of [
      () => session.triangles,
      () => session.read(),
      () => session.insert(0, [5, 1]),
      () => session.insertPoint([5, 5]),
      () => session.delete(0),
      () => session.move(-1, [1, 1]),
    ]) {
      expect(await rejectionOf(use())).toMatchObject({
        code: 'disposed',
        message: `Session ${session.id} is disposed of`,
      });
    }
    expect(await before[0]).toMatchObject({ triangleCount: 10 });
    expect((await before[1]) as Uint32Array).toHaveLength(30);
    expect((await refused).code).toBe('hole-outside');
    expect((await other.insertPoint([7, 7])).triangleCount).toBe(10);
    other.dispose();
  });

  test('of the pool: all sessions are disposed', async () => {
    const brief = await createWorker({ size: 2 });
    const sessions = await Promise.all([0, 1, 2].map(() => brief.createPolygonSession(kPolygon)));
    const late = rejectionOf(brief.createPolygonSession(kPolygon));
    const calls = sessions.map((session) => rejectionOf(session.read()));
    brief.dispose();
    for (const error of await Promise.all([late, ...calls])) expect(error.code).toBe('disposed');
    for (const session of sessions) {
      expect((await rejectionOf(session.move(0, [0, 1]))).code).toBe('disposed');
      session.dispose();
    }
    expect((await rejectionOf(brief.createPolygonSession(kPolygon))).code).toBe('disposed');
  });
});

test('ids: no session here or there has that of another', async () => {
  const [a, b, c] = [
    new PolygonSession(kPolygon),
    await film.createPolygonSession(kPolygon),
    new PolygonSession(kPolygon),
  ];
  expect([b.id, c.id]).toEqual([a.id + 1, a.id + 2]);
  for (const session of [a, b, c]) session.dispose();
});

test('a pool without polygons: not-loaded, as for its other calls', async () => {
  const loops = await createWorker({ parts: ['loops'] });
  const expected = await rejectionOf(loops.triangulatePolygon(kPolygon));
  const error = await rejectionOf(loops.createPolygonSession(kPolygon));
  expect(expected.code).toBe('not-loaded');
  expect(seen(error)).toEqual(seen(expected));
  loops.dispose();
});

test.each([
  ['idle: the process ends', '', '10\n'],
  ['an edit under way: the process ends after it', "session.move(0, [0, 1]).then(() => console.log('done'));", '10\ndone\n'],
  ['one is being opened: the process ends after that', "film.createPolygonSession(polygon).then(() => console.log('open'));", '10\nopen\n'],
  [
    'another is cancelled before its thread has started: the process ends',
    `const controller = new AbortController();
    film.createPolygonSession(polygon, { signal: controller.signal }).catch((error) => console.log(error.code));
    controller.abort();`,
    '10\ncancelled\n',
  ],
])('a session is open, %s', async (_, more, expected) => {
  const script = `
    import { createWorker } from 'soapfilm/worker';
    const film = await createWorker({ size: 2 });
    const polygon = ${JSON.stringify(kPolygon)};
    const session = await film.createPolygonSession(polygon);
    console.log((await session.insertPoint([7, 7])).triangleCount);
    ${more}`;
  const { stdout } = await promisify(execFile)(process.execPath, ['--input-type=module', '-e', script]);
  expect(stdout).toBe(expected);
});
