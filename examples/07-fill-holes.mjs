// Meshes: a torus with three regions missing is closed, so that one cannot tell where they were.
//   node 07-fill-holes.mjs torus.ply               also writes it to a file: OBJ, PLY, STL or GLB
//   node 07-fill-holes.mjs closed.ply scan.obj     fills the holes of a mesh in a file instead
import { readFileSync, writeFileSync } from 'node:fs';
import { fillHoles, findHoles, load } from 'soapfilm';
import { readMesh, writeMesh } from 'soapfilm/files';

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

const [, , output, input] = process.argv;
const mesh = input ? await readMesh(readFileSync(input), input) : torusWithout((u, v) => {
  const disc = far(u, v, 0.5, 0.25) < 0.35;
  const ring = far(u, v, 0.25, 0.25) < 0.6 && far(u, v, 0.25, 0.25) > 0.25;
  const band = u > 0.8 && u < 0.88;
  return disc || ring || band;
});

// What the file has and the mesh has not, such as materials.
for (const warning of mesh.warnings ?? []) console.log(warning);

// Loops that bound one hole come as one group: an island with the rim around it, both ends of a band.
const { loops, groups } = findHoles(mesh);
groups.forEach(({ why, loops: members }, g) => {
  const vertices = members.map((loop) => loops[loop].vertices.length);
  console.log(`hole ${g}: ${why}, loops of ${vertices.join(' and ')} vertices`);
});

// Old vertices and faces come first, exactly as they were. Colours of a scan are carried on.
const { mesh: filled, oldVertices, oldFaces, closed, holes } = fillHoles(mesh);
const count = holes.filter(({ status }) => status === 'filled').length;
console.log(`${count} of ${holes.length} filled, closed: ${closed}, ${filled.faces.length / 3 - oldFaces} new faces`);

if (!input) {
  /** How far new vertices are from the torus, at most. */
  let most = 0;
  for (let i = 3 * oldVertices; i < filled.positions.length; i += 3) {
    const [x, y, z] = filled.positions.subarray(i, i + 3);
    most = Math.max(most, Math.abs(Math.hypot(Math.hypot(x, y) - R, z) - r));
  }
  console.log(`off the torus by ${most.toFixed(4)} at most`);
}

// One hole, in a way of its own: only what is new, coarse, and not smoothed. A click needs no more.
if (groups.length > 0) {
  const click = fillHoles(mesh, { holes: [0], density: 0, fairness: 0, output: 'patches' });
  console.log(`hole 0 alone: ${click.mesh.faces.length / 3} faces, closed: ${click.closed}`);
}

if (output) writeFileSync(output, await writeMesh(filled, output.split('.').at(-1).toLowerCase()));
