// The examples run as a reader runs them, against the installed package.
import { cp, readFile } from 'node:fs/promises';
import path from 'node:path';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { execute, list, packAndInstall, repository, type Consumer } from './consumer.ts';

let consumer: Consumer;
beforeAll(async () => {
  consumer = await packAndInstall();
  await cp(path.join(repository, 'examples'), path.join(consumer.folder, 'examples'), { recursive: true });
});
afterAll(() => consumer.remove());

const run = (name: string, ...args: string[]): Promise<string> =>
  execute(process.execPath, [path.join('examples', name), ...args], consumer.folder);

/** The numbers with a decimal point in a text. */
const decimals = (text: string): number[] => (text.match(/\d+\.\d+/g) ?? []).map(Number);

/** How many edges of an OBJ file's faces lack a face on the other side. */
function openEdgesOf(file: string): number {
  const edges = new Set<string>();
  for (const [, ...corners] of file.matchAll(/^f (\d+) (\d+) (\d+)$/gm)) {
    corners.forEach((from, k) => {
      const to = corners[(k + 1) % 3];
      if (!edges.delete(`${to} ${from}`)) edges.add(`${from} ${to}`);
    });
  }
  return edges.size;
}

describe('examples', () => {
  test('the course: each step is checked here', async () => {
    const steps = (await list(path.join(repository, 'examples'))).filter((name) => name.endsWith('.mjs'));
    expect(steps).toEqual([
      '01-one-curve.mjs',
      '02-two-curves.mjs',
      '03-weights.mjs',
      '04-candidates.mjs',
      '05-worker.mjs',
      '06-extrude.mjs',
      '07-fill-holes.mjs',
      '08-soap-film.mjs',
      '09-trimmed-surface.mjs',
      '10-camera.mjs',
    ]);
  });

  test('01-one-curve: 24 vertices give 22 triangles, proven best', async () => {
    const output = await run('01-one-curve.mjs');
    expect(output).toContain('22 triangles on 24 vertices');
    expect(output).toContain('proven to be the best: true');
    const [area] = decimals(output);
    // The rim spans a graph over the unit disc, so its area exceeds the 24-gon's.
    expect(area).toBeGreaterThan(12 * Math.sin(Math.PI / 12));
  });

  test('02-two-curves: 40 triangles of less area than the discs across', async () => {
    const output = await run('02-two-curves.mjs', 'tube.obj');
    expect(output).toContain('40 triangles');
    const [area] = decimals(output);
    // A cone's frustum through the same circles, from which 20 chords take a little.
    const frustum = Math.PI * 1.7 * Math.hypot(0.3, 0.8);
    expect(area).toBeLessThan(frustum * 1.01);
    expect(area).toBeGreaterThan(frustum * 0.95);
    const file = await readFile(path.join(consumer.folder, 'tube.obj'), 'utf8');
    expect(file.match(/^v /gm)).toHaveLength(40);
    expect(file.match(/^f /gm)).toHaveLength(40);
  });

  test('03-weights: each setting wins by its own measure', async () => {
    const rows = (await run('03-weights.mjs')).trim().split('\n').slice(1).map(decimals);
    expect(rows).toHaveLength(4);
    const [area, bending, mix, worst] = rows;
    for (const row of rows) {
      expect(area[0]).toBeLessThanOrEqual(row[0]);
      expect(bending[1]).toBeLessThanOrEqual(row[1]);
      expect(worst[2]).toBeLessThanOrEqual(row[2]);
      const cost = ([a, b]: number[]): number => a + 0.2 * b;
      expect(cost(mix)).toBeLessThanOrEqual(cost(row) + 1e-3);
    }
  });

  test('04-candidates: all is no worse than Delaunay, own walls have area 4, a gap no answer', async () => {
    const [all, delaunay, own, open] = (await run('04-candidates.mjs')).trim().split('\n');
    expect(all).toMatch(/^all: 56 candidates/);
    expect(decimals(all)[0]).toBeLessThanOrEqual(decimals(delaunay)[0]);
    expect(own).toBe('own list: area 4.0000');
    expect(open).toBe('a wall less: found is false');
  });

  test('05-worker: two solves, a cancel, and another solve', async () => {
    const lines = (await run('05-worker.mjs')).trim().split('\n');
    expect(lines.splice(3, 1)[0]).toMatch(/^eight loops, ended early: 108 triangles, at most \d\d? % above/);
    expect(lines).toEqual([
      'tube: 24 triangles',
      'disc: 38 triangles',
      'cancelled: cancelled',
      'afterwards: 198 triangles, progress reported true',
    ]);
  });

  test('06-extrude: a closed solid of the plate’s volume, an error named, another polygon repaired', async () => {
    const [solid, error, repaired] = (await run('06-extrude.mjs', 'plate.obj')).trim().split('\n');
    // n + 2 holes - 2 triangles a cap and two a wall.
    const n = 6 + 32 + 16 + 8;
    expect(solid).toContain(`${2 * (n + 6 - 2) + 2 * n} triangles`);
    const disc = (radius: number, count: number): number =>
      (count / 2) * radius ** 2 * Math.sin((2 * Math.PI) / count);
    const area = 8 * 4 - 2 - disc(1, 32) - disc(0.5, 16) - disc(0.25, 8);
    expect(decimals(solid)[0]).toBeCloseTo(0.5 * area, 3);
    expect(error).toBe('hole-outside: ring 1 and ring 0');
    expect(repaired).toMatch(/^repaired: \d+ triangles, 2 points added$/);
    const file = await readFile(path.join(consumer.folder, 'plate.obj'), 'utf8');
    expect(openEdgesOf(file)).toBe(0);
  });

  test('07-fill-holes: three kinds of holes, closed without an open edge, on the torus', async () => {
    const lines = (await run('07-fill-holes.mjs', 'torus.obj')).trim().split('\n');
    expect(lines.slice(0, 3).map((line) => line.split(':')[1].split(',')[0].trim()).sort()).toEqual(['alone', 'band', 'island']);
    expect(lines[3]).toMatch(/^3 of 3 filled, closed: true, \d+ new faces$/);
    expect(decimals(lines[4])[0]).toBeLessThan(0.005);
    expect(lines[5]).toMatch(/^hole 0 alone: \d+ faces, closed: false$/);
    const file = await readFile(path.join(consumer.folder, 'torus.obj'), 'utf8');
    expect(openEdgesOf(file)).toBe(0);
    // Read again: there is nothing left to fill.
    expect((await run('07-fill-holes.mjs', 'again.stl', 'torus.obj')).trim()).toBe('0 of 0 filled, closed: true, 0 new faces');
  });

  test('08-soap-film: a catenoid to a thousandth of its radius, and none between rings too far apart', async () => {
    const output = await run('08-soap-film.mjs', 'film.obj');
    expect(output).toContain('at rest: true');
    const [, off] = decimals(output);
    expect(off).toBeLessThan(2e-3);
    expect(output).toContain('rings 2 apart: no film between them');
  });

  test('09-trimmed-surface: within each tolerance, the file a disc with a hole, a bad move refused', async () => {
    const output = await run('09-trimmed-surface.mjs', 'dome.obj');
    const lines = output.trim().split('\n');
    const within = lines.slice(0, 3).map((line) => decimals(line));
    for (const [tolerance, off] of within) expect(off).toBeLessThanOrEqual(tolerance);
    expect(lines[3]).toMatch(/^after the move: 1 face changed, off by 0\.00\d+ at most$/);
    expect(lines[4]).toMatch(/^refused: trim-outside\. Face 0, loop 1, use 0/);
    const file = await readFile(path.join(consumer.folder, 'dome.obj'), 'utf8');
    const faces = file.split('\n').filter((line) => line.startsWith('f ')).length;
    expect(faces).toBeGreaterThan(500);
    // The rims of the outer loop and the window: an even number, of some each.
    expect(openEdgesOf(file)).toBeGreaterThan(40);
  });

  test('10-camera: few faces change in a frame', async () => {
    const [triangles, changes] = (await run('10-camera.mjs')).trim().split('\n');
    expect(Number(triangles.split(' ')[0])).toBeGreaterThan(1000);
    expect(decimals(changes)[0]).toBeLessThan(4);
  });
});
