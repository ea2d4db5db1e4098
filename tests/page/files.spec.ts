import { readFile } from 'node:fs/promises';
import { parseLoops } from 'soapfilm';
import type { Page } from '@playwright/test';
import { changedShare, expect, expectSpans, hasCurves, openPage, spanned, stateOf, test } from './support.ts';

const kTwoSquares = `2 8
4
0 0 0
2 0 0
2 2 0
0 2 0
4
0 0 1
2 0 1
2 2 1
0 2 1
`;

test.beforeEach(async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
});

const openWith = (page: Page, name: string, text: string) =>
  page.getByLabel('File of loops').setInputFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });

const drop = (page: Page, name: string, text: string): Promise<void> => dropAll(page, [[name, text]]);

async function dropAll(page: Page, files: readonly (readonly [name: string, text: string])[]): Promise<void> {
  const transfer = await page.evaluateHandle((all) => {
    const data = new DataTransfer();
    for (const [name, text] of all) data.items.add(new File([text], name));
    return data;
  }, files);
  for (const type of ['dragenter', 'dragover', 'drop']) {
    await page.dispatchEvent('body', type, { dataTransfer: transfer });
  }
}

/** Takes an entry of the export menu and returns the file. */
async function exported(page: Page, entry: string): Promise<{ file: string; bytes: Buffer }> {
  await page.getByRole('button', { name: 'Export' }).click();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: entry }).click();
  const done = await download;
  return { file: done.suggestedFilename(), bytes: await readFile(await done.path()) };
}

test('open by button: a .curve file is spanned', async ({ quietPage: page }) => {
  await openPage(page);
  await page.keyboard.press(']');
  expect((await stateOf(page)).selection).not.toBeNull();
  const chooser = page.waitForEvent('filechooser');
  await page.getByRole('button', { name: 'Open a file' }).click();
  await (await chooser).setFiles({ name: 'box.curve', mimeType: 'text/plain', buffer: Buffer.from(kTwoSquares) });
  // What was there before had two curves as well.
  await expect(page.getByText('Opened “box.curve”: 2 curves.')).toBeVisible();
  await hasCurves(page, 2);
  const { span, curves } = await spanned(page);
  expect(curves[1][2]).toEqual([2, 2, 1]);
  expect((await stateOf(page)).selection).toBeNull();
  expectSpans(span, 2);
});

