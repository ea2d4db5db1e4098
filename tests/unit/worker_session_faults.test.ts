// Sessions in a pool whose core or threads misbehave: who is lost, what is freed, and when threads start and end.
import { execFile } from 'node:child_process';
import { once } from 'node:events';
import { rm, writeFile } from 'node:fs/promises';
import { syncBuiltinESMExports } from 'node:module';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { promisify } from 'node:util';
import threads, { Worker } from 'node:worker_threads';
import type { PolygonSet, Span } from 'soapfilm';
import { createWorker, type CallOptions, type Film, type PolygonSessionHandle } from 'soapfilm/worker';
import { afterAll, afterEach, beforeAll, describe, expect, test } from 'vitest';
import { rejectionOf } from '../support/errors.js';
import { Fault, faultyCore } from '../support/faulty_core.js';

/** How many instances a thread has for sessions before they have to share. */
const kMostRooms = 32;

const triangle = (fault: number = Fault.none): PolygonSet => ({
  positions: Float64Array.of(fault, 0, 1, 0, 0, 1),
  starts: Uint32Array.of(0, 3),
});
const kLoops = { positions: new Float64Array(9), starts: Uint32Array.of(0, 3) };

/** The threads that the pools start, in order. */
const started: Worker[] = [];
/** What starting a thread throws instead. */
let failure: Error | undefined;

class WatchedWorker extends Worker {
  constructor(...args: ConstructorParameters<typeof Worker>) {
    if (failure) throw failure;
    super(...args);
    started.push(this);
  }
}

function replaceWorker(by: typeof Worker): void {
  threads.Worker = by;
  syncBuiltinESMExports();
}

let bytes: Uint8Array<ArrayBuffer>;
const films: Film[] = [];
const file = path.join(tmpdir(), `soapfilm-sessions-${process.pid}.wasm`);

beforeAll(async () => {
  bytes = await faultyCore();
  await writeFile(file, bytes);
  replaceWorker(WatchedWorker);
});
afterEach(() => {
  failure = undefined;
  for (const film of films.splice(0)) film.dispose();
  started.length = 0;
});
afterAll(async () => {
  replaceWorker(Worker);
  await rm(file);
});

async function newFilm(size = 1): Promise<Film> {
  const film = await createWorker({ wasm: { loops: bytes, polygons: bytes }, size });
  films.push(film);
  return film;
}

async function open(film: Film, count: number): Promise<PolygonSessionHandle[]> {
  return Promise.all(Array.from({ length: count }, () => film.createPolygonSession(triangle())));
}

/** How many sessions there are where this one is, and what has not been freed there. */
const around = async (session: PolygonSessionHandle): Promise<number[]> => Array.from((await session.read()).positions);
const soon = (ms = 50): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));

describe('a crash of the core', () => {
  test('in one session: takes no other with it; its own uses say that it is lost', async () => {
    const film = await newFilm();
    const [a, b, c] = await open(film, 3);
    const [crash, next, other] = [
      rejectionOf(b.move(0, [Fault.trap, 0])),
      rejectionOf(b.read()),
      c.move(0, [Fault.none, 0]),
    ];
    const error = await crash;
    expect(error.code).toBe('crashed');
    expect(error.message).toMatch(new RegExp(`; session ${b.id} is lost$`));
    const lost = { code: 'crashed', message: `Session ${b.id} was lost when it crashed` };
    expect(await next).toMatchObject(lost);
    for (const use of [() => b.move(0, [1, 1]), () => b.triangles]) expect(await rejectionOf(use())).toMatchObject(lost);
    expect((await other).triangleCount).toBe(1);
    for (const session of [a, c, ...(await open(film, 1))]) expect(await around(session)).toEqual([1, 0]);
    b.dispose();
    expect((await rejectionOf(b.read())).code).toBe('disposed');
    expect(started.length).toBe(2);
  });

  test('in a shared instance: those in it go together, and are named', async () => {
    const film = await newFilm();
    const sessions = await open(film, kMostRooms + 1);
    const [a, b] = [sessions[0], sessions[kMostRooms]];
    expect((await rejectionOf(b.move(0, [Fault.trap, 0]))).message).toMatch(
      new RegExp(`; session ${b.id} is lost, and what shared its memory: session ${a.id}$`),
    );
    expect(await rejectionOf(a.read())).toMatchObject({
      code: 'crashed',
      message: `Session ${a.id} was lost when session ${b.id}, which shared its memory, crashed`,
    });
    expect(await around(sessions[1])).toEqual([1, 0]);
  });

  test('while one is opened: none is lost', async () => {
    const film = await newFilm();
    const [a] = await open(film, 1);
    expect((await rejectionOf(film.createPolygonSession(triangle(Fault.trap)))).code).toBe('crashed');
    expect(await around(a)).toEqual([1, 0]);
    expect(await around((await open(film, 1))[0])).toEqual([1, 0]);
  });

  test('in a span, or a span that hangs and is cancelled: none is lost, and none waits', async () => {
    const film = await newFilm();
    const [a] = await open(film, 1);
    expect((await rejectionOf(film.spanLoops(kLoops, { weights: { area: Fault.trap } }))).code).toBe('crashed');
    const controller = new AbortController();
    const hanging = rejectionOf(
      film.spanLoops(kLoops, { weights: { area: Fault.hang }, signal: controller.signal }),
    );
    expect((await a.move(0, [Fault.none, 0])).triangleCount).toBe(1);
    const [b] = await open(film, 1);
    expect(await around(b)).toEqual([1, 0]);
    controller.abort();
    expect((await hanging).code).toBe('cancelled');
    expect(await around(a)).toEqual([1, 0]);
    expect(((await film.spanLoops(kLoops, { weights: { area: Fault.none } })) as Span).cost).toBe(1);
  });
});

