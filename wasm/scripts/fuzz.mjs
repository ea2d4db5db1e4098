// npm run fuzz [-- seconds name…]: runs each libFuzzer program of tests/cpp/fuzz, or those whose names hold one
// of the words, for that long (600 s).
// A failing input is left in wasm/build/fuzz/found.
import path from 'node:path';
import { buildPreset } from './build.mjs';
import { Failure, buildRoot, main, say } from './run.mjs';
import { fuzz, fuzzers } from './suites.mjs';
import { checkNode, ensureTools } from './tools.mjs';

await main(async () => {
  checkNode();
  const [first, ...rest] = process.argv.slice(2);
  const seconds = Number(first ?? 600);
  if (!(seconds > 0)) throw new Failure('fuzz: the argument is the number of seconds for each program');
  const names = fuzzers(rest);
  if (names.length === 0) throw new Failure(`fuzz: there is none with ${rest.join(' or ')} in its name`);
  const { missing } = await ensureTools(['cmake', 'ninja', 'clang', 'fuzzer']);
  if (missing.length > 0) throw new Failure(`fuzz: ${missing.join(' and ')} not found`);
  await buildPreset('fuzz');
  const { passed, failed } = await fuzz(path.join(buildRoot, 'fuzz'), names, { seconds });
  say(`${passed} passed, ${failed} failed`);
  return failed > 0 ? 1 : 0;
});
