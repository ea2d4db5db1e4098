// npm run fuzz [-- seconds]: runs each libFuzzer program of tests/cpp/fuzz for that long (60 s).
// A failing input is left in wasm/build/fuzz/found.
import { mkdirSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { buildPreset } from './build.mjs';
import { Failure, buildRoot, main, run, say } from './run.mjs';
import { checkNode, ensureTools } from './tools.mjs';

await main(async () => {
  checkNode();
  const seconds = Number(process.argv[2] ?? 60);
  if (!(seconds > 0)) throw new Failure('fuzz: the argument is the number of seconds for each program');
  await ensureTools(['cmake', 'ninja', 'clang']);
  await ensureTools(['fuzzer']);
  await buildPreset('fuzz');
  const folder = path.join(buildRoot, 'fuzz');
  const programs = readdirSync(folder).filter((name) => /^fuzz_\w+$/.test(name));
  if (programs.length === 0) throw new Failure('tests/cpp/fuzz holds no fuzzer');
  const found = path.join(folder, 'found/');
  mkdirSync(found, { recursive: true });
  let failed = 0;
  for (const name of programs) {
    const corpus = path.join(folder, `corpus_${name}`);
    mkdirSync(corpus, { recursive: true });
    say(`· ${name}, ${seconds} s`);
    const args = [corpus, `-max_total_time=${seconds}`, `-artifact_prefix=${found}`, '-print_final_stats=1', '-timeout=30'];
    const { code } = await run(path.join(folder, name), args, { allowFailure: true });
    if (code !== 0) failed += 1;
  }
  say(`${programs.length - failed} passed, ${failed} failed`);
  return failed > 0 ? 1 : 0;
});
