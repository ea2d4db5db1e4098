// Which triangles may be used: every triple, the Delaunay facets, or a list of your own.
import { load, spanLoops } from 'soapfilm';

await load();

const square = (z) => [
  [0, 0, z],
  [1, 0, z],
  [1, 1, z],
  [0, 1, z],
];
const loops = [square(0), square(1)];
const weights = { area: 1, dihedral: 0.1 };

for (const candidates of ['all', 'delaunay']) {
  const span = spanLoops(loops, { weights, candidates });
  const result = span.found ? `cost ${span.cost.toFixed(4)}` : span.reason;
  console.log(`${candidates}: ${span.stats.candidates} candidates, ${result}`);
}

// The walls of the cube, and nothing else: one diagonal a wall, so there is one answer.
const walls = [0, 1, 2, 3].flatMap((i) => {
  const j = (i + 1) % 4;
  return [i, j, 4 + i, j, 4 + j, 4 + i];
});
const cube = spanLoops(loops, { weights, candidates: { triangles: Uint32Array.from(walls) } });
console.log(`own list: ${cube.found ? `area ${cube.terms.area.toFixed(4)}` : cube.reason}`);

// With a wall taken away no surface is left. That is an answer, not an error.
const open = spanLoops(loops, { weights, candidates: { triangles: Uint32Array.from(walls.slice(6)) } });
console.log(`a wall less: found is ${open.found}`);
