// Meshes in STL, text or binary. Its triangles have corners of their own: those at the same place become one vertex.
import type { MeshShape } from './settings.ts';
import { bad, Growing, Scanner } from './scanner.ts';

/** @throws SoapfilmError `bad-file` */
export function readStl(bytes: Uint8Array, isText: boolean, text: () => string): MeshShape {
  const corners = isText ? cornersInText(text()) : cornersIn(bytes);
  if (corners.length === 0) throw bad('it has no triangles');
  return welded(corners);
}

function cornersIn(bytes: Uint8Array): Float32Array {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = view.getUint32(80, true);
  const corners = new Float32Array(9 * count);
  for (let t = 0; t < count; t++) {
    for (let i = 0; i < 9; i++) {
      const x = view.getFloat32(84 + 50 * t + 12 + 4 * i, true);
      if (!Number.isFinite(x)) throw bad(`a coordinate of triangle ${t} is not a finite number`);
      corners[9 * t + i] = x;
    }
  }
  return corners;
}

function cornersInText(text: string): Float32Array {
  const scan = new Scanner(text);
  const corners = new Growing(new Float32Array(9216));
  let facetLine = 0;
  do {
    // Several statements may stand in one line.
    for (let word = scan.word().toLowerCase(); word !== '' && word !== 'solid' && word !== 'endsolid'; word = scan.word().toLowerCase()) {
      if (word === 'facet') facetLine = scan.line;
      if (word === 'vertex') for (let axis = 0; axis < 3; axis++) corners.push(scan.number('the vertex'));
      if (word === 'endfacet' && corners.length % 9 !== 0) throw bad('a facet has not three vertices', facetLine);
    }
  } while (scan.nextLine());
  if (corners.length % 9 !== 0) throw bad('it ends within a facet', facetLine);
  return corners.taken();
}

/** Corners at the same place as one vertex. @param corners `[9m]` */
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
