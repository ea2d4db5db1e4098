import { cp, mkdtemp, rm, writeFile } from 'node:fs/promises';
import { createServer, type Server } from 'node:http';
import { createRequire } from 'node:module';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { Worker } from 'node:worker_threads';
import {
  load,
  SoapfilmError,
  spanLoops,
  type LoadOptions,
  type LoopSet,
  type Span,
  type SpanOptions,
} from 'soapfilm';
import { afterAll, afterEach, beforeAll, describe, expect, test, vi } from 'vitest';
import { countingClock } from '../support/clock.js';
import { errorOf, rejectionOf } from '../support/errors.js';
import { Fault, faultyCore } from '../support/faulty_core.js';

const kLoops: LoopSet = {
  positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
  starts: Uint32Array.of(0, 3),
};

/** Makes the stand-in for the core do `fault`; see there for what cost and lower bound say. */
function provoke(fault: number, options: SpanOptions = {}): Span {
  return spanLoops(kLoops, { ...options, weights: { area: fault } }) as Span;
}

const calls = (): number => provoke(Fault.none).cost;
const leaks = (): number => provoke(Fault.none).lowerBound;

let bytes: Uint8Array<ArrayBuffer>;
let server: Server;
let address: string;
const file = path.join(tmpdir(), `soapfilm-${process.pid}.wasm`);

