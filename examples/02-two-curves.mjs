// Two rings, one surface: a tube between them.
//   node 02-two-curves.mjs tube.obj      also writes it to a file
import { writeFileSync } from 'node:fs';
import { formatObj, load, spanLoops } from 'soapfilm';

await load();

const ring = (radius, z) =>
  Array.from({ length: 20 }, (_, i) => {
    const angle = (2 * Math.PI * i) / 20;
    return [radius * Math.cos(angle), radius * Math.sin(angle), z];
  });

// The loops' directions do not matter: the surface decides how they are passed through.
const span = spanLoops([ring(1, 0), ring(0.7, 0.8).reverse()], { weights: { area: 1 } });
if (!span.found) throw new Error(span.reason);

// n vertices and k loops always give n + 2k - 4 triangles.
console.log(`${span.triangles.length / 3} triangles, area ${span.terms.area.toFixed(4)}`);

const file = process.argv[2];
if (file) writeFileSync(file, formatObj(span));
