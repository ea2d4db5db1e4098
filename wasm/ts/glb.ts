// Meshes in GLB, by glTF Transform, which is bundled into this module and fetched with it. It knows sparse and quantised data,
// and where nodes stand. What it would not notice is checked before: it takes what lies beyond the end for nothing.
// Only what is needed is handed to it, since it copies all it gets, and refuses extensions that are about materials.
import { Document, GLB_BUFFER, Logger, Primitive, VertexLayout, WebIO, type GLTF, type mat4, type Node } from '@gltf-transform/core';
import { weldedAttributes } from './attributes.js';
import { SoapfilmError } from './errors.js';
import { reducedGltf, splitGlb, type Gltf } from './gltf.js';
import { Growing } from './growing.js';
import { badFile, kColor, kSeamWarning, kUv, meshFile, type MeshFile, type ReadMeshOptions } from './mesh_file.js';
import { placesOf, type Places } from './places.js';
import type { MeshAttribute, MeshLike } from './types.js';

const io = (): WebIO => new WebIO().setLogger(new Logger(Logger.Verbosity.SILENT)).setVertexLayout(VertexLayout.SEPARATE);

/** @throws SoapfilmError `bad-file` */
export async function readGlb(bytes: Uint8Array<ArrayBuffer>, seams: ReadMeshOptions['seams']): Promise<MeshFile> {
  try {
    const glb = splitGlb(bytes);
    const { json, resources, warnings } = reducedGltf(glb.json as Gltf, glb.data, GLB_BUFFER);
    const document = await io().readJSON({ json: json as unknown as GLTF.IGLTF, resources });
    return meshOf(document, seams === 'split', warnings);
  } catch (error) {
    if (error instanceof SoapfilmError) throw error;
    // Something is not of the kind that it has to be.
    throw badFile('the file is damaged', {}, { cause: error });
  }
}

/** All primitives, one after the other. */
class Parts {
  readonly points = new Growing(new Float32Array(3072));
  readonly faces = new Growing(new Uint32Array(3072));
  readonly uvs = new Growing(new Float32Array(2048));
  /** Four for each vertex. */
  readonly colors = new Growing(new Float32Array(4096));
  hasAlpha = false;
  hasOthers = false;

  add(node: Node): void {
    const matrix = node.getWorldMatrix();
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      if (primitive.getMode() < Primitive.Mode.TRIANGLES) this.hasOthers = true;
      else this.addPrimitive(primitive, matrix);
    }
  }

  private addPrimitive(primitive: Primitive, matrix: mat4): void {
    const positions = primitive.getAttribute('POSITION');
    if (!positions) return;
    const first = this.points.length / 3;
    const n = positions.getCount();
    const point = [0, 0, 0];
    for (let i = 0; i < n; i++) {
      const [x, y, z] = positions.getElement(i, point);
      for (let axis = 0; axis < 3; axis++) {
        const at = matrix[axis] * x + matrix[4 + axis] * y + matrix[8 + axis] * z + matrix[12 + axis];
        if (!Number.isFinite(Math.fround(at))) throw badFile(`a coordinate of vertex ${first + i} is not a finite number`, { vertex: first + i });
        this.points.push(at);
      }
    }
    const order: ArrayLike<number> & Iterable<number> = (primitive.getIndices()?.getArray() as Uint32Array | null | undefined) ?? Uint32Array.from({ length: n }, (_, i) => i);
    for (const vertex of order) {
      if (vertex >= n) throw badFile(`a triangle names the vertex ${vertex}, and there are only ${n}`);
    }
    this.addFaces(order, primitive.getMode(), first, determinantOf(matrix) < 0);
    const color = primitive.getAttribute('COLOR_0');
    if (color && color.getCount() === n) {
      const rgba = [1, 1, 1, 1];
      if (color.getElementSize() === 4) this.hasAlpha = true;
      for (let i = 0; i < n; i++) {
        color.getElement(i, rgba);
        for (let k = 0; k < 4; k++) this.colors.push(k < 3 ? toDisplay(rgba[k]) : rgba[k]);
      }
    }
    const uv = primitive.getAttribute('TEXCOORD_0');
    if (uv && uv.getCount() === n) {
      const pair = [0, 0];
      for (let i = 0; i < n; i++) {
        uv.getElement(i, pair);
        this.uvs.push(pair[0]);
        this.uvs.push(1 - pair[1]);
      }
    }
  }

  /** Triangles one by one, as a strip, or as a fan. Those of what is mirrored run the other way round. */
  private addFaces(order: ArrayLike<number>, mode: number, first: number, isMirrored: boolean): void {
    const { faces } = this;
    const put = (a: number, b: number, c: number): void => {
      faces.push(first + a);
      faces.push(first + (isMirrored ? c : b));
      faces.push(first + (isMirrored ? b : c));
    };
    if (mode === Primitive.Mode.TRIANGLES) {
      for (let i = 0; i + 2 < order.length; i += 3) put(order[i], order[i + 1], order[i + 2]);
      return;
    }
    for (let i = 2; i < order.length; i++) {
      const isOdd = mode === Primitive.Mode.TRIANGLE_STRIP && i % 2 === 1;
      const [a, b] = mode === Primitive.Mode.TRIANGLE_FAN ? [order[0], order[i - 1]] : isOdd ? [order[i - 1], order[i - 2]] : [order[i - 2], order[i - 1]];
      if (a !== b && b !== order[i] && a !== order[i]) put(a, b, order[i]);
    }
  }
}

