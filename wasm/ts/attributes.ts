// Attributes of a mesh's vertices, such as colours, carried on over patches: harmonic, so that every new vertex is the
// mean of its neighbours and those on the rim keep what they have.
import { entriesOf, fieldsOf, guarded, mustBe, viewOf } from './check.js';
import { SoapfilmError } from './errors.js';
import type { MeshAttribute } from './types.js';

export type Attributes = Readonly<Record<string, MeshAttribute>>;

/**
 * The attributes as they are, checked; copies where they must be.
 * @throws SoapfilmError `bad-attributes`
 */
export function attributesOf(given: unknown, vertices: number, own: boolean): Attributes | undefined {
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

/** A step that changes nothing by more than this share of what there is, is the last. */
const kTolerance = 1e-5;
const kMostSteps = 300;

/**
 * The attributes of old vertices and of `added` new ones, which the new faces name from `old` on.
 * @param faces `[3m]` the new faces only
 */
export function carriedOn(attributes: Attributes, old: number, added: number, faces: Uint32Array): Attributes {
  const graph = neighboursOf(old, added, faces);
  return mapped(attributes, ({ data, size }) => {
    const all = new Float32Array(size * (old + added));
    all.set(data);
    for (let k = 0; k < size; k++) solve(all, size, k, graph);
    return { data: all, size };
  });
}

/** The vertices next to each new one; one that is next to it in two faces is there twice. */
interface Graph {
  /** How many old vertices there are. */
  readonly old: number;
  /** `[added + 1]` offsets into `neighbours`. */
  readonly starts: Uint32Array;
  readonly neighbours: Uint32Array;
}

function neighboursOf(old: number, added: number, faces: Uint32Array): Graph {
  const starts = new Uint32Array(added + 1);
  for (const v of faces) if (v >= old) starts[v - old + 1] += 2;
  for (let i = 0; i < added; i++) starts[i + 1] += starts[i];
  const next = starts.slice();
  const neighbours = new Uint32Array(starts[added]);
  for (let f = 0; f < faces.length; f += 3) {
    for (let k = 0; k < 3; k++) {
      const v = faces[f + k];
      if (v < old) continue;
      neighbours[next[v - old]++] = faces[f + ((k + 1) % 3)];
      neighbours[next[v - old]++] = faces[f + ((k + 2) % 3)];
    }
  }
  return { old, starts, neighbours };
}

/**
 * Number k of each new vertex: solves (degree - adjacency) x = sum of the old neighbours' numbers, by conjugate
 * gradients from 0.
 */
function solve(all: Float32Array, size: number, k: number, { old, starts, neighbours }: Graph): void {
  const added = starts.length - 1;
  const x = new Float64Array(added);
  const rest = new Float64Array(added);
  for (let i = 0; i < added; i++) {
    for (let at = starts[i]; at < starts[i + 1]; at++) if (neighbours[at] < old) rest[i] += all[size * neighbours[at] + k];
  }
  let square = rest.reduce((sum, r) => sum + r * r, 0);
  const enough = square * kTolerance ** 2;
  const way = rest.slice();
  const image = new Float64Array(added);
  for (let step = 0; step < kMostSteps && square > enough; step++) {
    for (let i = 0; i < added; i++) {
      image[i] = (starts[i + 1] - starts[i]) * way[i];
      for (let at = starts[i]; at < starts[i + 1]; at++) if (neighbours[at] >= old) image[i] -= way[neighbours[at] - old];
    }
    const length = square / way.reduce((sum, w, i) => sum + w * image[i], 0);
    let next = 0;
    for (let i = 0; i < added; i++) {
      x[i] += length * way[i];
      rest[i] -= length * image[i];
      next += rest[i] * rest[i];
    }
    const share = next / square;
    for (let i = 0; i < added; i++) way[i] = rest[i] + share * way[i];
    square = next;
  }
  for (let i = 0; i < added; i++) all[size * (old + i) + k] = x[i];
}

/** What the vertices from `old` on have. */
export const tailsOf = (attributes: Attributes, old: number): Attributes =>
  mapped(attributes, ({ data, size }) => ({ data: data.slice(size * old), size }));

function mapped(attributes: Attributes, make: (attribute: MeshAttribute) => MeshAttribute): Attributes {
  return Object.fromEntries(Object.entries(attributes).map(([name, attribute]) => [name, make(attribute)]));
}
