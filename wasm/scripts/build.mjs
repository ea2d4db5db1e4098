// npm run build [core | library | page]: builds what has changed, all of it without an argument.
//   core     wasm/src → loops.wasm, polygons.wasm, meshes.wasm, surfaces.wasm
//   library  core, and wasm/ts → the package in wasm/dist
//   page     library, and web → the static page in web/dist
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { writeBorder } from './border.mjs';
import { Failure, buildRoot, jobs, main, root, run, runTool, say } from './run.mjs';
import { listFiles, unlessUpToDate, writeIfChanged } from './stamp.mjs';
import { checkNode, emscriptenEnvironment, ensureNodeModules, ensureTools } from './tools.mjs';

const dist = path.join(root, 'wasm/dist');
/** The core's parts, each a CMake target. */
const modules = ['loops.wasm', 'polygons.wasm', 'meshes.wasm', 'surfaces.wasm'];
const built = modules.map((name) => `wasm/dist/${name}`);
const scripts = ['wasm/scripts/build.mjs', 'wasm/scripts/border.mjs'];
const packages = ['package.json', 'package-lock.json'];

/**
 * Configures and builds a CMake preset, or only some targets of it, shown only if it fails; anew where
 * the build tree is from another place or another compiler.
 */
export async function buildPreset(preset, { targets = [], launcher = [], env = {} } = {}) {
  const cwd = path.join(root, 'wasm');
  const tree = path.join(buildRoot, preset);
  const origin = path.join(tree, 'origin');
  const here = JSON.stringify([cwd, launcher, process.env.CXX]);
  if (!existsSync(origin) || readFileSync(origin, 'utf8') !== here) {
    rmSync(tree, { recursive: true, force: true });
    mkdirSync(tree, { recursive: true });
    writeFileSync(origin, here);
  }
  const options = { cwd, env, capture: true, allowFailure: true };
  const configure = [...launcher, 'cmake', '--preset', preset];
  const build = ['cmake', '--build', '--preset', preset, '-j', String(jobs)];
  if (targets.length > 0) build.push('--target', ...targets);
  for (const [program, ...args] of [configure, build]) {
    const { code, output } = await run(program, args, options);
    const told = output.split('\n').filter((line) => !/^\[\d+\/\d+\]/.test(line));
    if (code !== 0) throw new Failure(`${told.join('\n')}\nThe preset ${preset} does not build.`);
  }
}

export async function buildCore() {
  const { paths } = await ensureTools(['emcc', 'cmake', 'ninja']);
  const step = {
    inputs: ['wasm/src', 'wasm/include', 'wasm/CMakeLists.txt', 'wasm/CMakePresets.json', ...scripts],
    facts: [paths.emcc, statSync(paths.emcc).mtimeMs],
    outputs: built,
  };
  await unlessUpToDate('core', step, async () => {
    const env = emscriptenEnvironment(paths.emcc);
    const beside = path.join(path.dirname(paths.emcc), 'emcmake');
    const launcher = [existsSync(beside) ? beside : 'emcmake'];
    await buildPreset('emscripten', { launcher, env });
    for (const name of modules) {
      writeIfChanged(path.join(dist, name), readFileSync(path.join(buildRoot, 'emscripten', name)));
    }
  });
}

/** The tables of the border; wasm/ts by the TypeScript compiler, module by module; then what is generated of it. */
export async function buildLibrary() {
  await buildCore();
  await ensureNodeModules();
  writeBorder();
  const step = {
    inputs: ['wasm/ts', 'wasm/tsconfig.json', 'tsconfig.json', ...packages, ...scripts, ...built],
    outputs: ['wasm/dist/index.js', 'wasm/dist/index.d.ts'],
  };
  await unlessUpToDate('library', step, async () => {
    // Compiled aside and copied over: whoever uses wasm/dist meanwhile sees only whole files.
    const staging = path.join(buildRoot, 'library');
    rmSync(staging, { recursive: true, force: true });
    const project = path.join(root, 'wasm/tsconfig.json');
    const args = ['-p', project, '--outDir', staging, '--noEmitOnError', '--pretty', 'false'];
    await runTool('typescript/bin/tsc', args, { capture: true });
    await generateModules(staging);
    const names = readdirSync(staging);
    for (const name of names) {
      writeIfChanged(path.join(dist, name), readFileSync(path.join(staging, name)));
    }
    for (const name of readdirSync(dist)) {
      if (!modules.includes(name) && !names.includes(name)) {
        rmSync(path.join(dist, name), { recursive: true });
      }
    }
  });
}