test('open by dropping: JSON and OBJ lines', async ({ quietPage: page }) => {
  await openPage(page);
  await drop(page, 'a.json', '{ "name": "Kite", "loops": [[[0,0,0],[1,0,0.2],[1,1,0],[0,1,0.2]]] }');
  await hasCurves(page, 1);
  expectSpans((await spanned(page)).span, 1);
  await expect(page.getByText('Kite', { exact: true })).toBeVisible();
  await drop(page, 'b.obj', 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 1.5 1\nl 1 2 3 4 5 1\n');
  await expect.poll(async () => (await stateOf(page)).curves.map((curve) => curve.length)).toEqual([5]);
  expectSpans((await spanned(page)).span, 1);
});

test('curves of any size and place: drawn alike, and a good file afterwards as before', async ({ quietPage: page }) => {
  await openPage(page);
  const tent = (size: number, away: number) => {
    const points = [[0, 0, 0.3], [1, 0, 0], [1, 1, 0.3], [0, 1, 0]];
    return JSON.stringify([points.map((point) => point.map((x) => size * (x + away)))]);
  };
  const surfaceShare = () =>
    changedShare(page, async () => {
      await page.getByRole('switch', { name: 'Surface' }).click();
    });
  await openWith(page, 'tent.json', tent(1, 0));
  await spanned(page);
  const share = await surfaceShare();
  expect(share).toBeGreaterThan(0.05);
  await surfaceShare();
  for (const [size, away] of [[1e-30, 0], [1e-6, 0], [1e30, 0], [1e100, 0], [1, 1e7], [1, 0]]) {
    await openWith(page, 'tent.json', tent(size, away));
    await expect.poll(async () => (await stateOf(page)).curves[0][1][0]).toBe(size * (1 + away));
    const { span } = await spanned(page);
    expectSpans(span, 1);
    await page.getByRole('button', { name: 'Dismiss' }).click();
    expect(Math.abs((await surfaceShare()) / share - 1), `size ${size}, away ${away}`).toBeLessThan(0.02);
    await surfaceShare();
  }
});

test('coordinates too large to reckon with: an error in words, and a good file afterwards is drawn', async ({
  quietPage: page,
}) => {
  await openPage(page);
  for (const far of ['1e300', '1.7e308']) {
    await openWith(page, 'far.json', `[[[0,0,${far}],[${far},0,0],[0,-${far},0]]]`);
    await expect.poll(async () => (await stateOf(page)).message).toContain('1e150');
    await openWith(page, 'box.curve', kTwoSquares);
    await spanned(page);
    const share = await changedShare(page, async () => {
      await page.getByRole('switch', { name: 'Surface' }).click();
    });
    expect(share).toBeGreaterThan(0.05);
    await page.getByRole('switch', { name: 'Surface' }).click();
  }
});

test('export: the OBJ holds the surface shown, the curves come back bit for bit', async ({ quietPage: page }) => {
  await openPage(page);
  const { span, curves } = await spanned(page);

  const obj = await exported(page, 'OBJ');
  expect(obj.file).toBe('two-facing-saddles.obj');
  const lines = obj.bytes.toString().split('\n');
  const numbers = (tag: string) =>
    lines.filter((line) => line.startsWith(`${tag} `)).flatMap((line) => line.split(/\s+/).slice(1).map(Number));
  expect(numbers('v')).toEqual(span.positions);
  expect(numbers('f').map((index) => index - 1)).toEqual(span.triangles);

  for (const [entry, extension] of [['.curve', 'curve'], ['JSON', 'json']] as const) {
    const saved = await exported(page, entry);
    expect(saved.file).toBe(`two-facing-saddles.${extension}`);
    const loops = parseLoops(saved.bytes.toString());
    expect([...loops.positions]).toEqual(curves.flat(2));
    await openWith(page, saved.file, saved.bytes.toString());
    expect((await spanned(page)).curves).toEqual(curves);
  }
});

test('export: the picture is a PNG of the scene', async ({ quietPage: page }) => {
  await openPage(page);
  const { file, bytes } = await exported(page, 'PNG');
  expect(file).toBe('two-facing-saddles.png');
  expect(bytes.subarray(1, 4).toString()).toBe('PNG');
  const canvas = await page.locator('canvas').evaluate((element) => {
    const { width, height } = element as HTMLCanvasElement;
    return [width, height];
  });
  expect([bytes.readUInt32BE(16), bytes.readUInt32BE(20)]).toEqual(canvas);
});

test('a file that is none: the error names the line, the document stays', async ({ quietPage: page }) => {
  await openPage(page);
  const { curves } = await stateOf(page);
  await openWith(page, 'bad.curve', kTwoSquares.replace('2 2 0', '2 two 0'));
  await expect(page.getByText(/Could not open “bad\.curve”.*line 5/i)).toBeVisible();
  expect((await stateOf(page)).curves).toEqual(curves);
  await page.getByRole('button', { name: 'Dismiss' }).click();
  await openWith(page, 'picture.png', '\u0089PNG\r\n\u001a\n\0\0\0');
  await expect(page.getByText('Could not open “picture.png”')).toBeVisible();
});

test('curves that cross: an error in words, the place marked', async ({ quietPage: page }) => {
  await openPage(page);
  const square = (dx: number) => [[dx, 0, 0], [dx + 2, 0, 0], [dx + 2, 2, 0], [dx, 2, 0]];
  const shifted = square(1).map(([x, y, z]) => [x, y + 1, z]);
  await openWith(page, 'crossing.json', JSON.stringify([square(0), shifted]));
  await expect.poll(async () => (await stateOf(page)).phase).toBe('failed');
  const state = await stateOf(page);
  expect(state.faults).toBe(2);
  expect(state.message).toContain('Curves 1 and 2 cross');
  expect(state.span).toBeNull();
  await expect(page.getByRole('region', { name: 'Result' })).toContainText(state.message);
  await expect(page.getByText('The place is marked in red.')).toBeVisible();
  await page.keyboard.press('Control+z');
  await spanned(page);
});

test('no surface in the space: explained, and a wider space is a press away', async ({ quietPage: page }) => {
  await openPage(page);
  // A tight star: its spikes reach past each other, so that Delaunay facets alone cannot fill it.
  const star = Array.from({ length: 24 }, (_, i) => {
    const t = (11 * 2 * Math.PI * i) / 24;
    return [Math.cos(t), Math.sin(t), 0.02 * i];
  });
  await page.getByRole('radio', { name: 'Delaunay' }).check();
  await openWith(page, 'star.json', JSON.stringify([star]));
  await expect.poll(async () => (await stateOf(page)).phase).toBe('none');
  const result = page.getByRole('region', { name: 'Result' });
  await expect(result).toContainText('No surface in this space');
  for (let i = 0; i < 2 && (await stateOf(page)).phase === 'none'; i++) {
    await result.getByRole('button', { name: /^Try/ }).click();
    await expect.poll(async () => (await stateOf(page)).phase).toMatch(/done|none/);
  }
  expectSpans((await spanned(page)).span, 1);
});

test('a heavy span: shows progress, is cancelled, and the next one works', async ({ quietPage: page }) => {
  await openPage(page);
  const ring = (z: number) =>
    Array.from({ length: 46 }, (_, i) => {
      const t = (2 * Math.PI * i) / 46;
      return [Math.cos(t) + 0.2 * Math.cos(7 * t + z), Math.sin(t), z + 0.3 * Math.sin(3 * t + z)];
    });
  await page.getByRole('radio', { name: 'All', exact: true }).check();
  await openWith(page, 'heavy.json', JSON.stringify([ring(0), ring(1.5), ring(3)]));
  const result = page.getByRole('region', { name: 'Result' });
  await expect(result.getByRole('progressbar')).toBeVisible();
  await expect(page.getByRole('progressbar', { name: 'Spanning, over the scene' })).toBeVisible();
  await result.getByRole('button', { name: 'Cancel' }).click();
  expect((await stateOf(page)).phase).toBe('cancelled');
  await expect(result).toContainText('Spanning was cancelled.');
  await page.getByRole('radio', { name: 'Delaunay' }).check();
  await openWith(page, 'box.curve', kTwoSquares);
  expectSpans((await spanned(page)).span, 2);
});

test('files that this mode does not open: said what they are and what opens them', async ({ quietPage: page }) => {
  await openPage(page);
  const { curves } = await stateOf(page);
  const notice = page.locator('.toast');
  for (const [name, text, words] of [
    ['bunny.off', 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n', 'it is a mesh (OFF), which no mode opens. Film opens'],
    ['part.curve', 'ISO-10303-21;\nHEADER;\n', 'it is a CAD model (STEP), which no mode opens'],
    ['picture.curve', '\u0089PNG\r\n\u001a\n\0\0\0', 'it is in no format that is known here'],
    ['letter.txt', 'Dear reader,', 'it is in no format that is known here'],
  ]) {
    await openWith(page, name, text);
    await expect(notice).toContainText(`Could not open “${name}”: `);
    await expect(notice).toContainText(words);
  }
  expect((await stateOf(page)).curves).toEqual(curves);
  await openWith(page, 'squares.json', '{"type":"Polygon","coordinates":[[[0,0],[3,0],[3,3],[0,3],[0,0]]]}');
  await expect(notice).toContainText('“squares.json” is a GeoJSON file: the mode Polygon opens it.');
  await notice.getByRole('button', { name: 'Open in Polygon' }).click();
  await page.waitForFunction(() => window.__polygons?.document.name === 'squares');
  expect((await stateOf(page)).mode).toBe('polygon');
});

test('several files dropped: all are opened as one step, or named', async ({ quietPage: page }) => {
  await openPage(page);
  const { curves } = await stateOf(page);
  const kite = '[[[0,0,5],[1,0,5.2],[1,1,5],[0,1,5.2]]]';
  await dropAll(page, [
    ['box.curve', kTwoSquares],
    ['kite.json', kite],
    ['bunny.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'],
    ['bad.curve', kTwoSquares.replace('2 2 0', '2 two 0')],
  ]);
  await hasCurves(page, 3);
  await expect(page.locator('.toast')).toContainText('“box.curve” and “kite.json”: 3 curves');
  await expect(page.locator('.toast')).toContainText('“bunny.obj”');
  await expect(page.locator('.toast')).toContainText(/“bad\.curve”.*line 5/i);
  expectSpans((await spanned(page)).span, 3);
  await page.keyboard.press('Control+z');
  expect((await stateOf(page)).curves).toEqual(curves);
});

test('smoothing that is cancelled: said, done when tried again; meanwhile the span is exported if that is wanted', async ({ quietPage: page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await openPage(page);
  const { span } = await spanned(page);
  let release: () => void = () => undefined;
  const isReleased = new Promise<void>((resolve) => (release = resolve));
  await page.route(/\/meshes[-_][^/]*$/, async (route) => {
    await isReleased;
    await route.continue();
  });
  const result = page.getByRole('region', { name: 'Result' });
  await page.getByRole('radio', { name: 'Film', exact: true }).check();
  await expect(result).toContainText('Smoothing…');
  const exported = async () => {
    const download = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Export as it was spanned' }).click();
    return readFile(await (await download).path(), 'utf8');
  };
  await page.keyboard.press('Control+s');
  await expect(page.locator('.toast')).toContainText('The surface is still being smoothed.');
  expect((await exported()).match(/^v /gm)).toHaveLength(span.positions.length / 3);
  await page.keyboard.press('Escape');
  await expect(result).toContainText('Smoothing was cancelled.');
  // Without it the span is what there is.
  const download = page.waitForEvent('download');
  await page.keyboard.press('Control+s');
  expect((await readFile(await (await download).path(), 'utf8')).match(/^v /gm)).toHaveLength(span.positions.length / 3);
  release();
  await result.getByRole('button', { name: 'Try again' }).click();
  await expect(result).toContainText('Smoothed to');
  await expect(result).not.toContainText('cancelled');
});
