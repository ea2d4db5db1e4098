// What soapfilm/files writes, as three's loaders read it: an oracle that knows nothing of ours.
import { writeMesh } from 'soapfilm/files';
import { type BufferGeometry, Mesh, type Object3D } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import { PLYLoader } from 'three/examples/jsm/loaders/PLYLoader.js';
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';
import { expect, test } from 'vitest';
import type { MeshLike } from 'soapfilm';
import { Random } from '../support/generators.js';
import { kFaces } from '../support/mesh_files.js';

const random = new Random(6);
const numbers = (count: number): Float32Array => Float32Array.from({ length: count }, () => random.unit());
const mesh = {
  positions: numbers(15),
  faces: Uint32Array.from(kFaces),
  attributes: { color: { data: numbers(15).map((x) => Math.round(255 * x) / 255), size: 3 }, uv: { data: numbers(10), size: 2 } },
} satisfies MeshLike;

/** By corners of triangles, the numbers of an attribute. */
function cornersIn(geometry: BufferGeometry, name: string): number[][] {
  const attribute = geometry.getAttribute(name);
  const order = geometry.index ? [...geometry.index.array] : Array.from({ length: attribute.count }, (_, i) => i);
  return order.map((v) => Array.from({ length: attribute.itemSize }, (_, k) => attribute.getComponent(v, k)));
}

const cornersOf = (data: Float32Array, size: number, change: (x: number, k: number) => number = (x) => x): number[][] =>
  kFaces.map((v) => Array.from(data.subarray(size * v, size * (v + 1)), change));

const kPlaces = cornersOf(mesh.positions, 3);
/** Three has colours linear in light. */
const kLinear = cornersOf(mesh.attributes.color.data, 3, (x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
const kUpwards = cornersOf(mesh.attributes.uv.data, 2);

function expectNear(found: number[][], wanted: number[][], by = 1e-5): void {
  expect(found.length).toBe(wanted.length);
  found.forEach((numbers, i) => {
    expect(numbers.length).toBe(wanted[i].length);
    numbers.forEach((x, k) => { expect(Math.abs(x - wanted[i][k])).toBeLessThan(by); });
  });
}

function geometryIn(object: Object3D): BufferGeometry {
  const found: BufferGeometry[] = [];
  object.traverse((each) => {
    if (each instanceof Mesh) found.push(each.geometry as BufferGeometry);
  });
  expect(found).toHaveLength(1);
  return found[0];
}

test('OBJ: places, colours and texture coordinates', async () => {
  const text = new TextDecoder().decode(await writeMesh(mesh, 'obj'));
  const geometry = geometryIn(new OBJLoader().parse(text));
  expect(cornersIn(geometry, 'position')).toEqual(kPlaces);
  expectNear(cornersIn(geometry, 'color'), kLinear);
  expectNear(cornersIn(geometry, 'uv'), kUpwards);
});

test('PLY: places, colours and texture coordinates', async () => {
  const geometry = new PLYLoader().parse((await writeMesh(mesh, 'ply')).buffer);
  expect(cornersIn(geometry, 'position')).toEqual(kPlaces);
  // It rounds what it has made linear to 8 bits again.
  expectNear(cornersIn(geometry, 'color'), kLinear, 0.51 / 255);
  expectNear(cornersIn(geometry, 'uv'), kUpwards);
});

test('STL: places, and normals to the left of the way round', async () => {
  const geometry = new STLLoader().parse((await writeMesh(mesh, 'stl')).buffer);
  expect(cornersIn(geometry, 'position')).toEqual(kPlaces);
  const written = cornersIn(geometry, 'normal');
  geometry.deleteAttribute('normal');
  geometry.computeVertexNormals();
  expectNear(written, cornersIn(geometry, 'normal'));
});

test('GLB: places, colours and texture coordinates', async () => {
  const { scene } = await new GLTFLoader().parseAsync((await writeMesh(mesh, 'glb')).buffer, '');
  const geometry = geometryIn(scene);
  expect(cornersIn(geometry, 'position')).toEqual(kPlaces);
  expectNear(cornersIn(geometry, 'color'), kLinear);
  // From the upper left corner.
  expectNear(cornersIn(geometry, 'uv'), cornersOf(mesh.attributes.uv.data, 2, (x, k) => (k === 1 ? 1 - x : x)));
});
