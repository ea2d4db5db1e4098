// Meshes in STL, text or binary. Its triangles have corners of their own: those at the same place become one vertex. A
// reader of its own: three's STLLoader welds nothing, and reads what is cut off as zeros or not at all.
import { ByteScanner } from './byte_scanner.js';
import { Growing } from './growing.js';
import { badFile, meshFile, type MeshFile } from './mesh_file.js';
import { placesOf } from './places.js';

/** Of binary STL: 80 bytes of any kind, the number of triangles, then `kTriangle` bytes for each. */
const [kHead, kTriangle] = [84, 50];

const viewOf = (bytes: Uint8Array): DataView => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

/** Whether the length is exactly that of the triangles, whatever the file begins with: some write "solid" there. */
export const isBinaryStl = (bytes: Uint8Array): boolean =>
  bytes.length >= kHead && bytes.length === kHead + kTriangle * viewOf(bytes).getUint32(kHead - 4, true);

/** @throws SoapfilmError `bad-file` */
export function readStl(bytes: Uint8Array): MeshFile {
  const isText = !isBinaryStl(bytes) && !bytes.subarray(0, 1024).includes(0);
  const warnings: string[] = [];
  const corners = isText ? cornersInText(bytes, warnings) : cornersIn(bytes);
  if (corners.length === 0) throw badFile('the file has no triangles');
  const { positions, placeOf } = placesOf(corners, 3);
  return meshFile('stl', { positions, faces: placeOf }, [], warnings);
}

function cornersIn(bytes: Uint8Array): Float32Array {
  if (bytes.length < kHead) throw badFile('the file ends too early');
  const view = viewOf(bytes);
  const count = view.getUint32(kHead - 4, true);
  const there = Math.floor((bytes.length - kHead) / kTriangle);
  if (count > there) throw badFile(`the file ends too early: it has ${there} of ${count} triangles`, { face: there });
  const corners = new Float32Array(9 * count);
  for (let t = 0; t < count; t++) {
    for (let i = 0; i < 9; i++) {
      const x = view.getFloat32(kHead + kTriangle * t + 12 + 4 * i, true);
      if (!Number.isFinite(x)) throw badFile(`a coordinate of triangle ${t} is not a finite number`, { face: t });
      corners[9 * t + i] = x;
    }
  }
  return corners;
}

function cornersInText(bytes: Uint8Array, warnings: string[]): Float32Array {
  const scan = new ByteScanner(bytes, false);
  const corners = new Growing(new Float32Array(9216));
  /** 0: not within a facet. */
  let facetLine = 0;
  let hasEnd = false;
  do {
    // Several statements may stand in one line.
    while (scan.toWord()) {
      const word = scan.word().toLowerCase();
      if (word === 'facet') facetLine = scan.line;
      else if (word === 'vertex') for (let axis = 0; axis < 3; axis++) corners.push(scan.number('the vertex'));
      else if (word === 'endfacet') {
        if (corners.length % 9 !== 0) throw badFile('a facet has not three vertices', { line: facetLine });
        facetLine = 0;
      } else if (word === 'solid' || word === 'endsolid') {
        hasEnd = word === 'endsolid';
        // What follows is its name.
        break;
      }
    }
  } while (scan.nextLine());
  if (facetLine > 0 || corners.length % 9 !== 0) throw badFile('the file ends within this facet', { line: facetLine });
  if (!hasEnd) warnings.push('The file has no end, and may be cut off');
  return corners.taken();
}
