// The tables of the C ABI, for TypeScript: made from the header, and up to date.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { describe, expect, test } from 'vitest';

const root = path.resolve(import.meta.dirname, '../..');
const script = path.join(root, 'wasm/scripts/border.mjs');
const header = path.join(root, 'wasm/include/soapfilm_tables.h');

const moduleOf = (file: string): string =>
  execFileSync(process.execPath, [script, file], { encoding: 'utf8', stdio: 'pipe' });

/** The module for a header of that text. */
function moduleFor(text: string): string {
  const folder = mkdtempSync(path.join(tmpdir(), 'border-'));
  try {
    const file = path.join(folder, 'tables.h');
    writeFileSync(file, text);
    return moduleOf(file);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

describe('border.ts', () => {
  test('is what the header gives', () => {
    const text = readFileSync(path.join(root, 'wasm/ts/border.ts'), 'utf8');
    expect(text).toBe(moduleOf(header));
  });

  test('a table of each kind: names and numbers in the header\'s order', () => {
    const text = moduleFor(`
      #define SF_STATUSES(X) X(Ok, 0, "fine") X(Bad, 7, "not fine")
      #define SF_COLOUR_CHOICES(X) \\
        X(Red, 0, "red") \\
        X(DarkBlue, 1, "dark-blue")
      #define SF_BALL_SETTINGS(X) X(double, size, "metres") X(double, colour, "")
      #define SF_HIT_RECORD(X) X(uint32_t, face, "which " "face") X(uint32_t, corner, "")
      #define SF_GAME_ARRAYS(X) X(double, times, "[h]") X(SfHit, hits, "[h]")`);
    for (const part of [
      'Ok: 0,\n  /** not fine */\n  Bad: 7',
      "kColourChoices = ['red', 'dark-blue'] as const",
      'Float64Array.of(\n    settings.size,\n    settings.colour,\n  )',
      'kHitLength = 2',
      '/** which face */\n  readonly face: number',
      'face: from[at],\n  corner: from[at + 1],',
      'times: array(0, Float64Array),\n  hits: array(1, Uint32Array),',
      '/** Hit: [h] */\n  readonly hits: Uint32Array',
    ]) {
      expect(text).toContain(part);
    }
  });

  const bad: [string, string, string][] = [
    ['none at all', 'int x;', 'no tables'],
    ['one of no kind', '#define SF_THINGS(X) X(a, 0, "a")', 'SF_THINGS is no kind'],
    ['an entry of another form', '#define SF_STATUSES(X) X(Ok, 0, "ok") X(Bad, 1)', 'from here on: X(Bad'],
    ['a record of two types', '#define SF_A_RECORD(X) X(double, a, "") X(uint32_t, b, "")', 'several types'],
    ['an array of what there is not', '#define SF_A_ARRAYS(X) X(SfHit, hits, "")', 'SfHit is neither'],
    ['choices out of order', '#define SF_A_CHOICES(X) X(B, 1, "b") X(A, 0, "a")', 'not numbered from 0'],
  ];
  test.each(bad)('tables, %s: an error that says so', (_, text, message) => {
    expect(() => moduleFor(text)).toThrow(message);
  });
});
