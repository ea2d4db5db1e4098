// Meshes: a torus with three regions missing is closed, so that one cannot tell where they were.
//   node 07-fill-holes.mjs torus.obj      also writes it to a file
import { writeFileSync } from 'node:fs';
import { fillHoles, findHoles, load } from 'soapfilm';

await load({ parts: ['meshes'] });

const [R, r, across, around] = [1, 0.4, 48, 24];

/** The torus without the faces whose middle, in turns around it, is in a region. */
function torusWithout(isGone) {
  const [positions, faces] = [[], []];
  for (let i = 0; i < across; i++) {
    for (let j = 0; j < around; j++) {
      const [u, v] = [(2 * Math.PI * i) / across, (2 * Math.PI * j) / around];
      const radius = R + r * Math.cos(v);
      positions.push(radius * Math.cos(u), radius * Math.sin(u), r * Math.sin(v));
      if (isGone((i + 0.5) / across, (j + 0.5) / around)) continue;
      const at = (di, dj) => ((i + di) % across) * around + ((j + dj) % around);
      faces.push(at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1));
    }
  }
  return { positions: Float64Array.from(positions), faces: Uint32Array.from(faces) };
}

/** The distance of a place from another, both in turns around the torus, in lengths on its outside. */
const far = (u, v, u0, v0) => Math.hypot((R + r) * 2 * Math.PI * (u - u0), r * 2 * Math.PI * (v - v0));

const torus = torusWithout((u, v) => {
  const disc = far(u, v, 0.5, 0.25) < 0.35;
  const ring = far(u, v, 0.25, 0.25) < 0.6 && far(u, v, 0.25, 0.25) > 0.25;
  const band = u > 0.8 && u < 0.88;
  return disc || ring || band;
});

// Loops that bound one hole come as one group: an island with the rim around it, both ends of a band.
const { loops, groups } = findHoles(torus);
groups.forEach(({ why, loops: members }, g) => {
  const vertices = members.map((loop) => loops[loop].vertices.length);
  console.log(`hole ${g}: ${why}, loops of ${vertices.join(' and ')} vertices`);
});

// Old vertices and faces come first, exactly as they were.
const { mesh, oldFaces, closed, holes } = fillHoles(torus);
const filled = holes.filter(({ status }) => status === 'filled').length;
console.log(`${filled} of ${holes.length} filled, closed: ${closed}, ${mesh.faces.length / 3 - oldFaces} new faces`);

/** How far new vertices are from the torus, at most. */
let most = 0;
for (let i = torus.positions.length; i < mesh.positions.length; i += 3) {
  const [x, y, z] = mesh.positions.subarray(i, i + 3);
  most = Math.max(most, Math.abs(Math.hypot(Math.hypot(x, y) - R, z) - r));
}
console.log(`off the torus by ${most.toFixed(4)} at most`);

// One hole, in a way of its own: only what is new, coarse, and not smoothed. A click needs no more.
const click = fillHoles(torus, { holes: [0], density: 0, fairness: 0, output: 'patches' });
console.log(`hole 0 alone: ${click.mesh.faces.length / 3} faces, closed: ${click.closed}`);

const file = process.argv[2];
if (file) {
  const lines = [];
  for (let i = 0; i < mesh.positions.length; i += 3) lines.push(`v ${mesh.positions.subarray(i, i + 3).join(' ')}`);
  for (let t = 0; t < mesh.faces.length; t += 3) {
    lines.push(`f ${mesh.faces.subarray(t, t + 3).map((v) => v + 1).join(' ')}`);
  }
  writeFileSync(file, `${lines.join('\n')}\n`);
}
