// The mode of meshes: files, holes found and filled, undo, export.
import { readFile } from 'node:fs/promises';
import AxeBuilder from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import '../../web/src/modes/mesh/inspection.ts';
import { changedShare, expect, test } from './support.ts';

interface State {
  readonly name: string;
  readonly vertices: number;
  readonly faces: number;
  readonly holes: { readonly loops: readonly number[]; readonly why: string; readonly wish: string | null }[];
  readonly filled: number[];
  readonly chosen: readonly number[];
  /** Edges that a face has on one side alone. */
  readonly openEdges: number;
}

/** The state of the mode, once holes have been found and those that are to be filled have been. */
async function stateOf(page: Page): Promise<State> {
  await page.waitForFunction(() => window.__meshes?.isSettled);
  return page.evaluate((): State => {
    const now = window.__meshes;
    if (!now) throw new Error('The mode of meshes is not there.');
    const faces = now.filledFaces ?? [];
    const edges = new Map<string, number>();
    for (let i = 0; i < faces.length; i++) {
      const [a, b] = [faces[i], faces[i % 3 === 2 ? i - 2 : i + 1]];
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      edges.set(key, (edges.get(key) ?? 0) + (a < b ? 1 : -1));
    }
    return {
      name: now.document.name,
      vertices: now.document.vertices,
      faces: now.document.faces,
      holes: now.holes.map(({ loops, why, wish }) => ({ loops, why, wish })),
      filled: now.holes.flatMap(({ wish }, h) => (wish === 'fill' ? h : [])),
      chosen: now.chosen,
      openEdges: [...edges.values()].filter((sum) => sum !== 0).length,
    };
  });
}

async function openMode(page: Page): Promise<State> {
  await page.goto('?aa=0&dpr=1#mesh');
  return stateOf(page);
}

type Face = readonly [number, number, number];

/** A torus with two holes, one of them with an island. */
function tornTorus(): { points: number[][]; faces: Face[] } {
  const [rows, columns] = [48, 24];
  const points = Array.from({ length: rows * columns }, (_, v) => {
    const [s, t] = [(2 * Math.PI * Math.floor(v / columns)) / rows, (2 * Math.PI * (v % columns)) / columns];
    return [(1 + 0.4 * Math.cos(t)) * Math.cos(s), (1 + 0.4 * Math.cos(t)) * Math.sin(s), 0.4 * Math.sin(t)];
  });
  const at = (i: number, j: number) => (i % rows) * columns + (j % columns);
  const within = (i: number, j: number, i0: number, j0: number, r: number) => Math.abs(i - i0) <= r && Math.abs(j - j0) <= r;
  const faces: Face[] = [];
  for (let i = 0; i < rows; i++) {
    for (let j = 0; j < columns; j++) {
      const isMissing = (within(i, j, 10, 6, 3) && !within(i, j, 10, 6, 1)) || within(i, j, 34, 6, 2);
      if (!isMissing) faces.push([at(i, j), at(i + 1, j), at(i, j + 1)], [at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)]);
    }
  }
  return { points, faces };
}

function plyOf({ points, faces }: ReturnType<typeof tornTorus>): string {
  const header = `ply\nformat ascii 1.0\nelement vertex ${points.length}\nproperty float x\nproperty float y\nproperty float z\n` +
    `element face ${faces.length}\nproperty list uchar int vertex_indices\nend_header\n`;
  return header + points.map((p) => `${p.join(' ')}\n`).join('') + faces.map((face) => `3 ${face.join(' ')}\n`).join('');
}

async function openFile(page: Page, name: string, content: string | Buffer): Promise<void> {
  await page.getByLabel('File of meshes').setInputFiles({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(content) });
}

async function openTorus(page: Page): Promise<State> {
  await openMode(page);
  await openFile(page, 'torus.ply', plyOf(tornTorus()));
  await page.waitForFunction(() => window.__meshes?.document.name === 'torus');
  return stateOf(page);
}