function meshOf(document: Document, doSplit: boolean, warnings: string[]): MeshFile {
  const parts = new Parts();
  document.getRoot().getDefaultScene()?.traverse((node) => { parts.add(node); });
  if (parts.faces.length === 0) throw badFile('the file has no triangles');
  if (parts.hasOthers) warnings.push('Lines and points are left out');
  const points = parts.points.taken();
  const n = points.length / 3;
  const given: Record<string, MeshAttribute> = {};
  if (parts.colors.length === 4 * n) {
    const all = parts.colors.taken();
    given[kColor] = parts.hasAlpha ? { data: all, size: 4 } : { data: all.filter((_, i) => i % 4 < 3), size: 3 };
  } else if (parts.colors.length > 0) warnings.push('Only some vertices have a colour: colours are left out');
  if (parts.uvs.length === 2 * n) given[kUv] = { data: parts.uvs.taken(), size: 2 };
  else if (parts.uvs.length > 0) warnings.push('Only some vertices have texture coordinates: these are left out');
  // Files split vertices for their normals and textures.
  const { positions, placeOf } = joined(points, doSplit ? given[kUv] : undefined);
  const faces = parts.faces.taken().map((vertex) => placeOf[vertex]);
  const attributes = weldedAttributes(given, placeOf, positions.length / 3);
  const isKept = ([name, { data }]: [string, MeshAttribute]): boolean => {
    if (name !== kUv || placeOf.every((place, i) => given[kUv].data[2 * i] === data[2 * place] && given[kUv].data[2 * i + 1] === data[2 * place + 1])) {
      return true;
    }
    warnings.push(kSeamWarning);
    return false;
  };
  return meshFile('glb', { positions, faces }, Object.entries(attributes).filter(isKept), warnings);
}

/** Vertices at the same place as one; those with different texture coordinates, if given, stay apart. */
function joined(points: Float32Array, uv: MeshAttribute | undefined): Places {
  if (!uv) return placesOf(points, 3);
  const numbers = new Float32Array((5 * points.length) / 3);
  for (let i = 0; 3 * i < points.length; i++) {
    for (let k = 0; k < 5; k++) numbers[5 * i + k] = k < 3 ? points[3 * i + k] : uv.data[2 * i + k - 3];
  }
  const { positions, placeOf } = placesOf(numbers, 5);
  return { positions: positions.filter((_, i) => i % 5 < 3), placeOf };
}

/** Of the part that turns and scales. */
const determinantOf = (m: mat4): number =>
  m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) + m[8] * (m[1] * m[6] - m[2] * m[5]);

/** Colours of glTF are linear in light; those of all else are as displays take them (sRGB, IEC 61966-2-1). */
const toDisplay = (x: number): number => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
const toLinear = (x: number): number => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);

/** @param mesh checked: its indices are within range, its attributes `color` and `uv` have the right sizes */
export async function writeGlb({ positions, faces, attributes = {} }: MeshLike, name: string): Promise<Uint8Array<ArrayBuffer>> {
  const document = new Document();
  const buffer = document.createBuffer();
  const n = positions.length / 3;
  const primitive = document
    .createPrimitive()
    .setAttribute('POSITION', document.createAccessor().setBuffer(buffer).setType('VEC3').setArray(Float32Array.from(positions)))
    // The largest number of a type would begin anew.
    .setIndices(document.createAccessor().setBuffer(buffer).setType('SCALAR').setArray(n < 65536 ? Uint16Array.from(faces) : faces.slice()));
  if (kColor in attributes) {
    const { data, size } = attributes[kColor];
    const linear = data.map((x, i) => (i % size < 3 ? toLinear(Math.min(1, Math.max(0, x))) : x));
    primitive.setAttribute('COLOR_0', document.createAccessor().setBuffer(buffer).setType(size === 4 ? 'VEC4' : 'VEC3').setArray(linear));
  }
  if (kUv in attributes) {
    const down = attributes[kUv].data.map((x, i) => (i % 2 === 1 ? 1 - x : x));
    primitive.setAttribute('TEXCOORD_0', document.createAccessor().setBuffer(buffer).setType('VEC2').setArray(down));
  }
  const node = document.createNode(name).setMesh(document.createMesh(name).addPrimitive(primitive));
  document.getRoot().setDefaultScene(document.createScene().addChild(node)).getAsset().generator = 'soapfilm';
  return io().writeBinary(document);
}
