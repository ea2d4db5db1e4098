// npm run picture: takes the README's picture, the page itself with six saddles spanned.
import path from 'node:path';
import { buildPage } from './build.mjs';
import { main, root, say } from './run.mjs';
import { checkNode, ensureTools } from './tools.mjs';

const picture = path.join(root, 'examples/six-saddles.png');

await main(async () => {
  checkNode();
  const { paths } = await ensureTools(['chromium']);
  await buildPage();
  const { preview } = await import('vite');
  const { chromium } = await import('@playwright/test');
  const server = await preview({
    root: path.join(root, 'web'),
    configFile: path.join(root, 'vite.config.js'),
    preview: { port: 4273 },
  });
  const browser = await chromium.launch({
    executablePath: paths.chromium,
    args: [
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist',
      ...(process.getuid?.() === 0 ? ['--no-sandbox'] : []),
    ],
  });
  try {
    const page = await browser.newPage({
      viewport: { width: 1200, height: 760 },
      colorScheme: 'light',
      reducedMotion: 'reduce',
    });
    await page.goto(server.resolvedUrls.local[0]);
    const result = page.getByRole('region', { name: 'Result' });
    await result.getByText('optimal').first().waitFor();
    await page.keyboard.press('g');
    const card = page.getByRole('listitem').filter({ hasText: 'Saddles on an octahedron' });
    await card.getByRole('button', { name: '6 curves' }).click();
    await page.getByRole('dialog').waitFor({ state: 'hidden' });
    await result.getByText('optimal').first().waitFor({ timeout: 120_000 });
    // Rendering stops when there is nothing left to move.
    await page.waitForTimeout(3000);
    await page.screenshot({ path: picture });
    say(`Written: ${path.relative(root, picture)}`);
  } finally {
    await browser.close();
    await server.close();
  }
});
