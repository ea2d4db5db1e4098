import '../../web/src/modes/film/inspection.ts';
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

test('a narrow screen: nothing that floats covers another, and the modes stay where they are', async ({ quietPage: page }) => {
  await openPage(page);
  const boxes = (selector: string) =>
    page.locator(selector).evaluateAll((found) =>
      found
        .map((element) => element.getBoundingClientRect())
        .filter(({ width }) => width > 0)
        .map(({ left, top, right, bottom }) => ({ left, top, right, bottom })),
    );
  const expectApart = async () => {
    // Remarks pass by themselves, at any time.
    const floating = await boxes('.floating:not(.toast)');
    for (const [i, a] of floating.entries()) {
      for (const b of floating.slice(i + 1)) {
        const isApart = a.right + 4 <= b.left || b.right + 4 <= a.left || a.bottom + 4 <= b.top || b.bottom + 4 <= a.top;
        expect(isApart, JSON.stringify([a, b])).toBe(true);
      }
    }
    return floating.length;
  };
  const modes = await boxes('.modes');
  await page.getByRole('button', { name: 'Draw', exact: true }).tap();
  expect(await expectApart()).toBe(3);
  await page.getByRole('button', { name: 'Select', exact: true }).tap();
  const ring = (z: number) =>
    Array.from({ length: 46 }, (_, i) => {
      const t = (2 * Math.PI * i) / 46;
      return [Math.cos(t) + 0.2 * Math.cos(7 * t + z), Math.sin(t), z + 0.3 * Math.sin(3 * t + z)];
    });
  await page.locator('.panel-handle').tap();
  await page.getByRole('radio', { name: 'All', exact: true }).check();
  await page.getByLabel('File of loops').setInputFiles({
    name: 'heavy.json',
    mimeType: 'text/plain',
    buffer: Buffer.from(JSON.stringify([ring(0), ring(1.5), ring(3)])),
  });
  await expect(page.locator('.busy')).toBeVisible();
  expect(await expectApart()).toBe(3);
  await page.locator('.busy').getByRole('button').tap();
  await page.locator('.panel-handle').tap();
  await page.getByRole('button', { name: 'Polygon', exact: true }).tap();
  await page.waitForFunction(() => window.__polygons?.triangulated);
  expect(await boxes('.modes')).toEqual(modes);
  await page.getByRole('button', { name: 'Flood step by step' }).tap();
  await expect(page.locator('.flood-step')).toBeVisible();
  expect(await expectApart()).toBe(3);
});

test('polygons on a phone: all in view with the panel open, and as before once it is closed', async ({ quietPage: page }) => {
  await page.goto('?aa=0&dpr=1#polygon');
  await page.waitForFunction(() => window.__polygons?.triangulated);
  const places = () =>
    page.evaluate(() => window.__polygons?.document.polygons.flat(2).map((point) => window.__polygons?.whereIs(point)) ?? []);
  const handle = page.getByRole('button', { name: /triangles/ });
  const before = await places();
  await handle.tap();
  await expect.poll(places).not.toEqual(before);
  const box = await page.getByRole('application', { name: /^Polygons/ }).boundingBox();
  if (box === null) throw new Error('The canvas is not in the page.');
  const bottom = box.y + box.height;
  await expect.poll(async () => Math.max(...(await places()).map((place) => place?.y ?? Infinity))).toBeLessThan(bottom);
  await handle.tap();
  await expect.poll(async () => Math.abs(((await places())[0]?.y ?? 0) - (before[0]?.y ?? 0))).toBeLessThan(0.01);
});

test('two fingers over polygons: enlarge by as much as they have moved apart', async ({ quietPage: page }) => {
  await page.goto('?aa=0&dpr=1#polygon');
  await page.waitForFunction(() => window.__polygons?.triangulated);
  const client = await page.context().newCDPSession(page);
  const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', apart: number) =>
    client.send('Input.dispatchTouchEvent', {
      type,
      touchPoints: type === 'touchEnd' ? [] : [{ x: 195 - apart / 2, y: 400, id: 0 }, { x: 195 + apart / 2, y: 400, id: 1 }],
    });
  const unit = () =>
    page.evaluate(() => {
      const [a, b] = [window.__polygons?.whereIs([0, 0]), window.__polygons?.whereIs([1, 0])];
      return (b?.x ?? 0) - (a?.x ?? 0);
    });
  const before = await unit();
  await touch('touchStart', 100);
  for (let apart = 110; apart <= 200; apart += 10) await touch('touchMove', apart);
  await touch('touchEnd', 0);
  await expect.poll(async () => (await unit()) / before).toBeGreaterThan(1.7);
  expect((await unit()) / before).toBeLessThan(2.3);
});
