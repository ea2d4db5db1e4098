// Meshes in GLB: the triangles of all nodes of the scene, where they stand. A reader of its own, since three's GLTFLoader
// brings materials that the page has no use for. Vertices that were split for their texture are one again.
import { Matrix4, Quaternion, Vector3 } from 'three';
import { bad } from './scanner.ts';
import type { MeshShape } from './settings.ts';
import { welded } from './weld.ts';

interface Accessor {
  readonly bufferView?: number;
  readonly byteOffset?: number;
  readonly componentType: number;
  readonly normalized?: boolean;
  readonly count: number;
  readonly type: string;
  readonly sparse?: unknown;
}

interface Primitive {
  readonly attributes: Readonly<Partial<Record<string, number>>>;
  readonly indices?: number;
  readonly mode?: number;
  readonly extensions?: object;
}

interface Node {
  readonly mesh?: number;
  readonly children?: readonly number[];
  readonly matrix?: readonly number[];
  readonly translation?: readonly number[];
  readonly rotation?: readonly number[];
  readonly scale?: readonly number[];
}

interface Gltf {
  readonly scene?: number;
  readonly scenes?: readonly { readonly nodes?: readonly number[] }[];
  readonly nodes?: readonly Node[];
  readonly meshes?: readonly { readonly primitives: readonly Primitive[] }[];
  readonly accessors?: readonly Accessor[];
  readonly bufferViews?: readonly { readonly buffer: number; readonly byteOffset?: number; readonly byteStride?: number }[];
  readonly buffers?: readonly { readonly uri?: string }[];
}

interface Glb {
  readonly json: Gltf;
  readonly data: DataView;
}

/** Marks of the two chunks: "JSON" and "BIN". */
const kJson = 0x4e4f534a;
const kBin = 0x004e4942;

/** @throws SoapfilmError `bad-file` */
export function readGlb(bytes: Uint8Array): MeshShape {
  try {
    return read(split(bytes));
  } catch (error) {
    // Numbers that name nothing, and places beyond the end.
    if (error instanceof TypeError || error instanceof RangeError || error instanceof SyntaxError) throw bad('it is damaged');
    throw error;
  }
}

function split(bytes: Uint8Array): Glb {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (view.getUint32(4, true) !== 2) throw bad(`it is of version ${view.getUint32(4, true)} of GLB, and only 2 is read`);
  let json: Gltf | null = null;
  let data: DataView = new DataView(new ArrayBuffer(0));
  for (let at = 12; at + 8 <= bytes.length; ) {
    const [length, mark] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    if (at + 8 + length > bytes.length) throw bad('it ends too early');
    const chunk = bytes.subarray(at + 8, at + 8 + length);
    if (mark === kJson) json ??= JSON.parse(new TextDecoder().decode(chunk)) as Gltf;
    if (mark === kBin) data = new DataView(chunk.buffer, chunk.byteOffset, chunk.byteLength);
    at += 8 + length;
  }
  if (json === null) throw bad('it is damaged');
  return { json, data };
}

function read(glb: Glb): MeshShape {
  const { json } = glb;
  const corners: Float32Array[] = [];
  const visit = (number: number, above: Matrix4, depth: number): void => {
    const node = json.nodes?.[number];
    if (!node || depth > 1000) throw bad('it is damaged');
    const matrix = above.clone().multiply(matrixOf(node));
    const primitives = node.mesh === undefined ? [] : json.meshes?.[node.mesh]?.primitives;
    if (primitives === undefined) throw bad('it is damaged');
    for (const primitive of primitives) {
      const found = cornersOf(glb, primitive, matrix);
      if (found) corners.push(found);
    }
    for (const child of node.children ?? []) visit(child, matrix, depth + 1);
  };
  const roots = json.scenes?.[json.scene ?? 0]?.nodes ?? json.nodes?.map((_, i) => i).filter((i) => !json.nodes?.some(({ children }) => children?.includes(i)));
  for (const root of roots ?? []) visit(root, new Matrix4(), 0);
  const all = new Float32Array(corners.reduce((sum, { length }) => sum + length, 0));
  let to = 0;
  for (const each of corners) {
    all.set(each, to);
    to += each.length;
  }
  if (all.length === 0) throw bad('it has no triangles');
  return welded(all);
}

