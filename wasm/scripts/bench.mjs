// npm run bench [-- filter]: the native benchmark program and those of the packaged core in Node.
// Both print median, spread and a checksum for each case of tests/bench.
import { existsSync } from 'node:fs';
import path from 'node:path';
import { buildLibrary, buildPreset } from './build.mjs';
import { Failure, buildRoot, main, root, run, say } from './run.mjs';
import { listFiles } from './stamp.mjs';
import { checkNode, ensureTools } from './tools.mjs';

await main(async () => {
  checkNode();
  await ensureTools(['emcc', 'cmake', 'ninja', 'compiler']);
  const filter = process.argv.slice(2);
  let ran = 0;
  await buildPreset('native-release');
  const native = path.join(buildRoot, 'native-release/soapfilm_bench');
  if (existsSync(native)) {
    say('Native:');
    await run(native, filter);
    ran += 1;
  }
  await buildLibrary();
  for (const file of listFiles(['tests/bench'], (name) => name.endsWith('.bench.mjs'))) {
    say(`WebAssembly in Node ${process.versions.node}, ${path.basename(file)}:`);
    await run(process.execPath, [path.join(root, file), ...filter]);
    ran += 1;
  }
  if (ran === 0) throw new Failure('tests/bench holds no benchmark');
});
