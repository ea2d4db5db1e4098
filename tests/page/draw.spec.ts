import { changedShare, drawCircle, expect, expectSpans, hasCurves, openEmpty, openPage, spanned, stateOf, test } from './support.ts';

test('first visit: an example is spanned and grows in triangle by triangle', async ({ quietPage: page }) => {
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  // The page's time goes by in steps of this test, however long it waits for the surface.
  await page.clock.install({ time: 0 });
  await page.clock.pauseAt(1000);
  await page.goto('?aa=0&dpr=1');
  const grows = async (): Promise<boolean> => {
    await page.clock.runFor(50);
    const isThere = await page.evaluate(() => window.__soapfilm !== undefined);
    return isThere && (await stateOf(page)).isGrowing;
  };
  await expect.poll(grows, { intervals: [30] }).toBe(true);
  expectSpans((await spanned(page)).span, 2);
  expect((await stateOf(page)).isGrowing).toBe(true);
  await page.clock.runFor(2000);
  expect((await stateOf(page)).isGrowing).toBe(false);
  expect((await stateOf(page)).canUndo).toBe(false);
});

test('reduced motion: the surface is there at once, and a replay can be skipped', async ({ quietPage: page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.clock.install({ time: 0 });
  await openPage(page);
  expect((await stateOf(page)).isGrowing).toBe(false);
  await page.clock.pauseAt(3_600_000);
  await page.getByRole('button', { name: 'Let the surface appear again' }).click();
  await page.clock.runFor(50);
  expect((await stateOf(page)).isGrowing).toBe(true);
  await page.getByRole('button', { name: 'Show the whole surface now' }).click();
  await page.clock.runFor(50);
  expect((await stateOf(page)).isGrowing).toBe(false);
});

test('two drawn curves: spanned for least area among all triangles, then for least bending in Delaunay space', async ({
  quietPage: page,
}) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await openEmpty(page);
  await page.getByRole('button', { name: 'Draw', exact: true }).click();
  await page.getByRole('textbox', { name: 'Vertices' }).fill('14');
  await page.getByRole('textbox', { name: 'Vertices' }).press('Enter');
  await drawCircle(page, { x: 0.5, y: 0.5, radius: 190 });
  await hasCurves(page, 1);
  await page.getByRole('textbox', { name: 'Offset' }).fill('0.8');
  await page.getByRole('textbox', { name: 'Offset' }).press('Enter');
  await drawCircle(page, { x: 0.5, y: 0.5, radius: 120 });
  await hasCurves(page, 2);
  const { curves } = await stateOf(page);
  expect(curves.map((curve) => curve.length)).toEqual([14, 14]);
  for (const [, , z] of curves[0]) expect(z).toBeCloseTo(0, 9);
  for (const [, , z] of curves[1]) expect(z).toBeCloseTo(0.8, 9);

  await page.getByRole('radio', { name: 'Small' }).check();
  await page.getByRole('radio', { name: 'All', exact: true }).check();
  const small = await spanned(page);
  expectSpans(small.span, 2);
  expect(small.span.candidates).toBe('all');
  expect(small.weights).toEqual({ area: 1, perimeter: 0, dihedral: 0 });

  await page.getByRole('radio', { name: 'Smooth' }).check();
  await page.getByRole('radio', { name: 'Delaunay' }).check();
  const smooth = await spanned(page);
  expectSpans(smooth.span, 2);
  expect(smooth.span.candidates).toBe('delaunay');
  expect(smooth.span.terms.dihedral).toBeLessThanOrEqual(small.span.terms.dihedral + 1e-9);
  expect(smooth.span.terms.area).toBeGreaterThanOrEqual(small.span.terms.area - 1e-9);

  // Seen from above, the film between the rings covers a good part of the picture.
  const share = await changedShare(page, async () => {
    await page.getByRole('switch', { name: 'Surface' }).uncheck();
  });
  expect(share).toBeGreaterThan(0.08);
  await expect(page.getByRole('region', { name: 'Result' })).toContainText('optimal');
});

test('a short stroke: refused in words, nothing changes', async ({ quietPage: page }) => {
  await openEmpty(page);
  await page.keyboard.press('d');
  await drawCircle(page, { x: 0.5, y: 0.5, radius: 3 });
  await expect(page.getByText('That stroke was too short')).toBeVisible();
  expect((await stateOf(page)).curves).toEqual([]);
});

test('a plane seen edge-on: said, not drawn in', async ({ quietPage: page }) => {
  await openEmpty(page);
  await page.keyboard.press('d');
  await page.keyboard.press('2');
  await drawCircle(page, { x: 0.5, y: 0.5, radius: 90 });
  await expect(page.getByText('seen edge-on')).toBeVisible();
  expect((await stateOf(page)).curves).toEqual([]);
});

test('the view plane: a stroke lies in the plane of the screen, at its offset', async ({ quietPage: page }) => {
  await openEmpty(page);
  await page.keyboard.press('d');
  await page.keyboard.press('4');
  await drawCircle(page, { x: 0.5, y: 0.5, radius: 90 });
  await hasCurves(page, 1);
  const [curve] = (await stateOf(page)).curves;
  const heights = curve.map(([, , z]) => z);
  expect(Math.max(...heights) - Math.min(...heights)).toBeLessThan(1e-3);
});

test('the circle tool three times: three circles apart, spanned', async ({ quietPage: page }) => {
  await openEmpty(page);
  for (let count = 1; count <= 3; count++) {
    await page.keyboard.press('a');
    await hasCurves(page, count);
    expectSpans((await spanned(page)).span, count);
  }
});

test('escape while drawing: the stroke is dropped', async ({ quietPage: page }) => {
  await openEmpty(page);
  await page.keyboard.press('d');
  await page.mouse.move(400, 300);
  await page.mouse.down();
  await page.mouse.move(500, 300);
  await page.mouse.move(500, 400);
  await page.keyboard.press('Escape');
  await page.mouse.move(400, 400);
  await page.mouse.up();
  expect((await stateOf(page)).curves).toEqual([]);
});
