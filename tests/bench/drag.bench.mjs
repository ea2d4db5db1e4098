// The interactive case: one vertex of two loops is dragged, and each position is spanned in the package's
// worker, as the page does. Prints the round trips, in seconds, as one line of JSON.
//   node drag.bench.mjs curve-file
import { readFileSync } from 'node:fs';
import { parseLoops } from 'soapfilm';
import { createWorker } from 'soapfilm/worker';

const kSteps = 120;

const loops = parseLoops(readFileSync(process.argv[2]));
const film = await createWorker({ parts: ['loops'] });
const home = loops.positions.slice(0, 3);
const seconds = [];
let candidates;
for (let step = 0; step < kSteps; step++) {
  // A circle of a tenth of the loop's size, so that the surface has to change.
  const angle = (2 * Math.PI * step) / kSteps;
  const positions = loops.positions.slice();
  positions.set([home[0] + 0.1 * Math.cos(angle) - 0.1, home[1] + 0.1 * Math.sin(angle), home[2]]);
  const start = performance.now();
  const span = await film.spanLoops({ positions, starts: loops.starts }, { candidates: 'delaunay' });
  seconds.push((performance.now() - start) / 1000);
  if (!span.found || !span.optimal) throw new Error(`step ${step}: no optimal surface`);
  candidates = span.stats.candidates;
}
film.dispose();
console.log(JSON.stringify({ vertices: loops.positions.length / 3, candidates, seconds }));