async function exported(page: Page, note: string): Promise<{ file: string; bytes: Buffer }> {
  await page.getByRole('button', { name: 'Export' }).click();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: `Filled mesh ${note}` }).click();
  const done = await download;
  return { file: done.suggestedFilename(), bytes: await readFile(await done.path()) };
}

const summary = (page: Page) => page.locator('.mesh-summary');

test('a PLY with two holes and an island: listed, filled one by one and all at once, undone', async ({ quietPage: page }) => {
  const first = await openTorus(page);
  expect(first.holes.map(({ loops }) => loops.length).sort()).toEqual([1, 2]);
  await expect(summary(page)).toHaveText('0 of 2 holes filled');
  await expect(page.getByText('with 1 island')).toBeVisible();
  await page.getByRole('button', { name: 'Fill hole 1' }).click();
  const one = await stateOf(page);
  expect(one.filled).toEqual([0]);
  expect(one.openEdges).toBeLessThan(first.openEdges);
  expect(one.openEdges).toBeGreaterThan(0);
  await expect(summary(page)).toHaveText(/^1 of 2 holes filled, \d+ triangles$/);
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  expect(await stateOf(page)).toMatchObject({ filled: [0, 1], openEdges: 0 });
  await page.getByRole('button', { name: 'Leave hole 2' }).click();
  expect((await stateOf(page)).holes.map(({ wish }) => wish)).toEqual(['fill', 'leave']);
  for (const filled of [[0, 1], [0], []]) {
    await page.keyboard.press('Control+z');
    expect((await stateOf(page)).filled).toEqual(filled);
  }
  await page.keyboard.press('Control+z');
  expect((await stateOf(page)).name).toBe('Torn torus');
});

test('export: every format is watertight, and the old part is as it was', async ({ quietPage: page }) => {
  const { vertices, faces } = await openTorus(page);
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  await expect(summary(page)).toContainText('2 of 2 holes filled');
  const obj = await exported(page, 'OBJ');
  expect(obj.file).toBe('torus-filled.obj');
  const rows = (name: string) => obj.bytes.toString().split('\n').filter((line) => line.startsWith(`${name} `)).map((line) => line.split(' ').slice(1).map(Number));
  const torus = tornTorus();
  expect(rows('v').slice(0, vertices).map((p) => p.map(Math.fround))).toEqual(torus.points.map((p) => p.map((x) => Math.fround(x) + 0)));
  expect(rows('f').slice(0, faces)).toEqual(torus.faces.map((face) => face.map((v) => v + 1)));
  const edges = new Map<string, number>();
  for (const face of rows('f')) face.forEach((a, k) => {
    const b = face[(k + 1) % 3];
    const key = [a, b].sort((x, y) => x - y).join(' ');
    edges.set(key, (edges.get(key) ?? 0) + 1);
  });
  expect([...edges.values()].every((count) => count === 2)).toBe(true);
  const ply = await exported(page, 'PLY');
  expect(ply.bytes.toString('latin1')).toContain(`element face ${rows('f').length}\n`);
  const stl = await exported(page, 'STL');
  expect(stl.bytes.readUInt32LE(80)).toBe(rows('f').length);
  const glb = await exported(page, 'GLB');
  expect(glb.file).toBe('torus-filled.glb');
  // What is exported can be opened again: there is nothing left to fill.
  await openFile(page, 'again.glb', glb.bytes);
  await page.waitForFunction(() => window.__meshes?.document.name === 'again');
  expect(await stateOf(page)).toMatchObject({ faces: rows('f').length, openEdges: 0 });
  expect(stl.bytes.length).toBe(84 + 50 * rows('f').length);
  for (const { bytes, file } of [obj, ply, stl]) {
    await openFile(page, file.replace('.', '-again.'), bytes);
    await expect(page.locator('.toast')).toContainText('-again');
    await expect(summary(page)).toHaveText('No holes: the mesh is closed');
    expect((await stateOf(page)).faces).toBe(rows('f').length);
  }
});

