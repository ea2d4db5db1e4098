// The mode of surfaces: examples, files, handles dragged, undo, the camera followed, export.
import { readFile } from 'node:fs/promises';
import AxeBuilder from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import '../../web/src/modes/surface/inspection.ts';
import { expect, test } from './support.ts';

interface State {
  readonly faces: number;
  readonly triangles: number;
  readonly changed: readonly number[];
  readonly deviation: number;
  /** Edges of the mesh, vertices at one place as one, that a triangle has on one side alone. */
  readonly openEdges: number;
  readonly reports: readonly string[];
}

/** The state of the mode, once the model is meshed. */
async function stateOf(page: Page): Promise<State> {
  await page.waitForFunction(() => window.__surfaces?.isSettled);
  return page.evaluate((): State => {
    const now = window.__surfaces?.meshed;
    if (!now) throw new Error('There is no mesh.');
    const { mesh, faces } = now.change;
    const edges = new Map<string, number>();
    let triangles = 0;
    for (let i = 0; i < mesh.triangles.length; i += 3) {
      const corners = [...mesh.triangles.subarray(i, i + 3)];
      if (corners[0] === corners[1]) continue;
      triangles++;
      corners.forEach((corner, k) => {
        const [a, b] = [mesh.same[corner], mesh.same[corners[(k + 1) % 3]]];
        const key = a < b ? `${a} ${b}` : `${b} ${a}`;
        edges.set(key, (edges.get(key) ?? 0) + (a < b ? 1 : -1));
      });
    }
    return {
      faces: mesh.faceStarts.length - 1,
      triangles,
      changed: [...faces],
      deviation: mesh.deviation,
      openEdges: [...edges.values()].filter((sum) => sum !== 0).length,
      reports: mesh.reports.map(({ report }) => report),
    };
  });
}

async function openMode(page: Page): Promise<State> {
  await page.goto('?aa=0&dpr=1#surface');
  return stateOf(page);
}

async function openFile(page: Page, name: string, text: string): Promise<void> {
  await page.getByLabel('File of models').setInputFiles({ name, mimeType: 'application/json', buffer: Buffer.from(text) });
}

async function exported(page: Page, button: string): Promise<{ file: string; bytes: Buffer }> {
  await page.getByRole('button', { name: 'Export' }).click();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: button }).click();
  const done = await download;
  return { file: done.suggestedFilename(), bytes: await readFile(await done.path()) };
}

const summary = (page: Page) => page.locator('.surface-summary');

/** A flat square, of which one trimming curve crosses another if `isFaulty`. */
function plate(isFaulty: boolean): string {
  const corners = [[0, 0], [4, 0], [4, 4], [0, 4]];
  const order = isFaulty ? [0, 2, 1, 3] : [0, 1, 2, 3];
  const line = (a: number[], b: number[]) => ({ degree: 1, knots: [0, 0, 1, 1], poles: [a, b], weights: null, domain: [0, 1] });
  const uses = order.map((corner, k) => ({ edge: k, reversed: false, seam: false, pcurve: line(corners[corner], corners[order[(k + 1) % 4]]) }));
  const surface = { degreeU: 1, degreeV: 1, knotsU: [0, 0, 4, 4], knotsV: [0, 0, 4, 4], countU: 2, countV: 2, poles: [[0, 0, 0], [0, 4, 0], [4, 0, 0], [4, 4, 1]] };
  const edges = order.map((_, id) => ({ id, degenerate: false, tolerance: 1e-7, range: [0, 1], faces: [0], curve3d: null }));
  return JSON.stringify({ schema: 'trimmed-nurbs/1', name: 'plate', faces: [{ id: 0, reversed: false, surface, outer: 0, loops: [{ uses }] }], edges });
}

test('the examples: meshed within the tolerance, those that close without a crack', async ({ quietPage: page }) => {
  const first = await openMode(page);
  expect(first.faces).toBe(3);
  // The rims of two holes, which no other face has.
  expect(first.openEdges).toBeGreaterThan(8);
  for (const [title, faces] of [['Teapot', 32], ['Lofted shell', 1], ['Waves', 1], ['Assembly', 25]] as const) {
    await page.getByRole('button', { name: title }).click();
    await expect(summary(page)).toHaveText(new RegExp(`^${faces} face`));
    const { reports, deviation } = await stateOf(page);
    expect(reports).toEqual([]);
    expect(deviation).toBeGreaterThan(0);
  }
});

test('a finer tolerance: more triangles, nearer; a step of the history', async ({ quietPage: page }) => {
  const before = await openMode(page);
  const field = page.getByRole('textbox', { name: 'Tolerance' });
  await field.fill('0.0001');
  await field.press('Enter');
  await page.waitForFunction((triangles) => (window.__surfaces?.meshed?.change.mesh.triangles.length ?? 0) > 3 * triangles, before.triangles);
  const after = await stateOf(page);
  expect(after.triangles).toBeGreaterThan(1.5 * before.triangles);
  expect(after.deviation).toBeLessThan(before.deviation);
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(field).toHaveValue('0.001');
});

