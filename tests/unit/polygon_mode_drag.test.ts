// Dragging a vertex in the mode of polygons: by a session of its polygon, with the rest as it was.
import {
  load,
  PolygonSession,
  SoapfilmError,
  triangulatePolygons,
  type Point2Like,
  type PolygonLike,
  type PolygonsLike,
  type PolygonsOptions,
} from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { DragSession, type Sessions } from '../../web/src/modes/polygon/drag_session.ts';
import { kSettings, polygonKind, type PolygonGroup, type PolygonSettings } from '../../web/src/modes/polygon/polygons.ts';
import { triangulateAll, type Triangulation } from '../../web/src/modes/polygon/triangulation.ts';
import { linesOf, type Lines } from '../../web/src/shapes/lines.ts';
import { apply, newItem, registerKind } from '../../web/src/state/document.ts';
import { trianglesArea } from '../support/triangulation.js';

beforeAll(async () => {
  registerKind(polygonKind);
  await load();
});

const square = (x: number, size: number): number[][] => [[x, 0], [x + size, 0], [x + size, size], [x, size]];
const kSignal = new AbortController().signal;

/** The library, asynchronous as in a worker, with an account of its sessions. */
class FakeFilm implements Sessions {
  opened = 0;
  moves = 0;
  disposed = 0;
  wholes = 0;
  /** Called before each move. */
  beforeMove: () => void = () => undefined;
  /** What opening waits for. */
  gate: Promise<unknown> = Promise.resolve();

  async triangulatePolygons(polygons: PolygonsLike, { signal, ...options }: PolygonsOptions & { signal?: AbortSignal } = {}) {
    this.wholes++;
    await Promise.resolve(signal);
    return triangulatePolygons(polygons, options);
  }

  async createPolygonSession(polygon: PolygonLike) {
    await this.gate;
    const session = new PolygonSession(polygon);
    this.opened++;
    return {
      get triangles() {
        return Promise.resolve(session.triangles);
      },
      move: async (vertex: number, point: Point2Like) => {
        this.moves++;
        await Promise.resolve();
        this.beforeMove();
        return session.move(vertex, point);
      },
      dispose: () => {
        this.disposed++;
        session.dispose();
      },
    };
  }
}

const groupOf = (polygons: readonly number[][][][], settings: Partial<PolygonSettings> = {}): PolygonGroup => ({
  id: 1,
  mode: 'polygon',
  name: 'Test',
  settings: { ...kSettings, ...settings },
  items: polygons.map((rings) => newItem(polygonKind, linesOf(2, rings))),
});

/** Three polygons: one with a hole, one that crosses itself, and a square. */
const kPolygons = [[square(0, 10), square(2, 2).map(([x, y]) => [x, y + 2])], [[[20, 0], [24, 4], [24, 0], [20, 4]]], [square(30, 3)]];

async function setUp(polygons: readonly number[][][][] = kPolygons, settings: Partial<PolygonSettings> = {}) {
  const film = new FakeFilm();
  const group = groupOf(polygons, settings);
  const before = await triangulateAll(film, group, kSignal);
  film.wholes = 0;
  return { film, group, before, drag: new DragSession() };
}

/** The group with vertices moved. */
function moved(group: PolygonGroup, polygon: number, handles: readonly number[], by: readonly [number, number]): PolygonGroup {
  const item = group.items[polygon].id;
  const places = handles.map((handle) => ({ item, part: 0, handle }));
  return apply(group, { type: 'move', group: group.id, places, by: [...by, 0] }) as PolygonGroup;
}

