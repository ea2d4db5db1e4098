// The test suites: each runs one tool and counts what its machine-readable report says.
// A suite that crashes or that runs no test has failed.
import { mkdirSync, readdirSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import path from 'node:path';
import { readReport, reportFile, result } from './report.mjs';
import { buildRoot, metered, root, run, runTool } from './run.mjs';
import { digest, listFiles } from './stamp.mjs';

/** A tool is ended when it gets no further, however long it takes. */
const kTool = { capture: true, allowFailure: true, watched: {} };

/** One check that passes or fails as a whole, by its exit code. */
async function check(tool, args) {
  const { code, output } = await runTool(tool, args, kTool);
  return code === 0 ? result(1, 0) : result(0, 1, output);
}

export function typecheck(project) {
  const memory = path.join(buildRoot, 'types', `${path.dirname(project)}.tsbuildinfo`);
  const args = ['-p', path.join(root, project), '--noEmit', '--pretty', 'false'];
  return check('typescript/bin/tsc', [...args, '--incremental', '--tsBuildInfoFile', memory]);
}

/** What eslint found in a file stands while the file does, and all that its types can come from. */
export function eslint() {
  const isImported = (file) => !/\.(test|spec)\.ts$/.test(file);
  const key = digest(
    ['wasm/ts', 'wasm/tsconfig.json', 'web', 'tests', 'tsconfig.json', 'package-lock.json', 'eslint.config.js'],
    null,
    (file) => isImported(file) && /\.(ts|tsx|json|js)$/.test(file),
  );
  const folder = path.join(buildRoot, 'eslint');
  const cache = path.join(folder, key);
  mkdirSync(folder, { recursive: true });
  for (const name of readdirSync(folder)) if (name !== key) rmSync(path.join(folder, name));
  const args = ['.', '--max-warnings', '0', '--cache', '--cache-strategy', 'content', '--cache-location', cache];
  return check('eslint/bin/eslint.js', args);
}

export async function clangFormat(program) {
  const sources = listFiles(['wasm', 'tests'], (file) => /\.(cpp|h)$/.test(file));
  const args = ['--dry-run', '--Werror', ...sources];
  const { code, output } = await run(program, args, kTool);
  if (code === 0) return result(sources.length > 0 ? 1 : 0, 0);
  const files = [...new Set(output.match(/^[^\s:]+\.(cpp|h)/gm))];
  return result(0, 1, `Not as clang-format has it (clang-format -i mends it):\n${files.join('\n')}\n`);
}

/** Names and suspicious code in the core, as .clang-tidy has them, with the flags of a build tree. */
export async function clangTidy(program, tree) {
  const sources = listFiles(['wasm/src'], (file) => file.endsWith('.cpp'));
  const args = ['-p', tree, '--quiet', '--warnings-as-errors=*', ...sources];
  const { code, output } = await run(program, args, kTool);
  return code === 0 ? result(sources.length > 0 ? 1 : 0, 0, output) : result(0, 1, output);
}

/** The libFuzzer programs whose names hold one of the words, or all. */
export function fuzzers(words = []) {
  return readdirSync(path.join(root, 'tests/cpp/fuzz'))
    .filter((name) => name.endsWith('.cpp'))
    .map((name) => path.basename(name, '.cpp'))
    .filter((name) => words.length === 0 || words.some((word) => name.includes(word)));
}

/**
 * Runs libFuzzer programs of the build tree `folder`. A failing input is left in `folder`/found.
 *   runs     how many inputs each tries, from nothing and by one fixed seed: the same on every machine
 *   seconds  or how long each explores, from what earlier runs found, by chance and told all the while
 */
export async function fuzz(folder, names, { runs, seconds }) {
  const found = path.join(folder, 'found/');
  mkdirSync(found, { recursive: true });
  let [passed, failed, told] = [0, 0, ''];
  for (const name of names) {
    const corpus = path.join(folder, `corpus_fuzz_${name}`);
    if (seconds) mkdirSync(corpus, { recursive: true });
    // One input takes milliseconds; libFuzzer's own limit on it, in seconds, is to tell it from one that never ends.
    const args = [`-artifact_prefix=${found}fuzz_${name}_`, '-timeout=1200'];
    if (seconds) args.push(`-max_total_time=${seconds}`, corpus, '-print_final_stats=1');
    else args.push(`-runs=${runs[name] ?? runs.other}`, '-seed=1');
    const { code, output } = await run(path.join(folder, `fuzz_${name}`), args, {
      allowFailure: true,
      ...(seconds ? {} : kTool),
    });
    if (code === 0) passed++;
    else [failed, told] = [failed + 1, `${told}fuzz_${name}:\n${output.slice(-10_000)}\n`];
  }
  return result(passed, failed, told);
}

/** The vitest tests of one folder, or of its files whose names hold one of the words. */
export async function vitest(folder, { words = [], env = {} } = {}) {
  const file = reportFile(`${path.basename(folder)}.json`);
  // A line for each test, so that whether it gets on is seen.
  const args = ['run', '--dir', folder, '--reporter=verbose', '--reporter=json', `--outputFile.json=${file}`, ...words];
  const { code, output } = await runTool('vitest/vitest.mjs', args, {
    ...kTool,
    env: { ...env, NO_COLOR: '1', FORCE_COLOR: undefined },
  });
  const report = readReport(file);
  const passed = report.numPassedTests ?? (output.match(/^ +✓ /gm) ?? []).length;
  // A file that cannot be loaded fails without a failing test in it.
  const failed = Math.max(report.numFailedTests ?? 0, code === 0 ? 0 : 1);
  const skipped = (report.numPendingTests ?? 0) + (report.numTodoTests ?? 0);
  const notes = skipped > 0 ? [`${skipped} tests in ${folder} were skipped`] : [];
  return result(passed, failed, failed > 0 ? withoutPassed(output) : '', notes);
}

const withoutPassed = (output) => output.split('\n').filter((line) => !/^ *✓ /.test(line)).join('\n');

/** The Playwright tests on the built page, or of the files whose names hold one of the words. */
export async function playwright(chromium, words = []) {
  const file = reportFile('page.json');
  const { code, output } = await runTool('@playwright/test/cli.js', ['test', '--reporter=list,json', ...words], {
    ...kTool,
    env: {
      NO_COLOR: '1',
      FORCE_COLOR: undefined,
      CHROMIUM: chromium,
      SOAPFILM_PORT: String(await freePort()),
      PLAYWRIGHT_JSON_OUTPUT_FILE: file,
    },
  });
  const stats = readReport(file).stats ?? {};
  const passed = stats.expected ?? (output.match(/^ +✓ /gm) ?? []).length;
  const failed = Math.max((stats.unexpected ?? 0) + (stats.flaky ?? 0), code === 0 ? 0 : 1);
  const notes = stats.skipped > 0 ? [`${stats.skipped} tests in tests/page were skipped`] : [];
  return result(passed, failed, failed > 0 ? withoutPassed(output) : '', notes);
}

function freePort() {
  return new Promise((resolve, reject) => {
    const server = createServer().on('error', reject);
    server.listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** Runs suites, in the order given, and adds them up; the last line is `N passed, N failed`. */
export class Summary {
  passed = 0;
  failed = 0;
  processor = 0;
  notes = [];

  /** Runs one suite; an exception in it is its failure. */
  async suite(name, body) {
    const start = performance.now();
    const { value: outcome, processor } = await metered(async () => {
      try {
        return await body();
      } catch (error) {
        return { passed: 0, failed: 1, output: `${error.message}\n`, notes: [] };
      }
    });
    const { passed, failed, output, notes } = outcome;
    this.passed += passed;
    this.failed += failed;
    this.processor += processor;
    this.notes.push(...notes);
    const seconds = ((performance.now() - start) / 1000).toFixed(1);
    const counts = failed > 0 ? `${passed} passed, ${failed} FAILED` : `${passed} passed`;
    const mark = failed > 0 ? '✗' : '✓';
    process.stdout.write(`${mark} ${name}: ${counts} (${seconds} s, ${processor.toFixed(1)} s of processor time)\n`);
    if (failed > 0) process.stdout.write(`${output.trimEnd()}\n\n`);
  }

  /** Prints the summary; returns the exit code. */
  finish() {
    process.stdout.write(`\nProcessor time: ${(this.processor / 60).toFixed(1)} minutes\n`);
    for (const note of this.notes) process.stdout.write(`Note: ${note}\n`);
    process.stdout.write(`${this.passed} passed, ${this.failed} failed\n`);
    return this.failed > 0 || this.passed === 0 ? 1 : 0;
  }
}
