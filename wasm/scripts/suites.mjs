// The test suites: each runs one tool and counts what its machine-readable report says.
// A suite that crashes or that runs no test has failed.
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import path from 'node:path';
import { buildRoot, root, run, runTool } from './run.mjs';
import { listFiles } from './stamp.mjs';

const reports = path.join(buildRoot, 'reports');

function reportFile(name) {
  mkdirSync(reports, { recursive: true });
  const file = path.join(reports, name);
  rmSync(file, { force: true });
  return file;
}

/** What a suite resolves to. `notes` are told in the summary whatever the counts are. */
function result(passed, failed, output = '', notes = []) {
  if (passed + failed === 0) {
    return { passed, failed: 1, output: `${output}\nNo test was run.\n`, notes };
  }
  return { passed, failed, output, notes };
}

function readReport(file) {
  return existsSync(file) ? readFileSync(file, 'utf8') : '';
}

/** One check that passes or fails as a whole, by its exit code. */
async function check(tool, args) {
  const { code, output } = await runTool(tool, args, { capture: true, allowFailure: true });
  return code === 0 ? result(1, 0) : result(0, 1, output);
}

export const typecheck = (project) =>
  check('typescript/bin/tsc', ['-p', path.join(root, project), '--noEmit', '--pretty', 'false']);

export const eslint = () => check('eslint/bin/eslint.js', ['.', '--max-warnings', '0']);

export async function clangFormat(program) {
  const sources = listFiles(['wasm', 'tests'], (file) => /\.(cpp|h)$/.test(file));
  const args = ['--dry-run', '--Werror', ...sources];
  const { code, output } = await run(program, args, { capture: true, allowFailure: true });
  if (code === 0) return result(sources.length > 0 ? 1 : 0, 0);
  const files = [...new Set(output.match(/^[^\s:]+\.(cpp|h)/gm))];
  return result(0, 1, `Not as clang-format has it (clang-format -i mends it):\n${files.join('\n')}\n`);
}

/** Names and suspicious code in the core, as .clang-tidy has them, with the flags of a build tree. */
export async function clangTidy(program, tree) {
  const sources = listFiles(['wasm/src'], (file) => file.endsWith('.cpp'));
  const args = ['-p', tree, '--quiet', '--warnings-as-errors=*', ...sources];
  const { code, output } = await run(program, args, { capture: true, allowFailure: true });
  return code === 0 ? result(sources.length > 0 ? 1 : 0, 0, output) : result(0, 1, output);
}

/** A doctest program. Tests that ran before a crash count as passed, the crash as one failure. */
export async function doctest(program, { seconds = 900, args = [] } = {}) {
  const file = reportFile(`${path.basename(program)}.xml`);
  const env = {
    ASAN_OPTIONS: 'detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1',
    UBSAN_OPTIONS: 'print_stacktrace=1',
  };
  const { code, output } = await run(program, ['--reporters=xml', `--out=${file}`, ...args], {
    capture: true,
    allowFailure: true,
    seconds,
    env,
  });
  const cases = [...readReport(file).matchAll(/<TestCase [^>]*?(?:\/>|>[\s\S]*?(?=<\/TestCase>|<TestCase |$))/g)].map(([text]) => text);
  const ran = cases.filter((text) => !/^[^>]*skipped="true"/.test(text));
  const passed = ran.filter((text) => text.includes('test_case_success="true"'));
  const failed = ran.filter((text) => !passed.includes(text));
  const skipped = cases.length - ran.length;
  const crashed = code !== 0 && failed.length === 0;
  const told = failed.map(describeDoctestCase).join('');
  const tail = code === 0 ? '' : `${output.slice(-20_000)}\nexit code ${code}\n`;
  const notes = skipped > 0 ? [`${skipped} tests of ${path.basename(program)} were skipped`] : [];
  return result(passed.length, failed.length + (crashed ? 1 : 0), told + tail, notes);
}

/** All doctest programs in a build tree, one after the other. */
export async function cppTests(folder) {
  const sum = result(1, 0);
  sum.passed = 0;
  for (const name of readdirSync(folder).filter((file) => /^test_[a-z_.]+$/.test(file)).sort()) {
    const { passed, failed, output, notes } = await doctest(path.join(folder, name));
    sum.passed += passed;
    sum.failed += failed;
    sum.output += output;
    sum.notes.push(...notes);
  }
  return sum;
}

function describeDoctestCase(text) {
  const plain = (s) => s.replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&quot;/g, '"').replace(/&amp;/g, '&');
  const attribute = (name) => plain(new RegExp(`${name}="([^"]*)"`).exec(text)?.[1] ?? '?');
  const faults = [...text.matchAll(/<Expression success="false"[\s\S]*?<\/Expression>/g)].map(([fault]) => {
    const lines = fault.replace(/<[^>]*>/g, '').split('\n').map((line) => line.trim()).filter(Boolean);
    const line = /line="(\d+)"/.exec(fault)?.[1] ?? '?';
    return `    line ${line}: ${lines.map(plain).join('\n      ')}\n`;
  });
  const shown = faults.slice(0, 10).join('');
  const exception = /<Exception[^>]*>([\s\S]*?)<\/Exception>/.exec(text)?.[1];
  const rest = faults.length > 10 ? `    and ${faults.length - 10} more\n` : '';
  return `  ${attribute('filename')}: ${attribute('name')}\n${shown}${rest}${exception ? `    ${plain(exception.trim())}\n` : ''}`;
}