/** Checks a passing triangulation against the whole one of the same polygons. */
function expectAlike(found: Triangulation | null, of: PolygonGroup): void {
  if (found === null) throw new Error('No session took the polygon.');
  const whole = triangulatePolygons(
    of.items.map(({ shape }) => {
      const { positions, starts } = shape as Lines;
      return Array.from({ length: starts.length - 1 }, (_, r) => positions.slice(2 * starts[r], 2 * starts[r + 1]));
    }),
    { skipInvalid: true },
  );
  expect(found.of).toBe(of);
  expect(found.isPassing).toBe(true);
  expect(Array.from(found.triangleStarts)).toEqual(Array.from(whole.triangleStarts));
  expect(found.triangles).toHaveLength(whole.triangles.length);
  const all = Float64Array.from(of.items.flatMap(({ shape }) => Array.from((shape as Lines).positions)));
  expect(found.positions).toEqual(all);
  for (let p = 0; p < of.items.length; p++) {
    const trianglesOf = ({ triangles, triangleStarts }: Pick<Triangulation, 'triangles' | 'triangleStarts'>) =>
      triangles.subarray(3 * triangleStarts[p], 3 * triangleStarts[p + 1]);
    const [a, b] = [trianglesOf(found), trianglesOf(whole)];
    expect(trianglesArea(all, a)).toBeCloseTo(trianglesArea(all, b), 9);
    expect(new Set(a)).toEqual(new Set(b));
  }
  const place = ({ code, polygon, loop, vertex, otherLoop, otherVertex, point }: SoapfilmError) =>
    ({ code, polygon, loop, vertex, otherLoop, otherVertex, point });
  expect(found.errors.map(place).sort((a, b) => (a.polygon ?? 0) - (b.polygon ?? 0))).toEqual(whole.errors.map(place));
}

describe('a vertex that is dragged', () => {
  test('one session for all moves, and nothing is triangulated as a whole', async () => {
    const { film, group, before, drag } = await setUp();
    let latest = before;
    for (const x of [1, 3, -2, 5]) {
      const now = moved(group, 0, [1], [x, x / 2]);
      const found = await drag.triangulate(film, latest, now, kSignal);
      expectAlike(found, now);
      latest = found ?? latest;
    }
    expect(film).toMatchObject({ opened: 1, moves: 4, wholes: 0, disposed: 0 });
    drag.end();
    expect(film.disposed).toBe(1);
  });

  test('of a hole, and of the last polygon: by its number in the polygon', async () => {
    const { film, group, before, drag } = await setUp();
    const hole = moved(group, 0, [5], [1, -0.5]);
    expectAlike(await drag.triangulate(film, before, hole, kSignal), hole);
    drag.end();
    const last = moved(group, 2, [2], [4, 4]);
    expectAlike(await drag.triangulate(film, before, last, kSignal), last);
    expect(film).toMatchObject({ opened: 2, moves: 2, wholes: 0 });
  });

  test('across an edge: the error is that of the whole, and the session goes on', async () => {
    const { film, group, before, drag } = await setUp();
    const crossing = moved(group, 0, [1], [-9, 9]);
    const refused = await drag.triangulate(film, before, crossing, kSignal);
    expectAlike(refused, crossing);
    expect(refused?.errors.map(({ polygon }) => polygon).sort()).toEqual([0, 1]);
    const back = moved(group, 0, [1], [2, 1]);
    expectAlike(await drag.triangulate(film, refused, back, kSignal), back);
    expect(film).toMatchObject({ opened: 1, moves: 2, wholes: 1 });
  });

  test('onto another: sessions refuse, the library does not', async () => {
    const { film, group, before, drag } = await setUp([[square(0, 10), [[2, 2], [2, 4], [4, 4], [4, 2]]]]);
    const touching = moved(group, 0, [4], [-2, -2]);
    expectAlike(await drag.triangulate(film, before, touching, kSignal), touching);
    expect(film).toMatchObject({ opened: 1, wholes: 1 });
  });

  test('back where it was: as the session has it', async () => {
    const { film, group, before, drag } = await setUp();
    await drag.triangulate(film, before, moved(group, 0, [1], [1, 1]), kSignal);
    const here = moved(group, 0, [1], [1, 1]);
    expectAlike(await drag.triangulate(film, before, here, kSignal), here);
    expect(film.moves).toBe(1);
  });
});