function matrixOf({ matrix, translation, rotation, scale }: Node): Matrix4 {
  if (matrix) return new Matrix4().fromArray(matrix);
  const made = new Matrix4();
  const [t, r, s] = [new Vector3(), new Quaternion(), new Vector3(1, 1, 1)];
  if (translation) t.fromArray(translation);
  if (rotation) r.fromArray(rotation);
  if (scale) s.fromArray(scale);
  return made.compose(t, r, s);
}

/** `[9m]` the corners of triangles; null: there are only points or lines. */
function cornersOf(glb: Glb, { attributes, indices, mode = 4, extensions }: Primitive, matrix: Matrix4): Float32Array | null {
  if (mode < 4) return null;
  const compression = Object.keys(extensions ?? {}).find((name) => /draco|meshopt/i.test(name));
  if (compression !== undefined) throw bad(`its mesh is compressed (${compression}), which is not read`);
  if (attributes.POSITION === undefined) return null;
  const points = valuesOf(glb, attributes.POSITION, 3);
  const n = points.length / 3;
  const order = indices === undefined ? Float64Array.from({ length: n }, (_, i) => i) : valuesOf(glb, indices, 1);
  const triangles = trianglesOf(order, mode);
  const at = new Vector3();
  const moved = new Float32Array(points.length);
  for (let i = 0; i < n; i++) {
    at.fromArray(points, 3 * i).applyMatrix4(matrix).toArray(moved, 3 * i);
    if (!Number.isFinite(at.x + at.y + at.z)) throw bad(`a coordinate of vertex ${i} is not a finite number`);
  }
  // Mirrored, triangles run the other way round.
  const turn = matrix.determinant() < 0;
  const corners = new Float32Array(3 * triangles.length);
  triangles.forEach((vertex, i) => {
    if (vertex >= n) throw bad(`a triangle names the vertex ${vertex}, and there are only ${n}`);
    const to = turn ? i + [0, 1, -1][i % 3] : i;
    for (let axis = 0; axis < 3; axis++) corners[3 * to + axis] = moved[3 * vertex + axis];
  });
  return corners;
}

/** The corners of triangles that are given one by one (4), as a strip (5) or as a fan (6). */
function trianglesOf(order: Float64Array, mode: number): number[] | Float64Array {
  if (mode === 4) return order.subarray(0, order.length - (order.length % 3));
  const all: number[] = [];
  for (let i = 2; i < order.length; i++) {
    const isOdd = mode === 5 && i % 2 === 1;
    const [a, b] = mode === 6 ? [order[0], order[i - 1]] : isOdd ? [order[i - 1], order[i - 2]] : [order[i - 2], order[i - 1]];
    if (a !== b && b !== order[i] && a !== order[i]) all.push(a, b, order[i]);
  }
  return all;
}

function valuesOf({ json, data }: Glb, number: number, width: number): Float64Array {
  const accessor = json.accessors?.[number];
  if (!accessor) throw bad('it is damaged');
  const { bufferView, byteOffset = 0, componentType, normalized = false, count, sparse } = accessor;
  const view = bufferView === undefined ? undefined : json.bufferViews?.[bufferView];
  if (sparse !== undefined || !view) throw bad('it has sparse or compressed data, which are not read');
  if (view.buffer !== 0 || json.buffers?.[0]?.uri !== undefined) throw bad('its data are in another file');
  const [size, most, get] = componentOf(componentType, data);
  const stride = view.byteStride ?? size * width;
  const values = new Float64Array(width * count);
  let to = 0;
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < width; k++) {
      const value = get((view.byteOffset ?? 0) + byteOffset + i * stride + k * size);
      values[to++] = normalized && width > 1 ? Math.max(-1, value / most) : value;
    }
  }
  return values;
}

function componentOf(type: number, data: DataView): [size: number, most: number, get: (at: number) => number] {
  switch (type) {
    case 5120:
      return [1, 127, (at) => data.getInt8(at)];
    case 5121:
      return [1, 255, (at) => data.getUint8(at)];
    case 5122:
      return [2, 32767, (at) => data.getInt16(at, true)];
    case 5123:
      return [2, 65535, (at) => data.getUint16(at, true)];
    case 5125:
      return [4, 1, (at) => data.getUint32(at, true)];
    case 5126:
      return [4, 1, (at) => data.getFloat32(at, true)];
    default:
      throw bad('it is damaged');
  }
}
