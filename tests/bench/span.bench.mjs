// Times spanLoops of the built package on the cases of cases.csv, as span.cpp does natively.
import { readFileSync } from 'node:fs';
import { load, parseLoops, spanLoops } from 'soapfilm';

const kLeastRuns = 5;
const kMostRuns = 50;
const kSecondsPerCase = 2;

const read = (name) => readFileSync(new URL(name, import.meta.url), 'utf8');

// FNV-1a of the triangles and of the cost to nine digits: the native program prints the same.
function checksum(span) {
  let hash = 2166136261;
  const add = (value) => {
    for (let shift = 0; shift < 32; shift += 8) {
      hash = Math.imul(hash ^ ((value >>> shift) & 255), 16777619);
    }
  };
  span.triangles.forEach(add);
  for (const digit of String(Number(span.cost.toPrecision(9)))) add(digit.charCodeAt(0));
  return (hash >>> 0).toString(16).padStart(8, '0');
}

function measure(title) {
  const [curves, candidates, area, perimeter, dihedral, objective] = title.split(',');
  const loops = parseLoops(read(`../fixtures/curves/${curves}.curve`));
  const weights = { area: Number(area), perimeter: Number(perimeter), dihedral: Number(dihedral) };
  const times = [];
  let spent = 0;
  let span;
  while (times.length < kLeastRuns || (spent < kSecondsPerCase && times.length < kMostRuns)) {
    const start = performance.now();
    span = spanLoops(loops, { candidates, weights, objective });
    times.push(performance.now() - start);
    spent += times.at(-1) / 1000;
  }
  times.sort((a, b) => a - b);
  const at = (share) => times[Math.floor(times.length * share)];
  const spread = (100 * (at(0.75) - at(0.25))) / at(0.5);
  const columns = [
    title.padEnd(42),
    `${at(0.5).toFixed(2).padStart(10)} ms`,
    `±${spread.toFixed(0).padStart(3)} %`,
    `${(span.stats.peakBytes / 1e6).toFixed(1).padStart(8)} MB`,
    span.found ? `cost ${String(Number(span.cost.toPrecision(9))).padEnd(12)} ${checksum(span)}` : span.reason,
  ];
  console.log(columns.join('  '));
}

await load();
const word = process.argv[2] ?? '';
const lines = read('cases.csv').split('\n');
for (const line of lines) {
  if (/^\w+,\w+,\d/.test(line) && line.includes(word)) measure(line);
}
