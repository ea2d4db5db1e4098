import { canvasBox, drawCircle, expect, hasCurves, lookFrom, openEmpty, openPage, spanned, stateOf, test, whereIs } from './support.ts';

test.beforeEach(async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
});

test('a dragged vertex: follows the pointer, is spanned again, and is one step to undo', async ({ quietPage: page }) => {
  await openPage(page);
  const before = await spanned(page);
  const from = await whereIs(page, 0, 20);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  for (let i = 1; i <= 6; i++) await page.mouse.move(from.x + 6 * i, from.y - 8 * i);
  await page.mouse.up();
  const after = await spanned(page);
  const to = await whereIs(page, 0, 20);
  expect(to.x - from.x).toBeCloseTo(36, 0);
  expect(to.y - from.y).toBeCloseTo(-48, 0);
  expect(after.selection).toEqual({ curve: 0, vertex: 20 });
  expect(after.span.cost).not.toBe(before.span.cost);
  await page.keyboard.press('Control+z');
  const undone = await spanned(page);
  expect(undone.curves).toEqual(before.curves);
  expect(undone.span.cost).toBe(before.span.cost);
  expect(undone.canUndo).toBe(false);
});

test('a vertex dragged in the drawing plane: keeps its height', async ({ quietPage: page }) => {
  await openPage(page);
  const height = (await stateOf(page)).curves[0][20][2];
  const from = await whereIs(page, 0, 20);
  await page.mouse.click(from.x, from.y);
  await page.getByRole('radio', { name: 'Drawing plane' }).check();
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 30, from.y + 10, { steps: 3 });
  await page.mouse.up();
  const { curves } = await spanned(page);
  expect(curves[0][20][2]).toBeCloseTo(height, 9);
  expect((await whereIs(page, 0, 20)).x - from.x).toBeCloseTo(30, 0);
});

test('escape during a drag: the vertex goes back', async ({ quietPage: page }) => {
  await openPage(page);
  const { curves } = await stateOf(page);
  const from = await whereIs(page, 1, 20);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 40, from.y, { steps: 3 });
  expect((await stateOf(page)).curves).not.toEqual(curves);
  await page.keyboard.press('Escape');
  await page.mouse.up();
  const state = await spanned(page);
  expect(state.curves).toEqual(curves);
  expect([state.canUndo, state.canRedo]).toEqual([false, false]);
});

test('delete, clear, undo, redo: by key and by button', async ({ quietPage: page }) => {
  await openPage(page);
  const { curves } = await stateOf(page);
  await page.getByRole('button', { name: 'Curve 2 32 vertices' }).click();
  await page.keyboard.press('Delete');
  expect((await spanned(page)).curves).toEqual([curves[0]]);
  await page.getByRole('button', { name: 'Clear all curves' }).click();
  await hasCurves(page, 0);
  await expect(page.getByText('Nothing here yet.')).toBeVisible();
  const cleared = await stateOf(page);
  expect([cleared.phase, cleared.span]).toEqual(['idle', null]);
  await page.getByRole('button', { name: 'Undo' }).click();
  await page.keyboard.press('Control+z');
  expect((await spanned(page)).curves).toEqual(curves);
  await expect(page.getByRole('button', { name: 'Undo' })).toBeDisabled();
  await page.keyboard.press('Control+Shift+z');
  await page.keyboard.press('Control+y');
  await hasCurves(page, 0);
  await expect(page.getByRole('button', { name: 'Redo' })).toBeDisabled();
});

test('settings: part of the history, a slider’s travel one step', async ({ quietPage: page }) => {
  await openPage(page);
  const slider = page.getByRole('slider', { name: 'Bending' });
  const box = await slider.boundingBox();
  if (!box) throw new Error('The slider is not in the page.');
  await page.mouse.move(box.x + box.width * 0.5, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.9, box.y + box.height / 2, { steps: 5 });
  await page.mouse.up();
  const dragged = await spanned(page);
  expect(dragged.weights.dihedral).toBeGreaterThan(20);
  await page.keyboard.press('Control+z');
  expect((await spanned(page)).weights.dihedral).toBe(1);
  expect((await stateOf(page)).canUndo).toBe(false);
});

