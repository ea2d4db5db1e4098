// Files of meshes: all formats give the same mesh, what is written comes back, and what is broken is said.
import { Matrix4 } from 'three';
import { describe, expect, test } from 'vitest';
import { readGlb, readObj, readPly, readStl } from '../../web/src/modes/mesh/readers.ts';
import type { MeshShape } from '../../web/src/modes/mesh/settings.ts';
import { writeObj, writePly, writeStl } from '../../web/src/modes/mesh/write.ts';
import { errorOf } from '../support/errors.js';

const kPoints = [0, 0, 0, 1, 0, 0, 1, 1, 0.1, 0, 1, 0, 0.5, 0.5, -1];
const kFaces = [0, 1, 2, 0, 2, 3, 4, 1, 0];
const kMesh: MeshShape = { positions: new Float32Array(kPoints), faces: new Uint32Array(kFaces) };

const bytesOf = (text: string) => new TextEncoder().encode(text);
const bytesIn = async (blob: Blob) => new Uint8Array(await blob.arrayBuffer());
const lists = ({ positions, faces }: MeshShape) => [[...positions], [...faces]];
const stl = (text: string) => readStl(bytesOf(text), true, () => text);

/** The corners of all triangles, whatever the numbers of their vertices. */
const corners = ({ positions, faces }: MeshShape) => Array.from(faces, (v) => [...positions.subarray(3 * v, 3 * v + 3)]);

describe('OBJ', () => {
  test('shared vertices, polygons as fans, all forms of corners, negative numbers', () => {
    const text = `# by hand\nv 0 0 0 1\nv 1 0 0\nv 1 1 .1\nvt 0 0\nv 0 1 0 # last\nf 1/1 2/1 3/1 4/1\nv 0.5 0.5 -1e0\nf -1//1 2/1/1 1\n`;
    expect(lists(readObj(text))).toEqual(lists(kMesh));
    expect(lists(readObj(text.replaceAll('\n', '\r\n')))).toEqual(lists(kMesh));
    expect(lists(readObj(text.replaceAll('\n', '\r')))).toEqual(lists(kMesh));
  });

  test.each([
    ['v 0 0\n', 'Line 1: a number of the vertex is missing'],
    ['v 0 0 zero\n', 'Line 1: “zero” is not a finite number'],
    ['v 0 0 1e300\n', 'Line 1: “1e300” is not a finite number'],
    ['v 0 0 0\n\nf 1 2\n', 'Line 3: a face has fewer than three vertices'],
    ['v 0 0 0\nf 1 1 7\n', 'Line 2: there is no vertex 7'],
    ['v 0 0 0\nf 1 1 -2\n', 'Line 2: “-2” names no vertex'],
    ['v 0 0 0\n', 'it has no faces'],
  ])('%j: is said', (text, message) => {
    expect(errorOf(() => readObj(text)).message).toBe(message);
  });
});

const header = (format: string, faces = 'property list uchar int vertex_indices') =>
  `ply\nformat ${format} 1.0\ncomment by hand\nelement vertex 5\nproperty double x\nproperty double y\nproperty uchar red\nproperty double z\n` +
  `element face 2\n${faces}\nproperty float quality\nend_header\n`;

