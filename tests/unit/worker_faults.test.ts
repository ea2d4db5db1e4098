// The pool on a core that misbehaves: cancelling, crashes, and the end of the pool.
import { execFile } from 'node:child_process';
import { rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { promisify } from 'node:util';
import { SoapfilmError, type LoopSet, type Span, type SpanOptions } from 'soapfilm';
import { createWorker, type CallOptions, type Film } from 'soapfilm/worker';
import { afterEach, beforeAll, describe, expect, test, vi } from 'vitest';
import { rejectionOf } from '../support/errors.js';
import { Fault, faultyCore } from '../support/faulty_core.js';

const kLoops: LoopSet = {
  positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
  starts: Uint32Array.of(0, 3),
};

let bytes: Uint8Array<ArrayBuffer>;
const films: Film[] = [];

beforeAll(async () => {
  bytes = await faultyCore();
});

afterEach(() => {
  for (const film of films.splice(0)) film.dispose();
});

async function newFilm(size = 1): Promise<Film> {
  const film = await createWorker({ wasm: bytes, size });
  films.push(film);
  return film;
}

async function provoke(film: Film, fault: number, options: SpanOptions & CallOptions = {}) {
  return (await film.spanLoops(kLoops, { ...options, weights: { area: fault } })) as Span;
}

const soon = (ms = 50): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));

describe('cancelling', () => {
  test.each([
    ['a call that asks', Fault.runUntilStopped],
    ['a call that never asks', Fault.hang],
  ])('%s: cancelled at once, with the reason, and the next call works', async (_, fault) => {
    const film = await newFilm();
    const controller = new AbortController();
    const call = rejectionOf(provoke(film, fault, { signal: controller.signal }));
    await soon();
    const reason = new Error('enough');
    controller.abort(reason);
    const error = await call;
    expect(error).toMatchObject({ code: 'cancelled', cause: reason });
    expect((await provoke(film, Fault.none)).found).toBe(true);
  });

  test('a signal that is aborted already: nothing starts', async () => {
    const film = await newFilm();
    const error = await rejectionOf(provoke(film, Fault.hang, { signal: AbortSignal.abort() }));
    expect(error.code).toBe('cancelled');
    expect((await provoke(film, Fault.none)).cost).toBe(1);
  });

  test('a call that waits: cancelled without harm to the one that runs', async () => {
    const film = await newFilm();
    const controller = new AbortController();
    const running = rejectionOf(provoke(film, Fault.runUntilStopped, { maxSeconds: 0.5 }));
    const waiting = rejectionOf(provoke(film, Fault.hang, { signal: controller.signal }));
    const last = provoke(film, Fault.none);
    controller.abort();
    expect((await waiting).code).toBe('cancelled');
    expect((await running).code).toBe('time-limit');
    expect((await last).cost).toBe(2);
  });

  test('one signal for many calls: all are cancelled, others are not', async () => {
    const film = await newFilm(2);
    const controller = new AbortController();
    const { signal } = controller;
    const calls = Array.from({ length: 5 }, () => rejectionOf(provoke(film, Fault.hang, { signal })));
    const other = provoke(film, Fault.none);
    await soon();
    controller.abort();
    for (const error of await Promise.all(calls)) expect(error.code).toBe('cancelled');
    expect((await other).found).toBe(true);
  });

  test('an abort after the end: changes nothing', async () => {
    const film = await newFilm();
    const controller = new AbortController();
    await provoke(film, Fault.none, { signal: controller.signal });
    controller.abort();
    expect((await provoke(film, Fault.none)).cost).toBe(2);
  });

  test('again and again: every call after a cancel works', async () => {
    const film = await newFilm();
    for (let i = 0; i < 5; i++) {
      const controller = new AbortController();
      const call = rejectionOf(provoke(film, Fault.hang, { signal: controller.signal }));
      await soon(10 * i);
      controller.abort();
      expect((await call).code).toBe('cancelled');
    }
    expect((await provoke(film, Fault.none)).found).toBe(true);
  });
});

describe('errors', () => {
  test.each([
    ['a trap', Fault.trap, 'crashed'],
    ['endless recursion', Fault.recurseForever, 'crashed'],
    ['exhausted memory', Fault.exhaustMemory, 'out-of-memory'],
  ])('%s: its code, and the next call works', async (_, fault, code) => {
    const film = await newFilm();
    const error = await rejectionOf(provoke(film, fault));
    expect(error.code).toBe(code);
    expect((await provoke(film, Fault.none)).cost).toBe(1);
  });

  test('a status with a place: a SoapfilmError as from the synchronous call', async () => {
    const film = await newFilm();
    const error = await rejectionOf(provoke(film, Fault.repeatedVertex));
    expect(error).toBeInstanceOf(SoapfilmError);
    const { code, loop, vertex, otherLoop, otherVertex, line, message } = error;
    expect({ code, loop, vertex, otherLoop, otherVertex, line }).toEqual({
      code: 'repeated-vertex',
      loop: 1,
      vertex: 2,
      otherLoop: 3,
      otherVertex: 4,
      line: undefined,
    });
    expect(message).toMatch(/^Loop 1, vertex 2 /);
  });

  test('input that cannot be sent: is refused as by the synchronous call, and the next call works', async () => {
    const film = await newFilm();
    const odd = { area: (() => 1) as unknown as number };
    const error = await rejectionOf(film.spanLoops(kLoops, { weights: odd }));
    expect(error.code).toBe('bad-weights');
    expect(error.message).toContain('`weights.area`');
    expect((await provoke(film, Fault.none)).cost).toBe(1);
  });

  test.each([0, -1, 1.5, NaN])('size %d: bad-option', async (size) => {
    expect((await rejectionOf(createWorker({ wasm: bytes, size }))).code).toBe('bad-option');
  });
});

