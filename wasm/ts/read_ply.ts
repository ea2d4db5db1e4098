// Meshes in PLY: text, or binary with either order of bytes. A reader of its own: those of three and of loaders.gl, which
// stems from it, drop polygons of more than four vertices, and do not say where a file is broken.
import { FaceBuilder } from './concave.js';
import { Growing } from './growing.js';
import { badFile, kColor, kUv, meshFile, scaleColors, type MeshFile } from './mesh_file.js';
import { readPlyHeader, type Element, type Property, type Scalar } from './ply_header.js';
import { plySource, type Source } from './ply_source.js';
import type { MeshAttribute } from './types.js';

/** @throws SoapfilmError `bad-file` */
export function readPly(bytes: Uint8Array): MeshFile {
  const header = readPlyHeader(bytes);
  const source = plySource(bytes, header);
  const leftOut = new Set<string>();
  const faces = new Faces();
  let vertices: Vertices | null = null;
  for (const element of header.elements) {
    // Before any memory is taken.
    if (element.properties.length > 0 && element.count > source.roomFor(element)) {
      throw badFile(`the file ends too early: it has not ${element.count} elements “${element.name}”`);
    }
    if (element.name === 'vertex' && vertices === null) vertices = readVertices(element, source, leftOut);
    else readOthers(element, source, faces, leftOut);
  }
  if (vertices === null || vertices.positions.length === 0) throw badFile('the file has no vertices');
  const { positions, attributes } = vertices;
  const few = faces.few;
  const warnings = [
    ...(few > 0 ? [`${few} ${few === 1 ? 'face' : 'faces'} of fewer than three vertices ${few === 1 ? 'is' : 'are'} left out`] : []),
    ...[...leftOut].map((what) => `${what} left out`),
  ];
  return meshFile('ply', { positions, faces: faces.taken(positions) }, attributes, warnings);
}

interface Vertices {
  readonly positions: Float32Array | Float64Array;
  readonly attributes: readonly (readonly [name: string, attribute: MeshAttribute])[];
}

/** The names that go together, in each of the ways in which programs call them; the last colour may be missing. */
const kColorNames = [
  ['red', 'green', 'blue', 'alpha'],
  ['diffuse_red', 'diffuse_green', 'diffuse_blue', 'diffuse_alpha'],
  ['r', 'g', 'b', 'a'],
];
const kUvNames = [['u', 'v'], ['s', 't'], ['texture_u', 'texture_v'], ['texture_s', 'texture_t']];
const kNormalNames = ['nx', 'ny', 'nz'];

/** The largest value of the types in which colours may be whole numbers. */
const kMost: Readonly<Partial<Record<Scalar, number>>> = { uint8: 255, uint16: 65535 };

/** Where the numbers of a property go: `into[stride v + offset]`, divided by `over`. */
interface Target {
  readonly into: Float32Array | Float64Array;
  readonly stride: number;
  readonly offset: number;
  readonly over: number;
}

function readVertices({ count, properties }: Element, source: Source, leftOut: Set<string>): Vertices {
  const { positions, attributes, targets } = planFor(count, properties, leftOut);
  for (let v = 0; v < count; v++) {
    source.begin();
    for (let i = 0; i < properties.length; i++) {
      if (properties[i].countType !== null) {
        skipList(properties[i], source);
        continue;
      }
      const value = source.next(properties[i].type);
      const target = targets[i];
      if (target !== null) target.into[target.stride * v + target.offset] = value / target.over;
    }
    source.end();
    if (!Number.isFinite(Math.fround(positions[3 * v]) + Math.fround(positions[3 * v + 1]) + Math.fround(positions[3 * v + 2]))) {
      checkPoint(positions, v, source);
    }
  }
  const color = attributes.find(([name]) => name === kColor)?.[1];
  if (color) scaleColors(color);
  return { positions, attributes };
}

/** Three that are finite may have a sum that is not. */
function checkPoint(positions: Float32Array | Float64Array, vertex: number, source: Source): void {
  if (positions.subarray(3 * vertex, 3 * vertex + 3).every((x) => Number.isFinite(Math.fround(x)))) return;
  throw badFile(`a coordinate of vertex ${vertex} is not a finite number`, { vertex, ...source.place });
}

