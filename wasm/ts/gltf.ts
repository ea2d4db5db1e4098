// The two parts of a GLB, and what of its description is about triangles: checked, so that whoever reads the data finds them
// all there.
import { badFile } from './mesh_file.js';

interface View {
  readonly buffer: number;
  readonly byteOffset?: number;
  readonly byteLength: number;
  readonly byteStride?: number;
}

interface Accessor {
  readonly bufferView?: number;
  readonly byteOffset?: number;
  readonly componentType: number;
  readonly count: number;
  readonly type: string;
  readonly sparse?: {
    readonly count: number;
    readonly indices: { readonly bufferView: number; readonly byteOffset?: number; readonly componentType: number };
    readonly values: { readonly bufferView: number; readonly byteOffset?: number };
  };
}

interface Primitive {
  readonly attributes: Readonly<Partial<Record<string, number>>>;
  readonly indices?: number;
  readonly mode?: number;
  readonly material?: number;
  readonly extensions?: object;
}

interface Node {
  readonly mesh?: number;
  readonly skin?: number;
  readonly children?: readonly number[];
  readonly extensions?: object;
}

export interface Gltf {
  readonly asset?: unknown;
  readonly scene?: number;
  readonly scenes?: readonly { readonly nodes?: readonly number[] }[];
  readonly nodes?: readonly Node[];
  readonly meshes?: readonly { readonly primitives: readonly Primitive[] }[];
  readonly accessors?: readonly Accessor[];
  readonly bufferViews?: readonly View[];
  readonly buffers?: readonly { readonly uri?: string }[];
}

/** Marks of the two chunks: "JSON" and "BIN". */
const [kJson, kBin] = [0x4e4f534a, 0x004e4942];

type Bytes = Uint8Array<ArrayBuffer>;

/** @throws SoapfilmError `bad-file` */
export function splitGlb(bytes: Bytes): { readonly json: unknown; readonly data: Bytes } {
  if (bytes.length < 20) throw badFile('the file ends too early');
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const [version, all] = [view.getUint32(4, true), view.getUint32(8, true)];
  if (version !== 2) throw badFile(`the file is of version ${version} of GLB, and only 2 is read`);
  if (all > bytes.length) throw badFile(`the file ends too early: it has ${bytes.length} of ${all} bytes`);
  let json: unknown;
  let data = new Uint8Array();
  for (let at = 12; at + 8 <= all; ) {
    const [length, mark] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    if (at + 8 + length > all) throw badFile(`the file is damaged: a part of ${length} bytes begins at byte ${at}, and goes on beyond the end`);
    const chunk = bytes.subarray(at + 8, at + 8 + length);
    if (mark === kJson) json ??= JSON.parse(new TextDecoder().decode(chunk)) as unknown;
    if (mark === kBin) data = chunk;
    at += 8 + length;
  }
  if (typeof json !== 'object' || json === null) throw badFile('the file is damaged: it has no description');
  return { json, data };
}

interface Reduced {
  readonly json: object;
  /** The bytes of buffers, by their names. */
  readonly resources: Record<string, Bytes>;
  readonly warnings: string[];
}

/** How many numbers there are in an element of each type that triangles need. */
const kWidths: Readonly<Partial<Record<string, number>>> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
/** The bytes of a number of each type. */
const kBytes: Readonly<Partial<Record<number, number>>> = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };

/** The attributes that are read, and what their elements may be. */
const kAttributes: Readonly<Record<string, readonly string[]>> = { POSITION: ['VEC3'], COLOR_0: ['VEC3', 'VEC4'], TEXCOORD_0: ['VEC2'] };

/**
 * The nodes of the scene, their meshes, and the data that these name.
 * @param data the binary part
 * @param own the name of the buffer that is the binary part
 * @throws SoapfilmError `bad-file`; a TypeError where something is of another kind altogether
 */
export function reducedGltf(json: Gltf, data: Bytes, own: string): Reduced {
  const warnings = new Set<string>();
  const accessors = new AccessorList(json, data);
  const roots = checkNodes(json, warnings);
  const meshes = (json.meshes ?? []).map(({ primitives }) => ({
    primitives: primitives.map(({ attributes, indices, mode, material, extensions }) => {
      const compression = Object.keys(extensions ?? {}).find((name) => /draco|meshopt/i.test(name));
      if (compression !== undefined) throw badFile(`the mesh is compressed (${compression}), which is not read`);
      if (material !== undefined) warnings.add('Materials are left out');
      const kept = Object.keys(kAttributes).flatMap((name) => {
        const number = attributes[name];
        return number === undefined ? [] : [[name, accessors.add(number, kAttributes[name])] as const];
      });
      return {
        attributes: Object.fromEntries(kept),
        ...(indices !== undefined && { indices: accessors.add(indices, ['SCALAR']) }),
        ...(mode !== undefined && { mode }),
      };
    }),
  }));
  const nodes = (json.nodes ?? []).map(({ mesh, children, ...node }) => {
    const { matrix, translation, rotation, scale } = node as Record<string, unknown>;
    return Object.fromEntries(Object.entries({ mesh, children, matrix, translation, rotation, scale }).filter(([, value]) => value !== undefined));
  });
  return {
    json: {
      asset: { version: '2.0' },
      scene: 0,
      scenes: [{ nodes: roots }],
      nodes,
      meshes,
      accessors: accessors.kept,
      bufferViews: accessors.views(),
      buffers: [{ byteLength: data.length }],
    },
    resources: { [own]: data },
    warnings: [...warnings],
  };
}

