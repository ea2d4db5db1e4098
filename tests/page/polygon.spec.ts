// The mode of polygons: drawing, opening, both methods, strips, errors and repair, undo, flooding.
import AxeBuilder from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import '../../web/src/modes/polygon/inspection.ts';
import { canvasBox as filmCanvas, expect, test } from './support.ts';

interface State {
  readonly polygons: number[][][][];
  readonly triangles: number;
  readonly area: number;
  readonly strips: number;
  readonly added: number;
  readonly errors: string[];
  readonly flooded: number | null;
  readonly chosen: { polygon: number; ring: number; vertex: number | null } | null;
}

/** The state of the mode, once what is there has been triangulated. */
async function stateOf(page: Page): Promise<State> {
  await page.waitForFunction(() => window.__polygons?.isSettled);
  return page.evaluate((): State => {
    const now = window.__polygons;
    const found = now?.triangulated;
    if (!now || !found) throw new Error('The mode of polygons is not there.');
    const { positions: p, triangles } = found;
    let area = 0;
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = triangles.subarray(t, t + 3);
      area +=
        ((p[2 * b] - p[2 * a]) * (p[2 * c + 1] - p[2 * a + 1]) -
          (p[2 * b + 1] - p[2 * a + 1]) * (p[2 * c] - p[2 * a])) / 2;
    }
    return {
      polygons: now.document.polygons.map((rings) => rings.map((ring) => ring.map((at) => [...at]))),
      triangles: triangles.length / 3,
      area,
      strips: Math.max(0, found.stripStarts.length - 1),
      added: found.added,
      errors: found.errors.map(({ code }) => code),
      flooded: now.flooding?.taken ?? null,
      chosen: now.selection,
    };
  });
}

async function openMode(page: Page): Promise<State> {
  await page.goto('?aa=0&dpr=1#polygon');
  return stateOf(page);
}

const canvasOf = (page: Page) => page.getByRole('application', { name: /^Polygons/ });

async function draw(page: Page, at: { x: number; y: number; radius: number }): Promise<void> {
  await page.getByRole('button', { name: 'Draw', exact: true }).click();
  const box = await canvasOf(page).boundingBox();
  if (box === null) throw new Error('The canvas is not in the page.');
  const point = (i: number): [number, number] => [
    box.x + at.x * box.width + at.radius * Math.cos((2 * Math.PI * i) / 18),
    box.y + at.y * box.height + at.radius * Math.sin((2 * Math.PI * i) / 18),
  ];
  await page.mouse.move(...point(0));
  await page.mouse.down();
  for (let i = 1; i < 18; i++) await page.mouse.move(...point(i));
  await page.mouse.up();
}

test('the first polygon: triangulated by both methods alike, as strips too', async ({ quietPage: page }) => {
  const first = await openMode(page);
  const n = first.polygons.flat(2).length;
  expect(first.triangles).toBe(n + 2 * (first.polygons[0].length - 1) - 2);
  await page.getByRole('radio', { name: 'Trapezoids' }).check();
  await page.getByRole('radio', { name: 'Strips' }).check();
  const strips = await stateOf(page);
  expect(strips.triangles).toBe(first.triangles);
  expect(strips.area).toBeCloseTo(first.area, 9);
  expect(strips.strips).toBeGreaterThan(1);
  expect(strips.strips).toBeLessThan(first.triangles / 4);
  await page.getByRole('radio', { name: 'Delaunay' }).check();
  expect((await stateOf(page)).area).toBeCloseTo(first.area, 9);
});

test('drawing: a ring is a polygon, a ring inside it a hole; undo takes them back', async ({ quietPage: page }) => {
  await openMode(page);
  await page.getByRole('button', { name: 'Clear all polygons' }).click();
  await page.getByRole('button', { name: 'Draw a polygon' }).click();
  await expect(page.getByText('A ring drawn inside another is a hole.')).toBeVisible();
  await draw(page, { x: 0.5, y: 0.5, radius: 180 });
  const one = await stateOf(page);
  expect(one.polygons.map((rings) => rings.length)).toEqual([1]);
  expect(one.triangles).toBe(22);
  await draw(page, { x: 0.5, y: 0.5, radius: 60 });
  const two = await stateOf(page);
  expect(two.polygons.map((rings) => rings.length)).toEqual([2]);
  expect(two.triangles).toBe(48);
  expect(two.area).toBeLessThan(0.95 * one.area);
  await page.keyboard.press('Control+z');
  expect((await stateOf(page)).polygons).toEqual(one.polygons);
  await page.keyboard.press('Control+Shift+z');
  expect((await stateOf(page)).polygons).toEqual(two.polygons);
});

