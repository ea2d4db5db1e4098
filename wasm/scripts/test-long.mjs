// npm run test:long: C++ tests that take longer than `npm test` may, optimised, CGAL as an oracle;
// and clang-tidy.
import path from 'node:path';
import { buildPreset } from './build.mjs';
import { buildRoot, main, say } from './run.mjs';
import { Summary, clangTidy, doctest } from './suites.mjs';
import { checkNode, ensureTools } from './tools.mjs';

await main(async () => {
  checkNode();
  const { paths, missing } = await ensureTools([
    'cmake',
    'ninja',
    'compiler',
    'doctest',
    'cgal',
    'clangTidy',
  ]);
  const summary = new Summary();
  for (const tool of missing) summary.notes.push(`${tool} was not found: what needs it was LEFT OUT`);
  await buildPreset('native-long');
  say('');
  if (paths.clangTidy) {
    const tree = path.join(buildRoot, 'native-long');
    await summary.suite('clang-tidy', () => clangTidy(paths.clangTidy, tree));
  }
  const program = path.join(buildRoot, 'native-long/soapfilm_long_tests');
  await summary.suite('long C++ tests', () =>
    doctest(program, { seconds: 7200, args: process.argv.slice(2) }),
  );
  return summary.finish();
});
