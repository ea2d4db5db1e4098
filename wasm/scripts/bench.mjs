// npm run bench [-- filter… | --figures | --draw]: measures the cases of tests/bench, natively and in
// WebAssembly in the same run, and writes the results as JSON into the build tree.
//   filter     only the cases whose name holds all these words
//   --figures  all cases and the suites of smaller spaces; then draws the figures and the README's table anew
//   --draw     draws them from the last results
// npm run bench -- polygons [filter… | --figures]: triangulators of polygons, ours and others; with --figures
// all cases, and the README's table of them anew.
// npm run bench -- holes [words… | --figures]: holes of meshes; of those in ../shared/data/holes, if there are any.
// npm run bench -- surfaces [words… | --figures]: trimmed surfaces; of those in ../shared/data/nurbs, if there are any.
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { availableParallelism, loadavg } from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import {
  disagreement,
  dragLines,
  fitLines,
  fitSeries,
  goalLines,
  kHeading,
  nearLines,
  optimalityLines,
  readmeTable,
  row,
  summary,
  transferLines,
} from '../../tests/bench/report.mjs';
import { holeTable } from '../../tests/bench/hole_report.mjs';
import { polygonTable } from '../../tests/bench/polygon_report.mjs';
import { surfaceTable } from '../../tests/bench/surface_report.mjs';
import { buildLibrary, buildPreset } from './build.mjs';
import { Failure, buildRoot, main, root, run, say } from './run.mjs';
import { checkNode, ensureTools } from './tools.mjs';

const bench = path.join(root, 'tests/bench');
const figures = path.join(bench, 'figures');
const folder = path.join(buildRoot, 'bench');
const results = path.join(folder, 'results.json');
/** A module of tests/bench as one that this Node can run; returns where. */
async function compiled(name) {
  const { build } = await import('esbuild');
  const outfile = path.join(folder, `${name}.mjs`);
  await build({
    entryPoints: [path.join(bench, `${name}.ts`)],
    bundle: true,
    platform: 'node',
    format: 'esm',
    packages: 'external',
    outfile,
    logLevel: 'warning',
  });
  return outfile;
}

/** Writes loops as a curve file, every digit kept; returns where. */
function writeCurves(name, loops) {
  const file = path.join(folder, 'curves', `${name}.curve`);
  const lines = [loops.length, loops.flat().length];
  for (const loop of loops) lines.push(loop.length, ...loop.map((point) => point.join(' ')));
  mkdirSync(path.dirname(file), { recursive: true });
  writeFileSync(file, `${lines.join('\n')}\n`);
  return file;
}

/** What the one line of JSON of a measuring program comes to, or how it failed. */
async function measured(program, args) {
  const { code, output } = await run(program, args, { capture: true, allowFailure: true });
  if (code === 0) return summary(JSON.parse(output));
  say(output.trimEnd());
  return { problem: 'FAILED' };
}

async function measureCase(c) {
  const { loops, ...facts } = c;
  const curves = loops ? writeCurves(c.curves, loops) : path.join(root, 'tests', c.curves);
  const { space, objective, weights, bestSoFar = null } = c;
  const native = path.join(buildRoot, 'native-release/soapfilm_bench');
  const numbers = (weights ?? [NaN, 0, 1]).map(String);
  const question = JSON.stringify({ curves, space, objective, weights, bestSoFar });
  return {
    ...facts,
    native: bestSoFar ? null : await measured(native, [curves, space, objective, ...numbers]),
    wasm: await measured(process.execPath, [path.join(bench, 'span.bench.mjs'), question]),
  };
}

async function measureDrag(loops) {
  const args = [path.join(bench, 'drag.bench.mjs'), writeCurves('drag', loops)];
  return JSON.parse((await run(process.execPath, args, { capture: true })).output);
}

async function measureTransfer() {
  const args = [path.join(bench, 'transfer.bench.mjs')];
  return JSON.parse((await run(process.execPath, args, { capture: true })).output);
}