test('a polygon that crosses itself: the place is named, and repair makes it whole', async ({ quietPage: page }) => {
  await openMode(page);
  await page.getByRole('button', { name: 'Crossing star' }).click();
  expect(await stateOf(page)).toMatchObject({ errors: ['self-intersecting'], triangles: 0 });
  await expect(page.locator('.message.error')).toContainText('The outer ring crosses or overlaps itself.');
  await page.getByRole('radio', { name: 'Nonzero' }).check();
  const whole = await stateOf(page);
  expect(whole.errors).toEqual([]);
  expect(whole.added).toBeGreaterThan(6);
  await page.getByRole('radio', { name: 'Even-odd' }).check();
  const odd = await stateOf(page);
  expect(odd.area).toBeLessThan(whole.area - 0.1);
  await page.keyboard.press('Control+z');
  expect((await stateOf(page)).area).toBe(whole.area);
});

test('a vertex: is dragged, moved by keys, and deleted', async ({ quietPage: page }) => {
  await openMode(page);
  await page.getByRole('button', { name: 'Plate with holes' }).click();
  const before = await stateOf(page);
  const corner = await page.evaluate(() => window.__polygons?.whereIs([0, 0]));
  if (corner === undefined) throw new Error('The mode of polygons is not there.');
  await page.mouse.move(corner.x, corner.y);
  await page.mouse.down();
  for (let i = 1; i <= 5; i++) await page.mouse.move(corner.x - 5 * i, corner.y + 3 * i);
  await page.mouse.up();
  const dragged = await stateOf(page);
  expect(dragged.chosen).toEqual({ polygon: 0, ring: 0, vertex: 0 });
  expect(dragged.area).toBeGreaterThan(before.area);
  await page.keyboard.press('Control+z');
  expect((await stateOf(page)).polygons).toEqual(before.polygons);
  await canvasOf(page).focus();
  await page.keyboard.press(']');
  await page.keyboard.press('.');
  await page.keyboard.press('Shift+ArrowLeft');
  expect((await stateOf(page)).area).not.toBe(before.area);
  await page.keyboard.press('Delete');
  expect((await stateOf(page)).triangles).toBe(before.triangles - 1);
  await page.keyboard.press(']');
  expect((await stateOf(page)).chosen).not.toBeNull();
  await page.getByRole('button', { name: 'Interleaved combs' }).click();
  expect((await stateOf(page)).chosen).toBeNull();
});

test('a vertex on its way: its polygon is kept as a session, and is never half there', async ({ quietPage: page }) => {
  await openMode(page);
  await page.getByRole('button', { name: 'Plate with holes' }).click();
  const before = await stateOf(page);
  const at = (point: [number, number]) =>
    page.evaluate((p) => {
      if (!window.__polygons) throw new Error('The mode of polygons is not there.');
      return window.__polygons.whereIs(p);
    }, point);
  const [corner, beside, across] = [await at([10, 0]), await at([10.5, -0.5]), await at([-3, 5.5])];
  const now = () =>
    page.evaluate(() => {
      const found = window.__polygons?.triangulated;
      const ring = window.__polygons?.document.polygons[0][0] ?? [];
      return { corner: ring[1], count: found?.triangles.length ?? 0, errors: found?.errors.length ?? 0, isPassing: found?.isPassing ?? false };
    });
  await page.mouse.move(corner.x, corner.y);
  await page.mouse.down();
  await page.mouse.move(beside.x, beside.y, { steps: 5 });
  await expect.poll(now).toMatchObject({ count: 3 * before.triangles, errors: 0, isPassing: true });
  expect((await now()).corner[0]).toBeCloseTo(10.5, 6);
  await page.mouse.move(across.x, across.y, { steps: 5 });
  await expect.poll(now).toMatchObject({ count: 0, errors: 1, isPassing: true });
  await expect(page.locator('.fault-label')).toContainText('The outer ring crosses or overlaps itself.');
  await page.mouse.move(beside.x, beside.y, { steps: 5 });
  await expect.poll(now).toMatchObject({ count: 3 * before.triangles, errors: 0, isPassing: true });
  await page.mouse.up();
  const after = await stateOf(page);
  expect(after.errors).toEqual([]);
  expect(after.triangles).toBe(before.triangles);
  // The corner's triangle with its neighbours, (0, 0) and (10, 6), has grown from 30 to 34.
  expect(after.area - before.area).toBeCloseTo(4, 3);
  await expect(page.locator('.fault-label')).toHaveCount(0);
});

