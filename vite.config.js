import { defineConfig } from 'vite';

// The page: static, served from any folder, without special HTTP headers.
export default defineConfig({
  root: 'web',
  base: './',
  oxc: { jsx: { runtime: 'automatic', importSource: 'preact' } },
  build: {
    outDir: 'dist',
    emptyOutDir: true,
    target: 'es2022',
    chunkSizeWarningLimit: 1000,
    modulePreload: { polyfill: false },
    // three gives its animation classes constants through their prototypes. Nothing here uses these classes, and
    // without this they would be kept for the sake of the constants: 6 KB.
    rolldownOptions: { treeshake: { propertyReadSideEffects: false, propertyWriteSideEffects: false } },
  },
  worker: { format: 'es' },
  preview: { port: 4173 },
});
