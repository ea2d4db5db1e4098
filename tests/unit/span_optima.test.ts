import { readFileSync } from 'node:fs';
import { load, parseLoops, spanLoops, type SpanOptions } from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { expectClose, expectSpans } from '../support/surface.js';

beforeAll(() => load());

const fixture = (name: string): string =>
  readFileSync(new URL(`../fixtures/${name}`, import.meta.url), 'utf8');

interface Row {
  curves: string;
  space: 'all' | 'delaunay';
  weights: { area: number; perimeter: number; dihedral: number };
  objective: 'sum' | 'worst-dihedral';
  best: number;
  proved: boolean;
  native: number;
}

function readRows(): Row[] {
  const lines = fixture('optima.csv').split('\n');
  return lines
    .filter((line) => line !== '' && !line.startsWith('#') && !line.startsWith('curves,'))
    .map((line) => {
      const [curves, space, area, perimeter, dihedral, objective, best, proved, native] =
        line.split(',');
      return {
        curves,
        space: space as Row['space'],
        weights: {
          area: Number(area),
          perimeter: Number(perimeter),
          // The worst angle has no factor; ties need one.
          dihedral: objective === 'sum' ? Number(dihedral) : 1,
        },
        objective: objective as Row['objective'],
        best: Number(best),
        proved: proved === 'yes',
        native: Number(native),
      };
    });
}

describe('spanLoops, known optima', () => {
  test.each(readRows())(
    '$curves, $space, $weights, $objective: reached, and equal to the native cost',
    ({ curves, space, weights, objective, best, proved, native }) => {
      const input = parseLoops(fixture(`curves/${curves}.curve`));
      const options: SpanOptions = { candidates: space, weights, objective };
      const result = spanLoops(input, options);
      expectSpans(result, input, options);
      expect(result.optimal).toBe(true);
      // Best costs were printed to nine or ten digits.
      if (proved) expect(Math.abs(result.cost / best - 1)).toBeLessThanOrEqual(1e-8);
      else expect(result.cost).toBeLessThanOrEqual(best * (1 + 1e-9));
      expectClose(result.cost, native, 'native cost', 1e-12);
    },
  );
});
