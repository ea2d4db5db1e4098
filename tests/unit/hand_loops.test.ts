// Loops as hands draw them, through the API: default options, ended early or not, at once and in a worker.
import { load, spanLoops, type Point } from 'soapfilm';
import { createWorker } from 'soapfilm/worker';
import { beforeAll, describe, expect, test } from 'vitest';
import { Random } from '../support/generators.js';
import { handLoops, kHands } from '../support/hand_loops.js';
import { expectSurface } from '../support/surface.js';

beforeAll(() => load());

/** Ends the work once it has a surface: by a listener, so that no clock decides. */
class Enough extends Error {}

const kSmall = kHands.filter((kind) => kind !== 'many small' && kind !== 'several');

describe('loops as hands draw them', () => {
  test.each(kSmall)('%s: default options give a valid surface', (kind) => {
    const random = new Random(kSmall.indexOf(kind) + 1);
    for (const size of [3, 8, 20, 45]) {
      const span = spanLoops(handLoops(kind, size, random));
      if (!span.found) throw new Error(span.reason);
      expectSurface(span);
      expect(span.lowerBound).toBeGreaterThanOrEqual(0);
      expect(span.lowerBound).toBeLessThanOrEqual(span.cost);
    }
  });

  test.each(['several', 'many small'] as const)('%s: the first surface comes before any proof', (kind) => {
    const random = new Random(41);
    const heard: number[] = [];
    expect(() =>
      spanLoops(handLoops(kind, 60, random), {
        bestSoFar: true,
        onBest: (span) => {
          expectSurface(span);
          heard.push(span.lowerBound);
          throw new Enough();
        },
      }),
    ).toThrow(Enough);
    expect(heard).toEqual([expect.any(Number)]);
    expect(heard[0]).toBeGreaterThanOrEqual(0);
  });

  test('bestSoFar that ends early: bounds are numbers that weights prove, on the way and at the end', async () => {
    using film = await createWorker();
    const ends = new AbortController();
    const bounds: number[] = [];
    const loops: Point[][] = handLoops('many small', 0, new Random(42));
    const span = await film.spanLoops(loops, {
      bestSoFar: true,
      signal: ends.signal,
      onProgress: (_fraction, _best, lowerBound) => bounds.push(lowerBound),
      onBest: () => {
        ends.abort();
      },
    });
    if (!span.found) throw new Error(span.reason);
    expectSurface(span);
    expect(span.optimal).toBe(false);
    for (const bound of [...bounds, span.lowerBound]) expect(bound).toBeGreaterThanOrEqual(0);
    expect(JSON.parse(JSON.stringify({ bound: span.lowerBound }))).toEqual({ bound: span.lowerBound });
  });
});