function binaryPly(isLittle: boolean): Uint8Array {
  const view = new DataView(new ArrayBuffer(1000));
  let at = 0;
  for (let v = 0; v < 5; v++) {
    [0, 1, 2].forEach((axis) => {
      if (axis === 2) view.setUint8(at++, 200);
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
  const head = bytesOf(header(isLittle ? 'binary_little_endian' : 'binary_big_endian'));
  return Uint8Array.from([...head, ...new Uint8Array(view.buffer, 0, at)]);
}

describe('PLY', () => {
  const kText = `${header('ascii')}0 0 9 0\n1 0 9 0\n1 1 9 0.1\n0 1 9 0\n.5 .5 9 -1\n4 0 1 2 3 1\n3 4 1 0 1\n`;
  test('text and both orders of bytes: with what is of no use between', () => {
    for (const bytes of [bytesOf(kText), bytesOf(kText.replaceAll('\n', '\r\n')), binaryPly(true), binaryPly(false)]) {
      expect(lists(readPly(bytes))).toEqual(lists(kMesh));
    }
  });

  test('strips of triangles', () => {
    const text = 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 3 2 1\n';
    expect([...readPly(bytesOf(text)).faces]).toEqual([0, 1, 2, 2, 1, 3, 3, 2, 1]);
  });

  test.each([
    ['ply\nformat ascii 1.0\n', 'its header has no end'],
    ['ply\nformat zip 1.0\nend_header\n', 'its header names no known format'],
    ['ply\nformat ascii 1.0\nelement vertex many\nend_header\n', 'Line 3: “many” is no number of elements'],
    ['ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n', 'Line 4: a property of no known type'],
    ['ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n', 'its vertices have no x, y and z'],
    ['ply\nformat ascii 1.0\nend_header\n', 'it has no vertices'],
    [kText.replace('9 0.1', '9 one'), 'Line 15: “one” is not a number'],
    [kText.replace('9 0.1', '9 1e300'), 'Line 15: a coordinate of vertex 2 is not a finite number'],
    [kText.replace('3 4 1 0', '3 9 1 0'), 'a face names the vertex 9, and there are only 5'],
    [kText.replace('3 4 1 0', '3 -1 1 0'), 'Line 19: face 1 names the vertex -1'],
    [kText.slice(0, -12), 'it ends too early'],
  ])('%j: is said', (text, message) => {
    expect(errorOf(() => readPly(bytesOf(text))).message).toContain(message);
  });

  test('cut off in binary: is said', () => {
    expect(errorOf(() => readPly(binaryPly(true).subarray(0, -3))).message).toBe('it ends too early');
  });
});

describe('STL', () => {
  const facet = (...points: string[]) => `facet normal 0 0 1\n outer loop\n${points.map((p) => `  vertex ${p}\n`).join('')} endloop\nendfacet\n`;
  test('corners at the same place are one vertex, zeros of either sign too', () => {
    const mesh = stl(`solid two vertex\n${facet('0 0 0', '1 0 0', '1 1 0')}${facet('-0 0 0', '1 1 0', '0 1 0')}endsolid two vertex\n`);
    expect(lists(mesh)).toEqual([[0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], [0, 1, 2, 0, 2, 3]]);
  });

  test('broken text: is said', () => {
    expect(errorOf(() => stl(`solid\n${facet('0 0 0', '1 0 0')}`)).message).toBe('Line 2: a facet has not three vertices');
    expect(errorOf(() => stl(`solid\n${facet('0 0 0', '1 0 x', '0 0 1')}`)).message).toBe('Line 5: “x” is not a finite number');
    expect(errorOf(() => stl('solid facet\nendsolid\n')).message).toBe('it has no triangles');
  });
});

/** A GLB with one triangle fan of nodes, made by hand. */
function glb(json: object, data: Uint8Array): Uint8Array {
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

describe('GLB', () => {
  const positions = new Uint8Array(new Float32Array(kPoints).buffer);
  const indices = new Uint8Array(new Uint16Array([...kFaces, 0]).buffer);
  const data = new Uint8Array([...positions, ...indices]);
  const json = (rest: object = {}, primitive: object = {}) => ({
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ children: [1] }, { mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, ...primitive }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 5, type: 'VEC3' },
      { bufferView: 1, componentType: 5123, count: 9, type: 'SCALAR' },
    ],
    bufferViews: [{ buffer: 0, byteLength: 60 }, { buffer: 0, byteOffset: 60, byteLength: 20 }],
    buffers: [{ byteLength: data.length }],
    ...rest,
  });

  test('triangles of a node, and where its parents put them', () => {
    expect(corners(readGlb(glb(json(), data)))).toEqual(corners(kMesh));
    const moved = readGlb(glb(json({ nodes: [{ translation: [1, 2, 3], children: [1] }, { mesh: 0, scale: [2, 2, 2] }] }), data));
    expect(corners(moved)).toEqual(corners(kMesh).map(([x, y, z]) => [2 * x + 1, 2 * y + 2, Math.fround(2 * z + 3)]));
  });

  test('mirrored: faces are turned, so that outside stays outside', () => {
    const matrix = new Matrix4().makeScale(-1, 1, 1).toArray();
    const [a, b, c] = corners(readGlb(glb(json({ nodes: [{ matrix, mesh: 0 }] }), data)));
    expect([a, c, b]).toEqual(corners(kMesh).slice(0, 3).map(([x, y, z]) => [0 - x, y, z]));
  });

  test.each([
    ['compressed', json({}, { extensions: { KHR_draco_mesh_compression: {} } }), 'its mesh is compressed (KHR_draco_mesh_compression), which is not read'],
    ['data elsewhere', json({ buffers: [{ uri: 'a.bin' }] }), 'its data are in another file'],
    ['only lines', json({}, { mode: 1 }), 'it has no triangles'],
    ['a loop of nodes', json({ nodes: [{ children: [0] }] }), 'it is damaged'],
    ['numbers that name nothing', json({ accessors: [] }), 'it is damaged'],
    ['data that end early', json({ bufferViews: [{ buffer: 0 }, { buffer: 0, byteOffset: 78 }] }), 'it is damaged'],
    ['too large an index', json({ accessors: [{ bufferView: 0, componentType: 5126, count: 3 }, { bufferView: 1, componentType: 5123, count: 9 }] }), 'a triangle names the vertex 3, and there are only 3'],
  ])('%s: is said', (_, file, message) => {
    expect(errorOf(() => readGlb(glb(file, data))).message).toBe(message);
  });
});

describe('what is written', () => {
  const mesh: MeshShape = { ...kMesh, positions: kMesh.positions.map((x) => x / 3 + 1e-7) };
  test('OBJ and PLY: come back bit for bit', async () => {
    expect(lists(readObj(await writeObj(mesh, 'two\nlines').text()))).toEqual(lists(mesh));
    expect(lists(readPly(await bytesIn(writePly(mesh))))).toEqual(lists(mesh));
  });

  test('STL: the corners come back', async () => {
    const bytes = await bytesIn(writeStl(mesh));
    expect(corners(readStl(bytes, false, () => ''))).toEqual(corners(mesh));
  });
});