test('all weights zero: refused, since nothing would be minimised', async ({ quietPage: page }) => {
  await openPage(page);
  await page.getByRole('radio', { name: 'Small' }).check();
  const field = page.getByRole('textbox', { name: 'Area' });
  await field.fill('0');
  await field.press('Enter');
  expect((await spanned(page)).weights.area).toBe(1);
});

test('auto off: nothing is spanned until asked for', async ({ quietPage: page }) => {
  await openPage(page);
  await page.getByRole('switch', { name: 'Auto' }).uncheck();
  await page.getByRole('radio', { name: 'Small' }).check();
  await page.waitForTimeout(400);
  expect((await stateOf(page)).isStale).toBe(true);
  await page.getByRole('button', { name: 'Span the curves' }).click();
  const { span, weights } = await spanned(page);
  expect(weights.area).toBe(1);
  expect(span.terms.area).toBeGreaterThan(0);
});

test('keyboard alone: curves are added, chosen, shaped and spanned', async ({ quietPage: page }) => {
  await openPage(page);
  await page.getByRole('button', { name: 'Clear all curves' }).press('Enter');
  await lookFrom(page, 'plus z');
  await page.keyboard.press('a');
  await page.keyboard.press('d');
  await page.getByRole('textbox', { name: 'Offset' }).fill('0.7');
  await page.getByRole('textbox', { name: 'Offset' }).press('Enter');
  await page.locator('canvas').focus();
  await page.keyboard.press('a');
  await hasCurves(page, 2);
  await spanned(page);
  await page.keyboard.press('v');
  await page.keyboard.press('[');
  await page.keyboard.press('.');
  const { curves, selection } = await stateOf(page);
  expect(selection).toEqual({ curve: 0, vertex: 0 });
  await page.keyboard.press('Shift+ArrowRight');
  const moved = await spanned(page);
  expect(moved.curves[0][0][0]).toBeGreaterThan(curves[0][0][0]);
  expect(moved.curves[0][0][1]).toBeCloseTo(curves[0][0][1], 3);
  await page.keyboard.press('Escape');
  await page.keyboard.press('?');
  await expect(page.getByRole('dialog', { name: 'Keys and gestures' })).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(page.getByRole('dialog')).toBeHidden();
});

test('a chosen curve: is dragged as a whole, lifted in a view from the side, and goes back in one step', async ({ quietPage: page }) => {
  await openPage(page);
  const { curves } = await stateOf(page);
  await lookFrom(page, 'minus y');
  await page.getByRole('button', { name: 'Curve 1 32 vertices' }).click();
  // A vertex of it: what is chosen as a whole is dragged as a whole.
  const from = await whereIs(page, 0, 20);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x, from.y - 60, { steps: 4 });
  await page.mouse.up();
  const lifted = await spanned(page);
  expect(lifted.curves[1]).toEqual(curves[1]);
  const rises = lifted.curves[0].map((point, i) => point.map((x, axis) => x - curves[0][i][axis]));
  for (const [dx, dy, dz] of rises) {
    expect(dz).toBeGreaterThan(0.05);
    expect(dz).toBeCloseTo(rises[0][2], 9);
    expect(Math.hypot(dx, dy)).toBeLessThan(1e-9);
  }
  expect(lifted.selection).toEqual({ curve: 0, vertex: null });
  await page.locator('canvas').focus();
  await page.keyboard.press('ArrowDown');
  expect((await stateOf(page)).curves[0][0][2]).toBeLessThan(lifted.curves[0][0][2]);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  const undone = await spanned(page);
  expect(undone.curves).toEqual(curves);
  expect(undone.canUndo).toBe(false);
});

test('Delete: takes the chosen vertex, not its curve; of a triangle the whole', async ({ quietPage: page }) => {
  await openPage(page);
  const { curves } = await stateOf(page);
  const at = await whereIs(page, 0, 20);
  await page.mouse.click(at.x, at.y);
  await expect(page.getByRole('button', { name: 'Delete the chosen vertex' })).toBeEnabled();
  await page.keyboard.press('Delete');
  const state = await spanned(page);
  expect(state.curves).toEqual([curves[0].filter((_, i) => i !== 20), curves[1]]);
  await page.getByLabel('File of loops').setInputFiles({
    name: 'triangle.json',
    mimeType: 'text/plain',
    buffer: Buffer.from('[[[0,0,0],[1,0,0],[0,1,0.2]]]'),
  });
  await hasCurves(page, 1);
  await page.keyboard.press(']');
  await page.keyboard.press('.');
  await page.keyboard.press('Delete');
  await hasCurves(page, 0);
});