/** The roots of the scene. Every node has to have one parent at most, and no node may be below itself. */
function checkNodes({ nodes = [], scenes, scene = 0, meshes = [] }: Gltf, warnings: Set<string>): readonly number[] {
  const isBelow = new Uint8Array(nodes.length);
  nodes.forEach(({ children = [] }, i) => {
    for (const child of children) {
      if (!(child in nodes)) throw badFile(`the file is damaged: there is no node ${child}`);
      if (isBelow[child] === 1) throw badFile(`the file is damaged: node ${child} is below two others`);
      if (child === i) throw badFile(`the file is damaged: node ${i} is below itself`);
      isBelow[child] = 1;
    }
  });
  const roots = scenes ? (scenes[scene].nodes ?? []) : [...nodes.keys()].filter((i) => isBelow[i] === 0);
  // With one parent each, only a loop is out of reach of all that have none.
  const open = [...nodes.keys()].filter((i) => isBelow[i] === 0);
  let reached = 0;
  for (let i = open.pop(); i !== undefined; i = open.pop()) {
    reached++;
    const { mesh, skin, children = [], extensions = {} } = nodes[i];
    open.push(...children);
    if (mesh !== undefined && !(mesh in meshes)) throw badFile(`the file is damaged: there is no mesh ${mesh}`);
    if (skin !== undefined) warnings.add('Skeletons are left out');
    if ('EXT_mesh_gpu_instancing' in extensions) warnings.add('Copies of meshes (EXT_mesh_gpu_instancing) are left out');
  }
  if (reached < nodes.length) throw badFile('the file is damaged: a node is below itself');
  for (const root of roots) if (!(root in nodes)) throw badFile(`the file is damaged: there is no node ${root}`);
  return roots;
}

/** The accessors that are used, with numbers of their own. */
class AccessorList {
  readonly kept: Accessor[] = [];
  private readonly numbers = new Map<number, number>();
  private readonly usedViews = new Set<number>();

  constructor(
    private readonly json: Gltf,
    private readonly data: Uint8Array,
  ) {}

  /** @returns the new number */
  add(number: number, types: readonly string[]): number {
    const accessor = this.json.accessors?.[number];
    const what = `accessor ${number}`;
    if (!accessor) throw badFile(`the file is damaged: there is no ${what}`);
    if (!types.includes(accessor.type)) throw badFile(`the file is damaged: ${what} is ${accessor.type}, and not ${types.join(' or ')}`);
    const known = this.numbers.get(number);
    if (known !== undefined) return known;
    this.check(accessor, what);
    this.numbers.set(number, this.kept.length);
    this.kept.push(accessor);
    return this.kept.length - 1;
  }

  /** All views, by their numbers; those that are not used are empty. */
  views(): View[] {
    return (this.json.bufferViews ?? []).map((view, i) => (this.usedViews.has(i) ? view : { buffer: 0, byteLength: 0 }));
  }

  private check({ bufferView, byteOffset, componentType, count, type, sparse }: Accessor, what: string): void {
    const width = kWidths[type] ?? 0;
    if (bufferView !== undefined) this.checkRange(bufferView, byteOffset, componentType, width, count, what);
    // Zeros, but for some: no reason for more of them than the file has bytes.
    else if (sparse === undefined || !(count <= this.data.length)) throw badFile(`${what} has no data in the file`);
    if (sparse === undefined) return;
    const { indices, values } = sparse;
    this.checkRange(indices.bufferView, indices.byteOffset, indices.componentType, 1, sparse.count, what);
    this.checkRange(values.bufferView, values.byteOffset, componentType, width, sparse.count, what);
  }

  private checkRange(number: number, offset = 0, componentType: number, width: number, count: number, what: string): void {
    const { json, data } = this;
    const view = json.bufferViews?.[number];
    const size = (kBytes[componentType] ?? NaN) * width;
    if (!view || !(view.buffer in (json.buffers ?? []))) throw badFile(`the file is damaged: ${what} names data that are not there`);
    if (view.buffer !== 0 || json.buffers?.[0]?.uri !== undefined) throw badFile(`the data of ${what} are in another file`);
    const { byteOffset = 0, byteLength, byteStride = size } = view;
    const all = [offset, byteOffset, byteLength, byteStride, count];
    const isWhole = all.every((x) => Number.isInteger(x) && x >= 0) && byteOffset + byteLength <= data.length;
    if (!isWhole || byteStride < size || (count > 0 && offset + (count - 1) * byteStride + size > byteLength)) {
      throw badFile(`the file is damaged: the data of ${what} go on beyond their end`);
    }
    this.usedViews.add(number);
  }
}
