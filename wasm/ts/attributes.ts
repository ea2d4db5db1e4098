// Attributes of a mesh's vertices, such as colours, which go on over patches: harmonic, so that every new vertex is the
// mean of its neighbours and those on the rim keep what they have. The core finds the values.
import { entriesOf, fieldsOf, guarded, mustBe, viewOf } from './check.js';
import type { BareMesh, CarryWork } from './compute_holes.js';
import { SoapfilmError } from './errors.js';
import type { MeshAttribute } from './types.js';

export type Attributes = Readonly<Record<string, MeshAttribute>>;

/**
 * The attributes as they are, checked; copies where they must be.
 * @throws SoapfilmError `bad-attributes`
 */
export function checkedAttributes(given: unknown, vertices: number, own: boolean): Attributes | undefined {
  if (given === undefined) return undefined;
  const code = 'bad-attributes';
  const entries = entriesOf(given, 'mesh.attributes', code).map(([name, value]): [string, MeshAttribute] => {
    const path = `mesh.attributes.${name}`;
    const { data, size } = fieldsOf<MeshAttribute>(value, { data: true, size: true }, path, code);
    const numbers = guarded(code, path, () => viewOf(['Float32Array'], data));
    const fits = typeof size === 'number' && Number.isInteger(size) && size >= 1 && numbers?.length === size * vertices;
    if (!numbers || !fits) throw mustBe(code, path, `{ data: a Float32Array of ${vertices} times size numbers, size }`, value);
    const wrong = numbers.findIndex((x) => !Number.isFinite(x));
    if (wrong >= 0) throw new SoapfilmError(code, `\`${path}\` has a number that is not finite`, { vertex: Math.floor(wrong / size) });
    return [name, { data: own ? numbers.slice() : numbers, size }];
  });
  return Object.fromEntries(entries);
}

/** The attributes of the vertices that were the first at their places. */
export function weldedAttributes(attributes: Attributes, vertexMap: Uint32Array, count: number): Attributes {
  const first = firstsOf(vertexMap, count);
  return mapped(attributes, ({ data, size }) => {
    const kept = new Float32Array(size * count);
    first.forEach((from, to) => {
      kept.set(data.subarray(size * from, size * (from + 1)), size * to);
    });
    return { data: kept, size };
  });
}

/** By names, for each welded vertex: 1 where texture coordinates are not one, since charts meet there. */
export type Seams = Readonly<Record<string, Uint8Array>>;

/** Names that texture coordinates go by. */
const kTextureName = /^(uv|texcoord|st$)/i;

export function seamsOf(attributes: Attributes, vertexMap: Uint32Array, count: number): Seams {
  const charted = Object.entries(attributes).filter(([name, { size }]) => size === 2 && kTextureName.test(name));
  const first = firstsOf(vertexMap, count);
  return Object.fromEntries(
    charted.map(([name, { data }]) => {
      const seams = new Uint8Array(count);
      vertexMap.forEach((to, from) => {
        const differs = data[2 * from] !== data[2 * first[to]] || data[2 * from + 1] !== data[2 * first[to] + 1];
        if (differs) seams[to] = 1;
      });
      return [name, seams];
    }),
  );
}

/** By welded vertices: the first that each was before. */
function firstsOf(vertexMap: Uint32Array, count: number): Int32Array {
  const first = new Int32Array(count).fill(-1);
  vertexMap.forEach((to, from) => {
    if (first[to] < 0) first[to] = from;
  });
  return first;
}

/**
 * What the core needs to carry attributes on over patches: the faces, numbered anew, with the old vertices that are in
 * them first. Undefined if there is nothing to carry.
 * @param old the mesh that has the patches
 * @param tails attributes of those of its vertices that come after `attributes`
 */
export function carryWorkOf(attributes: Attributes, tails: Attributes | undefined, old: BareMesh, patches: BareMesh): CarryWork | undefined {
  const [oldVertices, added] = [old.positions.length / 3, patches.positions.length / 3];
  const parts = Object.entries(attributes);
  if (added === 0 || parts.length === 0) return undefined;
  const numbers = new Map<number, number>();
  for (const v of patches.faces) if (v < oldVertices && !numbers.has(v)) numbers.set(v, numbers.size);
  const fixed = numbers.size;
  const size = parts.reduce((sum, [, attribute]) => sum + attribute.size, 0);
  const positions = new Float64Array(3 * (fixed + added));
  const values = new Float64Array(fixed * size);
  for (const [vertex, number] of numbers) {
    positions.set(old.positions.subarray(3 * vertex, 3 * vertex + 3), 3 * number);
    let at = number * size;
    for (const [name, attribute] of parts) {
      const count = attribute.data.length / attribute.size;
      const [{ data }, v] = tails && vertex >= count ? [tails[name], vertex - count] : [attribute, vertex];
      values.set(data.subarray(attribute.size * v, attribute.size * (v + 1)), at);
      at += attribute.size;
    }
  }
  positions.set(patches.positions, 3 * fixed);
  const faces = patches.faces.map((v) => (v < oldVertices ? (numbers.get(v) as number) : v - oldVertices + fixed));
  return { mesh: { positions, faces }, fixed, values, size };
}

/**
 * The attributes of a filled mesh, or of its vertices from `from` on.
 * @param tails those of vertices on split rims
 * @param carried of all attributes, one after the other for each new vertex
 */
export function filledAttributes(attributes: Attributes, tails: Attributes | undefined, carried: Float64Array, from: number): Attributes {
  const total = Object.values(attributes).reduce((sum, { size }) => sum + size, 0);
  const added = carried.length / total;
  let channel = 0;
  const filled = Object.entries(attributes).map(([name, { data, size }]): [string, MeshAttribute] => {
    const old = data.subarray(size * from);
    const tail = tails ? tails[name].data : new Float32Array();
    const all = new Float32Array(old.length + tail.length + size * added);
    all.set(old);
    all.set(tail, old.length);
    let at = old.length + tail.length;
    for (let i = 0; i < added; i++) {
      for (let k = 0; k < size; k++) all[at++] = carried[total * i + channel + k];
    }
    channel += size;
    return [name, { data: all, size }];
  });
  return Object.fromEntries(filled);
}

export function mapped(attributes: Attributes, make: (attribute: MeshAttribute) => MeshAttribute): Attributes {
  return Object.fromEntries(Object.entries(attributes).map(([name, attribute]) => [name, make(attribute)]));
}
