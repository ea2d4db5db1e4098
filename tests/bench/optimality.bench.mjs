// How near to the optimum among all triples the smaller candidate spaces come (section 4.2 of the paper,
// figure 9). Prints one line of JSON: for each curve file and weight the costs in each space, and the
// processor's seconds.
//   node optimality.bench.mjs area,dihedral,default curve-file...
import { readFileSync } from 'node:fs';
import { load, parseLoops, spanLoops } from 'soapfilm';

const kSpaces = ['all', 'delaunay', 'near'];
const kWeights = { area: { area: 1 }, dihedral: { dihedral: 1 }, default: undefined };

function spanIn(candidates, loops, weights) {
  const start = process.cpuUsage();
  const span = spanLoops(loops, { candidates, ...(weights && { weights }) });
  const { user, system } = process.cpuUsage(start);
  return { cost: span.found ? span.cost : null, seconds: (user + system) / 1e6 };
}

await load({ parts: ['loops'] });
const [names, ...files] = process.argv.slice(2);
// A while before, so that the engine has compiled what is measured.
const kWarmUpSeconds = 1;
for (const space of kSpaces)
  for (let spent = 0, i = 0; spent < kWarmUpSeconds && i < 10 * files.length; ++i)
    spent += spanIn(space, parseLoops(readFileSync(files[i % files.length]))).seconds;
const rows = files.flatMap((file) => {
  const loops = parseLoops(readFileSync(file));
  const [k, n] = [loops.starts.length - 1, loops.starts.at(-1)];
  return names.split(',').map((weight) => ({
    weight,
    n,
    interiorEdges: n + 3 * k - 6,
    ...Object.fromEntries(kSpaces.map((space) => [space, spanIn(space, loops, kWeights[weight])])),
  }));
});
console.log(JSON.stringify(rows));
