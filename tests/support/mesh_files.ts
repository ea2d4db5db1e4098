// A small mesh in each of the formats of files, by hand.
import type { MeshLike } from 'soapfilm';

export const kPoints = [0, 0, 0, 1, 0, 0, 1, 1, 0.1, 0, 1, 0, 0.5, 0.5, -1];
export const kFaces = [0, 1, 2, 0, 2, 3, 4, 1, 0];
export const kMesh: MeshLike = { positions: new Float32Array(kPoints), faces: new Uint32Array(kFaces) };

export const bytesOf = (text: string): Uint8Array => new TextEncoder().encode(text);

export const kObj = '# by hand\nv 0 0 0 1\nv 1 0 0\nv 1 1 .1\nvt 0 0\nv 0 1 0 # last\nf 1/1 2/1 3/1 4/1\nv 0.5 0.5 -1e0\nf -1//1 2/1/1 1\n';

const plyHeader = (format: string): string =>
  `ply\nformat ${format} 1.0\ncomment by hand\nelement vertex 5\nproperty double x\nproperty double y\nproperty uchar quality\nproperty double z\n` +
  'element face 2\nproperty list uchar int vertex_indices\nproperty float weight\nend_header\n';

export const kPly = `${plyHeader('ascii')}0 0 9 0\n1 0 9 0\n1 1 9 0.1\n0 1 9 0\n.5 .5 9 -1\n4 0 1 2 3 1\n3 4 1 0 1\n`;

export function binaryPly(isLittle: boolean): Uint8Array {
  const view = new DataView(new ArrayBuffer(1000));
  let at = 0;
  for (let v = 0; v < 5; v++) {
    [0, 1, 2].forEach((axis) => {
      if (axis === 2) view.setUint8(at++, 9);
      view.setFloat64(at, kPoints[3 * v + axis], isLittle);
      at += 8;
    });
  }
  for (const face of [[0, 1, 2, 3], [4, 1, 0]]) {
    view.setUint8(at++, face.length);
    for (const v of face) {
      view.setInt32(at, v, isLittle);
      at += 4;
    }
    view.setFloat32(at, 0.5, isLittle);
    at += 4;
  }
  const head = bytesOf(plyHeader(isLittle ? 'binary_little_endian' : 'binary_big_endian'));
  return Uint8Array.from([...head, ...new Uint8Array(view.buffer, 0, at)]);
}

export const facet = (...points: string[]): string =>
  `facet normal 0 0 1\n outer loop\n${points.map((p) => `  vertex ${p}\n`).join('')} endloop\nendfacet\n`;

export const kStl = `solid two vertex\n${facet('0 0 0', '1 0 0', '1.0e0 1 1E-1')}${facet('-0 0 0', '1 1 .1', '0 1 0')}${facet('.5 .5 -1', '1 0 0', '0 0 0')}endsolid two vertex\n`;

/** Of the mesh's triangles; the first 80 bytes begin with a word. */
export function binaryStl(head = 'solid'): Uint8Array {
  const bytes = new Uint8Array(84 + 50 * 3);
  bytes.set(bytesOf(head));
  const view = new DataView(bytes.buffer);
  view.setUint32(80, 3, true);
  kFaces.forEach((v, i) => {
    const at = 84 + 50 * Math.floor(i / 3) + 12 + 12 * (i % 3);
    for (let axis = 0; axis < 3; axis++) view.setFloat32(at + 4 * axis, kPoints[3 * v + axis], true);
  });
  return bytes;
}

export function glbOf(json: object, data: Uint8Array): Uint8Array {
  const text = JSON.stringify(json);
  const chunk = bytesOf(text + ' '.repeat((4 - (text.length % 4)) % 4));
  const view = new DataView(new ArrayBuffer(28 + chunk.length + data.length));
  const bytes = new Uint8Array(view.buffer);
  [0x46546c67, 2, bytes.length, chunk.length, 0x4e4f534a].forEach((word, i) => { view.setUint32(4 * i, word, true); });
  bytes.set(chunk, 20);
  view.setUint32(20 + chunk.length, data.length, true);
  view.setUint32(24 + chunk.length, 0x004e4942, true);
  bytes.set(data, 28 + chunk.length);
  return bytes;
}

/** Positions, then indices. */
export const kGlbData = new Uint8Array([...new Uint8Array(new Float32Array(kPoints).buffer), ...new Uint8Array(new Uint16Array([...kFaces, 0]).buffer)]);

/** The mesh as glTF, below a node. */
export const gltfOf = (rest: object = {}, primitive: object = {}): object => ({
  asset: { version: '2.0' },
  scene: 0,
  scenes: [{ nodes: [0] }],
  nodes: [{ children: [1] }, { mesh: 0 }],
  meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, ...primitive }] }],
  accessors: [
    { bufferView: 0, componentType: 5126, count: 5, type: 'VEC3' },
    { bufferView: 1, componentType: 5123, count: 9, type: 'SCALAR' },
  ],
  bufferViews: [
    { buffer: 0, byteLength: 60 },
    { buffer: 0, byteOffset: 60, byteLength: 20 },
  ],
  buffers: [{ byteLength: kGlbData.length }],
  ...rest,
});

export const kGlb = glbOf(gltfOf(), kGlbData);