/**
 * Scripts that run by themselves, and files turned into modules:
 * worker_thread*.js, bundled so that a thread needs no other file;
 * loops_inline.js and the like, loops.wasm in base64; any other *_inline.js, that script as text.
 */
async function generateModules(folder) {
  const { build } = await import('esbuild');
  const bundle = async (stem, format) => {
    const { outputFiles } = await build({
      entryPoints: [path.join(folder, `${stem}.js`)],
      bundle: true,
      minify: true,
      write: false,
      format,
      platform: stem.endsWith('_node') ? 'node' : 'browser',
      target: 'es2022',
    });
    return outputFiles[0].text;
  };
  const stems = readdirSync(folder).filter((name) => /^worker_thread(_node)?\.js$/.test(name));
  const bundled = new Map();
  for (const stem of stems.map((name) => name.slice(0, -3))) {
    bundled.set(stem, await bundle(stem, 'esm'));
  }
  for (const declared of listFiles(['wasm/ts'], (name) => name.endsWith('_inline.d.ts'))) {
    const name = path.basename(declared, '.d.ts');
    const stem = name.slice(0, -'_inline'.length);
    const content =
      modules.includes(`${stem}.wasm`)
        ? readFileSync(path.join(dist, `${stem}.wasm`)).toString('base64')
        : await bundle(stem, stem.endsWith('_node') ? 'cjs' : 'iife');
    writeFileSync(path.join(folder, `${name}.js`), `export default ${JSON.stringify(content)};\n`);
  }
  for (const [stem, text] of bundled) writeFileSync(path.join(folder, `${stem}.js`), text);
  await bundlePackages(folder, 'glb');
}

/**
 * A module with the packages that it imports, so that the library has no dependencies, and with their licences. What it
 * imports of the library stays apart: there must be one class of errors.
 */
async function bundlePackages(folder, stem) {
  const { build } = await import('esbuild');
  const file = path.join(folder, `${stem}.js`);
  const ofFolder = {
    name: 'of-folder',
    setup({ onResolve }) {
      onResolve({ filter: /^\.\// }, (found) => (found.importer === file ? { path: found.path, external: true } : null));
    },
  };
  const { outputFiles, metafile } = await build({
    entryPoints: [file],
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    absWorkingDir: root,
    format: 'esm',
    target: 'es2022',
    external: ['node:*'],
    plugins: [ofFolder],
  });
  const packages = new Set(Object.keys(metafile.inputs).flatMap((name) => /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(name)?.[1] ?? []));
  const licences = [...packages].sort().map((name) => {
    const home = path.join(root, 'node_modules', name);
    const licence = readdirSync(home).find((each) => /^licen[cs]e/i.test(each));
    if (!licence) throw new Failure(`${name} has no file of its licence.`);
    return `${name}:\n${readFileSync(path.join(home, licence), 'utf8').trim().replaceAll('*/', '* /')}`;
  });
  writeFileSync(file, `/*!\n${licences.join('\n\n')}\n*/\n${outputFiles[0].text}`);
}

export async function buildPage() {
  await buildLibrary();
  const step = {
    inputs: ['web', 'vite.config.js', 'tsconfig.json', ...packages, ...scripts],
    facts: libraryDigest(),
    outputs: ['web/dist/index.html'],
  };
  await unlessUpToDate('page', step, async () => {
    await runTool('vite/bin/vite.js', ['build', '--logLevel', 'warn']);
  });
}

// Size and time of the built library's files: the page bundles them.
function libraryDigest() {
  return readdirSync(dist).map((name) => {
    const { size, mtimeMs } = statSync(path.join(dist, name));
    return [name, size, mtimeMs];
  });
}

const kTargets = { core: buildCore, library: buildLibrary, page: buildPage };

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  await main(async () => {
    const target = process.argv[2] ?? 'page';
    if (!(target in kTargets)) throw new Failure(`build ${target}: not one of ${Object.keys(kTargets).join(', ')}`);
    checkNode();
    await kTargets[target]();
    say('Built.');
  });
}
