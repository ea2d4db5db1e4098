// npm test [suite…]: installs what is missing, builds what has changed, runs every suite (or those
// named; `lint` stands for the checks without a program run) and ends with `N passed, N failed`.
import path from 'node:path';
import { buildLibrary, buildPage, buildPreset } from './build.mjs';
import { Failure, buildRoot, main, say } from './run.mjs';
import { Summary, clangFormat, cppTests, eslint, fuzz, playwright, typecheck, vitest } from './suites.mjs';
import { checkNode, ensureNodeModules, ensureTools } from './tools.mjs';

const kLint = ['typecheck', 'eslint', 'format', 'layering'];
const kSuites = [...kLint, 'cpp', 'fuzz', 'unit', 'pack', 'page'];
/** For each fuzzer; `npm run fuzz` takes longer. */
const kFuzzSeconds = 20;

await main(async () => {
  const named = process.argv.slice(2).flatMap((name) => (name === 'lint' ? kLint : [name]));
  const unknown = named.filter((name) => !kSuites.includes(name));
  if (unknown.length > 0) {
    throw new Failure(`Unknown suite ${unknown.join(', ')}; there are ${kSuites.join(', ')} and lint.`);
  }
  const chosen = (name) => named.length === 0 || named.includes(name);

  const chosenOf = (...names) => names.some(chosen);
  const needsLibrary = chosenOf('typecheck', 'eslint', 'unit', 'pack', 'page');

  checkNode();
  const tools = [];
  if (needsLibrary) tools.push('emcc', 'cmake', 'ninja');
  if (chosen('cpp')) tools.push('cmake', 'ninja', 'compiler', 'doctest');
  if (chosen('fuzz')) tools.push('cmake', 'ninja', 'clang', 'fuzzer');
  if (chosenOf('pack', 'page')) tools.push('chromium');
  if (chosen('format')) tools.push('clangFormat');
  const { paths, missing } = await ensureTools([...new Set(tools)]);
  if (needsLibrary || chosen('layering')) await ensureNodeModules();

  const summary = new Summary();
  for (const tool of missing) summary.notes.push(`${tool} was not found: its check was LEFT OUT`);

  // What fails to build fails each suite that needs it, with the compiler's message once.
  const broken = {};
  const build = async (name, step) => {
    try {
      await step();
    } catch (error) {
      if (!(error instanceof Failure)) throw error;
      broken[name] = new Error(`The ${name} does not build.`);
      process.stdout.write(`${error.message}\n`);
    }
  };
  const suite = async (name, label, needs, body) => {
    if (!chosen(name)) return;
    await summary.suite(label, () => {
      if (needs && broken[needs]) throw broken[needs];
      return body();
    });
  };

  if (needsLibrary) await build('library', buildLibrary);
  if (chosen('page') && !broken.library) await build('page', buildPage);
  if (broken.library) broken.page = broken.library;
  if (chosen('cpp')) {
    say('· C++ tests');
    await build('C++ test program', () => buildPreset('native'));
  }
  const fuzzes = chosen('fuzz') && paths.fuzzer;
  if (fuzzes) {
    say('· fuzzers');
    await build('fuzzers', () => buildPreset('fuzz'));
  }

  say('');
  await Promise.all([
    suite('cpp', 'C++ tests with sanitizers', 'C++ test program', () => cppTests(path.join(buildRoot, 'native'))),
    (async () => {
      await suite('typecheck', 'types of the library', null, () => typecheck('wasm/tsconfig.json'));
      await suite('typecheck', 'types of the page', 'library', () => typecheck('web/tsconfig.json'));
      await suite('typecheck', 'types of the tests', 'library', () => typecheck('tests/tsconfig.json'));
      await suite('eslint', 'eslint', 'library', eslint);
      if (paths.clangFormat) {
        await suite('format', 'clang-format', null, () => clangFormat(paths.clangFormat));
      }
      await suite('layering', 'layering', null, () => vitest('tests/layering'));
      await suite('unit', 'API in Node', 'library', () => vitest('tests/unit'));
      await suite('pack', 'packed package', 'library', () =>
        vitest('tests/pack', { CHROMIUM: paths.chromium }),
      );
      if (fuzzes) {
        await suite('fuzz', 'fuzzers with sanitizers', 'fuzzers', () =>
          fuzz(path.join(buildRoot, 'fuzz'), kFuzzSeconds),
        );
      }
    })(),
  ]);
  // Alone: pointer strokes on a software-rendered page suffer from a busy machine.
  await suite('page', 'page in Chromium', 'page', () => playwright(paths.chromium));
  return summary.finish();
});
