import { gzipSync } from 'node:zlib';
import '../../web/src/modes/film/inspection.ts';
import { expect, openPage, test } from './support.ts';

test('first load: at most 300 KB gzipped, all from the page’s own server', async ({ quietPage: page, baseURL }) => {
  const sizes: Promise<readonly [url: string, bytes: number]>[] = [];
  page.on('response', (response) => {
    const url = response.url();
    if (/^(data|blob):/.test(url)) return;
    sizes.push(response.body().then((body) => [url, gzipSync(body).length] as const));
  });
  await openPage(page);
  const loaded = await Promise.all(sizes);
  expect(loaded.filter(([url]) => !url.startsWith(baseURL ?? '?'))).toEqual([]);
  const total = loaded.reduce((sum, [, bytes]) => sum + bytes, 0);
  // Page, style, script, core: less would mean that the count has missed something.
  expect(total).toBeGreaterThan(150_000);
  expect(total, loaded.map(([url, bytes]) => `${url} ${bytes}`).join('\n')).toBeLessThan(300 * 1024);
});

test('the core: its part for loops at first, that for polygons once their mode is wanted', async ({ quietPage: page }) => {
  const parts: string[] = [];
  page.on('request', (request) => {
    const name = /\/(\w+)-[^/]*\.wasm$/.exec(request.url())?.[1];
    if (name !== undefined) parts.push(name);
  });
  await openPage(page);
  expect(parts).toEqual(['loops']);
  for (const mode of ['Polygon', 'Film', 'Polygon']) {
    await page.getByRole('button', { name: mode, exact: true }).click();
    if (mode === 'Polygon') await page.waitForFunction(() => window.__polygons?.triangulated);
  }
  expect(parts).toEqual(['loops', 'polygons']);
});
