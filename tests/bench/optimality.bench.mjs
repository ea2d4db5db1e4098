// How near to the optimum among all triples the smaller candidate spaces come (section 4.2 of the paper,
// figure 9). Prints one line of JSON: for each curve file and weight the costs in each space.
//   node optimality.bench.mjs curve-file...
import { readFileSync } from 'node:fs';
import { load, parseLoops, spanLoops } from 'soapfilm';

const kSpaces = ['all', 'delaunay', 'near'];
const kWeights = { area: { area: 1 }, dihedral: { dihedral: 1 } };

function spanIn(candidates, loops, weights) {
  const start = performance.now();
  const span = spanLoops(loops, { candidates, weights });
  const seconds = (performance.now() - start) / 1000;
  return { cost: span.found ? span.cost : null, seconds };
}

await load({ parts: ['loops'] });
const rows = process.argv.slice(2).flatMap((file) => {
  const loops = parseLoops(readFileSync(file));
  const [k, n] = [loops.starts.length - 1, loops.starts.at(-1)];
  return Object.entries(kWeights).map(([weight, weights]) => ({
    weight,
    interiorEdges: n + 3 * k - 6,
    ...Object.fromEntries(kSpaces.map((space) => [space, spanIn(space, loops, weights)])),
  }));
});
console.log(JSON.stringify(rows));
