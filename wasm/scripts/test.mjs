// npm test [-- suite… word…]: installs what is missing, builds what has changed, runs every suite or those
// named, and ends with `N passed, N failed`. `npm test -- --help` says what the words are.
import path from 'node:path';
import { buildLibrary, buildPage, buildPreset } from './build.mjs';
import { choose, cppTests, programsOf } from './cpp.mjs';
import { Failure, buildRoot, main, say } from './run.mjs';
import { Summary, clangFormat, eslint, fuzz, fuzzers, playwright, typecheck, vitest } from './suites.mjs';
import { checkNode, ensureNodeModules, ensureTools } from './tools.mjs';

const kLint = ['typecheck', 'eslint', 'format', 'layering'];
const kSuites = [...kLint, 'scripts', 'cpp', 'fuzz', 'unit', 'pack', 'page'];
/** Suites of which words choose a part. */
const kParted = ['cpp', 'quick', 'fuzz', 'unit', 'pack', 'page'];
const kHelp = `npm test                            every suite
npm test -- unit page               these suites: ${kSuites.join(', ')}; \`lint\` is the first four
npm test -- cpp polygon.repair      the tests of tests/cpp/polygon/repair, with sanitizers
npm test -- quick polygon.repair    the same without sanitizers, for the inner loop; builds only what they need
npm test -- quick polygon.repair bow    those with \`bow\` in their name
npm test -- unit span               the files of tests/unit with \`span\` in their name; the same for pack, page, fuzz
Suites first, then words. Several folders add up; of other words, a C++ test's name has to hold each,
and a file's name one.`;

/** How many inputs each fuzzer tries; \`npm run fuzz\` goes on for longer. */
const kFuzzRuns = { session: 12_000, span: 8_000, surfaces: 1_000, other: 60_000 };

/** Suites and the words after them. */
function readArguments(args) {
  const isSuite = (word) => word === 'lint' || word === 'quick' || kSuites.includes(word);
  const end = args.findIndex((word) => !isSuite(word));
  const [named, words] = end < 0 ? [args, []] : [args.slice(0, end), args.slice(end)];
  const suites = named.flatMap((name) => (name === 'lint' ? kLint : [name]));
  if (words.some((word) => word.startsWith('-')) || (words.length > 0 && suites.length !== 1)) {
    throw new Failure(`${words.join(' ')}: not the name of a suite.\n\n${kHelp}`);
  }
  if (words.length > 0 && !kParted.includes(suites[0])) {
    throw new Failure(`${suites[0]} has no parts to choose by ${words.join(' ')}.\n\n${kHelp}`);
  }
  return { suites, words };
}

await main(async () => {
  const args = process.argv.slice(2);
  if (args.some((word) => word === '--help' || word === '-h' || word === 'help')) return say(kHelp);
  const { suites, words } = readArguments(args);
  const chosen = (name) => suites.includes(name) || (suites.length === 0 && kSuites.includes(name));

  const chosenOf = (...names) => names.some(chosen);
  const needsLibrary = chosenOf('typecheck', 'eslint', 'unit', 'pack', 'page');

  checkNode();
  const tools = [];
  if (needsLibrary) tools.push('emcc', 'cmake', 'ninja');
  if (chosenOf('cpp', 'quick')) tools.push('cmake', 'ninja', 'compiler', 'doctest');
  if (chosen('fuzz')) tools.push('cmake', 'ninja', 'clang', 'fuzzer');
  if (chosenOf('pack', 'page')) tools.push('chromium');
  if (chosen('format')) tools.push('clangFormat');
  const { paths, missing } = await ensureTools([...new Set(tools)]);
  if (needsLibrary || chosenOf('layering', 'scripts')) await ensureNodeModules();

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
  const choice = chosenOf('cpp', 'quick') && choose(words);
  for (const [name, preset] of [['cpp', 'native'], ['quick', 'native-quick']]) {
    if (!chosen(name)) continue;
    say('· C++ tests');
    const targets = words.length > 0 ? programsOf(choice) : [];
    await build(`program of ${name}`, () => buildPreset(preset, { targets }));
  }
  const fuzzes = chosen('fuzz') && paths.fuzzer;
  if (fuzzes) {
    say('· fuzzers');
    await build('fuzzers', () => buildPreset('fuzz'));
  }

  say('');
  await Promise.all([
    suite('cpp', 'C++ tests with sanitizers', 'program of cpp', () => cppTests('native', choice)),
    suite('quick', 'C++ tests', 'program of quick', () => cppTests('native-quick', choice)),
    (async () => {
      await suite('typecheck', 'types of the library', null, () => typecheck('wasm/tsconfig.json'));
      await suite('typecheck', 'types of the page', 'library', () => typecheck('web/tsconfig.json'));
      await suite('typecheck', 'types of the tests', 'library', () => typecheck('tests/tsconfig.json'));
      await suite('eslint', 'eslint', 'library', eslint);
      if (paths.clangFormat) {
        await suite('format', 'clang-format', null, () => clangFormat(paths.clangFormat));
      }
      await suite('layering', 'layering', null, () => vitest('tests/layering'));
      await suite('scripts', 'scripts', null, () => vitest('tests/scripts'));
      await suite('unit', 'API in Node', 'library', () => vitest('tests/unit', { words }));
      await suite('pack', 'packed package', 'library', () =>
        vitest('tests/pack', { words, env: { CHROMIUM: paths.chromium } }),
      );
      if (fuzzes) {
        await suite('fuzz', 'fuzzers with sanitizers', 'fuzzers', () =>
          fuzz(path.join(buildRoot, 'fuzz'), fuzzers(words), { runs: kFuzzRuns }),
        );
      }
    })(),
  ]);
  // Alone: Chromium draws on the processor.
  await suite('page', 'page in Chromium', 'page', () => playwright(paths.chromium, words));
  return summary.finish();
});