test('GeoJSON: is opened, all its polygons', async ({ quietPage: page }) => {
  await openMode(page);
  const ring = (x: number) => [[x, 0], [x + 3, 0], [x + 3, 3], [x, 3], [x, 0]];
  const hole = [[1, 1], [1, 2], [2, 2], [1, 1]];
  const file = {
    type: 'FeatureCollection',
    features: [
      { type: 'Feature', properties: {}, geometry: { type: 'Polygon', coordinates: [ring(0), hole] } },
      { type: 'Feature', properties: {}, geometry: { type: 'MultiPolygon', coordinates: [[ring(5)], [ring(10)]] } },
    ],
  };
  await page.getByLabel('File of polygons').setInputFiles({
    name: 'squares.geojson',
    mimeType: 'application/geo+json',
    buffer: Buffer.from(JSON.stringify(file)),
  });
  await expect.poll(async () => (await stateOf(page)).polygons.length).toBe(3);
  expect((await stateOf(page)).area).toBeCloseTo(26.5, 9);
  await expect(page.getByText('Opened “squares.geojson”: 3 polygons.')).toBeVisible();
  for (const [name, text, reason] of [
    ['no.geojson', '{"type": "Point"}', 'it has no polygons'],
    ['none.geojson', '{"type": "Polygon", "coordinates": []}', 'it has no polygons'],
    ['five.geojson', '{"type": "Polygon", "coordinates": 5}', 'a list is missing in its GeoJSON'],
    ['empty.geojson', '{"type": "Polygon", "coordinates": [[]]}', 'a ring in its GeoJSON has no points'],
    ['words.geojson', '{"type": "Polygon", "coordinates": [[["a", "b"]]]}', 'a coordinate in its GeoJSON is not a number'],
  ]) {
    const broken = { name, mimeType: 'text/plain', buffer: Buffer.from(text) };
    await page.getByLabel('File of polygons').setInputFiles(broken);
    await expect(page.getByText(`Could not open “${name}”: ${reason}`)).toBeVisible();
  }
  expect((await stateOf(page)).polygons).toHaveLength(3);
});

test('flooding: goes step by step to the end, or is stopped', async ({ quietPage: page }) => {
  await openMode(page);
  await page.getByRole('button', { name: 'Interleaved combs' }).click();
  await page.getByRole('button', { name: 'Flood step by step' }).click();
  await expect(page.locator('.flood-step')).toBeVisible();
  await page.keyboard.press('Escape');
  expect((await stateOf(page)).flooded).toBeNull();
  await page.getByRole('button', { name: 'Crossing star' }).click();
  await page.getByRole('button', { name: 'Flood step by step' }).click();
  await expect(page.getByText('There is nothing to flood')).toBeVisible();
});

test('the modes: the address tells which, and each keeps what it has', async ({ quietPage: page }) => {
  await page.goto('?aa=0&dpr=1');
  const box = await filmCanvas(page);
  expect(box.width).toBeGreaterThan(300);
  await page.getByRole('button', { name: 'Polygon', exact: true }).click();
  await stateOf(page);
  expect(new URL(page.url()).hash).toBe('#polygon');
  await page.getByRole('button', { name: 'Clear all polygons' }).click();
  await page.getByLabel('File of polygons').setInputFiles({ name: 'no.json', mimeType: 'text/plain', buffer: Buffer.from('no') });
  await expect(page.getByText('Could not open “no.json”')).toBeVisible();
  await page.getByRole('button', { name: 'Film', exact: true }).click();
  await expect(page.getByText('Could not open “no.json”')).toBeHidden();
  await expect(page.getByRole('button', { name: 'Clear all curves' })).toBeVisible();
  await page.getByRole('button', { name: 'Polygon', exact: true }).click();
  expect((await stateOf(page)).polygons).toEqual([]);
});

test('the bar at the top: names the document; help is on this mode’s own keys', async ({ quietPage: page }) => {
  await openMode(page);
  await expect(page.locator('.document-name')).toHaveText('Pond with islands');
  await page.keyboard.press('?');
  await expect(page.getByRole('dialog')).toContainText('inside another it is a hole');
  await expect(page.getByRole('dialog')).not.toContainText('drawing plane');
  await page.keyboard.press('Escape');
  await expect(page.getByRole('dialog')).toBeHidden();
});

test('for all: no fault that axe finds', async ({ quietPage: page }) => {
  await openMode(page);
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)])).toEqual([]);
});
