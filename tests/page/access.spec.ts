import AxeBuilder from '@axe-core/playwright';
import { expect, openPage, spanned, stateOf, test } from './support.ts';

for (const colorScheme of ['light', 'dark'] as const) {
  test(`axe, ${colorScheme}: nothing serious on the page, in the dialogs, in an error`, async ({ quietPage: page }) => {
    await page.emulateMedia({ reducedMotion: 'reduce', colorScheme });
    await openPage(page);
    const check = async (where: string) => {
      const { violations } = await new AxeBuilder({ page }).analyze();
      const serious = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
      expect(serious.map(({ id, nodes }) => [id, nodes.map((node) => node.html)]), where).toEqual([]);
    };
    await check('the page');
    await page.keyboard.press('d');
    await page.getByRole('button', { name: 'Export' }).click();
    await check('the draw tool and the export menu');
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: 'Gallery' }).click();
    await expect(page.getByRole('dialog')).toContainText('Monkey saddle');
    await check('the gallery');
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: 'Keys and gestures' }).click();
    await expect(page.getByRole('dialog')).toContainText('Face the drawing plane');
    await check('the help sheet');
    await page.keyboard.press('Escape');
    await page.getByLabel('File of loops').setInputFiles({
      name: 'twice.json',
      mimeType: 'text/plain',
      buffer: Buffer.from('[[[0,0,0],[1,0,0],[1,1,0],[1,0,0]]]'),
    });
    await expect.poll(async () => (await stateOf(page)).phase).toBe('failed');
    await check('an error');
  });
}

test('the gallery: every example is spanned to the optimum', async ({ quietPage: page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await openPage(page);
  const choices: readonly [card: string, variant: string | null, curves: number][] = [
    ['Monkey saddle', null, 1],
    ['Tennis-ball seam', null, 1],
    ['Saddles on an octahedron', '2 curves', 2],
    ['Saddles on an octahedron', '5 curves', 5],
    ['Nested rings with an island', null, 3],
    ['Bumper', null, 2],
    ['Two facing saddles', null, 2],
  ];
  for (const [card, variant, curves] of choices) {
    await page.keyboard.press('g');
    const item = page.getByRole('listitem').filter({ hasText: card });
    if (variant) await item.getByRole('button', { name: variant }).click();
    else await item.getByRole('button').first().click();
    await expect(page.getByRole('dialog')).toBeHidden();
    const state = await spanned(page);
    expect(state.curves).toHaveLength(curves);
    await expect(page.getByRole('region', { name: 'Result' })).toContainText('optimal');
  }
});

test('focus: tab reaches bar, scene, tools and panel in reading order', async ({ quietPage: page }) => {
  await openPage(page);
  const seen: string[] = [];
  for (let i = 0; i < 22; i++) {
    await page.keyboard.press('Tab');
    seen.push(
      await page.evaluate(() => {
        const element = document.activeElement;
        return element?.getAttribute('aria-label') ?? element?.textContent ?? '';
      }),
    );
  }
  const places = ['Gallery', 'Keys and gestures', 'Scene', 'Select', 'Look from plus x', 'All in view'].map((label) =>
    seen.findIndex((text) => text.startsWith(label)),
  );
  expect(places.every((place) => place >= 0), seen.join(' | ')).toBe(true);
  expect(places).toEqual([...places].sort((a, b) => a - b));
});

test('a tool in hand: looks so under the pointer as well', async ({ quietPage: page }) => {
  await openPage(page);
  const draw = page.getByRole('button', { name: 'Draw', exact: true });
  const background = () => draw.evaluate((button) => getComputedStyle(button).backgroundColor);
  await page.keyboard.press('d');
  await expect(draw).toHaveAttribute('aria-pressed', 'true');
  const inHand = await background();
  await draw.hover();
  expect(await background()).toBe(inHand);
});
