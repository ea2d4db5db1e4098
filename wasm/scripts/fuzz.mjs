// npm run fuzz [-- seconds]: runs each libFuzzer program of tests/cpp/fuzz for that long (600 s).
// A failing input is left in wasm/build/fuzz/found.
import path from 'node:path';
import { buildPreset } from './build.mjs';
import { Failure, buildRoot, main, say } from './run.mjs';
import { fuzz } from './suites.mjs';
import { checkNode, ensureTools } from './tools.mjs';

await main(async () => {
  checkNode();
  const seconds = Number(process.argv[2] ?? 600);
  if (!(seconds > 0)) throw new Failure('fuzz: the argument is the number of seconds for each program');
  const { missing } = await ensureTools(['cmake', 'ninja', 'clang', 'fuzzer']);
  if (missing.length > 0) throw new Failure(`fuzz: ${missing.join(' and ')} not found`);
  await buildPreset('fuzz');
  const { passed, failed } = await fuzz(path.join(buildRoot, 'fuzz'), seconds, { explores: true });
  say(`${passed} passed, ${failed} failed`);
  return failed > 0 ? 1 : 0;
});
