// Rims that get vertices of their own, where no surface can be had without: the faces along them are split.
import { mapped, type Attributes } from './attributes.js';
import type { FlatMesh } from './compute_holes.js';
import type { Patches } from './hole_crossings.js';
import type { FilledHole, SplitFace } from './types.js';

/** A vertex to be put on an edge of a face, at (1 - parameter) `tail` + parameter `head`. */
export interface RimSplit {
  readonly face: number;
  readonly tail: number;
  readonly head: number;
  readonly parameter: number;
}

/** By groups, which all need all of theirs. */
export type RimSplits = ReadonlyMap<number, readonly RimSplit[]>;

/** A mesh with some of its faces split: old vertices and faces first, each split face as its first piece. */
export interface SplitMesh {
  readonly mesh: Omit<FlatMesh, 'attributes'>;
  /** Attributes of the vertices on the rims. */
  readonly tails?: Attributes | undefined;
  readonly splitFaces: readonly SplitFace[];
}

/** Splits faces. The shape stays as it is, and so do attributes. */
export function splitRims(mesh: FlatMesh, splits: readonly RimSplit[]): SplitMesh {
  const old = mesh.positions.length / 3;
  const round = mesh.single ? Math.fround : (x: number): number => x;
  const between = ({ tail, head, parameter: t }: RimSplit, data: ArrayLike<number>, size: number, k: number): number =>
    (1 - t) * data[size * tail + k] + t * data[size * head + k];
  const onRims = (data: ArrayLike<number>, size: number): number[] =>
    splits.flatMap((split) => Array.from({ length: size }, (_, k) => round(between(split, data, size, k))));
  const positions = new Float64Array(mesh.positions.length + 3 * splits.length);
  positions.set(mesh.positions);
  positions.set(onRims(mesh.positions, 3), mesh.positions.length);
  const byFaces = new Map<number, Sides>();
  splits.forEach(({ face, tail, head, parameter }, i) => {
    const sides = byFaces.get(face) ?? new Map<string, OnSide[]>();
    byFaces.set(face, sides);
    const [side, at] = tail < head ? [`${tail} ${head}`, parameter] : [`${head} ${tail}`, 1 - parameter];
    sides.set(side, [...(sides.get(side) ?? []), { vertex: old + i, at }]);
  });
  const faces = mesh.faces.slice();
  const further: number[] = [];
  const splitFaces = [...byFaces].map(([face, sides]): SplitFace => {
    for (const list of sides.values()) list.sort((a, b) => a.at - b.at);
    const [a, b, c] = mesh.faces.subarray(3 * face, 3 * face + 3);
    const [corners, ...rest] = piecesOf([a, b, c], sides);
    faces.set(corners, 3 * face);
    const first = (faces.length + further.length) / 3;
    for (const piece of rest) further.push(...piece);
    return { face, corners: Uint32Array.from(corners), first, count: rest.length };
  });
  const all = new Uint32Array(faces.length + further.length);
  all.set(faces);
  all.set(further, faces.length);
  const tails = mesh.attributes && mapped(mesh.attributes, ({ data, size }) => ({ data: Float32Array.from(onRims(data, size)), size }));
  return { mesh: { positions, faces: all, single: mesh.single }, tails, splitFaces };
}

interface OnSide {
  readonly vertex: number;
  /** 0 at the end of the lower number, 1 at the other. */
  readonly at: number;
}

/** The vertices on the sides of a face, by the numbers of their ends, in order from the lower one. */
type Sides = Map<string, OnSide[]>;

type Triangle = readonly [number, number, number];

/** Splits a triangle at a vertex on a side, as long as there is one. None of the pieces is without area. */
function piecesOf([a, b, c]: Triangle, sides: Sides): Triangle[] {
  for (const [p, q, r] of [[a, b, c], [b, c, a], [c, a, b]] as const) {
    const [low, high] = p < q ? [p, q] : [q, p];
    const list = sides.get(`${low} ${high}`);
    if (!list) continue;
    const middle = list.length >> 1;
    const { vertex } = list[middle];
    // The vertex has a higher number than both ends.
    const [below, above] = [list.slice(0, middle), list.slice(middle + 1).reverse()];
    const rest = new Map(sides);
    rest.delete(`${low} ${high}`);
    if (below.length > 0) rest.set(`${low} ${vertex}`, below);
    if (above.length > 0) rest.set(`${high} ${vertex}`, above);
    return [...piecesOf([p, vertex, r], rest), ...piecesOf([vertex, q, r], rest)];
  }
  return [[a, b, c]];
}

/**
 * Patches of a mesh, and those of holes whose rims were split, as patches of the split mesh.
 * @param first numbered on from the mesh before
 * @param second numbered on from the split mesh
 * @param groups those that are of `second`
 */
export function joined(before: FlatMesh, { mesh, splitFaces }: SplitMesh, first: Patches, second: Patches, groups: readonly number[]): Patches {
  const shifted = (from: number, by: number) => (number: number): number => (number < from ? number : number + by);
  const [oldVertices, oldFaces] = [before.positions.length / 3, before.faces.length / 3];
  const [vertices, faces] = [mesh.positions.length / 3, mesh.faces.length / 3];
  const faceOfFirst = shifted(oldFaces, faces - oldFaces);
  const faceOfSecond = shifted(faces, first.faces.length / 3);
  const pieces = new Map(splitFaces.map(({ face, first, count }) => [face, [face, ...Array.from({ length: count }, (_, i) => first + i)]]));
  // Of a face that was whole, every piece is told: which of them is met, nobody has looked.
  const piecesOf = (pairs: Uint32Array): Uint32Array => {
    if (!pairs.some((face) => pieces.has(face))) return pairs;
    const told: number[] = [];
    for (let i = 0; i < pairs.length; i += 2) for (const met of pieces.get(pairs[i + 1]) ?? [pairs[i + 1]]) told.push(pairs[i], met);
    return Uint32Array.from(told);
  };
  const moved = (hole: FilledHole, faceOf: (face: number) => number): FilledHole => ({
    ...hole,
    faces: [faceOf(hole.faces[0]), faceOf(hole.faces[1])],
    intersections: hole.intersections.map(faceOf),
  });
  const movedFirst = (hole: FilledHole): FilledHole => {
    const { intersections, ...rest } = moved(hole, faceOfFirst);
    return { ...rest, intersections: piecesOf(intersections) };
  };
  const isSecond = new Set(groups);
  return {
    holes: first.holes.map((hole, g) => (isSecond.has(g) ? moved(second.holes[g], faceOfSecond) : movedFirst(hole))),
    positions: Float64Array.from([...first.positions, ...second.positions]),
    faces: Uint32Array.from([
      ...first.faces.map(shifted(oldVertices, vertices - oldVertices)),
      ...second.faces.map(shifted(vertices, first.positions.length / 3)),
    ]),
    splits: new Map(),
  };
}