test('a diamond dragged: the trimming curve moves with it, and back with undo', async ({ quietPage: page }) => {
  await openMode(page);
  const poleOf = () => page.evaluate(() => {
    const now = window.__surfaces;
    const use = now?.meshed?.of.model.faces?.[0].loops?.[1].uses[0];
    return use?.pcurve?.poles.map((pole) => Array.from(pole));
  });
  const before = await poleOf();
  const at = await page.evaluate(() => {
    const now = window.__surfaces;
    if (!now) throw new Error('The mode is not there.');
    return now.whereIs(now.handles.findIndex((handle) => handle.kind === 'trim' && handle.pole === 3));
  });
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 8, at.y + 6, { steps: 4 });
  await page.mouse.move(at.x + 16, at.y + 12, { steps: 4 });
  await page.mouse.up();
  await stateOf(page);
  await expect.poll(poleOf).not.toEqual(before);
  const { reports } = await stateOf(page);
  expect(reports.filter((report) => report === 'left-out')).toEqual([]);
  await page.keyboard.press('Control+z');
  await expect.poll(poleOf).toEqual(before);
});

test('colours: each with what it says', async ({ quietPage: page }) => {
  await openMode(page);
  const key = page.locator('.surface-key');
  const choose = (name: string) => page.locator('label.segment', { hasText: name }).click();
  await expect(key).toHaveCount(0);
  await choose('Cells');
  await expect(key).toHaveText('Grid Band');
  await choose('Error');
  const { deviation } = await stateOf(page);
  await expect(key).toHaveText(`0 ${deviation.toPrecision(2)}`);
  await choose('Strips');
  await expect(key).toHaveCount(0);
});

test('the second view: with the camera followed, where it is wanted', async ({ quietPage: page }) => {
  await openMode(page);
  const second = page.locator('.inset');
  await expect(second).toBeHidden();
  await page.getByRole('switch', { name: 'Follow the camera' }).click();
  await expect(second).toBeVisible();
  await page.waitForFunction(() => window.__surfaces?.meshed?.of.sampling.camera !== undefined);
  const canvas = page.locator('canvas').first();
  const pictureOf = async (): Promise<string> => (await second.screenshot()).toString('base64');
  const before = await pictureOf();
  const eye = () => page.evaluate(() => JSON.stringify(window.__surfaces?.meshed?.of.sampling.camera?.eye));
  await stateOf(page);
  const seenFrom = await eye();
  const at = await second.boundingBox();
  if (!at) throw new Error('There is no second view.');
  // It turns by itself: the picture that the mesh is for stays.
  await page.mouse.move(at.x + at.width / 2, at.y + at.height / 2);
  await page.mouse.down();
  await page.mouse.move(at.x + at.width / 2 + 60, at.y + at.height / 2, { steps: 4 });
  await page.mouse.up();
  await expect.poll(pictureOf).not.toBe(before);
  expect(await eye()).toBe(seenFrom);
  await page.getByRole('switch', { name: 'Second view' }).click();
  await expect(second).toBeHidden();
  await expect(canvas).toBeVisible();
});

test('the camera followed: finer when near, kept when frozen', async ({ quietPage: page }) => {
  await openMode(page);
  await page.getByRole('button', { name: 'Assembly' }).click();
  await expect(summary(page)).toHaveText(/^25 faces/);
  await page.getByRole('switch', { name: 'Follow the camera' }).click();
  await page.waitForFunction(() => window.__surfaces?.meshed?.of.sampling.camera !== undefined);
  // Frozen first: only then is it certain that no later picture of the camera is on its way.
  await page.getByRole('switch', { name: 'Freeze' }).click();
  const far = await stateOf(page);
  const eyeOf = () => page.evaluate(() => window.__surfaces?.eye());
  const eye = await eyeOf();
  const canvas = await page.locator('canvas').first().boundingBox();
  if (!canvas) throw new Error('There is no canvas.');
  await page.mouse.move(canvas.x + canvas.width / 2, canvas.y + canvas.height / 2);
  for (let i = 0; i < 8; i++) await page.mouse.wheel(0, -240);
  await expect.poll(eyeOf).not.toEqual(eye);
  expect((await stateOf(page)).triangles).toBe(far.triangles);
  await page.getByRole('switch', { name: 'Freeze' }).click();
  await expect.poll(async () => (await stateOf(page)).triangles).not.toBe(far.triangles);
});

test('files: a model opened, one with a fault told by its place or left out', async ({ quietPage: page }) => {
  await openMode(page);
  await openFile(page, 'plate.json', plate(false));
  await expect(summary(page)).toHaveText(/^1 face/);
  await openFile(page, 'bad.json', plate(true));
  await expect(page.getByText(/^Left out\. Face 0, loop 0/)).toBeVisible();
  await page.getByRole('switch', { name: 'Leave faulty faces out' }).click();
  await expect(page.locator('.message.error')).toContainText('Face 0, loop 0');
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(page.getByText(/^Left out\. Face 0, loop 0/)).toBeVisible();
});

test('export: a GLB of the mesh, and the model as JSON that opens again', async ({ quietPage: page }) => {
  await openMode(page);
  const glb = await exported(page, 'Mesh GLB');
  expect(glb.file).toBe('drilled-cylinder.glb');
  expect(glb.bytes.subarray(0, 4).toString()).toBe('glTF');
  const json = await exported(page, 'Model JSON');
  await page.getByRole('button', { name: 'Waves' }).click();
  await expect(summary(page)).toHaveText(/^1 face/);
  await openFile(page, json.file, json.bytes.toString());
  await expect(summary(page)).toHaveText(/^3 faces/);
});

test('for all: no fault that axe finds', async ({ quietPage: page }) => {
  await openMode(page);
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)])).toEqual([]);
});