test('rims: lit from the list and the other way round, chosen by a click, filled by Enter, dragging turns the view', async ({ quietPage: page }) => {
  await openTorus(page);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.getByRole('button', { name: 'Look from plus z' }).click();
  const rim = async (hole: number) => {
    await page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
    return page.evaluate((h) => {
      const now = window.__meshes;
      const loop = now?.report?.loops[now.holes[h].loops[0]];
      if (!now || !loop) throw new Error('There is no such hole.');
      return now.whereIs(loop.vertices[2]);
    }, hole);
  };
  const at = await rim(1);
  await page.mouse.move(at.x, at.y);
  await expect.poll(() => page.evaluate(() => window.__meshes?.hovered)).toBe(1);
  await expect(page.locator('.mesh-hole.hovered')).toContainText('Hole 2');
  await page.mouse.click(at.x, at.y);
  expect((await stateOf(page)).chosen).toEqual([1]);
  // What is chosen is not dragged: the view turns.
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 60, at.y + 20, { steps: 4 });
  await page.mouse.up();
  const turned = await rim(1);
  expect(Math.hypot(turned.x - at.x, turned.y - at.y)).toBeGreaterThan(5);
  expect((await stateOf(page)).filled).toEqual([]);
  await page.keyboard.press('Enter');
  expect((await stateOf(page)).filled).toEqual([1]);
  await page.keyboard.press('Delete');
  expect((await stateOf(page)).holes.map(({ wish }) => wish)).toEqual([null, 'leave']);
  await page.getByRole('button', { name: /^Hole 1 / }).hover();
  await expect.poll(() => page.evaluate(() => window.__meshes?.hovered)).toBe(0);
});