describe('a thread that fails', () => {
  test('its sessions are lost, and say so; those of other threads live on, and new ones are opened', async () => {
    const film = await newFilm(2);
    const [a, b, c, d] = await open(film, 4);
    expect(started.length).toBe(3);
    const hanging = rejectionOf(a.move(0, [Fault.hang, 0]));
    const waiting = rejectionOf(c.read());
    expect(await around(b)).toEqual([1, 0]);
    await started[1].terminate();
    const error = await hanging;
    expect(error.code).toBe('crashed');
    expect(error.message).toMatch(
      new RegExp(`^The worker failed: .*; session ${a.id} is lost, and what shared its thread: session ${c.id}$`),
    );
    expect((await waiting).message).toMatch(
      new RegExp(`; session ${c.id} is lost, and what shared its thread: session ${a.id}$`),
    );
    for (const session of [a, c]) {
      for (const use of [() => session.read(), () => session.triangles, () => session.move(-1, [0, 0])]) {
        expect(await rejectionOf(use())).toMatchObject({
          code: 'crashed',
          message: `Session ${session.id} was lost when its thread failed`,
        });
      }
    }
    for (const session of [b, d, ...(await open(film, 2))]) expect(await around(session)).toEqual([1, 0]);
    expect(started.length).toBe(4);
    a.dispose();
    expect((await rejectionOf(a.read())).code).toBe('disposed');
    film.dispose();
    expect((await rejectionOf(b.read())).code).toBe('disposed');
  });

  test('while it is idle: its sessions are lost, and new ones are opened', async () => {
    const film = await newFilm();
    const [a] = await open(film, 1);
    await started[1].terminate();
    await soon(10);
    expect((await rejectionOf(a.read())).code).toBe('crashed');
    expect(await around((await open(film, 1))[0])).toEqual([1, 0]);
  });

  test('that does not start: load-failed, for all that wait for it; the next session is opened', async () => {
    const film = await newFilm();
    failure = new Error('no more threads');
    for (const call of [1, 2].map(() => rejectionOf(film.createPolygonSession(triangle())))) {
      const error = await call;
      expect(error.code).toBe('load-failed');
      expect(error.message).toContain('no more threads');
    }
    failure = undefined;
    expect(await around((await open(film, 1))[0])).toEqual([1, 0]);
  });
});

describe('signal', () => {
  const opening = (film: Film, options: CallOptions, fault?: number) =>
    rejectionOf(film.createPolygonSession(triangle(fault), options));

  test('aborted already: cancelled, and nothing starts', async () => {
    const film = await newFilm();
    const reason = new Error('enough');
    const error = await opening(film, { signal: AbortSignal.abort(reason) });
    expect(error).toMatchObject({ code: 'cancelled', cause: reason });
    expect(started.length).toBe(1);
  });

  test('aborted before the thread has started: cancelled, others are opened, nothing is left', async () => {
    const film = await newFilm();
    const controller = new AbortController();
    const call = opening(film, { signal: controller.signal }, Fault.hang);
    const others = open(film, kMostRooms);
    controller.abort();
    expect((await call).code).toBe('cancelled');
    for (const session of await others) expect(await around(session)).toEqual([1, 0]);
  });

  test('aborted on its way to the thread: cancelled at once, and closed there', async () => {
    const film = await newFilm();
    const sessions = await open(film, kMostRooms);
    const controller = new AbortController();
    const { signal } = controller;
    const calls = [1, 2, 3].map(() => opening(film, { signal }));
    const edit = sessions[0].move(0, [Fault.none, 0]);
    controller.abort();
    for (const call of calls) expect((await call).code).toBe('cancelled');
    expect((await edit).triangleCount).toBe(1);
    for (const session of sessions) expect(await around(session)).toEqual([1, 0]);
  });

  test('aborted while the core hangs: cancelled at once', async () => {
    const film = await newFilm();
    await open(film, 1);
    const controller = new AbortController();
    const call = opening(film, { signal: controller.signal }, Fault.hang);
    await soon();
    controller.abort();
    expect((await call).code).toBe('cancelled');
  });

  test('aborted when the session is open: changes nothing', async () => {
    const film = await newFilm();
    const controller = new AbortController();
    const session = await film.createPolygonSession(triangle(), { signal: controller.signal });
    controller.abort();
    expect(await around(session)).toEqual([1, 0]);
  });
});

