// The C++ tests: one doctest program a folder of tests/cpp, each of its test cases a test of CTest.
// A test's full name is that of its folder and its own, `polygon.repair/repair: a bow tie`.
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { Failure, buildRoot, jobs, run } from './run.mjs';
import { listFiles } from './stamp.mjs';
import { describeCase, reportFile, result } from './report.mjs';

/** Seconds of processor time for one test case: a hundred times what the longest takes. */
const kProcessorSeconds = 1800;
const kLongProcessorSeconds = 4 * 3600;

/** The folders with tests, by their dotted names. Long tests are apart. */
function folders(isLong) {
  const files = listFiles(['tests/cpp'], (file) => file.endsWith('_test.cpp'));
  const names = files.map((file) => path.posix.dirname(file).split('/').slice(2).join('.'));
  return [...new Set(names)].filter((name) => (name === 'long') === isLong);
}

/**
 * What words on the command line ask for. A word that names a folder, or all folders below it, asks for these;
 * any other is part of a test's name, in any case of letters. All words of the second kind have to be there.
 */
export function choose(words, { isLong = false } = {}) {
  const all = folders(isLong);
  const dotted = (word) => word.replace(/^tests\/cpp\//, '').replace(/\/$/, '').replaceAll('/', '.');
  const under = (word) => all.filter((name) => name === dotted(word) || name.startsWith(`${dotted(word)}.`));
  const parts = words.filter((word) => under(word).length === 0).map((word) => word.toLowerCase());
  const named = all.filter((name) => words.some((word) => under(word).includes(name)));
  return { folders: named.length > 0 ? named : all, parts };
}

/** The build targets of what is chosen. */
export const programsOf = (choice) => choice.folders.map((folder) => `test_${folder}`);

/**
 * Runs the chosen test cases in the build tree of a preset. A test case that ends by a crash, or is ended because
 * it goes on for ever, is one failure; so is one that CTest does not know of, and a choice of none.
 */
export async function cppTests(preset, choice, { isLong = false } = {}) {
  const tree = path.join(buildRoot, preset);
  const all = await knownTests(tree);
  const strays = [];
  for (const folder of choice.folders) strays.push(...(await strayOf(tree, folder, all)));
  const wanted = ({ name }) =>
    choice.folders.some((folder) => name.startsWith(`${folder}/`)) &&
    choice.parts.every((part) => name.toLowerCase().includes(part));
  const chosen = all.filter(wanted);
  if (chosen.length === 0) {
    const words = choice.parts.map((part) => `“${part}”`).join(' and ');
    const where = choice.folders.length > 3 ? 'of C++' : `in ${choice.folders.join(', ')}`;
    return result(0, 1 + strays.length, `${strays.join('')}There is no test ${where}${words && ` with ${words} in its name`}.\n`);
  }

  const file = reportFile(`${preset}.xml`);
  const args = ['--test-dir', tree, '--parallel', String(jobs), '--timeout', '10000000', '--output-junit', file];
  // Which test cases: by number, and none by range.
  args.push('-I', `0,0,0,${chosen.map(({ number }) => number).join()}`);
  for (const kind of ['passed', 'failed']) args.push(`--test-output-size-${kind}`, '1000000');
  const { code, output } = await run('ctest', args, {
    capture: true,
    allowFailure: true,
    watched: { processor: 1.5 * jobs * (isLong ? kLongProcessorSeconds : kProcessorSeconds) },
    processor: isLong ? kLongProcessorSeconds : kProcessorSeconds,
    env: {
      UBSAN_OPTIONS: 'print_stacktrace=1',
      CTEST_OUTPUT_ON_FAILURE: undefined,
    },
  });
  const report = existsSync(file) ? readFileSync(file, 'utf8') : '';
  const outcomes = new Map([...report.matchAll(/<testcase [\s\S]*?<\/testcase>/g)].map(([text]) => outcomeOf(text)));
  let [passed, failed, told] = [0, strays.length, strays.join('')];
  for (const { name } of chosen) {
    const outcome = outcomes.get(name) ?? { passed: 0, fault: 'It did not come to an end.' };
    passed += outcome.passed;
    if (!outcome.fault) continue;
    failed++;
    told += `${name}\n${outcome.fault}\n`;
  }
  if (failed === 0 && code !== 0) [failed, told] = [1, output.slice(-10_000)];
  else if (report === '') told = `${output.slice(-10_000)}\n${told}`;
  return result(passed, failed, told);
}

/** All tests that CTest knows in a build tree. */
async function knownTests(tree) {
  const args = ['--test-dir', tree, '--show-only=json-v1'];
  const { code, output } = await run('ctest', args, { capture: true, allowFailure: true });
  if (code !== 0) throw new Failure(`${output}CTest cannot read the list of tests: has a name one bracket of two in it?`);
  const { tests } = JSON.parse(output.slice(output.indexOf('{')));
  return tests.map(({ name }, i) => ({ name, number: i + 1 }));
}

/** Test cases of a program that are not run: skipped, two of one name, or of a name that CTest spoils. */
async function strayOf(tree, folder, all) {
  const program = path.join(tree, `test_${folder}`);
  if (!existsSync(program)) return [`test_${folder} is not built.\n`];
  const { output } = await run(program, ['--no-skip', '--list-test-cases'], { capture: true, allowFailure: true });
  const names = output.split('\n').filter((line) => line && !/^(\[doctest\]|=+$)/.test(line));
  if (names.length === 0) return [`test_${folder} has no test case.\n`];
  const known = new Set(all.map(({ name }) => name));
  if (known.has(`${folder}/all`)) return [];
  return names
    .filter((name, i) => !known.has(`${folder}/${name}`) || names.indexOf(name) !== i)
    .map((name) => `${folder}/${name}\n  is not run: it is skipped, or not the only one of its name.\n`);
}

/** A test's name, how many of its test cases passed, and what is wrong, from CTest's report. */
function outcomeOf(text) {
  const plain = (s) => s.replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&quot;/g, '"').replace(/&apos;/g, "'").replace(/&amp;/g, '&');
  const name = plain(/ name="([^"]*)"/.exec(text)[1]);
  const output = plain(/<system-out>([\s\S]*?)<\/system-out>/.exec(text)?.[1] ?? '');
  const message = plain(/<(?:failure|error|skipped) message="([^"]*)"/.exec(text)?.[1] ?? '');
  const cases = [...output.matchAll(/<TestCase [^>]*?(?:\/>|>[\s\S]*?(?=<\/TestCase>|<TestCase |$))/g)]
    .map(([found]) => found)
    .filter((found) => !/^[^>]*skipped="true"/.test(found));
  const passed = cases.filter((found) => found.includes('test_case_success="true"'));
  const failed = cases.filter((found) => !passed.includes(found));
  const ran = / status="run"/.test(text);
  if (ran && failed.length === 0 && passed.length > 0) return [name, { passed: passed.length, fault: '' }];
  const isComplete = output.includes('</doctest>');
  const told = failed.map(describeCase).join('') || (cases.length > 0 ? '' : '  No test case was run.\n');
  // What the program wrote beside its report: of a sanitizer, say.
  const said = output.replace(/<TestCase [^>]*skipped="true"[^>]*>\n?|<\?xml[^>]*>|<doctest [^>]*>|<Options [^>]*>|^\s*\n/gm, '');
  const rest = isComplete ? '' : `${said.slice(-20_000)}  It was ended in the middle of this, by a crash or a limit of processor time${message && `: ${message}`}.\n`;
  return [name, { passed: passed.length, fault: told + rest }];
}
