// Drafts: what was drawn is there again after a reload, and no tab overwrites another's.
import '../../web/src/modes/film/inspection.ts';
import '../../web/src/modes/polygon/inspection.ts';
import { expect, hasCurves, openPage, spanned, stateOf, test } from './support.ts';

test.beforeEach(async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
});

test('a reload: the document of all modes is as it was, and the example of a first visit is not kept', async ({ quietPage: page }) => {
  await openPage(page);
  await page.reload();
  await spanned(page);
  expect((await stateOf(page)).canUndo).toBe(false);
  await page.keyboard.press('a');
  await hasCurves(page, 3);
  await page.getByRole('radio', { name: 'Small' }).check();
  const before = await spanned(page);
  await page.getByRole('button', { name: 'Polygon', exact: true }).click();
  await page.waitForFunction(() => window.__polygons?.triangulated);
  await page.getByRole('button', { name: 'Interleaved combs' }).click();
  await expect.poll(() => page.evaluate(() => window.__polygons?.document.name)).toBe('Interleaved combs');
  await page.reload();
  await page.waitForFunction(() => window.__polygons?.triangulated);
  expect(await page.evaluate(() => window.__polygons?.document.name)).toBe('Interleaved combs');
  await page.getByRole('button', { name: 'Film', exact: true }).click();
  const after = await spanned(page);
  expect(after.curves).toEqual(before.curves);
  expect(after.weights).toEqual(before.weights);
});

test('a cleared drawing: stays empty after a reload', async ({ quietPage: page }) => {
  await openPage(page);
  await page.getByRole('button', { name: 'Clear all curves' }).click();
  await hasCurves(page, 0);
  await page.reload();
  await page.waitForFunction(() => window.__soapfilm);
  await expect(page.getByText('Nothing here yet.')).toBeVisible();
  expect((await stateOf(page)).curves).toEqual([]);
});

test('two tabs: each keeps its own drawing, and the second says so', async ({ quietPage: page, context }) => {
  await openPage(page);
  await page.keyboard.press('a');
  await hasCurves(page, 3);
  const first = (await spanned(page)).curves;
  const other = await context.newPage();
  await other.emulateMedia({ reducedMotion: 'reduce' });
  await openPage(other);
  await expect(other.getByText('Your drawing is open in another tab. This tab has one of its own; both are kept.')).toBeVisible();
  await other.getByRole('button', { name: 'Clear all curves' }).click();
  await other.keyboard.press('a');
  await hasCurves(other, 1);
  const second = (await spanned(other)).curves;
  await page.reload();
  expect((await spanned(page)).curves).toEqual(first);
  await other.reload();
  expect((await spanned(other)).curves).toEqual(second);
  // Whoever comes after both are closed goes on where the last left off.
  await page.close();
  await other.close();
  const next = await context.newPage();
  await openPage(next);
  const { curves } = await stateOf(next);
  expect([first, second]).toContainEqual(curves);
});

test('storage that is refused: the page works, and says once that nothing is kept', async ({ page }) => {
  await page.addInitScript(() => {
    Object.defineProperty(window, 'indexedDB', { get: () => undefined });
  });
  await openPage(page);
  await page.keyboard.press('a');
  await hasCurves(page, 3);
  await expect(page.getByText('This browser keeps no draft')).toBeVisible();
});
