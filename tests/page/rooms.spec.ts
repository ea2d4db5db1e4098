// The rooms of the page: going from one to another, one history for all, what happens without a network.
import { createRequire } from 'node:module';
import { feature } from 'topojson-client';
import '../../web/src/modes/film/inspection.ts';
import '../../web/src/modes/polygon/inspection.ts';
import { expect, hasCurves, openPage, spanned, stateOf, test } from './support.ts';

type Page = Parameters<typeof openPage>[0];

const toPolygons = async (page: Page): Promise<void> => {
  await page.getByRole('button', { name: 'Polygon', exact: true }).click();
  await page.waitForFunction(() => window.__polygons?.triangulated);
};
const polygonCount = (page: Page) => page.evaluate(() => window.__polygons?.document.polygons.length);
const modeOf = async (page: Page) => (await stateOf(page)).mode;

test('undo and redo: one history for all modes, and the mode is shown that they change', async ({ quietPage: page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await openPage(page);
  const { curves } = await stateOf(page);
  await page.keyboard.press('a');
  await hasCurves(page, 3);
  await toPolygons(page);
  expect(await polygonCount(page)).toBe(1);
  await page.getByRole('button', { name: 'Clear all polygons' }).click();
  await expect.poll(() => polygonCount(page)).toBe(0);
  await page.getByRole('button', { name: 'Film', exact: true }).click();
  await page.keyboard.press('a');
  await hasCurves(page, 4);

  await page.keyboard.press('Control+z');
  await hasCurves(page, 3);
  expect(await modeOf(page)).toBe('film');
  await page.keyboard.press('Control+z');
  await expect.poll(() => polygonCount(page)).toBe(1);
  expect(await modeOf(page)).toBe('polygon');
  expect(new URL(page.url()).hash).toBe('#polygon');
  await expect(page.getByRole('region', { name: 'Triangulation' })).toBeVisible();
  await page.getByRole('button', { name: 'Undo' }).click();
  await hasCurves(page, 2);
  expect(await modeOf(page)).toBe('film');
  expect((await spanned(page)).curves).toEqual(curves);
  await expect(page.getByRole('button', { name: 'Undo' })).toBeDisabled();

  await page.keyboard.press('Control+y');
  await hasCurves(page, 3);
  await page.keyboard.press('Control+y');
  await expect.poll(() => polygonCount(page)).toBe(0);
  expect(await modeOf(page)).toBe('polygon');
  await page.keyboard.press('Control+y');
  await hasCurves(page, 4);
  expect(await modeOf(page)).toBe('film');
  await expect(page.getByRole('button', { name: 'Redo' })).toBeDisabled();
});

test('the browser’s own steps: back and forward go between modes', async ({ quietPage: page }) => {
  await openPage(page);
  await toPolygons(page);
  await page.goBack();
  await expect.poll(() => modeOf(page)).toBe('film');
  await page.goForward();
  await expect.poll(() => modeOf(page)).toBe('polygon');
});

test('without a network: a mode that is not there yet says so, the page stays, and later tries work', async ({ page, context }) => {
  // The browser says of its own accord that a script could not be fetched, so the console is not quiet.
  const thrown: string[] = [];
  page.on('pageerror', (error) => thrown.push(error.message));
  await openPage(page);
  await context.setOffline(true);
  await page.getByRole('button', { name: 'Polygon', exact: true }).click();
  await expect(page.getByText('Polygon could not be fetched: there is no connection.')).toBeVisible();
  expect(await modeOf(page)).toBe('film');
  expect(new URL(page.url()).hash).toBe('');
  await expect(page.getByRole('button', { name: 'Clear all curves' })).toBeVisible();
  expect((await page.locator('canvas').boundingBox())?.width).toBeGreaterThan(300);
  // Still at work.
  await page.keyboard.press('a');
  await hasCurves(page, 3);
  await page.getByRole('button', { name: 'Polygon', exact: true }).click();
  await page.getByRole('button', { name: 'Try again' }).click();
  await expect(page.getByText('Polygon could not be fetched')).toBeVisible();
  await context.setOffline(false);
  await page.getByRole('button', { name: 'Try again' }).click();
  await page.waitForFunction(() => window.__polygons?.triangulated);
  expect(await modeOf(page)).toBe('polygon');
  expect(thrown).toEqual([]);
});

test('an address whose mode cannot be fetched: the first mode in its place, and words', async ({ page }) => {
  await page.route(/room-.*\.js/, async (route) => {
    const body = await (await route.fetch()).text();
    // The room of polygons, whatever its file is called.
    if (body.includes('A ring drawn inside another is a hole')) await route.abort();
    else await route.fulfill({ body, contentType: 'text/javascript' });
  });
  await page.goto('?aa=0&dpr=1#polygon');
  await page.waitForFunction(() => window.__soapfilm);
  await expect(page.getByText('Polygon could not be opened.')).toBeVisible();
  expect(await modeOf(page)).toBe('film');
  expect(new URL(page.url()).hash).toBe('');
  await page.unroute(/room-.*\.js/);
  await page.getByRole('button', { name: 'Try again' }).click();
  await page.waitForFunction(() => window.__polygons?.triangulated);
  expect(await modeOf(page)).toBe('polygon');
});

test('going to another mode: ends what the pointer has begun, and closes what is open', async ({ quietPage: page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await openPage(page);
  await toPolygons(page);
  await page.getByRole('button', { name: 'Interleaved combs' }).click();
  await page.getByRole('button', { name: 'Film', exact: true }).click();
  await page.keyboard.press('d');
  await page.mouse.move(200, 300);
  await page.mouse.down();
  for (const [x, y] of [[400, 300], [400, 500], [200, 500]]) await page.mouse.move(x, y, { steps: 3 });
  await page.goBack();
  await expect.poll(() => modeOf(page)).toBe('polygon');
  await page.mouse.up();
  // The combs: neither is what was drawn a hole in them, nor a curve.
  expect(await page.evaluate(() => window.__polygons?.document.polygons.map((rings) => rings.length))).toEqual([1]);
  await page.goForward();
  await expect.poll(() => modeOf(page)).toBe('film');
  expect((await stateOf(page)).curves).toHaveLength(2);
  // Undo takes back what the pointer has begun, and nothing else.
  await page.mouse.down();
  await page.mouse.move(400, 300, { steps: 3 });
  await page.keyboard.press('Control+z');
  await page.mouse.up();
  expect(await modeOf(page)).toBe('film');
  expect((await stateOf(page)).canUndo).toBe(true);
  await page.keyboard.press('g');
  await expect(page.getByRole('dialog')).toBeVisible();
  await page.goBack();
  await expect.poll(() => modeOf(page)).toBe('polygon');
  await expect(page.getByRole('dialog')).toBeHidden();
  await page.keyboard.press('d');
  expect((await stateOf(page)).tool).toBe('draw');
});

test('countries at 1 : 50 million: drawn, no task longer than a few of those that reading the file takes', async ({ quietPage: page }) => {
  const require = createRequire(import.meta.url);
  const world = require('world-atlas/countries-50m.json') as Parameters<typeof feature>[0];
  const geojson = JSON.stringify(feature(world, world.objects.countries));
  await page.goto('?aa=0&dpr=1#polygon');
  await page.waitForFunction(() => window.__polygons?.triangulated);
  // The machine's own measure: what the browser needs to read the file as JSON, the median of some.
  const parse = await page.evaluate((text) => {
    const times = Array.from({ length: 5 }, () => {
      const since = performance.now();
      JSON.parse(text);
      return performance.now() - since;
    });
    return times.sort((a, b) => a - b)[2];
  }, geojson);
  await page.evaluate((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], 'countries.geojson'));
    const tasks: number[] = [];
    const watch = () => {
      new PerformanceObserver((list) => {
        for (const { duration } of list.getEntries()) tasks.push(duration);
      }).observe({ type: 'longtask' });
      document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
    };
    Object.assign(window, { tasks });
    setTimeout(watch, 100);
  }, geojson);
  await page.waitForFunction(() => (window.__polygons?.triangulated?.triangles.length ?? 0) > 3 * 80_000);
  const nextPicture = () => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  await nextPicture();
  await expect(page.getByText(/Opened “countries.geojson”: 1,\d+ polygons/)).toBeVisible();
  await page.mouse.move(300, 300);
  await page.mouse.wheel(0, -200);
  await nextPicture();
  const tasks = await page.evaluate(() => (window as unknown as { tasks: number[] }).tasks);
  const longest = Math.max(0, ...tasks);
  console.log(`longest task ${longest.toFixed(0)} ms; reading the file as JSON ${parse.toFixed(0)} ms`);
  // When all triangles were one path of a 2D canvas it was more than a thousand times as long.
  expect(longest).toBeLessThan(25 * parse);
});
