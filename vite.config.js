import { defineConfig } from 'vite';

/**
 * Drops three's animation classes, 6 KB that nothing on the page uses: bundlers keep them for the constants that
 * three assigns to them. Whoever begins to animate with three removes this; until then the build says so.
 */
const withoutAnimation = {
  name: 'without-animation',
  apply: 'build',
  transform(code, id) {
    if (!id.endsWith('/three.core.js')) return null;
    return { code: code.replace(/^(\w*KeyframeTrack|PropertyBinding)\.[\w.]+ = [^;]*;$/gm, ''), map: null };
  },
  renderChunk(code) {
    if (/THREE\.(KeyframeTrack|PropertyBinding)/.test(code)) {
      this.error("three's animation is used: remove `withoutAnimation` from vite.config.js");
    }
  },
};

// The page: static, served from any folder, without special HTTP headers.
export default defineConfig({
  root: 'web',
  base: './',
  plugins: [withoutAnimation],
  oxc: { jsx: { runtime: 'automatic', importSource: 'preact' } },
  build: {
    outDir: 'dist',
    emptyOutDir: true,
    target: 'es2022',
    chunkSizeWarningLimit: 1000,
    modulePreload: { polyfill: false },
  },
  worker: { format: 'es' },
  preview: { port: 4173 },
});