describe('threads', () => {
  test('as many as the size, each with its share of the sessions', async () => {
    const film = await newFilm(2);
    const sessions = await open(film, 4);
    expect(started.length).toBe(3);
    sessions[1].dispose();
    sessions[3].dispose();
    // Both go where there are fewest.
    const more = await open(film, 2);
    const hanging = rejectionOf(sessions[0].move(0, [Fault.hang, 0]));
    for (const session of more) expect(await around(session)).toEqual([1, 0]);
    expect(started.length).toBe(3);
    film.dispose();
    expect((await hanging).code).toBe('disposed');
  });

  test('none before it is needed; without sessions one ends after a while, and the next session starts another', async () => {
    const film = await newFilm();
    expect(started.length).toBe(1);
    const [a] = await open(film, 1);
    a.dispose();
    const [b] = await open(film, 1);
    expect(started.length).toBe(2);
    b.dispose();
    await once(started[1], 'exit');
    const [c] = await open(film, 1);
    expect(started.length).toBe(3);
    expect(await around(c)).toEqual([1, 0]);
  });

  test('one whose only session could not be opened: ends as well', async () => {
    const film = await newFilm();
    expect((await rejectionOf(film.createPolygonSession(triangle(Fault.trap)))).code).toBe('crashed');
    await once(started[1], 'exit');
    expect(await around((await open(film, 1))[0])).toEqual([1, 0]);
  });

  test('one does not end while a session is being opened, however long that takes', async () => {
    const film = await newFilm();
    const [a] = await open(film, 1);
    a.dispose();
    await soon(100);
    const opening = rejectionOf(film.createPolygonSession(triangle(Fault.hang)));
    const first = await Promise.race([once(started[1], 'exit'), soon(1500)]);
    expect(first).toBeUndefined();
    film.dispose();
    expect((await opening).code).toBe('disposed');
  });

  test('the pool is disposed of while one hangs, and another starts: everything is disposed', async () => {
    const film = await newFilm(2);
    const [a] = await open(film, 1);
    const calls = [
      rejectionOf(a.move(0, [Fault.hang, 0])),
      rejectionOf(a.read()),
      rejectionOf(film.createPolygonSession(triangle())),
    ];
    const ends = Promise.all(started.map((thread) => once(thread, 'exit')));
    film.dispose();
    for (const call of calls) expect((await call).code).toBe('disposed');
    await ends;
    for (const use of [() => a.read(), () => a.triangles, () => a.move(-1, [0, 0])]) {
      expect((await rejectionOf(use())).code).toBe('disposed');
    }
  });
});

describe('dispose', () => {
  test('in a shared instance: ends the session in the core, once', async () => {
    const film = await newFilm();
    const sessions = await open(film, kMostRooms + 1);
    const [a, b] = [sessions[0], sessions[kMostRooms]];
    expect(await around(a)).toEqual([2, 0]);
    b.dispose();
    b.dispose();
    expect(await around(a)).toEqual([1, 0]);
  });

  test('of thousands, one after the other: nothing is left of them', async () => {
    const film = await newFilm();
    const kept = await open(film, kMostRooms);
    for (let i = 0; i < 3000; i++) {
      const session = await film.createPolygonSession(triangle());
      session.dispose();
    }
    for (const session of kept) expect(await around(session)).toEqual([1, 0]);
    expect(started.length).toBe(2);
  });
});

test('handles that are forgotten: their sessions are ended in the thread', async () => {
  const script = `
    import { createWorker } from 'soapfilm/worker';
    const file = ${JSON.stringify(file)};
    const film = await createWorker({ wasm: { loops: file, polygons: file } });
    const polygon = { positions: Float64Array.of(1, 0, 1, 0, 0, 1), starts: Uint32Array.of(0, 3) };
    const open = (count) => Promise.all(Array.from({ length: count }, () => film.createPolygonSession(polygon)));
    const [kept] = await open(1);
    const forget = async () => {
      const sessions = await open(${2 * kMostRooms - 1});
      const answers = await Promise.all(sessions.map((session) => session.move(0, [1, 1])));
      return answers.length;
    };
    const inCore = async () => (await kept.read()).positions[0];
    const forgotten = await forget();
    console.log(forgotten, await inCore());
    for (let i = 0; i < 2000 && (await inCore()) !== 1; i++) {
      // What has been looked at stays until the next task.
      await new Promise((resolve) => setTimeout(resolve, 1));
      gc();
    }
    console.log(await inCore());`;
  const { stdout } = await promisify(execFile)(process.execPath, ['--expose-gc', '--input-type=module', '-e', script]);
  expect(stdout).toBe(`${2 * kMostRooms - 1} 2\n1\n`);
});
