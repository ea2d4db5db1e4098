// Polygons with holes: a plate is extruded into a solid, as three.js' ExtrudeGeometry does it.
//   node 06-extrude.mjs plate.obj      also writes it to a file
import { writeFileSync } from 'node:fs';
import { load, triangulatePolygon } from 'soapfilm';

await load();

/**
 * A closed solid from a polygon: caps at z = 0 and z = depth, and walls between them. With three.js:
 *   const geometry = new THREE.BufferGeometry();
 *   geometry.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(positions), 3));
 *   geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
 * @param rings arrays of [x, y], the outer one first; they may run either way
 */
export function extrude(rings, depth) {
  const { triangles: cap } = triangulatePolygon(rings);
  const points = rings.flat();
  const n = points.length;
  const positions = [0, depth].flatMap((z) => points.flatMap(([x, y]) => [x, y, z]));
  const triangles = [];
  for (let t = 0; t < cap.length; t += 3) {
    const [a, b, c] = cap.subarray(t, t + 3);
    triangles.push(c, b, a); // seen from below
    triangles.push(n + a, n + b, n + c);
  }
  // An edge that only one triangle has is part of a ring, and has the polygon to its left.
  const edges = new Set();
  for (let t = 0; t < cap.length; t += 3) {
    for (let k = 0; k < 3; k++) {
      const [from, to] = [cap[t + k], cap[t + ((k + 1) % 3)]];
      if (!edges.delete(to * n + from)) edges.add(from * n + to);
    }
  }
  for (const edge of edges) {
    const [from, to] = [Math.floor(edge / n), edge % n];
    triangles.push(from, to, n + to, from, n + to, n + from);
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** The volume inside closed triangles, by tetrahedra to the origin. */
function volume({ positions, triangles }) {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => positions.subarray(3 * triangles[t + k], 3 * triangles[t + k] + 3));
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

const circle = (x, y, radius, count) =>
  Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * i) / count;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });

// A plate of 8 by 4 with a slot that opens a corner, and three drilled holes.
const outer = [[0, 0], [8, 0], [8, 3], [6, 3], [6, 4], [0, 4]];
const plate = [outer, circle(2, 2, 1, 32), circle(5, 1.5, 0.5, 16), circle(7, 1, 0.25, 8)];
const solid = extrude(plate, 0.5);
console.log(`${solid.triangles.length / 3} triangles, volume ${volume(solid).toFixed(4)}`);

// A hole that is not inside is no polygon: the error says which edges meet, and where.
try {
  extrude([outer, circle(6, 3.5, 0.9, 24)], 1);
} catch (error) {
  console.log(`${error.code}: ring ${error.loop} and ring ${error.otherLoop}`);
}
// Where that is not one's own to decide, `repair` makes the best of any rings.
const { triangles, added } = triangulatePolygon([outer, circle(6, 3.5, 0.9, 24)], { repair: 'even-odd' });
console.log(`repaired: ${triangles.length / 3} triangles, ${added.length / 2} points added`);

const file = process.argv[2];
if (file) {
  const lines = [];
  for (let i = 0; i < solid.positions.length; i += 3) lines.push(`v ${solid.positions.subarray(i, i + 3).join(' ')}`);
  for (let t = 0; t < solid.triangles.length; t += 3) {
    lines.push(`f ${solid.triangles.subarray(t, t + 3).map((v) => v + 1).join(' ')}`);
  }
  writeFileSync(file, `${lines.join('\n')}\n`);
}
