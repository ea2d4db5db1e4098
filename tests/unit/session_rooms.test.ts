// Sessions on a core that misbehaves: who is lost in a crash, and what is freed when.
import { execFile } from 'node:child_process';
import { rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { promisify } from 'node:util';
import { load, PolygonSession, spanLoops, type PolygonSet } from 'soapfilm';
import { afterAll, afterEach, beforeAll, describe, expect, test, vi } from 'vitest';
import { errorOf } from '../support/errors.js';
import { Fault, faultyCore } from '../support/faulty_core.js';

/** How many instances there are for sessions before they have to share. */
const kMostRooms = 32;

const triangle = (fault: number): PolygonSet => ({
  positions: Float64Array.of(fault, 0, 1, 0, 0, 1),
  starts: Uint32Array.of(0, 3),
});

const file = path.join(tmpdir(), `soapfilm-rooms-${process.pid}.wasm`);
const opened: PolygonSession[] = [];

beforeAll(async () => {
  const bytes = await faultyCore();
  await writeFile(file, bytes);
  await load({ wasm: { loops: bytes, polygons: bytes } });
});
afterEach(() => {
  for (const session of opened.splice(0)) session.dispose();
});
afterAll(() => rm(file));

function open(count: number, fault: number = Fault.none): PolygonSession[] {
  const sessions = Array.from({ length: count }, () => new PolygonSession(triangle(fault)));
  opened.push(...sessions);
  return sessions;
}

const crash = (session: PolygonSession) => errorOf(() => session.move(0, [Fault.trap, 0]));
/** How many sessions there are where this one is, and what has not been freed there. */
const around = (session: PolygonSession): number[] => Array.from(session.read().positions);

describe('a crash in one session', () => {
  test('takes no other with it; its own uses say that it is lost', () => {
    const [a, b, c] = open(3);
    expect([a, b, c].map(around)).toEqual([[1, 0], [1, 0], [1, 0]]);
    const error = crash(b);
    expect(error.code).toBe('crashed');
    expect(error.message).toMatch(new RegExp(`; session ${b.id} is lost$`));
    expect(error.cause).toBeInstanceOf(WebAssembly.RuntimeError);
    for (const use of [() => b.read(), () => b.move(0, [1, 1]), () => b.triangles]) {
      expect(errorOf(use)).toMatchObject({
        code: 'crashed',
        message: `Session ${b.id} was lost when it crashed`,
      });
    }
    for (const session of [a, c, ...open(1)]) {
      expect(session.move(0, [Fault.none, 0]).triangleCount).toBe(1);
      expect(around(session)).toEqual([1, 0]);
    }
    b.dispose();
    expect(errorOf(() => b.read()).code).toBe('disposed');
  });

  test('while it is opened: none is lost', () => {
    const [a] = open(1);
    expect(errorOf(() => new PolygonSession(triangle(Fault.trap))).code).toBe('crashed');
    expect(around(a)).toEqual([1, 0]);
    expect(around(open(1)[0])).toEqual([1, 0]);
  });

  test('of a span: none is lost', () => {
    const [a] = open(1);
    const { positions, starts } = { positions: new Float64Array(9), starts: Uint32Array.of(0, 3) };
    expect(errorOf(() => spanLoops({ positions, starts }, { weights: { area: Fault.trap } })).code).toBe('crashed');
    expect(around(a)).toEqual([1, 0]);
  });

  test('more than there are instances for: those of one instance go together, and are named', () => {
    const sessions = open(2 * kMostRooms + 1);
    expect(sessions.map((session) => around(session)[0]).sort()).toEqual([
      ...Array.from({ length: 2 * kMostRooms - 2 }, () => 2),
      ...[3, 3, 3],
    ]);
    // New ones go where there are fewest, in order.
    const [a, b, c] = [0, kMostRooms, 2 * kMostRooms].map((i) => sessions[i]);
    expect(crash(b).message).toMatch(
      new RegExp(`; session ${b.id} is lost, and what shared its memory: session ${a.id}, ${c.id}$`),
    );
    for (const other of [a, c]) {
      expect(errorOf(() => other.read())).toMatchObject({
        code: 'crashed',
        message: `Session ${other.id} was lost when session ${b.id}, which shared its memory, crashed`,
      });
    }
    for (const session of sessions) {
      if (![a, b, c].includes(session)) expect(around(session)).toEqual([2, 0]);
    }
    // Their instance is gone: there is room for another.
    expect(around(open(1)[0])).toEqual([1, 0]);
  });
});

describe('an engine without room for another instance', () => {
  afterEach(() => {
    vi.restoreAllMocks();
  });

  test('sessions share those there are; without any, out-of-memory, and later ones are opened', () => {
    const [a] = open(1);
    const spy = vi.spyOn(WebAssembly, 'Instance').mockImplementation(function () {
      throw new RangeError('Cannot allocate Wasm memory for new instance');
    });
    open(2);
    expect(around(a)).toEqual([3, 0]);
    for (const session of opened.splice(0)) session.dispose();
    expect(errorOf(() => open(1)).code).toBe('out-of-memory');
    expect(spy).toHaveBeenCalledTimes(3);
    spy.mockRestore();
    expect(around(open(1)[0])).toEqual([1, 0]);
  });
});

describe('dispose', () => {
  test('in a shared instance: ends the session in the core, once', () => {
    const sessions = open(kMostRooms + 1);
    const [a, b] = [sessions[0], sessions[kMostRooms]];
    expect(around(a)).toEqual([2, 0]);
    b.dispose();
    b.dispose();
    expect(around(a)).toEqual([1, 0]);
    for (const use of [() => b.triangles, () => b.read(), () => b.delete(0), () => b.move(0, [1, 1])]) {
      expect(errorOf(use)).toMatchObject({ code: 'disposed', message: `Session ${b.id} is disposed of` });
    }
  });

  test('from within a listener, in a shared instance: refused, and may be done later', () => {
    const sessions = open(kMostRooms + 1);
    const [a, b] = [sessions[0], sessions[kMostRooms]];
    let inner: unknown;
    const onBest = (): void => {
      inner = errorOf(() => {
        b.dispose();
      });
    };
    const loops = { positions: new Float64Array(9), starts: Uint32Array.of(0, 3) };
    spanLoops(loops, { weights: { area: Fault.resultThenDone }, onBest });
    expect(inner).toMatchObject({ code: 'bad-option' });
    expect(around(a)).toEqual([2, 0]);
    b.dispose();
    expect(around(a)).toEqual([1, 0]);
  });

  test('of the last in an instance: makes room for another', () => {
    const sessions = open(kMostRooms);
    sessions[3].dispose();
    expect(around(open(1)[0])).toEqual([1, 0]);
    expect(around(open(1)[0])).toEqual([2, 0]);
  });
});

test('sessions that are forgotten: are ended in the core, and their instances collected', async () => {
  const script = `
    import { load, PolygonSession } from 'soapfilm';
    const memories = [];
    const Real = WebAssembly.Instance;
    WebAssembly.Instance = function (...args) {
      const instance = new Real(...args);
      memories.push(new WeakRef(instance.exports.memory));
      return instance;
    };
    await load({ parts: ['polygons'], wasm: { polygons: ${JSON.stringify(file)} } });
    const polygon = { positions: Float64Array.of(1, 0, 1, 0, 0, 1), starts: Uint32Array.of(0, 3) };
    const open = (count) => Array.from({ length: count }, () => new PolygonSession(polygon));
    const [kept] = open(1);
    const forget = () => { open(${2 * kMostRooms - 1}); };
    const inCore = () => kept.read().positions[0];
    const alive = () => memories.filter((memory) => memory.deref()).length;
    forget();
    console.log(inCore(), memories.length);
    for (let i = 0; i < 2000 && !(inCore() === 1 && alive() === 1); i++) {
      // What has been looked at stays until the next task.
      await new Promise((resolve) => setTimeout(resolve, 1));
      gc();
    }
    console.log(inCore(), alive());`;
  const { stdout } = await promisify(execFile)(process.execPath, [
    '--expose-gc',
    '--input-type=module',
    '-e',
    script,
  ]);
  expect(stdout).toBe(`2 ${kMostRooms}\n1 1\n`);
});
