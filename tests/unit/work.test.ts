// The queue of work: when it begins, what takes its place, how it ends. The threads are stand-ins; time is the test's.
import { signal } from '@preact/signals';
import { SoapfilmError } from 'soapfilm';
import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';

const createWorker = vi.fn<() => Promise<object>>();
vi.mock('soapfilm/worker', () => ({ createWorker: () => createWorker() }));

const { busy, createWork, endShownWork, plainFailure } = await import('../../web/src/state/work.ts');
const { dispatch, endGesture, ensureGroup, mode } = await import('../../web/src/state/store.ts');

interface Input {
  readonly name: string;
}
interface Call {
  readonly input: Input;
  readonly signal: AbortSignal;
  readonly live: boolean;
  onlyForNow(): void;
  progress(fraction: number, detail?: string): void;
  finish(result: string): void;
  fail(error: unknown): void;
}

mode.value = 'test';
const group = ensureGroup('test', { step: 0 }).id;
let step = 0;
/** A gesture that is under way, or goes on. */
const gesture = () => { dispatch({ type: 'set', group, settings: { step: ++step } }, 'gesture'); };

function setUp(options: { auto?: boolean; alwaysLive?: boolean } = {}) {
  const input = signal<Input | null>(null);
  const auto = signal(options.auto ?? true);
  const calls: Call[] = [];
  const shown: (string | null)[] = [];
  const work = createWork<Input, string, string>({
    mode: 'test',
    verb: 'Testing',
    part: 'loops',
    input,
    auto,
    ...(options.alwaysLive !== undefined && { alwaysLive: options.alwaysLive }),
    compute: (_, of, watch) =>
      new Promise((resolve, reject) => {
        watch.signal.addEventListener('abort', () => { reject(new SoapfilmError('cancelled', 'cancelled')); });
        const { signal: ends, live } = watch;
        calls.push({
          input: of,
          signal: ends,
          live,
          onlyForNow: () => { watch.onlyForNow(); },
          progress: (fraction, detail) => { watch.progress(fraction, detail); },
          finish: resolve,
          fail: reject,
        });
      }),
    show: (result) => shown.push(result),
    explain: plainFailure,
  });
  return { input, auto, calls, shown, work };
}

/** Lets time pass, and whatever waits for a thread. */
const pass = (ms: number) => vi.advanceTimersByTimeAsync(ms);

beforeEach(() => {
  vi.useFakeTimers();
  createWorker.mockReset().mockResolvedValue({});
});
afterEach(() => {
  endGesture();
  endShownWork();
  vi.useRealTimers();
});

test('a change: is worked on once it has settled, and shown', async () => {
  const { input, calls, shown, work } = setUp();
  expect(work.state.value.phase).toBe('idle');
  for (const name of ['a', 'b', 'c']) {
    input.value = { name };
    await pass(20);
  }
  expect(calls).toEqual([]);
  await pass(60);
  expect(calls.map((call) => call.input.name)).toEqual(['c']);
  expect(busy.value).toBe(work);
  calls[0].progress(0.5, 'half');
  expect(work.state.value).toMatchObject({ phase: 'running', fraction: 0.5, detail: 'half' });
  calls[0].finish('C');
  await pass(0);
  expect([work.state.value.phase, shown, busy.value]).toEqual(['done', ['C'], null]);
  await pass(1000);
  expect(calls).toHaveLength(1);
});

test('the latest wins: what is under way is dropped, and nothing more is heard of it', async () => {
  const { input, calls, shown, work } = setUp();
  input.value = { name: 'a' };
  await pass(60);
  input.value = { name: 'b' };
  await pass(60);
  expect(calls.map(({ input: { name }, signal: { aborted } }) => [name, aborted])).toEqual([['a', true], ['b', false]]);
  calls[0].progress(0.9);
  expect(work.state.value).toMatchObject({ phase: 'running', fraction: 0 });
  calls[1].finish('B');
  await pass(100);
  expect(shown).toEqual(['B']);
});

test('nothing to do: shown at once, and what is under way is dropped', async () => {
  const { input, calls, shown, work } = setUp();
  input.value = { name: 'a' };
  await pass(60);
  input.value = null;
  expect([calls[0].signal.aborted, shown, work.state.value.phase]).toEqual([true, [null], 'idle']);
});

test('ended: what was shown stays, and a change begins anew', async () => {
  const { input, calls, shown, work } = setUp();
  input.value = { name: 'a' };
  await pass(60);
  endShownWork();
  await pass(0);
  expect([work.state.value.phase, shown]).toEqual(['cancelled', []]);
  await pass(1000);
  expect(calls).toHaveLength(1);
  input.value = { name: 'b' };
  await pass(60);
  expect(calls).toHaveLength(2);
});

test('work of a mode that is not shown: is not ended from elsewhere, and goes on', async () => {
  const { input, calls, shown } = setUp();
  input.value = { name: 'a' };
  await pass(60);
  mode.value = 'other';
  expect([busy.value, endShownWork(), calls[0].signal.aborted]).toEqual([null, false, false]);
  calls[0].finish('A');
  await pass(0);
  expect(shown).toEqual(['A']);
  mode.value = 'test';
});