/**
 * The libFuzzer programs in the build tree `folder`, for `seconds` each. A failing input is left in
 * `folder`/found.
 *   explores  from what earlier runs found, by chance and told all the while; otherwise from nothing, by
 *             one fixed seed
 */
export async function fuzz(folder, seconds, { explores = false } = {}) {
  const found = path.join(folder, 'found/');
  mkdirSync(found, { recursive: true });
  const programs = readdirSync(path.join(root, 'tests/cpp/fuzz'))
    .filter((name) => name.endsWith('.cpp'))
    .map((name) => `fuzz_${path.basename(name, '.cpp')}`);
  let [passed, failed, told] = [0, 0, ''];
  for (const name of programs) {
    const corpus = path.join(folder, `corpus_${name}`);
    if (explores) mkdirSync(corpus, { recursive: true });
    const { code, output } = await run(
      path.join(folder, name),
      [
        `-max_total_time=${seconds}`,
        `-artifact_prefix=${found}${name}_`,
        '-timeout=30',
        ...(explores ? [corpus, '-print_final_stats=1'] : ['-seed=1']),
      ],
      { allowFailure: true, capture: !explores },
    );
    if (code === 0) passed++;
    else [failed, told] = [failed + 1, `${told}${name}:\n${output.slice(-10_000)}\n`];
  }
  return result(passed, failed, told);
}

/** The vitest tests of one folder. */
export async function vitest(folder, env = {}) {
  const file = reportFile(`${path.basename(folder)}.json`);
  const args = ['run', '--dir', folder, '--reporter=default', '--reporter=json', `--outputFile.json=${file}`];
  const { code, output } = await runTool('vitest/vitest.mjs', args, {
    capture: true,
    allowFailure: true,
    seconds: 900,
    env: { ...env, NO_COLOR: '1', FORCE_COLOR: undefined },
  });
  const report = JSON.parse(readReport(file) || '{}');
  const passed = report.numPassedTests ?? 0;
  // A file that cannot be loaded fails without a failing test in it.
  const failed = Math.max(report.numFailedTests ?? 0, code === 0 ? 0 : 1);
  const skipped = (report.numPendingTests ?? 0) + (report.numTodoTests ?? 0);
  const notes = skipped > 0 ? [`${skipped} tests in ${folder} were skipped`] : [];
  return result(passed, failed, failed > 0 ? output : '', notes);
}

/** The Playwright tests on the built page. */
export async function playwright(chromium) {
  const file = reportFile('page.json');
  const { code, output } = await runTool('@playwright/test/cli.js', ['test', '--reporter=line,json'], {
    capture: true,
    allowFailure: true,
    seconds: 900,
    env: {
      NO_COLOR: '1',
      FORCE_COLOR: undefined,
      CHROMIUM: chromium,
      SOAPFILM_PORT: String(await freePort()),
      PLAYWRIGHT_JSON_OUTPUT_FILE: file,
    },
  });
  const stats = JSON.parse(readReport(file) || '{}').stats ?? {};
  const passed = stats.expected ?? 0;
  const failed = Math.max((stats.unexpected ?? 0) + (stats.flaky ?? 0), code === 0 ? 0 : 1);
  const notes = stats.skipped > 0 ? [`${stats.skipped} tests in tests/page were skipped`] : [];
  return result(passed, failed, failed > 0 ? output : '', notes);
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
  notes = [];

  /** Runs one suite; an exception in it is its failure. */
  async suite(name, body) {
    const start = performance.now();
    let outcome;
    try {
      outcome = await body();
    } catch (error) {
      outcome = { passed: 0, failed: 1, output: `${error.message}\n`, notes: [] };
    }
    const { passed, failed, output, notes } = outcome;
    this.passed += passed;
    this.failed += failed;
    this.notes.push(...notes);
    const seconds = ((performance.now() - start) / 1000).toFixed(1);
    const counts = failed > 0 ? `${passed} passed, ${failed} FAILED` : `${passed} passed`;
    process.stdout.write(`${failed > 0 ? '✗' : '✓'} ${name}: ${counts} (${seconds} s)\n`);
    if (failed > 0) process.stdout.write(`${output.trimEnd()}\n\n`);
  }

  /** Prints the summary; returns the exit code. */
  finish() {
    process.stdout.write('\n');
    for (const note of this.notes) process.stdout.write(`Note: ${note}\n`);
    process.stdout.write(`${this.passed} passed, ${this.failed} failed\n`);
    return this.failed > 0 || this.passed === 0 ? 1 : 0;
  }
}
