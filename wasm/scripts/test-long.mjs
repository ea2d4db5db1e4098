// npm run test:long [-- tidy | word…]: C++ tests that take longer than `npm test` may, optimised, CGAL as an
// oracle; and clang-tidy. `tidy` is clang-tidy alone, other words are parts of the names of tests.
import path from 'node:path';
import { buildPreset } from './build.mjs';
import { choose, cppTests } from './cpp.mjs';
import { buildRoot, main, say } from './run.mjs';
import { Summary, clangTidy } from './suites.mjs';
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
  const words = process.argv.slice(2);
  if (paths.clangTidy && (words.length === 0 || words.includes('tidy'))) {
    const tree = path.join(buildRoot, 'native-long');
    await summary.suite('clang-tidy', () => clangTidy(paths.clangTidy, tree));
  }
  const others = words.filter((word) => word !== 'tidy');
  if (words.length === 0 || others.length > 0) {
    const choice = choose(others, { isLong: true });
    await summary.suite('long C++ tests', () => cppTests('native-long', choice, { isLong: true }));
  }
  return summary.finish();
});
