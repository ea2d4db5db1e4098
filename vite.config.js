import { defineConfig } from 'vite';

/**
 * Drops from three what nothing on the page uses but bundlers must keep, 30 KB gzipped: shaders of lit materials and
 * of shadows (the page's own materials bring their shaders; `MeshBasicMaterial` and lines still work), virtual
 * reality, and animation classes. Whoever begins to use one of these takes its line away; until then the build says so.
 */
const kUnused = [
  {
    what: 'lit materials',
    from: /^(const|var) (?:lights_|shadowm|transmission_|iridescence_|clearcoat_|lightprobes_|envmap_physical_|bsdfs)\w* = "(?:[^"\\]|\\.)*";$/gm,
    used: /\.type\s*=\s*["'`]Mesh(Lambert|Phong|Standard|Physical|Toon|Matcap|Normal)Material/,
  },
  {
    what: 'lit materials',
    from: /^(const|var) (?:vertex|fragment)\$\w+ = "#define (?:LAMBERT|PHONG|STANDARD|TOON|MATCAP|NORMAL)\\n(?:[^"\\]|\\.)*";$/gm,
  },
  {
    what: 'virtual reality',
    from: /(?<=^class WebXRManager extends EventDispatcher \{\n)[\s\S]*?(?=^\}\n)/m,
    to: `
      enabled = false;
      isPresenting = false;
      getEnvironmentBlendMode() {}
      setAnimationLoop() {}
      dispose() {}
    `,
    used: /\.xr\.enabled\s*=\s*(true|!0)/,
  },
  {
    what: 'animation',
    from: /^(\w*KeyframeTrack|PropertyBinding)\.[\w.]+ = [^;]*;$/gm,
    used: /THREE\.(KeyframeTrack|PropertyBinding)/,
  },
];

const leanThree = {
  name: 'lean-three',
  apply: 'build',
  transform(code, id) {
    if (!/\/three\.(core|module)\.js$/.test(id)) return null;
    let lean = code;
    for (const { from, to } of kUnused) {
      lean = lean.replace(from, (found, keyword) => to ?? (/^(const|var)$/.test(keyword) ? `${found.split(' = ')[0]} = "";` : ''));
    }
    return { code: lean, map: null };
  },
  renderChunk(code) {
    const again = kUnused.find(({ used }) => used?.test(code));
    if (again) this.error(`three's ${again.what} is used: remove it from \`kUnused\` in vite.config.js`);
  },
};

// The page: static, served from any folder, without special HTTP headers.
export default defineConfig({
  root: 'web',
  base: './',
  plugins: [leanThree],
  oxc: { jsx: { runtime: 'automatic', importSource: 'preact' } },
  build: {
    outDir: 'dist',
    emptyOutDir: true,
    target: 'es2022',
    chunkSizeWarningLimit: 1000,
    modulePreload: { polyfill: false },
    // All styles come with the page: they are small, and a mode that is fetched later then needs its script alone.
    cssCodeSplit: false,
    rolldownOptions: {
      output: {
        // What every mode stands on is one file: split by who uses it, it would be larger.
        codeSplitting: { groups: [{ name: 'core', test: /web\/src\/(shapes|state|scene|app)\/(?!(sheets|formats|known_files)\.)|node_modules\/(three|preact|@preact|idb-keyval)\// }] },
      },
    },
  },
  worker: { format: 'es' },
  preview: { port: 4173 },
});
