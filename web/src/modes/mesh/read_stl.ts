// Meshes in STL, text or binary. Its triangles have corners of their own: those at the same place become one vertex.
import type { MeshShape } from './settings.ts';
import { bad, Growing, Scanner } from './scanner.ts';
import { welded } from './weld.ts';

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
