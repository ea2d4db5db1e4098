import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['**/*.test.ts'],
    testTimeout: 60_000,
    hookTimeout: 60_000,
    // The tests use the package as built, loaded by Node itself.
    server: { deps: { external: [/\/wasm\/dist\//] } },
  },
});