/** Costs in the candidate spaces. Where times do not matter a process for each processor. */
async function measureOptimality(loopSets, name, weights, count = 1) {
  const files = loopSets.map((loops, i) => writeCurves(`${name}_${i}`, loops));
  const shares = Array.from({ length: count }, (_, part) => files.filter((_, i) => i % count === part));
  const program = path.join(bench, 'optimality.bench.mjs');
  const runs = shares.map((share) => run(process.execPath, [program, weights, ...share], { capture: true }));
  return (await Promise.all(runs)).flatMap(({ output }) => JSON.parse(output));
}

function print(title, lines) {
  if (lines.length > 0) say(`\n${title ? `${title}\n` : ''}${lines.join('\n')}`);
}

async function measure(words, wantsAll) {
  const wanted = (name) => words.every((word) => name.includes(word));
  await buildPreset('native-release');
  await buildLibrary();
  mkdirSync(folder, { recursive: true });
  const { allCases, dragLoops, noisyLoops, optimalityLoops, pictureLoops } = await import(
    pathToFileURL(await compiled('cases')).href
  );
  const found = { node: process.versions.node, processors: availableParallelism(), load: [loadavg()[0]] };
  found.cases = [];
  const chosen = allCases().filter((c) => wanted(c.id));
  if (chosen.length > 0) say(kHeading);
  for (const c of chosen) {
    found.cases.push(await measureCase(c));
    say(row(found.cases.at(-1)));
  }
  found.fits = fitSeries(found.cases);
  print('', found.fits.length > 0 ? fitLines(found.fits) : []);
  print('', goalLines(found.cases));
  if (wanted('drag 2x40 delaunay')) {
    found.drag = await measureDrag(dragLoops());
    print('', dragLines(found.drag));
  }
  if (wanted('transfer to a worker')) {
    found.transfer = await measureTransfer();
    print('', transferLines(found.transfer));
  }
  if (wantsAll || (words.length > 0 && wanted('optimality'))) {
    found.optimality = {};
    for (const kind of ['single', 'pairs']) {
      const [loops, name] = [optimalityLoops(kind, 100), `optimality_${kind}`];
      found.optimality[kind] = await measureOptimality(loops, name, 'area,dihedral', found.processors);
    }
    print('', optimalityLines(found.optimality));
  }
  if (wantsAll || (words.length > 0 && wanted('near noisy'))) {
    found.near = {
      single: await measureOptimality(noisyLoops('single', 120), 'noisy_single', 'default,dihedral'),
      pairs: await measureOptimality(noisyLoops('pairs', 120), 'noisy_pair', 'default,dihedral,area'),
      'larger pairs': await measureOptimality(
        noisyLoops('larger pairs', 40),
        'noisy_larger_pair',
        'default,dihedral,area',
      ),
    };
    print('', nearLines(found.near));
  }
  found.pictures = pictureLoops().map((loops, i) => writeCurves(`picture_${i}`, loops));
  found.load.push(loadavg()[0]);
  writeFileSync(results, `${JSON.stringify(found, null, 1)}\n`);
  const load = found.load.map((l) => l.toFixed(1)).join(' to ');
  say(`\nLoad ${load} on ${found.processors} processors, Node ${found.node}.`);
  say(`Written: ${path.relative(root, results)}`);
  if (chosen.length === 0 && !found.drag && !found.transfer && !found.optimality && !found.near) {
    throw new Failure('No case has that name.');
  }
  const isBroken = (c) => [c.native, c.wasm].some((side) => side?.problem === 'FAILED');
  const failed = found.cases.filter((c) => disagreement(c) || isBroken(c));
  if (failed.length > 0) throw new Failure(`Failed or not alike: ${failed.map((c) => c.id).join(', ')}`);
}

/** The figures as SVG and PNG, and the README's table. */
async function draw() {
  if (!existsSync(results)) throw new Failure('There are no results to draw: npm run bench -- --figures');
  const found = JSON.parse(readFileSync(results, 'utf8'));
  if (!found.optimality) throw new Failure('The last run left cases out: npm run bench -- --figures');
  mkdirSync(figures, { recursive: true });
  await run(process.execPath, [path.join(bench, 'figures.mjs'), results, figures]);
  await takePictures();
  intoReadme('npm run bench -- --figures', readmeTable(found));
  say(`Written: ${path.relative(root, figures)}, README.md`);
}

