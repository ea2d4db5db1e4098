// `bestSoFar`: what limits and cancelling leave, at once and in a worker.
import { load, spanLoops, type Point, type Span } from 'soapfilm';
import { createWorker } from 'soapfilm/worker';
import { beforeAll, describe, expect, test } from 'vitest';
import { countingClock } from '../support/clock.js';
import { rejectionOf } from '../support/errors.js';

/** Loops around points spread over a sphere: far more than can be proven within a test. */
function bubbles(count: number, size: number): Point[][] {
  return Array.from({ length: count }, (_, i) => {
    const z = 1 - (2 * (i + 0.5)) / count;
    const [a, r, rim] = [2.4 * i, Math.sqrt(1 - z * z), 1 / Math.sqrt(count)];
    const out = [r * Math.cos(a), r * Math.sin(a), z];
    const u = [-Math.sin(a), Math.cos(a), 0];
    const v = [-z * Math.cos(a), -z * Math.sin(a), r];
    return Array.from({ length: size }, (_, j): Point => {
      const t = (2 * Math.PI * j) / size;
      const at = (k: number): number =>
        out[k] * (1 + 0.3 * rim * Math.cos(2 * t + i)) + rim * (u[k] * Math.cos(t) + v[k] * Math.sin(t));
      return [at(0), at(1), at(2)];
    });
  });
}

const kMany = bubbles(12, 10);
const kOptions = { candidates: 'delaunay', weights: { area: 1 }, bestSoFar: true } as const;

function expectGap(span: Span): void {
  expect(span.optimal).toBe(false);
  expect(span.cost).toBeGreaterThan(span.lowerBound);
  expect(span.triangles.length / 3).toBe(span.positions.length / 3 + 2 * kMany.length - 4);
}

beforeAll(() => load());

describe('bestSoFar', () => {
  test('maxSeconds: the best surface so far, and every better one on the way', () => {
    const costs: number[] = [];
    const clock = countingClock();
    let span;
    try {
      span = spanLoops(kMany, {
        ...kOptions,
        maxSeconds: 0.3,
        onBest: (best) => {
          expect(best.optimal).toBe(false);
          costs.push(best.cost);
        },
      });
    } finally {
      clock.restore();
    }
    if (!span.found) throw new Error(span.reason);
    expectGap(span);
    expect(span.lowerBound).toBeGreaterThan(0);
    expect(costs.length).toBeGreaterThan(2);
    expect(costs).toEqual([...costs].sort((a, b) => b - a));
    expect(span.cost).toBeCloseTo(costs[costs.length - 1], 9);
  });

  test('maxSeconds: without any surface yet, time-limit', () => {
    expect(() => spanLoops(kMany, { ...kOptions, maxSeconds: 0 })).toThrow(
      expect.objectContaining({ code: 'time-limit' }),
    );
  });

  test('what the listener throws ends the work and is thrown on', () => {
    const reason = new Error('enough');
    const onBest = (): never => {
      throw reason;
    };
    expect(() => spanLoops(kMany, { ...kOptions, onBest })).toThrow(reason);
    expect(spanLoops(kMany.slice(0, 2), { candidates: 'delaunay' }).found).toBe(true);
  });

  test('startFrom: an earlier answer, and nonsense, do no harm', () => {
    const loops = bubbles(4, 8);
    const plain = spanLoops(loops, { candidates: 'delaunay' });
    if (!plain.found) throw new Error(plain.reason);
    for (const startFrom of [plain.triangles, Uint32Array.of(0, 9, 4000000000, 1, 1, 1)]) {
      const again = spanLoops(loops, { candidates: 'delaunay', startFrom });
      expect(again).toMatchObject({ found: true, optimal: true });
      expect((again as Span).cost).toBeCloseTo(plain.cost, 9);
    }
  });

  test.each([
    [{ bestSoFar: 1 }],
    [{ onBest: 'log' }],
    [{ startFrom: [0, 1, 2] }],
    [{ startFrom: new Uint32Array(4) }],
  ])('%o: bad-option', (options) => {
    expect(() => spanLoops(kMany, options as never)).toThrow(
      expect.objectContaining({ code: 'bad-option' }),
    );
  });
});

describe('bestSoFar in a worker', () => {
  test('a signal ends the call with the best surface so far; without one, with cancelled', async () => {
    const film = await createWorker();
    try {
      const stop = new AbortController();
      let heard: Span | undefined;
      const span = await film.spanLoops(kMany, {
        ...kOptions,
        signal: stop.signal,
        onBest: (best) => {
          heard = best;
          setTimeout(() => {
            stop.abort();
          }, 300);
        },
      });
      if (!span.found) throw new Error(span.reason);
      expectGap(span);
      expect(span.cost).toBe(heard?.cost);

      const early = new AbortController();
      const call = film.spanLoops(kMany, { ...kOptions, signal: early.signal });
      early.abort();
      expect(await rejectionOf(call)).toMatchObject({ code: 'cancelled' });

      const after = await film.spanLoops(kMany.slice(0, 2), { candidates: 'delaunay' });
      expect(after).toMatchObject({ found: true, optimal: true });
    } finally {
      film.dispose();
    }
  });
});
