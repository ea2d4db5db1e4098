import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['**/*.test.ts'],
    // No limits in seconds: what stands still is ended by wasm/scripts/watch.mjs.
    testTimeout: 0,
    hookTimeout: 0,
    // The tests use the package as built, loaded by Node itself.
    server: { deps: { external: [/\/wasm\/dist\//] } },
  },
});