test('a hole that is looked at, without flights: the grid stays as large as the mesh', async ({ quietPage: page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await openTorus(page);
  await page.getByRole('button', { name: /^Hole 1 / }).click();
  const grid = page.getByRole('switch', { name: 'Grid' });
  await grid.hover();
  const nextPictures = () => page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
  await nextPictures();
  // Hidden and shown again, it is placed anew.
  const changed = await changedShare(page, async () => {
    for (let i = 0; i < 2; i++) await grid.click();
    await nextPictures();
  });
  expect(changed).toBe(0);
});

test('a group: is split into its rims, and joined again', async ({ quietPage: page }) => {
  const first = await openTorus(page);
  const island = first.holes.findIndex(({ loops }) => loops.length === 2);
  await page.getByRole('button', { name: new RegExp(`^Hole ${island + 1} `) }).click();
  await page.getByRole('button', { name: 'Split' }).click();
  const apart = await stateOf(page);
  expect(apart.holes.map(({ loops }) => loops.length)).toEqual([1, 1, 1]);
  const parts = apart.holes.flatMap(({ loops }, h) => (first.holes[island].loops.includes(loops[0]) ? h : []));
  await page.getByRole('button', { name: new RegExp(`^Hole ${parts[0] + 1} `) }).click();
  if ((await stateOf(page)).chosen.length === 0) await page.getByRole('button', { name: new RegExp(`^Hole ${parts[0] + 1} `) }).click();
  await page.getByRole('button', { name: new RegExp(`^Hole ${parts[1] + 1} `) }).click({ modifiers: ['Shift'] });
  await page.getByRole('button', { name: 'Join' }).click();
  expect((await stateOf(page)).holes.map(({ loops }) => [...loops].sort())).toEqual(first.holes.map(({ loops }) => [...loops].sort()));
  await page.keyboard.press('Control+z');
  expect((await stateOf(page)).holes).toHaveLength(3);
});

test('smoothness and density: patches follow', async ({ quietPage: page }) => {
  await openTorus(page);
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  await stateOf(page);
  const patches = () => page.evaluate(() => window.__meshes?.patches.map(({ faces, result }) => [faces.length, result.fairnessUsed]) ?? []);
  const before = await patches();
  await page.getByRole('radio', { name: 'Direction' }).check();
  await stateOf(page);
  expect((await patches()).map(([, used]) => used)).toEqual([1, 1]);
  await page.getByRole('textbox', { name: 'Density' }).fill('0');
  await page.getByRole('textbox', { name: 'Density' }).press('Enter');
  await stateOf(page);
  const coarse = await patches();
  coarse.forEach(([count], h) => { expect(count).toBeLessThan(before[h][0]); });
});

test('broken files and meshes: are said', async ({ quietPage: page }) => {
  const first = await openTorus(page);
  const text = plyOf(tornTorus());
  for (const [name, broken, words] of [
    ['short.ply', text.slice(0, -2000), 'Line 3208: the file ends too early'],
    ['word.ply', text.replace('end_header\n1.4', 'end_header\none'), 'Line 10: “one'],
    ['none.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n', 'Line 4: there is no vertex 9'],
  ]) {
    await openFile(page, name, broken);
    await expect(page.locator('.toast')).toContainText(`Could not open “${name}”: ${words}`);
  }
  expect((await stateOf(page)).name).toBe(first.name);
  const torus = tornTorus();
  await openFile(page, 'twice.ply', plyOf({ ...torus, faces: [...torus.faces, torus.faces[7], torus.faces[9]] }));
  await page.waitForFunction(() => window.__meshes?.document.name === 'twice');
  await stateOf(page);
  await expect(page.getByText(/there twice: kept as they are\./)).toBeVisible();
});

test('undo across modes, and a draft: what was decided is there again', async ({ quietPage: page }) => {
  await openTorus(page);
  await page.getByRole('button', { name: 'Fill hole 2' }).click();
  await stateOf(page);
  await page.getByRole('button', { name: 'Polygon', exact: true }).click();
  await page.getByRole('button', { name: 'Clear all polygons' }).click();
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  expect((await stateOf(page)).filled).toEqual([]);
  expect(new URL(page.url()).hash).toBe('#mesh');
  await page.keyboard.press('Control+Shift+z');
  expect((await stateOf(page)).filled).toEqual([1]);
  await page.reload();
  const again = await stateOf(page);
  expect([again.name, again.filled]).toEqual(['torus', [1]]);
  // Another mesh begins anew.
  await openFile(page, 'other.ply', plyOf(tornTorus()));
  await page.waitForFunction(() => window.__meshes?.document.name === 'other');
  expect((await stateOf(page)).filled).toEqual([]);
});

test('triangles with vertices of their own: their seams are told, and welded', async ({ quietPage: page }) => {
  await openMode(page);
  const { points, faces } = tornTorus();
  const soup = { points: faces.flat().map((v) => points[v]), faces: faces.map((_, f): Face => [3 * f, 3 * f + 1, 3 * f + 2]) };
  await openFile(page, 'soup.ply', plyOf(soup));
  await expect(page.getByText('such rims are seams')).toBeVisible();
  await page.getByRole('button', { name: 'Weld the seams' }).click();
  await expect(summary(page)).toHaveText('0 of 2 holes filled');
  await expect(page.getByText('such rims are seams')).toBeHidden();
  await page.keyboard.press('Control+z');
  await expect(page.getByText('such rims are seams')).toBeVisible();
});

test('a patch that crosses something: is said and marked', async ({ quietPage: page }) => {
  await openMode(page);
  await page.getByRole('button', { name: 'Pot with a mouth' }).click();
  await page.getByRole('button', { name: /with 2 islands/ }).click();
  await page.getByRole('button', { name: 'Split' }).click();
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  await expect(page.getByText('it crosses something: marked in red')).toBeVisible();
  const marked = await page.evaluate(() => window.__meshes?.patches.reduce((sum, { crossing }) => sum + crossing.length, 0));
  expect(marked).toBeGreaterThan(0);
});

/** Two spheres about the x axis, each without the cap in which it would meet the other. */
function cappedSpheres(): { points: number[][]; faces: Face[] } {
  const [around, along] = [16, 9];
  const points: number[][] = [];
  const faces: Face[] = [];
  for (const side of [-1, 1]) {
    const pole = points.push([1.9 * side, 0, 0]) - 1;
    const at = (ring: number, i: number): number => pole + 1 + around * (ring - 1) + (i % around);
    const put = (a: number, b: number, c: number): void => { faces.push(side < 0 ? [a, b, c] : [a, c, b]); };
    for (let ring = 1; ring <= along; ring++) {
      const [away, radius] = [Math.cos((Math.PI * ring) / 13.5), Math.sin((Math.PI * ring) / 13.5)];
      for (let i = 0; i < around; i++) {
        const turn = (2 * Math.PI * i) / around;
        points.push([side * (0.9 + away), radius * Math.cos(turn), radius * Math.sin(turn)]);
        if (ring === 1) put(pole, at(1, i + 1), at(1, i));
        else {
          put(at(ring - 1, i), at(ring - 1, i + 1), at(ring, i));
          put(at(ring - 1, i + 1), at(ring, i + 1), at(ring, i));
        }
      }
    }
  }
  return { points, faces };
}

test('two patches that cross: neither is marked any more once the other one goes, and both are by undo', async ({ quietPage: page }) => {
  await openMode(page);
  await openFile(page, 'spheres.ply', plyOf(cappedSpheres()));
  await page.waitForFunction(() => window.__meshes?.document.name === 'spheres');
  await stateOf(page);
  // The rims face each other, as the ends of a band do.
  await page.getByRole('button', { name: /Hole 1/ }).first().click();
  await page.getByRole('button', { name: 'Split' }).click();
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  const words = page.getByText('it crosses something: marked in red');
  await expect(words).toHaveCount(2);
  await page.getByRole('button', { name: 'Leave hole 1' }).click();
  await expect(words).toHaveCount(0);
  const marked = () => page.evaluate(() => window.__meshes?.patches.map(({ crossing, crossed }) => crossing.length + crossed.length));
  expect(await marked()).toEqual([0]);
  await page.keyboard.press('Control+z');
  await expect(words).toHaveCount(2);
});

/** A cube's surface of small squares, without those near the middle of one of its edges. */
function tornCube(): { points: number[][]; faces: Face[] } {
  const [count, points, faces, numbers] = [16, [] as number[][], [] as Face[], new Map<string, number>()];
  const numberOf = (p: number[]): number => {
    const key = p.join(' ');
    const known = numbers.get(key) ?? points.push(p) - 1;
    numbers.set(key, known);
    return known;
  };
  for (let axis = 0; axis < 3; axis++) {
    for (const side of [-1, 1]) {
      for (let i = 0; i < count; i++) {
        for (let j = 0; j < count; j++) {
          const at = (u: number, v: number): number[] => {
            const p = [0, 0, 0];
            [p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]] = [side, (2 * u) / count - 1, (2 * v) / count - 1];
            return p;
          };
          const [x, y, z] = at(i + 0.5, j + 0.5);
          if (x > 0.6 && z > 0.6 && Math.abs(y) < 0.4) continue;
          const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)].map(numberOf);
          faces.push(...(side > 0 ? [[a, b, c], [a, c, d]] : [[a, c, b], [a, d, c]]) as Face[]);
        }
      }
    }
  }
  return { points, faces };
}

