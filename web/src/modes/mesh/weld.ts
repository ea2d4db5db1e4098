// Vertices at the same place as one.
import { picked } from './attributes.ts';
import type { MeshShape } from './settings.ts';

/** Corners at the same place as one vertex, the first of them. @param corners `[3n]`, of which zeros lose their sign */
export function welded(corners: Float32Array): MeshShape {
  const n = corners.length / 3;
  // Zero has two signs.
  for (let i = 0; i < corners.length; i++) corners[i] += 0;
  const bits = new Uint32Array(corners.buffer, corners.byteOffset, corners.length);
  let size = 1;
  while (size < 2 * n) size *= 2;
  // A table of vertices by their places: 1 more than the number, 0 for none.
  const table = new Uint32Array(size);
  const positions = new Float32Array(corners.length);
  const own = new Uint32Array(positions.buffer);
  const faces = new Uint32Array(n);
  let count = 0;
  for (let i = 0; i < n; i++) {
    const [x, y, z] = [bits[3 * i], bits[3 * i + 1], bits[3 * i + 2]];
    let slot = (Math.imul(x, 0x9e3779b1) ^ Math.imul(y, 0x85ebca6b) ^ Math.imul(z, 0xc2b2ae35)) >>> 0;
    slot = (slot ^ (slot >>> 15)) & (size - 1);
    for (;;) {
      const vertex = table[slot] - 1;
      if (vertex < 0) {
        own.set([x, y, z], 3 * count);
        table[slot] = ++count;
        faces[i] = count - 1;
        break;
      }
      if (own[3 * vertex] === x && own[3 * vertex + 1] === y && own[3 * vertex + 2] === z) {
        faces[i] = vertex;
        break;
      }
      slot = (slot + 1) & (size - 1);
    }
  }
  return { positions: positions.slice(0, 3 * count), faces };
}

/** The mesh with vertices at the same place as one, with the attributes of the first, and without faces that have a vertex twice then. */
export function weld({ positions, faces, attributes }: MeshShape): MeshShape {
  const { positions: places, faces: placeOf } = welded(positions.slice());
  const kept = new Uint32Array(faces.length);
  let to = 0;
  for (let i = 0; i < faces.length; i += 3) {
    const [a, b, c] = [placeOf[faces[i]], placeOf[faces[i + 1]], placeOf[faces[i + 2]]];
    if (a === b || b === c || a === c) continue;
    kept[to++] = a;
    kept[to++] = b;
    kept[to++] = c;
  }
  const first = new Uint32Array(places.length / 3);
  for (let vertex = placeOf.length - 1; vertex >= 0; vertex--) first[placeOf[vertex]] = vertex;
  return { positions: places, faces: kept.slice(0, to), ...picked(attributes, first) };
}

/** How many of some vertices lie where another of them does. */
export function countTwins({ positions }: MeshShape, vertices: Iterable<number>): number {
  const own = [...new Set(vertices)];
  const corners = new Float32Array(3 * own.length);
  own.forEach((vertex, i) => {
    corners.set(positions.subarray(3 * vertex, 3 * vertex + 3), 3 * i);
  });
  const { faces: placeOf, positions: places } = welded(corners);
  return placeOf.length - places.length / 3;
}
