import { gzipSync } from 'node:zlib';
import { expect, openPage, test } from './support.ts';

test('first load: at most 400 KB gzipped, all from the page’s own server', async ({ quietPage: page, baseURL }) => {
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
  expect(total, loaded.map(([url, bytes]) => `${url} ${bytes}`).join('\n')).toBeLessThan(400 * 1024);
});