test('creases: go on through a hole, unless they are not to', async ({ quietPage: page }) => {
  await openMode(page);
  await openFile(page, 'cube.ply', plyOf(tornCube()));
  await page.waitForFunction(() => window.__meshes?.document.name === 'cube');
  await stateOf(page);
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  /** Whether the patch has the cube's edge: vertices on it, and nowhere else. */
  const hasEdge = async (): Promise<boolean> => {
    expect(await stateOf(page)).toMatchObject({ openEdges: 0 });
    const points = await page.evaluate(() => Array.from(window.__meshes?.patches[0].added.positions ?? []));
    const onEdge = points.filter((x, i) => i % 3 === 0 && Math.abs(x - 1) < 1e-6 && Math.abs(points[i + 2] - 1) < 1e-6);
    expect(onEdge).toHaveLength(points.length / 3);
    return onEdge.length > 3;
  };
  expect(await hasEdge()).toBe(true);
  await page.getByRole('switch', { name: 'Creases go on' }).uncheck();
  expect(await hasEdge()).toBe(false);
  const angle = page.getByRole('textbox', { name: 'From angle' });
  await expect(angle).toBeHidden();
  await page.keyboard.press('Control+z');
  expect(await hasEdge()).toBe(true);
  // The cube's edges turn by 90 degrees.
  await angle.fill('95');
  await angle.press('Enter');
  expect(await hasEdge()).toBe(false);
});

