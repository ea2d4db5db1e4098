import { defineConfig } from '@playwright/test';
import { findChromium } from './wasm/scripts/tools.mjs';

const port = Number(process.env.SOAPFILM_PORT ?? 4174);
const isRoot = process.getuid?.() === 0;

export default defineConfig({
  testDir: 'tests/page',
  // Files named *.test.ts are vitest's.
  testMatch: '**/*.spec.ts',
  outputDir: 'test-results',
  workers: 1,
  // Far more than any machine needs: they end a test that waits for what never comes.
  timeout: 1_800_000,
  expect: { timeout: 300_000, toPass: { timeout: 300_000 } },
  // A page that does not start fails all tests, each after such a wait: the first few say enough.
  maxFailures: 3,
  forbidOnly: Boolean(process.env.CI),
  use: {
    baseURL: `http://127.0.0.1:${port}/`,
    viewport: { width: 1000, height: 700 },
    trace: 'off',
    launchOptions: {
      timeout: 0,
      executablePath: findChromium(),
      args: [
        '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader',
        '--ignore-gpu-blocklist',
        // Chromium's sandbox refuses to run for root.
        ...(isRoot ? ['--no-sandbox'] : []),
      ],
    },
  },
  webServer: {
    command: `node node_modules/vite/bin/vite.js preview --host 127.0.0.1 --port ${port} --strictPort`,
    url: `http://127.0.0.1:${port}/`,
    reuseExistingServer: false,
    timeout: 600_000,
  },
});