describe('progress', () => {
  test('onProgress: called here while the work goes on', async () => {
    const film = await newFilm();
    const seen: number[][] = [];
    const controller = new AbortController();
    // The work goes on until it has been heard of twice.
    const onProgress = (...values: number[]): void => {
      if (seen.push(values) === 2) controller.abort();
    };
    const call = provoke(film, Fault.runUntilStopped, { signal: controller.signal, onProgress });
    expect((await rejectionOf(call)).code).toBe('cancelled');
    expect(seen.length).toBeGreaterThan(1);
    expect(seen[0].slice(1)).toEqual([Infinity, 0.5]);
  });

  test('onProgress throws: the work ends with that error, and the next call works', async () => {
    const film = await newFilm();
    const mine = new Error('mine');
    const onProgress = (): void => {
      throw mine;
    };
    await expect(provoke(film, Fault.runUntilStopped, { onProgress })).rejects.toBe(mine);
    expect((await provoke(film, Fault.none)).found).toBe(true);
  });
});

describe('listeners that throw when the work is done', () => {
  test('onProgress, told of the end: the result comes back, the error is reported', async () => {
    const film = await newFilm();
    const mine = new Error('mine');
    const seen: number[] = [];
    const onProgress = (fraction: number): void => {
      seen.push(fraction);
      throw mine;
    };
    const log = vi.spyOn(console, 'error').mockImplementation(() => undefined);
    try {
      expect((await provoke(film, Fault.none, { onProgress })).cost).toBe(1);
      expect(seen).toEqual([1]);
      expect(log).toHaveBeenCalledExactlyOnceWith(mine);
    } finally {
      log.mockRestore();
    }
    // The thread is still the same.
    expect((await provoke(film, Fault.none)).cost).toBe(2);
  });
});

describe('pool', () => {
  test('size 2: a call that hangs holds up no other', async () => {
    const film = await newFilm(2);
    const controller = new AbortController();
    const stuck = rejectionOf(provoke(film, Fault.hang, { signal: controller.signal }));
    const others = await Promise.all([1, 2, 3, 4].map(() => provoke(film, Fault.none)));
    // One thread and its one instance did them all, in order.
    expect(others.map(({ cost }) => cost)).toEqual([1, 2, 3, 4]);
    controller.abort();
    expect((await stuck).code).toBe('cancelled');
  });

  test('input: copied when the call is made, left to the caller', async () => {
    const film = await newFilm();
    const running = rejectionOf(provoke(film, Fault.runUntilStopped, { maxSeconds: 0.1 }));
    const weights = { area: Fault.none as number };
    const positions = kLoops.positions.slice();
    const waiting = film.spanLoops({ ...kLoops, positions }, { weights });
    weights.area = Fault.trap;
    expect((await running).code).toBe('time-limit');
    expect((await waiting).found).toBe(true);
    expect(positions).toEqual(kLoops.positions);
  });

  test('dispose: what runs, what waits and what comes later is rejected', async () => {
    const film = await newFilm(2);
    const calls = Array.from({ length: 4 }, () => rejectionOf(provoke(film, Fault.hang)));
    await soon();
    film.dispose();
    for (const error of await Promise.all(calls)) expect(error.code).toBe('disposed');
    expect((await rejectionOf(provoke(film, Fault.none))).code).toBe('disposed');
    film.dispose();
  });

  test('dispose while a thread starts: the calls are rejected', async () => {
    const film = await newFilm();
    const controller = new AbortController();
    const first = rejectionOf(provoke(film, Fault.hang, { signal: controller.signal }));
    controller.abort();
    const second = rejectionOf(provoke(film, Fault.none));
    film.dispose();
    expect((await first).code).toBe('cancelled');
    expect((await second).code).toBe('disposed');
  });

  test('Symbol.dispose: the same as dispose', async () => {
    const film = await newFilm();
    film[Symbol.dispose]();
    expect((await rejectionOf(provoke(film, Fault.none))).code).toBe('disposed');
  });
});

test.each([
  ['cancelled', 'controller.abort()'],
  ['disposed', 'film.dispose()'],
])('a call that hangs, %s: its thread is gone and the process ends', async (code, end) => {
  const file = path.join(tmpdir(), `soapfilm-${process.pid}-${code}.wasm`);
  await writeFile(file, bytes);
  const script = `
    import { createWorker } from 'soapfilm/worker';
    const film = await createWorker({ wasm: ${JSON.stringify(file)} });
    const controller = new AbortController();
    const options = { weights: { area: ${Fault.hang} }, signal: controller.signal };
    const call = film.spanLoops([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], options);
    setTimeout(() => ${end}, 50);
    await call.catch((error) => console.log(error.code));`;
  try {
    const { stdout } = await promisify(execFile)(
      process.execPath,
      ['--input-type=module', '-e', script],
    );
    expect(stdout).toBe(`${code}\n`);
  } finally {
    await rm(file);
  }
});