test('colours of vertices: on the mesh and on patches, or not', async ({ quietPage: page }) => {
  await openMode(page);
  const colors = page.getByRole('switch', { name: 'Colours' });
  await expect(colors).toBeHidden();
  await page.getByRole('button', { name: 'Painted knot' }).click();
  await page.waitForFunction(() => window.__meshes?.document.name === 'Painted knot');
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  expect(await stateOf(page)).toMatchObject({ openEdges: 0 });
  const strange = await page.evaluate(() => window.__meshes?.patches.filter(({ added: { attributes, positions } }) => {
    const color = attributes?.color;
    return color?.size !== 3 || color.data.length !== positions.length || color.data.some((x) => !(x >= 0 && x <= 1));
  }).length);
  expect(strange).toBe(0);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.getByRole('button', { name: 'Look from plus z' }).click();
  await colors.hover();
  const nextPictures = () => page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
  await nextPictures();
  expect(await changedShare(page, async () => {
    await colors.uncheck();
    await nextPictures();
  })).toBeGreaterThan(0.05);
});

test('a file of which something is left out: it opens, and says what', async ({ quietPage: page }) => {
  await openMode(page);
  await openFile(page, 'seam.obj', 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt .5 .5\nf 1/1 2/2 3/3\nf 1/5 3/3 4/4\n');
  await expect(page.getByText(/Opened “seam.obj”: 1 mesh. Some vertices have several texture coordinates/)).toBeVisible();
});

test('a PLY with colours: they are drawn, carried on by patches and exported', async ({ quietPage: page }) => {
  await openMode(page);
  const torus = tornTorus();
  const colored = plyOf(torus)
    .replace('property float z\n', 'property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n')
    .replaceAll(/^-?[\d.]+(e-\d+)? \S+ \S+$/gm, (line) => `${line} 250 120 10`);
  await openFile(page, 'orange.ply', colored);
  await page.waitForFunction(() => window.__meshes?.document.name === 'orange');
  await expect(page.getByRole('switch', { name: 'Colours' })).toBeChecked();
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  expect(await stateOf(page)).toMatchObject({ openEdges: 0 });
  const { bytes } = await exported(page, 'PLY');
  expect(bytes.toString('latin1')).toContain('property uchar red\n');
  await openFile(page, 'again.ply', bytes);
  await page.waitForFunction(() => window.__meshes?.document.name === 'again');
  await expect(page.getByRole('switch', { name: 'Colours' })).toBeVisible();
});

test('the list by keys: arrows go through it, Enter fills, Delete leaves, Escape chooses nothing', async ({ quietPage: page }) => {
  await openTorus(page);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const rows = page.locator('.mesh-hole-name');
  await rows.first().focus();
  await page.keyboard.press('ArrowDown');
  await expect(rows.nth(1)).toBeFocused();
  expect((await stateOf(page)).chosen).toEqual([1]);
  await page.keyboard.press('Enter');
  expect((await stateOf(page)).holes.map(({ wish }) => wish)).toEqual([null, 'fill']);
  await page.keyboard.press('Shift+ArrowUp');
  expect([...(await stateOf(page)).chosen].sort()).toEqual([0, 1]);
  await page.keyboard.press('Delete');
  expect((await stateOf(page)).holes.map(({ wish }) => wish)).toEqual(['leave', 'leave']);
  await page.keyboard.press('Escape');
  expect((await stateOf(page)).chosen).toEqual([]);
  // Delete and Enter are for the row that has the focus, whatever else is chosen.
  await rows.first().press('Enter');
  await rows.nth(1).focus();
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Delete');
  expect(await stateOf(page)).toMatchObject({ chosen: [1], holes: [{ wish: null }, { wish: 'leave' }] });
});

test('a missing band: is looked at from where the eye is, since it faces nowhere', async ({ quietPage: page }) => {
  await openMode(page);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.getByRole('button', { name: 'Look from plus z' }).click();
  const band = page.getByRole('button', { name: /^Hole \d+ band/ });
  await band.click();
  await page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
  // Seen from above, as before, its rims are nearly straight: along the tube they would be circles.
  const [width, height] = await page.evaluate(() => {
    const now = window.__meshes;
    const places = now?.holes[now.chosen[0]].loops.flatMap((loop) => Array.from(now.report?.loops[loop].vertices ?? [], (vertex) => now.whereIs(vertex))) ?? [];
    const extent = (of: number[]) => Math.max(...of) - Math.min(...of);
    return [extent(places.map(({ x }) => x)), extent(places.map(({ y }) => y))];
  });
  expect(width).toBeGreaterThan(1.5 * height);
});

test('hundreds of holes: the first are listed, all when asked for, made as they come into view', async ({ quietPage: page }) => {
  await openMode(page);
  const [rows, columns] = [90, 90];
  const points = Array.from({ length: rows * columns }, (_, v) => [v % columns, Math.floor(v / columns), 0.2 * Math.sin(v)]);
  const faces: Face[] = [];
  for (let i = 0; i + 1 < rows; i++) {
    for (let j = 0; j + 1 < columns; j++) {
      const a = i * columns + j;
      if (i % 4 !== 2 || j % 4 !== 2) faces.push([a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]);
    }
  }
  await openFile(page, 'sieve.ply', plyOf({ points, faces }));
  await page.waitForFunction(() => window.__meshes?.document.name === 'sieve');
  const { holes } = await stateOf(page);
  expect(holes.length).toBeGreaterThan(400);
  const names = page.locator('.mesh-hole-name');
  await expect(names).toHaveCount(200);
  await page.getByRole('button', { name: `Show all ${holes.length}` }).click();
  await page.getByRole('heading', { name: 'Filling' }).scrollIntoViewIfNeeded();
  await expect(names.last()).toContainText(`Hole ${holes.length} `);
  await names.last().click();
  expect((await stateOf(page)).chosen).toEqual([holes.length - 1]);
  await page.getByRole('group', { name: 'Chosen holes' }).getByRole('button', { name: 'Fill' }).click();
  expect((await stateOf(page)).filled).toEqual([holes.length - 1]);
});

test('the help: tells of nothing that the mode does not have', async ({ quietPage: page }) => {
  await openMode(page);
  await page.keyboard.press('?');
  const help = page.getByRole('dialog');
  await expect(help).toContainText('Choose the hole');
  for (const words of ['vertex', 'Draw', 'drawing plane', 'stroke', 'Tools']) await expect(help).not.toContainText(words);
  await page.keyboard.press('Escape');
  await expect(page.getByRole('toolbar', { name: 'Tools' }).getByRole('button')).toHaveCount(2);
});

test.describe('by touch', () => {
  test.use({ hasTouch: true });
  test('a hole that was touched in the list: is chosen, and not pointed at any more', async ({ quietPage: page }) => {
    await openTorus(page);
    await page.getByRole('button', { name: /^Hole 2 / }).tap();
    expect((await stateOf(page)).chosen).toEqual([1]);
    expect(await page.evaluate(() => window.__meshes?.hovered)).toBeNull();
  });
});

test('open rims: are left, unless that is asked for', async ({ quietPage: page }) => {
  await openMode(page);
  await page.getByRole('button', { name: 'Pot with a mouth' }).click();
  await page.waitForFunction(() => window.__meshes?.document.name === 'Pot with a mouth');
  const { holes } = await stateOf(page);
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  expect((await stateOf(page)).filled).toHaveLength(holes.length - 2);
  await page.getByRole('switch', { name: 'Fill open rims too' }).check();
  expect(await stateOf(page)).toMatchObject({ openEdges: 0 });
  await page.getByRole('switch', { name: 'Fill open rims too' }).uncheck();
  expect((await stateOf(page)).filled).toHaveLength(holes.length - 2);
});

test('for all: no fault that axe finds', async ({ quietPage: page }) => {
  await openMode(page);
  await page.getByRole('button', { name: 'Fill all', exact: true }).click();
  await stateOf(page);
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)])).toEqual([]);
});
