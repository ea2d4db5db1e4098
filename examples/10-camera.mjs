// A mesh that follows a camera: eight spheres, and an eye that flies past them. Each frame makes finer what has come near,
// coarser what is far, and tells what it has written.
import { load } from 'soapfilm';
import { TrimmedModel } from 'soapfilm/surfaces';

await load({ parts: ['surfaces'] });

// A sphere: a half circle around the axis, rational of degree 2. Without loops a face is all of its surface.
const h = Math.SQRT1_2;
const around = [[1, 0, 1], [1, 1, h], [0, 1, 1], [-1, 1, h], [-1, 0, 1], [-1, -1, h], [0, -1, 1], [1, -1, h], [1, 0, 1]];
const profile = [[0, -1, 1], [1, -1, h], [1, 0, 1], [1, 1, h], [0, 1, 1]];
const sphere = {
  faces: [
    {
      surface: {
        degreeU: 2,
        degreeV: 2,
        knotsU: [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4],
        knotsV: [0, 0, 0, 1, 1, 2, 2, 2],
        countU: 9,
        countV: 5,
        poles: around.flatMap(([x, y]) => profile.map(([r, z]) => [r * x, r * y, z])),
        weights: around.flatMap(([, , a]) => profile.map(([, , b]) => a * b)),
      },
    },
  ],
  edges: [],
};
const at = (x, y) => [1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, 0];
const row = new TrimmedModel({ instances: Array.from({ length: 8 }, (_, i) => ({ part: sphere, matrix: at(4 * i, 0) })) });

/** Looks along +y from a place, 60 degrees wide: projection times view, column by column. */
function cameraAt(x, y) {
  const f = 1 / Math.tan(Math.PI / 6);
  const [near, far] = [0.1, 1000];
  const [a, b] = [(far + near) / (near - far), (2 * far * near) / (near - far)];
  const rows = [
    [f, 0, 0, -f * x],
    [0, 0, f, 0],
    [0, -a, 0, a * y + b],
    [0, 1, 0, -y],
  ];
  return { eye: [x, y, 0], viewProjection: [0, 1, 2, 3].flatMap((column) => rows.map((r) => r[column])), width: 1000, height: 1000, pixels: 0.5 };
}

const count = (ranges) => ranges.reduce((sum, end, i) => sum + (i % 2 ? end : -end), 0);
const frames = 60;
let [changed, written, drawn] = [0, 0, 0];
for (let frame = 0; frame < frames; frame++) {
  const { mesh, faces, vertexRanges, indexRanges } = row.update({ camera: cameraAt((28 * frame) / (frames - 1), -4) });
  if (frame === 0) continue;
  changed += faces.length;
  written += 32 * count(vertexRanges) + 4 * count(indexRanges);
  // What is left of a face's room is filled with triangles of one vertex.
  for (let i = 0; i < mesh.triangles.length; i += 3) if (mesh.triangles[i] !== mesh.triangles[i + 1]) drawn++;
}
const mean = (sum) => sum / (frames - 1);
console.log(`${mean(drawn).toFixed(0)} triangles a frame`);
console.log(`${mean(changed).toFixed(1)} of 8 faces change, ${(mean(written) / 1024).toFixed(0)} KB are written`);
row.dispose();