/** Puts a table between the README's marks for what measures it. */
function intoReadme(command, table) {
  const readme = path.join(root, 'README.md');
  const [mark, end] = [`<!-- ${command} -->\n`, '\n<!-- end -->'];
  const text = readFileSync(readme, 'utf8');
  const from = text.indexOf(mark) + mark.length;
  const to = text.indexOf(end, from);
  if (from < mark.length || to < 0) throw new Failure(`README.md has lost its marks for ${command}`);
  writeFileSync(readme, text.slice(0, from) + table + text.slice(to));
}

async function takePictures() {
  const { paths } = await ensureTools(['chromium']);
  const { chromium } = await import('@playwright/test');
  const browser = await chromium.launch({
    executablePath: paths.chromium,
    args: process.getuid?.() === 0 ? ['--no-sandbox'] : [],
  });
  try {
    const page = await browser.newPage({ deviceScaleFactor: 1.5, colorScheme: 'light' });
    for (const name of readdirSync(figures).filter((file) => file.endsWith('.svg'))) {
      const svg = readFileSync(path.join(figures, name), 'utf8');
      await page.setContent(`<body style="margin:0">${svg}</body>`);
      await page.locator('svg').screenshot({ path: path.join(figures, name.replace('.svg', '.png')) });
    }
  } finally {
    await browser.close();
  }
}

async function measurePolygons(words) {
  await buildLibrary();
  mkdirSync(folder, { recursive: true });
  const module = await compiled('polygon_cases');
  const file = path.join(folder, 'polygons.json');
  const wanted = words.filter((word) => word !== '--figures');
  await run(process.execPath, [path.join(bench, 'polygon.bench.mjs'), module, file, ...wanted]);
  say(`\nWritten: ${path.relative(root, file)}`);
  if (words.length === wanted.length) return;
  if (wanted.length > 0) throw new Failure('The table is of all cases: npm run bench -- polygons --figures');
  intoReadme('npm run bench -- polygons --figures', polygonTable(JSON.parse(readFileSync(file, 'utf8'))));
  say('Written: README.md');
}

/** What is measured on the files of ../shared/data, where these are there: the folder, and the README's table of the results. */
const kOnFiles = { holes: { data: 'holes', table: holeTable }, surfaces: { data: 'nurbs', table: surfaceTable } };

async function measureOnFiles(name, words) {
  const { data, table } = kOnFiles[name];
  await buildLibrary();
  mkdirSync(folder, { recursive: true });
  const file = path.join(folder, `${name}.json`);
  const wanted = words.filter((word) => word !== '--figures');
  // In a clone, and in a worktree.
  const files = ['../shared', '../../shared'].map((shared) => path.join(root, shared, 'data', data)).find(existsSync);
  await run(process.execPath, ['--stack-size=4000', path.join(bench, `${name}.bench.mjs`), files ?? '-', file, ...wanted]);
  say(`\nWritten: ${path.relative(root, file)}`);
  if (words.length === wanted.length) return;
  const command = `npm run bench -- ${name} --figures`;
  if (wanted.length > 0 || files === undefined) throw new Failure(`The table is of all files of ../shared/data/${data}: ${command}`);
  intoReadme(command, table(JSON.parse(readFileSync(file, 'utf8'))));
  say('Written: README.md');
}

await main(async () => {
  checkNode();
  await ensureTools(['emcc', 'cmake', 'ninja', 'compiler']);
  const words = process.argv.slice(2);
  if (words[0] === 'polygons') return measurePolygons(words.slice(1));
  if (words[0] in kOnFiles) return measureOnFiles(words[0], words.slice(1));
  const wants = (flag) => words.includes(flag);
  if (!wants('--draw')) await measure(words.filter((word) => !word.startsWith('--')), wants('--figures'));
  if (wants('--draw') || wants('--figures')) await draw();
});
