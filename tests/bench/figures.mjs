// Draws figures 7 to 9 of the paper anew from the benchmark's results.
//   node figures.mjs results.json folder
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { load, parseLoops, spanLoops } from 'soapfilm';
import { count, drawing, histogram, legend, logLog, surface, text } from './plot.mjs';
import { fitPower, optimality } from './report.mjs';

const results = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const folder = process.argv[3];

const inkOf = (k) => `k${k}`;

function timeTick(seconds) {
  if (seconds >= 1) return `${seconds} s`;
  if (seconds >= 0.999e-3) return `${+(1000 * seconds).toPrecision(2)} ms`;
  return `${+(1e6 * seconds).toPrecision(2)} µs`;
}

function memoryTick(bytes) {
  if (bytes >= 0.999e6) return `${+(bytes / 1e6).toPrecision(5)} MB`;
  return `${+(bytes / 1e3).toPrecision(2)} kB`;
}

const measured = (series) => results.cases.filter((c) => c.series === series && c.wasm?.median);
const authors = (k, space) =>
  results.cases.filter((c) => c.authors && c.k === k && c.space === space && c.weights[2] === 1);

/** The marks of one series for one quantity: ours in WebAssembly, ours natively, the authors'. */
function curves({ series, ink, label, k, space }, value, authorsValue) {
  const cases = measured(series);
  const points = cases.map((c) => [c.n, value(c.wasm)]).filter(([, v]) => v > 0);
  const native = cases.filter((c) => c.native?.median).map((c) => [c.n, value(c.native)]);
  const isWork = cases.filter((c) => c.wasm.median >= 0.5e-3).map((c) => [c.n, value(c.wasm)]);
  const exponent = fitPower(isWork)?.exponent;
  const ours = { points, ink, mark: 'line', label: { text: label, exponent } };
  const parts = [{ points: native, ink, mark: 'dotted' }, ours];
  if (k) {
    const theirs = authors(k, space).map((c) => [c.n, authorsValue(c.authors)]);
    parts.push({ points: theirs, ink, mark: 'diamond' });
  }
  return parts;
}

const kTime = [(s) => s.median, (a) => a.seconds];
const kMemory = [(s) => s.peakBytes, (a) => 1e6 * a.megabytes];

const kLegend = [
  { ink: 'k1', mark: 'line', text: 'soapfilm in WebAssembly' },
  { ink: 'k1', mark: 'dotted', text: 'soapfilm, native' },
  { ink: 'k1', mark: 'diamond', text: "the paper authors' program, native" },
];

function pictures() {
  return results.pictures.map((file) => {
    const options = { candidates: 'delaunay', weights: { dihedral: 1 } };
    const span = spanLoops(parseLoops(readFileSync(file)), options);
    if (!span.found) throw new Error(`${file}: no surface to show`);
    return span;
  });
}

function figure7(shown) {
  const all = [
    { series: 'monkey 1 all dihedral', ink: 'k2', label: '', k: 1, space: 'all' },
    { series: 'monkey 1 all area', ink: 'k4', label: '' },
  ];
  const sparse = [{ series: 'monkey 1 delaunay dihedral', ink: 'k2', label: '', k: 1, space: 'delaunay' }];
  const panel = (at, title, list, [value, theirs], format) =>
    logLog({
      ...at,
      width: 330,
      height: 250,
      title,
      xLabel: 'vertices',
      format,
      series: list.flatMap((s) => curves(s, value, theirs)),
    });
  return drawing(920, 610, 'One curve: a monkey saddle of n vertices (figure 7)', [
    legend(20, 56, kLegend),
    surface(shown[0], { x: 24, y: 150, size: 180, from: [1.1, -1, 1.2] }),
    text(114, 372, '48 vertices, least dihedral sum', 'm'),
    legend(40, 410, [{ ink: 'k2', mark: 'line', text: 'dihedral' }]),
    legend(40, 430, [{ ink: 'k4', mark: 'line', text: 'area' }]),
    panel({ x: 230, y: 80 }, 'All triples: time', all, kTime, timeTick),
    panel({ x: 575, y: 80 }, 'All triples: memory', all, kMemory, memoryTick),
    panel({ x: 230, y: 345 }, 'Delaunay facets: time', sparse, kTime, timeTick),
    panel({ x: 575, y: 345 }, 'Delaunay facets: memory', sparse, kMemory, memoryTick),
  ]);
}