describe('no session is used', () => {
  const cases: [string, Partial<PolygonSettings>, (group: PolygonGroup) => PolygonGroup][] = [
    ['for strips', { output: 'strips' }, (group) => moved(group, 0, [1], [1, 1])],
    ['with repair', { repair: 'nonzero' }, (group) => moved(group, 0, [1], [1, 1])],
    ['for two vertices', {}, (group) => moved(group, 0, [1, 2], [1, 1])],
    ['for two polygons', {}, (group) => moved(moved(group, 0, [1], [1, 1]), 2, [1], [1, 1])],
    ['for a polygon that was invalid', {}, (group) => moved(group, 1, [1], [1, 1])],
    ['for other settings', {}, (group) => ({ ...moved(group, 0, [1], [1, 1]), settings: { ...group.settings } })],
    ['for fewer polygons', {}, (group) => ({ ...group, items: group.items.slice(1) })],
    ['where nothing has changed', {}, (group) => group],
  ];
  test.each(cases)('%s', async (_, settings, change) => {
    const { film, group, before, drag } = await setUp(kPolygons, settings);
    expect(await drag.triangulate(film, before, change(group), kSignal)).toBeNull();
    expect(film.opened).toBe(0);
  });

  test('before anything has been triangulated', async () => {
    const { film, group, drag } = await setUp();
    expect(await drag.triangulate(film, null, group, kSignal)).toBeNull();
  });

  test('of a polygon that it refused, until the gesture ends', async () => {
    // A hole that touches the outer ring.
    const { film, group, before, drag } = await setUp([[square(0, 10), [[0, 0], [2, 4], [4, 2]]]]);
    expect(before.errors).toEqual([]);
    let tries = 0;
    film.gate = { then: (done: () => void) => { tries++; done(); } } as unknown as Promise<unknown>;
    for (const x of [1, 2, 3]) expect(await drag.triangulate(film, before, moved(group, 0, [2], [x, x]), kSignal)).toBeNull();
    expect(tries).toBe(1);
    drag.end();
    await drag.triangulate(film, before, moved(group, 0, [2], [1, 1]), kSignal);
    expect(tries).toBe(2);
  });
});

describe('a gesture that ends', () => {
  test('while its session is being opened: that is freed', async () => {
    const { film, group, before, drag } = await setUp();
    let open: () => void = () => undefined;
    film.gate = new Promise<void>((resolve) => (open = resolve));
    const answer = drag.triangulate(film, before, moved(group, 0, [1], [1, 1]), kSignal);
    await Promise.resolve();
    drag.end();
    open();
    expect(await answer).toBeNull();
    expect(film).toMatchObject({ opened: 1, disposed: 1, moves: 0 });
  });

  test('and the next: a session of its own, from what there is then', async () => {
    const { film, group, before, drag } = await setUp();
    const first = moved(group, 0, [1], [1, 1]);
    const latest = await drag.triangulate(film, before, first, kSignal);
    drag.end();
    const second = moved(first, 0, [2], [3, 0]);
    expectAlike(await drag.triangulate(film, latest, second, kSignal), second);
    expect(film).toMatchObject({ opened: 2, disposed: 1 });
  });
});

test('edits are made in the order in which they are asked for', async () => {
  const { film, group, before, drag } = await setUp();
  const groups = [1, 2, 3].map((x) => moved(group, 0, [1], [x, 0]));
  const found = await Promise.all(groups.map((now) => drag.triangulate(film, before, now, kSignal)));
  found.forEach((each, i) => {
    expectAlike(each, groups[i]);
  });
  expect(film).toMatchObject({ opened: 1, moves: 3 });
});

test('a session that is lost: no other for its polygon in this gesture', async () => {
  const { film, group, before, drag } = await setUp();
  await drag.triangulate(film, before, moved(group, 0, [1], [1, 0]), kSignal);
  film.beforeMove = () => {
    throw new SoapfilmError('crashed', 'lost');
  };
  expect(await drag.triangulate(film, before, moved(group, 0, [1], [2, 0]), kSignal)).toBeNull();
  expect(await drag.triangulate(film, before, moved(group, 0, [1], [3, 0]), kSignal)).toBeNull();
  expect(film).toMatchObject({ opened: 1, disposed: 1 });
});
