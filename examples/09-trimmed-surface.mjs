// Trimmed surfaces: a bicubic dome with a round window, meshed to a tolerance, then edited.
//   node 09-trimmed-surface.mjs dome.obj      also writes it to a file
import { writeFileSync } from 'node:fs';
import { formatObj, load } from 'soapfilm';
import { TrimmedSurface } from 'soapfilm/surfaces';

await load({ parts: ['surfaces'] });

// A bicubic Bézier patch of 4 × 4 poles: flat but for the four in the middle.
const ends = [0, 0, 0, 0, 1, 1, 1, 1];
const four = [0, 1, 2, 3];
const surface = {
  degreeU: 3,
  degreeV: 3,
  knotsU: ends,
  knotsV: ends,
  countU: 4,
  countV: 4,
  poles: four.flatMap((i) => four.map((j) => [i, j, i % 3 && j % 3 ? 2 : 0])),
};

/** A circle in the domain, of four quarters: rational of degree 2. */
function circle([x, y], radius) {
  const around = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
  return {
    degree: 2,
    knots: [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4],
    poles: around.map(([u, v]) => [x + radius * u, y + radius * v]),
    weights: around.map((_, k) => (k % 2 ? Math.SQRT1_2 : 1)),
  };
}
const side = (from, to) => ({ degree: 1, knots: [0, 0, 1, 1], poles: [from, to] });

// Each edge is used once here, so it needs no curve in space: it lies where the surface has it.
const corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
const dome = new TrimmedSurface({
  surface,
  edges: [...corners.map(() => ({ range: [0, 1] })), { range: [0, 4] }],
  loops: [
    { uses: corners.map((corner, k) => ({ edge: k, pcurve: side(corner, corners[(k + 1) % 4]) })) },
    { uses: [{ edge: 4, pcurve: circle([0.5, 0.5], 0.2) }] },
  ],
});

for (const tolerance of [0.1, 0.01, 0.001]) {
  const { triangles, deviation } = dome.tessellate({ tolerance });
  console.log(`within ${tolerance}: ${triangles.length / 3} triangles, off by ${deviation.toPrecision(2)} at most`);
}

// A pole is pulled up, and the window moves along with the next update.
dome.movePole(0, 5, [1, 1, 4]);
const { mesh, faces } = dome.update({ tolerance: 0.01 });
console.log(`after the move: ${faces.length} face changed, off by ${mesh.deviation.toPrecision(2)} at most`);

// A move after which the window would reach across the outer loop is refused.
try {
  dome.moveTrim(0, 1, 0, 2, [0.5, 1.9]);
} catch ({ code, message }) {
  console.log(`refused: ${code}. ${message}`);
}

const file = process.argv[2];
if (file) {
  const { positions, triangles } = dome.tessellate({ tolerance: 0.01 });
  writeFileSync(file, formatObj({ positions, triangles }, { name: 'dome' }));
}
dome.dispose();
