import { expect, expectSpans, hasCurves, lookFrom, openPage, spanned, stateOf, test } from './support.ts';

test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

test('touch on a phone: one finger draws, two turn the view, the sheet opens', async ({ quietPage: page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await openPage(page);
  await page.getByRole('button', { name: 'Clear all curves' }).tap();
  await lookFrom(page, 'plus z');
  await page.getByRole('button', { name: 'Draw', exact: true }).tap();
  const client = await page.context().newCDPSession(page);
  const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', touchPoints: { x: number; y: number; id: number }[]) =>
    client.send('Input.dispatchTouchEvent', { type, touchPoints });
  const ring = (i: number) => ({ x: 220 + 90 * Math.cos(i / 3), y: 400 + 90 * Math.sin(i / 3), id: 0 });
  await touch('touchStart', [ring(0)]);
  for (let i = 1; i < 19; i++) await touch('touchMove', [ring(i)]);
  await touch('touchEnd', []);
  await hasCurves(page, 1);
  expectSpans((await spanned(page)).span, 1);

  // A second finger takes the stroke back and turns the view instead.
  const viewOf = () => page.evaluate(() => window.__soapfilm?.whereIs(0, 0));
  const before = await viewOf();
  await touch('touchStart', [{ x: 150, y: 350, id: 0 }]);
  await touch('touchMove', [{ x: 152, y: 352, id: 0 }]);
  await touch('touchStart', [{ x: 152, y: 352, id: 0 }, { x: 260, y: 420, id: 1 }]);
  for (let i = 1; i < 8; i++) {
    await touch('touchMove', [{ x: 152 + 6 * i, y: 352 + 4 * i, id: 0 }, { x: 260 + 6 * i, y: 420 + 9 * i, id: 1 }]);
  }
  await touch('touchEnd', []);
  await expect.poll(viewOf).not.toEqual(before);
  expect((await stateOf(page)).curves).toHaveLength(1);

  // The browser takes no tap that follows two fingers at once.
  await page.waitForTimeout(500);
  const handle = page.getByRole('button', { name: /^Cost/ });
  await expect(handle).toHaveAttribute('aria-expanded', 'false');
  await handle.tap();
  await expect(page.getByRole('radio', { name: 'Small' })).toBeVisible();
  await page.getByRole('radio', { name: 'Small' }).tap();
  expect((await spanned(page)).weights.dihedral).toBe(0);
});

test('a narrow screen: nothing is wider than it', async ({ quietPage: page }) => {
  await openPage(page);
  const widest = await page.evaluate(() => Math.max(...[...document.querySelectorAll('body *')].map((e) => e.getBoundingClientRect().right)));
  expect(widest).toBeLessThanOrEqual(391);
  for (const button of await page.locator('.top-bar button, .tool-bar button').all()) {
    const box = await button.boundingBox();
    expect(Math.min(box?.width ?? 0, box?.height ?? 0)).toBeGreaterThanOrEqual(40);
  }
});