/** What becomes of each property of a vertex. */
function planFor(count: number, properties: readonly Property[], leftOut: Set<string>): Vertices & { readonly targets: readonly (Target | null)[] } {
  const scalar = new Map(properties.flatMap(({ name, type, countType }) => (countType === null ? [[name, type] as const] : [])));
  const axes = ['x', 'y', 'z'];
  if (!axes.every((axis) => scalar.has(axis))) throw badFile('the vertices of the file have no x, y and z');
  const isDouble = axes.some((axis) => scalar.get(axis) === 'float64');
  const positions = isDouble ? new Float64Array(3 * count) : new Float32Array(3 * count);
  const attributes: [string, MeshAttribute][] = [];
  const targets = new Map<string, Target>();
  const put = (names: readonly string[], into: Float32Array | Float64Array, over = 1): void => {
    names.forEach((name, offset) => targets.set(name, { into, stride: names.length, offset, over }));
  };
  const give = (name: string, names: readonly string[], over?: number): void => {
    const attribute = { data: new Float32Array(names.length * count), size: names.length };
    attributes.push([name, attribute]);
    put(names, attribute.data, over);
  };
  put(axes, positions);
  const colors = kColorNames.find((names) => names.slice(0, 3).every((name) => scalar.has(name)));
  if (colors) give(kColor, colors.filter((name) => scalar.has(name)), kMost[scalar.get(colors[0]) ?? 'float32']);
  const uv = kUvNames.find((names) => names.every((name) => scalar.has(name) && !targets.has(name)));
  if (uv) give(kUv, uv);
  for (const { name, countType } of properties) {
    if (countType !== null) leftOut.add(`The lists “${name}” of vertices are`);
    else if (kNormalNames.includes(name)) leftOut.add('Normals are');
    // Names that stand for something else here, or stand there twice.
    else if (!targets.has(name) && name !== kColor && name !== kUv) give(name, [name]);
  }
  return { positions, attributes, targets: properties.map(({ name, countType }) => (countType === null ? (targets.get(name) ?? null) : null)) };
}

const kIndices = ['vertex_indices', 'vertex_index'];

/** Faces, triangle strips, and what is of no use here. */
function readOthers({ name, count, properties }: Element, source: Source, faces: Faces, leftOut: Set<string>): void {
  const uses = properties.map((property) => {
    if (property.countType === null) return 'skip';
    if (name === 'face' && kIndices.includes(property.name)) return 'face';
    return name === 'tristrips' && kIndices.includes(property.name) ? 'strip' : 'skip';
  });
  if (name === 'edge') leftOut.add('Edges are');
  properties.forEach((property, i) => {
    if (name === 'face' && uses[i] === 'skip') leftOut.add(`“${property.name}” of faces is`);
  });
  if (properties.length === 0) return;
  for (let e = 0; e < count; e++) {
    source.begin();
    for (let i = 0; i < properties.length; i++) {
      const property = properties[i];
      if (uses[i] === 'face') faces.readFace(source, property, e);
      else if (uses[i] === 'strip') faces.readStrip(source, property);
      else if (property.countType === null) source.next(property.type);
      else skipList(property, source);
    }
    source.end();
  }
}

const lengthOf = (countType: Scalar, source: Source): number => {
  const length = source.next(countType);
  if (Number.isInteger(length) && length >= 0) return length;
  throw badFile(`${length} is no length of a list`, source.place);
};

function skipList({ type, countType }: Property, source: Source): void {
  if (countType === null) return;
  for (let left = lengthOf(countType, source); left > 0; left--) source.next(type);
}

class Faces {
  /** How many faces had fewer than three vertices. */
  few = 0;
  private readonly faces = new Growing(new Uint32Array(3072));
  private readonly builder = new FaceBuilder(this.faces);
  /** The largest number of a vertex so far, which may come later, and where it is. */
  private most: { readonly vertex: number; readonly what: string; readonly place: object } = { vertex: -1, what: '', place: {} };

  readFace(source: Source, { type, countType }: Property, face: number): void {
    if (countType === null) return;
    for (let left = lengthOf(countType, source); left > 0; left--) {
      const vertex = source.next(type);
      if (!(vertex <= this.most.vertex && vertex >= 0 && Number.isInteger(vertex))) this.check(vertex, `face ${face}`, { face, ...source.place });
      this.builder.add(vertex);
    }
    if (this.builder.end() < 3) this.few++;
  }

  /** Every other triangle of a strip runs the other way round; −1 begins another. */
  readStrip(source: Source, { type, countType }: Property): void {
    if (countType === null) return;
    let [a, b, at] = [0, 0, 0];
    for (let left = lengthOf(countType, source); left > 0; left--) {
      const vertex = source.next(type);
      if (vertex === -1) {
        at = 0;
        continue;
      }
      this.check(vertex, 'a strip', source.place);
      if (at >= 2 && a !== b && b !== vertex && a !== vertex) {
        for (const corner of at % 2 === 0 ? [a, b, vertex] : [b, a, vertex]) this.faces.push(corner);
      }
      [a, b] = [b, vertex];
      at++;
    }
  }

  taken(positions: Float32Array | Float64Array): Uint32Array {
    const n = positions.length / 3;
    const { vertex, what, place } = this.most;
    if (vertex >= n) throw badFile(`${what} names the vertex ${vertex}, and there are only ${n}`, place);
    if (this.faces.length === 0) throw badFile('the file has no faces');
    const faces = this.faces.taken();
    this.builder.cut(faces, positions);
    return faces;
  }

  private check(vertex: number, what: string, place: object): void {
    if (!Number.isInteger(vertex) || vertex < 0) throw badFile(`${what} names the vertex ${vertex}`, place);
    if (vertex > this.most.vertex) this.most = { vertex, what, place };
  }
}