test('several vertices: chosen with Shift, by click and by box, moved and deleted together', async ({ quietPage: page }) => {
  await openPage(page);
  await lookFrom(page, 'plus z');
  const { curves } = await stateOf(page);
  const spots = await Promise.all([0, 8, 16].map((vertex) => whereIs(page, 0, vertex)));
  await page.mouse.click(spots[0].x, spots[0].y);
  await page.keyboard.down('Shift');
  await page.mouse.click(spots[1].x, spots[1].y);
  expect((await stateOf(page)).places).toBe(2);
  // From the middle, where nothing is, around the vertex at the left.
  const box = await canvasBox(page);
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2 - 20);
  await page.mouse.down();
  await page.mouse.move(spots[2].x - 30, spots[2].y + 20, { steps: 4 });
  await expect(page.locator('.selection-box')).toBeVisible();
  await page.mouse.up();
  await page.keyboard.up('Shift');
  await expect(page.locator('.selection-box')).toBeHidden();
  const { places } = await stateOf(page);
  expect(places).toBeGreaterThanOrEqual(3);
  await page.locator('canvas').focus();
  await page.keyboard.press('ArrowRight');
  const moved = (await stateOf(page)).curves.flat().filter((point, i) => point[0] !== curves.flat()[i][0]).length;
  expect(moved).toBe(places);
  await page.keyboard.press('Delete');
  expect((await stateOf(page)).curves.flat()).toHaveLength(curves.flat().length - places);
});

test('a complaint: goes with the next stroke, with a change, with what it was about', async ({ quietPage: page }) => {
  await openEmpty(page);
  await page.keyboard.press('d');
  const complaint = page.getByText('That stroke was too short');
  await drawCircle(page, { x: 0.5, y: 0.5, radius: 3 });
  await expect(complaint).toBeVisible();
  await drawCircle(page, { x: 0.5, y: 0.5, radius: 90 });
  await hasCurves(page, 1);
  await expect(complaint).toBeHidden();
  await drawCircle(page, { x: 0.5, y: 0.5, radius: 3 });
  await expect(complaint).toBeVisible();
  await page.keyboard.press('Control+z');
  await expect(complaint).toBeHidden();
  await page.keyboard.press('2');
  await drawCircle(page, { x: 0.5, y: 0.5, radius: 90 });
  await expect(page.getByText('seen edge-on')).toBeVisible();
  await page.keyboard.press('1');
  await expect(page.getByText('seen edge-on')).toBeHidden();
});

test('undo and redo by the keys of a Mac; a drag back to where it began costs no step', async ({ quietPage: page }) => {
  await openPage(page);
  await page.keyboard.press('a');
  await hasCurves(page, 3);
  await page.keyboard.press('Meta+z');
  await hasCurves(page, 2);
  await page.keyboard.press('Meta+Shift+z');
  await hasCurves(page, 3);
  const from = await whereIs(page, 0, 20);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 30, from.y, { steps: 3 });
  await page.mouse.move(from.x, from.y, { steps: 3 });
  await page.mouse.move(from.x, from.y + 30, { steps: 3 });
  await page.mouse.up();
  await hasCurves(page, 3);
  await page.keyboard.press('Control+z');
  await hasCurves(page, 3);
  await page.keyboard.press('Control+z');
  await hasCurves(page, 2);
});

test('a key held down: one step of the history', async ({ quietPage: page }) => {
  await openPage(page);
  const { curves } = await stateOf(page);
  await page.keyboard.press(']');
  await page.keyboard.press('.');
  await page.locator('canvas').focus();
  // A key that goes down again without having come up repeats.
  for (let i = 0; i < 30; i++) await page.keyboard.down('ArrowRight');
  await page.keyboard.up('ArrowRight');
  await page.keyboard.press('ArrowRight');
  expect((await stateOf(page)).curves).not.toEqual(curves);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  const state = await stateOf(page);
  expect(state.curves).toEqual(curves);
  expect(state.canUndo).toBe(false);
});