function figure8(shown) {
  const listed = (space, numbers) =>
    numbers.map((k) => ({ series: `saddles ${k} ${space} dihedral`, ink: inkOf(k), label: '', k, space }));
  const row = (y, title, list) => {
    const size = { width: 326, height: 250, xLabel: 'vertices of all curves' };
    const at = (column) => ({ x: 14 + 326 * column, y, ...size });
    const of = (value, theirs) => list.flatMap((s) => curves(s, value, theirs));
    const counted = (series, key) =>
      measured(series)
        .map((c) => [c.n, c.wasm[key]])
        .filter(([, v]) => v > 0);
    const counts = list.flatMap(({ series, ink }) => [
      { points: counted(series, 'domains'), ink, mark: 'line' },
      { points: counted(series, 'minimalSets'), ink, mark: 'dotted' },
    ]);
    return [
      logLog({ ...at(0), title: `${title}: time`, format: timeTick, series: of(...kTime) }),
      logLog({ ...at(1), title: `${title}: memory`, format: memoryTick, series: of(...kMemory) }),
      logLog({ ...at(2), title: `${title}: domains, minimal sets`, format: count, series: counts }),
    ];
  };
  const isCut = results.cases.some((c) => /^saddles \d/.test(c.series ?? '') && c.wasm?.problem);
  const note = isCut ? 'lines end where larger sizes take more than 30 s' : '';
  return drawing(1000, 800, 'Several curves: saddles at the corners of an octahedron (figure 8)', [
    legend(20, 56, kLegend),
    text(980, 28, note, 'e'),
    text(980, 56, 'right column: domains, minimal sets dotted', 'e'),
    ...shown.slice(1).flatMap((span, i) => {
      const x = 28 + 198 * i;
      const caption = [{ ink: inkOf(i + 2), mark: 'line', text: `${i + 2} curves` }];
      return [surface(span, { x, y: 72, size: 150, from: [1.5, 1.1, 0.8] }), legend(x + 40, 248, caption)];
    }),
    ...row(272, 'All triples', listed('all', [2, 3])),
    ...row(535, 'Delaunay facets', listed('delaunay', [2, 3, 4, 5, 6])),
  ]);
}

/** At most twelve bins of a round width from below `low` to `high` or above. */
function roundEdges(low, high) {
  const width = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5].find((w) => (high - low) / w <= 11);
  const first = Math.floor(low / width + 1e-9);
  const last = Math.ceil(high / width - 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * width);
}

function figure9() {
  const { single, pairs } = results.optimality;
  const sets = (rows, weight) =>
    [['delaunay', 'k2'], ['near', 'k5']].map(([space, ink]) => ({
      ink,
      values: rows
        .filter((r) => r.weight === weight)
        .map((r) => optimality(r, space))
        .filter((v) => v !== null),
    }));
  const panel = (x, y, rows, kind, weight) => {
    const isArea = weight === 'area';
    const values = sets(rows, weight).flatMap((set) => set.values);
    const [low, high] = isArea ? [Math.min(0.9, ...values), 1] : [0, Math.max(2, ...values)];
    return histogram({
      x,
      y,
      width: 430,
      height: 235,
      title: `${kind}: ${weight}`,
      xLabel: isArea
        ? 'area of the optimum among all triples / area found'
        : 'degrees above the optimum, per interior edge',
      edges: roundEdges(low, high),
      format: (v) => String(Math.round(100 * v) / 100),
      sets: sets(rows, weight),
    });
  };
  const isMissing = (r) => r.weight === 'area' && r.delaunay.cost === null;
  const missing = [...single, ...pairs].filter(isMissing).length;
  const note = missing > 0 ? `; ${missing} have no surface of Delaunay facets` : '';
  return drawing(900, 590, 'What smaller candidate spaces cost (figure 9)', [
    legend(20, 56, [
      { ink: 'k2', mark: 'bar', text: 'Delaunay facets' },
      { ink: 'k5', mark: 'bar', text: 'near triples' },
    ]),
    text(300, 56, `random loops on closed surfaces, ${single.length / 2} inputs each${note}`),
    panel(10, 80, single, 'One loop of 100 to 200 vertices', 'area'),
    panel(455, 80, pairs, 'Two loops of 10 to 20 vertices', 'area'),
    panel(10, 335, single, 'One loop of 100 to 200 vertices', 'dihedral'),
    panel(455, 335, pairs, 'Two loops of 10 to 20 vertices', 'dihedral'),
  ]);
}

await load({ parts: ['loops'] });
const shown = pictures();
const files = {
  'figure-7-one-curve.svg': figure7(shown),
  'figure-8-several-curves.svg': figure8(shown),
  'figure-9-optimality.svg': figure9(),
};
for (const [name, svg] of Object.entries(files)) writeFileSync(path.join(folder, name), svg);