test('ended while the threads are on their way: at once', async () => {
  vi.resetModules();
  const fresh = await import('../../web/src/state/work.ts');
  const { mode: freshMode } = await import('../../web/src/state/store.ts');
  freshMode.value = 'test';
  createWorker.mockReturnValueOnce(new Promise(() => undefined));
  const work = fresh.createWork<Input, string>({
    mode: 'test',
    verb: 'Testing',
    part: 'loops',
    input: signal<Input | null>({ name: 'a' }),
    compute: () => Promise.resolve('A'),
    show: () => undefined,
    explain: fresh.plainFailure,
  });
  await pass(60);
  expect(work.state.value.phase).toBe('running');
  fresh.endShownWork();
  await pass(0);
  expect(work.state.value.phase).toBe('cancelled');
});

test('ended, but it had something: that is its result', async () => {
  const { input, calls, shown, work } = setUp();
  input.value = { name: 'a' };
  await pass(60);
  calls[0].finish('best so far');
  endShownWork();
  await pass(0);
  expect([work.state.value.phase, shown]).toEqual(['done', ['best so far']]);
});

test('an error: in words, with nothing shown; threads that could not be had are tried for again', async () => {
  const { input, calls, shown, work } = setUp();
  input.value = { name: 'a' };
  await pass(60);
  calls[0].fail(new SoapfilmError('too-large', 'too much'));
  await pass(0);
  expect(work.state.value).toMatchObject({ phase: 'failed', code: 'too-large', message: 'too much' });
  expect(shown).toEqual([null]);
});

test('no threads: said, and the next try asks for them anew', async () => {
  vi.resetModules();
  const fresh = await import('../../web/src/state/work.ts');
  createWorker.mockRejectedValueOnce(new SoapfilmError('load-failed', 'no network'));
  const input = signal<Input | null>({ name: 'a' });
  const shown: (string | null)[] = [];
  const work = fresh.createWork<Input, string>({
    mode: 'test',
    verb: 'Testing',
    part: 'polygons',
    input,
    compute: () => Promise.resolve('A'),
    show: (result) => shown.push(result),
    explain: fresh.plainFailure,
  });
  await pass(60);
  expect(work.state.value).toMatchObject({ phase: 'failed', code: 'load-failed' });
  work.start();
  await pass(0);
  expect([work.state.value.phase, shown]).toEqual(['done', [null, 'A']]);
  expect(createWorker).toHaveBeenCalledTimes(2);
});

test('not of its own accord: begins when asked, and again only when asked', async () => {
  const { input, auto, calls, work } = setUp({ auto: false });
  input.value = { name: 'a' };
  await pass(1000);
  expect(calls).toEqual([]);
  work.start();
  await pass(0);
  calls[0].finish('A');
  input.value = { name: 'b' };
  await pass(1000);
  expect(calls).toHaveLength(1);
  auto.value = true;
  await pass(60);
  expect(calls).toHaveLength(2);
});

describe('during a gesture', () => {
  test('quick work: each waits for the one before, the latest follows', async () => {
    const { input, calls, shown } = setUp();
    gesture();
    input.value = { name: 'a' };
    await pass(1);
    expect(calls[0].live).toBe(true);
    for (const name of ['b', 'c', 'd']) {
      input.value = { name };
      await pass(1);
    }
    expect(calls).toHaveLength(1);
    calls[0].finish('A');
    await pass(1);
    expect(calls.map((call) => call.input.name)).toEqual(['a', 'd']);
    expect(calls[1].signal.aborted).toBe(false);
    calls[1].finish('D');
    await pass(1);
    endGesture();
    await pass(1000);
    expect([calls.length, shown]).toEqual([2, ['A', 'D']]);
  });

  test('slow work: waits for the end of the gesture, unless it always follows', async () => {
    for (const alwaysLive of [false, true]) {
      const { input, calls } = setUp({ alwaysLive });
      input.value = { name: 'a' };
      await pass(60);
      await pass(400);
      calls[0].finish('A');
      await pass(100);
      gesture();
      input.value = { name: 'b' };
      await pass(200);
      expect(calls).toHaveLength(alwaysLive ? 2 : 1);
      if (alwaysLive) calls[1].finish('B');
      await pass(0);
      endGesture();
      await pass(200);
      expect(calls).toHaveLength(2);
    }
  });

  test('a result only for now: is made anew once the gesture has ended', async () => {
    const { input, calls, shown } = setUp();
    gesture();
    input.value = { name: 'a' };
    await pass(1);
    calls[0].onlyForNow();
    calls[0].finish('for now');
    await pass(500);
    expect(calls).toHaveLength(1);
    endGesture();
    await pass(60);
    calls[1].finish('for good');
    await pass(0);
    expect([calls[1].live, shown]).toEqual([false, ['for now', 'for good']]);
  });
});
