// Soap films: between two rings the surface of least area is a catenoid, as long as they are not too far apart.
//   node 08-soap-film.mjs film.obj      also writes it to a file
import { writeFileSync } from 'node:fs';
import { formatObj, load, smoothSurface, spanLoops } from 'soapfilm';

await load({ parts: ['loops', 'meshes'] });

const ring = (z) =>
  Array.from({ length: 96 }, (_, i) => {
    const angle = (2 * Math.PI * i) / 96;
    return [Math.cos(angle), Math.sin(angle), z];
  });

/** The film between two rings of radius 1, as far apart as `height`. */
function filmBetween(height) {
  // Any surface to begin with: the film keeps its rims, and is refined inside.
  const span = spanLoops([ring(-height / 2), ring(height / 2)], { candidates: 'delaunay' });
  if (!span.found) throw new Error(span.reason);
  return smoothSurface(span, { kind: 'soap-film', maxNewVertices: 2000 });
}

const height = 0.8;
const film = filmBetween(height);
console.log(`${film.triangles.length / 3} triangles of area ${film.area.toFixed(4)}, at rest: ${film.isMinimal}`);

// The catenoid r = c cosh(z / c) through the rings; of the two values of c the larger.
let [low, high] = [0.6, 1];
for (let i = 0; i < 60; i++) {
  const c = (low + high) / 2;
  if (c * Math.cosh(height / 2 / c) < 1) low = c;
  else high = c;
}
let most = 0;
for (let v = film.boundary.length; v < film.positions.length / 3; v++) {
  const [x, y, z] = film.positions.subarray(3 * v, 3 * v + 3);
  most = Math.max(most, Math.abs(Math.hypot(x, y) - low * Math.cosh(z / low)));
}
console.log(`off the catenoid by ${most.toFixed(5)} at most`);

// Rings farther apart than 1.3255 radii have no film between them: the neck shrinks to a thread.
const { collapsed } = filmBetween(2);
console.log(`rings 2 apart: ${collapsed.length > 0 ? 'no film between them' : 'a film'}`);

const file = process.argv[2];
if (file) writeFileSync(file, formatObj(film, { name: 'catenoid' }));