beforeAll(async () => {
  bytes = await faultyCore();
  await writeFile(file, bytes);
  server = createServer((request, response) => {
    const found = request.url !== '/none';
    const type = request.url === '/typed' ? 'application/wasm' : 'text/plain';
    response.writeHead(found ? 200 : 404, { 'content-type': type }).end(found ? bytes : '');
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  address = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
});

afterAll(async () => {
  server.close();
  await rm(file);
});

describe('before load', () => {
  test('spanLoops: not-loaded', () => {
    expect(errorOf(() => spanLoops(kLoops)).code).toBe('not-loaded');
  });

  const bad: [string, () => LoadOptions | Promise<LoadOptions>][] = [
    ['a file that does not exist', () => ({ wasm: `${file}.none` })],
    ['a URL that is not found', () => ({ wasm: new URL(`${address}/none`) })],
    ['a file that is not wasm', () => ({ wasm: import.meta.filename })],
    ['bytes that are not wasm', () => ({ wasm: new Uint8Array(8) })],
    ['a response that is an error', async () => ({ wasm: await fetch(`${address}/none`) })],
    ['a module without memory', () => ({ wasm: Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0) })],
  ];
  test.each(bad)('load: %s is load-failed, with a cause or in words', async (_, options) => {
    const error = await rejectionOf(load(await options()));
    expect(error.code).toBe('load-failed');
    expect(error.cause !== undefined || error.message.includes('has no memory')).toBe(true);
    expect(errorOf(() => spanLoops(kLoops)).code).toBe('not-loaded');
  });
});

describe('load', () => {
  test('concurrent and later calls: one load', async () => {
    await Promise.all([load({ wasm: bytes }), load(), load({ wasm: { loops: 'nothing' } })]);
    expect(calls()).toBe(1);
    await load({ wasm: 'nothing' });
    expect(calls()).toBe(2);
  });
});

describe('traps', () => {
  test.each([
    ['a trap', Fault.trap, 'crashed'],
    ['endless recursion', Fault.recurseForever, 'crashed'],
    ['an exit', Fault.exit, 'crashed'],
    ['exhausted memory', Fault.exhaustMemory, 'out-of-memory'],
  ])('%s: its code, its cause, and a new instance for the next call', (_, fault, code) => {
    calls();
    const before = calls();
    expect(before).toBeGreaterThan(1);
    const error = errorOf(() => provoke(fault));
    expect(error.code).toBe(code);
    expect(error.cause).toBeInstanceOf(Error);
    expect(calls()).toBe(1);
  });

  test('an instance that has grown large: kept for calls in a row, given up when idle', () => {
    vi.useFakeTimers();
    try {
      const before = calls();
      provoke(Fault.growMemory);
      expect(calls()).toBeGreaterThan(before);
      vi.advanceTimersByTime(900);
      const later = calls();
      vi.advanceTimersByTime(900);
      expect(calls()).toBeGreaterThan(later);
      vi.advanceTimersByTime(1100);
      expect(calls()).toBe(1);
    } finally {
      vi.useRealTimers();
    }
  });
});

describe('statuses', () => {
  test('a place of two vertices: in the error and in words', () => {
    const error = errorOf(() => provoke(Fault.repeatedVertex));
    expect(error).toMatchObject({
      code: 'repeated-vertex',
      loop: 1,
      vertex: 2,
      otherLoop: 3,
      otherVertex: 4,
    });
    expect(error.message).toMatch(/^Loop 1, vertex 2 .*loop 3, vertex 4/);
    expect(error).toBeInstanceOf(SoapfilmError);
  });

  test('a place of a loop alone: no other field', () => {
    const error = errorOf(() => provoke(Fault.tooFewVertices));
    expect(error).toMatchObject({ code: 'too-few-vertices', loop: 1 });
    for (const field of ['vertex', 'otherLoop', 'otherVertex', 'face', 'line']) {
      expect(error[field as 'vertex']).toBeUndefined();
    }
  });

  test('an unknown status: crashed', () => {
    expect(errorOf(() => provoke(Fault.unknownStatus)).code).toBe('crashed');
  });

  test('a stop that nobody asked for: cancelled', () => {
    expect(errorOf(() => provoke(Fault.stopUnasked)).code).toBe('cancelled');
  });

  test('errors: everything lent to the core is taken back', () => {
    expect(leaks()).toBe(0);
    for (const fault of [Fault.repeatedVertex, Fault.unknownStatus, Fault.stopUnasked]) {
      errorOf(() => provoke(fault));
      expect(leaks()).toBe(0);
    }
    errorOf(() => provoke(Fault.ignoreStop, { maxSeconds: 0.01 }));
    expect(leaks()).toBe(0);
  });

  test('input that does not fit: out-of-memory, instance kept', () => {
    const before = calls();
    const positions = Float64Array.from({ length: 30_000 }, (_, i) => i % 3 === 0 ? i : (i * i) % 7);
    const big = { positions, starts: Uint32Array.of(0, 10_000) };
    expect(errorOf(() => spanLoops(big)).code).toBe('out-of-memory');
    expect(calls()).toBe(before + 1);
  });
});

/** With memory for typed arrays at an end: the `nth` copy of one fails. */
function withoutRoom<T>(nth: number, call: () => T): T {
  let count = 0;
  const original = Object.getOwnPropertyDescriptor(
    Object.getPrototypeOf(Float64Array.prototype),
    'slice',
  )?.value as (this: Float64Array, ...args: unknown[]) => Float64Array<ArrayBuffer>;
  const spy = vi.spyOn(Float64Array.prototype, 'slice').mockImplementation(function (
    this: Float64Array,
    ...args
  ) {
    if (++count === nth) throw new RangeError('Array buffer allocation failed');
    return original.apply(this, args);
  });
  try {
    return call();
  } finally {
    spy.mockRestore();
    expect(count).toBeGreaterThanOrEqual(nth);
  }
}

const mine = new Error('mine');
const throwMine = (): never => {
  throw mine;
};

function detached(): Uint32Array {
  const array = new Uint32Array(3);
  structuredClone(array.buffer, { transfer: [array.buffer] });
  return array;
}

describe('memory of a call', () => {
  const outcomes: [string, () => unknown, unknown][] = [
    ['success', () => provoke(Fault.none), undefined],
    ['a status', () => provoke(Fault.repeatedVertex), 'repeated-vertex'],
    ['an unknown status', () => provoke(Fault.unknownStatus), 'crashed'],
    ['a limit', () => provoke(Fault.runUntilStopped, { maxSeconds: 0 }), 'time-limit'],
    ['a limit that the core ignores', () => provoke(Fault.ignoreStop, { maxSeconds: 0 }), 'time-limit'],
    [
      'a limit that leaves the best so far',
      () => provoke(Fault.ignoreStop, { maxSeconds: 0, bestSoFar: true }),
      undefined,
    ],
    ['a listener that throws', () => provoke(Fault.runUntilStopped, { onProgress: throwMine }), mine],
    [
      'a listener that throws and a core that does not care',
      () => provoke(Fault.ignoreStop, { onProgress: throwMine, bestSoFar: true }),
      mine,
    ],
    ['a result that cannot be copied', () => withoutRoom(1, () => provoke(Fault.none)), 'out-of-memory'],
    [
      'a result on the way',
      () => provoke(Fault.resultThenDone, { bestSoFar: true, onBest: () => undefined }),
      undefined,
    ],
    [
      'a result that cannot be copied after one on the way',
      () => withoutRoom(2, () => provoke(Fault.resultThenDone, { onBest: () => undefined })),
      'out-of-memory',
    ],
    ['an input that is detached', () => provoke(Fault.none, { startFrom: detached() }), 'bad-option'],
  ];
  test.each(outcomes)('%s: all of it is freed, and the instance stays', (_, call, expected) => {
    const before = calls();
    const log = vi.spyOn(console, 'error').mockImplementation(() => undefined);
    let thrown: unknown;
    try {
      call();
    } catch (error) {
      thrown = error instanceof SoapfilmError ? error.code : error;
    }
    expect(thrown).toBe(expected);
    expect(log).not.toHaveBeenCalled();
    log.mockRestore();
    expect(leaks()).toBe(0);
    expect(calls()).toBeGreaterThan(before + 1);
  });

  test('a result on the way that cannot be copied: the error for it, nothing is left', () => {
    const onBest = vi.fn();
    vi.spyOn(console, 'error').mockImplementation(() => undefined);
    // The core is done all the same, so its result is the answer.
    const span = withoutRoom(1, () => provoke(Fault.resultThenDone, { onBest }));
    expect(span.found).toBe(true);
    expect(onBest).not.toHaveBeenCalled();
    expect(console.error).toHaveBeenCalledExactlyOnceWith(
      expect.objectContaining({ code: 'out-of-memory' }),
    );
    vi.restoreAllMocks();
    expect(leaks()).toBe(0);
  });

  test('a trap when the result is freed: crashed, and a new instance', () => {
    expect(errorOf(() => provoke(Fault.trapWhenFreed)).code).toBe('crashed');
    expect(calls()).toBe(1);
  });

  test('a trap when a result on the way is read: crashed although the call goes on, and a new instance', () => {
    const onBest = vi.fn();
    const error = errorOf(() => provoke(Fault.trapWhenRead, { onBest }));
    expect(error.code).toBe('crashed');
    expect(error.cause).toBeInstanceOf(WebAssembly.RuntimeError);
    expect(onBest).not.toHaveBeenCalled();
    expect(calls()).toBe(1);
  });
});

describe('listeners that throw when the work is done', () => {
  afterEach(() => {
    vi.unstubAllGlobals();
    vi.restoreAllMocks();
  });

  const listeners: [string, SpanOptions, number][] = [
    ['onProgress, told of the end', { onProgress: throwMine }, Fault.none],
    ['onBest, told of the last surface', { onBest: throwMine }, Fault.resultThenDone],
    ['both', { onProgress: throwMine, onBest: throwMine }, Fault.resultThenDone],
  ];
  test.each(listeners)('%s: the result comes back, the error goes to reportError', (_, options, fault) => {
    const report = vi.fn();
    vi.stubGlobal('reportError', report);
    const before = calls();
    const span = provoke(fault, options);
    expect(span).toMatchObject({ found: true, cost: before + 1 });
    expect(report.mock.calls).toEqual(Object.keys(options).map(() => [mine]));
    expect(leaks()).toBe(0);
  });

  test('without reportError: to the console', () => {
    vi.stubGlobal('reportError', undefined);
    const log = vi.spyOn(console, 'error').mockImplementation(() => undefined);
    expect(provoke(Fault.none, { onProgress: throwMine }).found).toBe(true);
    expect(log).toHaveBeenCalledExactlyOnceWith(mine);
  });
});

describe('progress', () => {
  test('maxSeconds: time-limit, at once if 0', () => {
    const error = errorOf(() => provoke(Fault.runUntilStopped, { maxSeconds: 0.05 }));
    expect(error.code).toBe('time-limit');
    expect(error.message).toContain('0.05 s');
  });

  test('onProgress: called now and then, its fraction never falling, values passed on', () => {
    const seen: number[][] = [];
    const onProgress = (...values: number[]): void => void seen.push(values);
    const clock = countingClock();
    try {
      errorOf(() => provoke(Fault.runUntilStopped, { maxSeconds: 0.4, onProgress }));
    } finally {
      clock.restore();
    }
    expect(seen.length).toBeGreaterThan(1);
    expect(seen.length).toBeLessThan(20);
    for (const [fraction, bestCost, lowerBound] of seen) {
      expect(fraction).toBe(seen[0][0]);
      expect([bestCost, lowerBound]).toEqual([Infinity, 0.5]);
    }
  });

  test.each([
    ['an error', new Error('mine')],
    ['a SoapfilmError', new SoapfilmError('cancelled', 'mine')],
    ['undefined', undefined],
    ['a RuntimeError', new WebAssembly.RuntimeError('mine')],
  ])('onProgress throws %s: it comes out as it is, the instance is kept', (_, thrown) => {
    for (const fault of [Fault.runUntilStopped, Fault.ignoreStop]) {
      const before = calls();
      let caught: unknown = 'nothing';
      try {
        provoke(fault, {
          onProgress: () => {
            // eslint-disable-next-line @typescript-eslint/only-throw-error -- users may
            throw thrown;
          },
        });
      } catch (error) {
        caught = error;
      }
      expect(caught).toBe(thrown);
      expect(calls()).toBe(before + 2);
      expect(leaks()).toBe(0);
    }
  });

  test('a call within onProgress: refused, the outer call goes on', () => {
    let inner: SoapfilmError | undefined;
    const onProgress = (): void => {
      inner ??= errorOf(() => spanLoops(kLoops));
    };
    const before = calls();
    const outer = errorOf(() => provoke(Fault.runUntilStopped, { maxSeconds: 0.2, onProgress }));
    expect(inner).toMatchObject({ code: 'bad-option' });
    expect(inner?.message).toContain('onProgress');
    expect(outer.code).toBe('time-limit');
    expect(calls()).toBe(before + 2);
  });
});

/**
 * Loads the package anew, in a thread of its own, and spans a triangle.
 * @param source code for `load`'s `wasm`; `text` stands for the given text
 */
function spanInThread(entry: string, source: string, text = ''): Promise<unknown> {
  const script = `
    const { parentPort, workerData: { entry, text, loops } } = require('node:worker_threads');
    import(entry).then(async ({ load, spanLoops }) => {
      await load({ wasm: ${source} });
      parentPort.postMessage(spanLoops(loops, { weights: { area: ${Fault.none} } }).found);
    });`;
  const thread = new Worker(script, { eval: true, workerData: { entry, text, loops: kLoops } });
  return new Promise((resolve, reject) => {
    thread.on('message', resolve).on('error', reject);
  });
}

describe('sources', () => {
  test.each([
    ['a path', 'text', () => file],
    ['a file URL', 'new URL(text)', () => pathToFileURL(file).href],
    ['a file URL as text', 'text', () => pathToFileURL(file).href],
    ['an http URL', 'new URL(text)', () => `${address}/untyped`],
    ['an http URL as text', 'text', () => `${address}/typed`],
    ['a response with the right type', 'await fetch(text)', () => `${address}/typed`],
    ['a response with another type', 'await fetch(text)', () => `${address}/untyped`],
    ['bytes', "require('node:fs').readFileSync(text)", () => file],
    [
      'a module',
      "await WebAssembly.compile(require('node:fs').readFileSync(text))",
      () => file,
    ],
    ['nothing: the core itself', 'undefined', () => ''],
  ])('%s: loads', async (_, source, text) => {
    expect(await spanInThread('soapfilm', source, text())).toBe(true);
  });

  test('loops.wasm and polygons.wasm are missing: the copies within the scripts take their place', async () => {
    const dist = path.dirname(createRequire(import.meta.url).resolve('soapfilm/loops.wasm'));
    const copy = await mkdtemp(path.join(tmpdir(), 'soapfilm-'));
    try {
      await cp(dist, copy, { recursive: true });
      for (const name of ['loops.wasm', 'polygons.wasm']) await rm(path.join(copy, name));
      await writeFile(path.join(copy, 'package.json'), '{ "type": "module" }');
      const entry = pathToFileURL(path.join(copy, 'node.js')).href;
      expect(await spanInThread(entry, 'undefined')).toBe(true);
    } finally {
      await rm(copy, { recursive: true });
    }
  });
});
