// What filling has made of holes: patches, which of them can be kept, and meshes with patches.
import type { FilledHole, FillResult } from 'soapfilm';
import { add, subtract, type Box } from '../../shapes/vec.ts';
import { joined, picked, type Attributes } from './attributes.ts';
import type { Hole } from './grouping.ts';
import type { MeshShape } from './settings.ts';
import { boxOfLoops, type Found, type Whole } from './whole.ts';

/** A face along a rim that had to be split. */
interface SplitPieces {
  readonly face: number;
  /** `[3k]` vertices, as patches have them. The first piece takes the place of the face. */
  readonly pieces: Uint32Array;
}

/** What comes with patches besides their faces: of one patch, or of all those along whose rims the same faces had to be split. */
interface Addition {
  /** `[3n]` new vertices. */
  readonly positions: Float32Array;
  /** Of the new vertices: those that the mesh has. */
  readonly attributes?: Attributes;
  readonly split: readonly SplitPieces[];
}

/** What became of one hole. */
export interface Patch {
  readonly of: Whole;
  /** How it was made. */
  readonly manner: string;
  readonly result: FilledHole;
  /** `[3m]` vertices of the whole mesh, and from its number of vertices on those of the addition. */
  readonly faces: Uint32Array;
  readonly added: Addition;
  /** Numbers of its faces that intersect something, and of the mesh's that it intersects. */
  readonly crossing: readonly number[];
  readonly crossed: readonly number[];
  /** The patches that it intersects or shares its addition with, by the keys of their holes: without them it would be another. */
  readonly peers: ReadonlyMap<string, Patch>;
}

/** How patches are made, and of which mesh. */
export type Making = Pick<Patch, 'of' | 'manner'>;

export type Patches = ReadonlyMap<string, Patch>;

/** What a hole is known by. */
export const keyOf = ({ loops }: Pick<Hole, 'loops'>): string => loops.join(' ');

/** Tells whether a hole has the patch that it is to have, where no other holes are filled than `all`. */
export function currentAmong(all: readonly Hole[], kept: Patches, { of, manner }: Making): (hole: Hole) => boolean {
  const keys = new Set(all.map(keyOf));
  return (hole) => {
    const patch = kept.get(keyOf(hole));
    return patch?.of === of && patch.manner === manner && [...patch.peers].every(([key, peer]) => keys.has(key) && kept.get(key) === peer);
  };
}

/** The holes to be filled at once, so that all have current patches: with those whose patches the new ones may meet. */
export function dueAmong(all: readonly Hole[], kept: Patches, making: Making, report: Found['report']): Hole[] {
  const isCurrent = currentAmong(all, kept, making);
  const missing = all.filter((hole) => !isCurrent(hole));
  if (missing.length === 0 || missing.length === all.length) return missing;
  const reachOf = ({ loops }: Hole): Box => grown(boxOfLoops({ of: making.of, report }, loops));
  const boxes = missing.map(reachOf);
  const isNear = (hole: Hole): boolean => {
    const own = reachOf(hole);
    return boxes.some((box) => doMeet(box, own));
  };
  const due = new Set(all.filter(isNear).map(keyOf));
  // A set is walked to its end, with what is added on the way.
  for (const key of due) for (const peer of kept.get(key)?.peers.keys() ?? []) due.add(peer);
  return all.filter((hole) => due.has(keyOf(hole)));
}

/** A box and half as much again all round, for what bulges. */
function grown({ low, high }: Box): Box {
  const more = Math.max(...subtract(high, low)) / 2;
  return { low: subtract(low, [more, more, more]), high: add(high, [more, more, more]) };
}

const doMeet = (a: Box, b: Box): boolean => a.low.every((x, axis) => x <= b.high[axis] && b.low[axis] <= a.high[axis]);

/** The patches of holes, by their keys. @param result of these holes in this order, only the new part */
export function patchesIn(result: FillResult, filled: readonly Hole[], { of, manner }: Making): Map<string, Patch> {
  const { oldFaces, holes, splitFaces } = result;
  const keys = filled.map(keyOf);
  const ownerOf = ownersOf(holes);
  const marks = holes.map(() => ({ crossing: new Set<number>(), crossed: new Set<number>(), others: new Set<number>() }));
  const oldFaceOf = (face: number): number =>
    face < oldFaces ? face : (splitFaces.find(({ first, count }) => face >= first && face < first + count)?.face ?? face);
  holes.forEach(({ intersections }, h) => {
    for (const face of intersections) {
      const owner = ownerOf(face);
      if (owner === null) marks[h].crossed.add(oldFaceOf(face));
      else {
        marks[owner].crossing.add(face - holes[owner].faces[0]);
        marks[owner].others.add(h);
        marks[h].others.add(owner);
      }
    }
  });
  const made = withAdditions(result).map(({ faces, added }, h) => {
    const { crossing, crossed } = marks[h];
    return { of, manner, result: holes[h], faces, added, crossing: [...crossing], crossed: [...crossed], peers: new Map<string, Patch>() };
  });
  const sharing = new Map<Addition, number[]>();
  made.forEach(({ added }, h) => sharing.set(added, [...(sharing.get(added) ?? []), h]));
  made.forEach(({ peers, added }, h) => {
    for (const other of [...marks[h].others, ...(sharing.get(added) ?? [])]) if (other !== h) peers.set(keys[other], made[other]);
  });
  return new Map(made.map((patch, h) => [keys[h], patch]));
}

/** Which hole a new face is of; null: of none. */
function ownersOf(holes: readonly FilledHole[]): (face: number) => number | null {
  const order = holes.map((_, h) => h).filter((h) => holes[h].faces[0] < holes[h].faces[1]);
  order.sort((a, b) => holes[a].faces[0] - holes[b].faces[0]);
  return (face) => {
    let [low, high] = [0, order.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (holes[order[middle]].faces[1] <= face) low = middle + 1;
      else high = middle;
    }
    return low < order.length && holes[order[low]].faces[0] <= face ? order[low] : null;
  };
}

/** The faces of each hole, and what comes with them, numbered anew. */
function withAdditions({ mesh, oldVertices, oldFaces, holes, splitFaces }: FillResult): Pick<Patch, 'faces' | 'added'>[] {
  const cornersOf = (from: number, to: number): Uint32Array => mesh.faces.subarray(3 * (from - oldFaces), 3 * (to - oldFaces));
  const splits = splitFaces.map(({ face, corners, first, count }) => ({ face, pieces: [...corners, ...cornersOf(first, first + count)] }));
  const holeAt = new Map<number, number>();
  if (splits.length > 0) {
    holes.forEach(({ faces }, h) => {
      for (const vertex of cornersOf(...faces)) if (vertex >= oldVertices) holeAt.set(vertex, h);
    });
  }
  // Of each hole the least one that it shares an addition with.
  let least = holes.map((_, h) => h);
  const sharing = splits.map(({ pieces }) => pieces.flatMap((vertex) => holeAt.get(vertex) ?? []));
  for (const some of sharing) {
    const joint = new Set(some.map((h) => least[h]));
    const to = Math.min(...joint);
    least = least.map((h) => (joint.has(h) ? to : h));
  }
  const numbers = holes.map(() => new Map<number, number>());
  const renumbered = (h: number, corners: Uint32Array): Uint32Array =>
    corners.map((vertex) => {
      if (vertex < oldVertices) return vertex;
      const own = numbers[least[h]];
      const number = own.get(vertex) ?? own.size;
      own.set(vertex, number);
      return oldVertices + number;
    });
  const faces = holes.map((hole, h) => renumbered(h, cornersOf(...hole.faces)));
  const additions = numbers.map((own, h): Addition => {
    const split = splits.flatMap(({ face, pieces }, s) => (least[sharing[s][0]] === h ? { face, pieces: renumbered(h, Uint32Array.from(pieces)) } : []));
    const positions = new Float32Array(3 * own.size);
    for (const [vertex, number] of own) {
      const at = 3 * (vertex - oldVertices);
      positions.set(mesh.positions.subarray(at, at + 3), 3 * number);
    }
    return { positions, split, ...picked(mesh.attributes, Array.from(own.keys(), (vertex) => vertex - oldVertices)) };
  });
  return faces.map((own, h) => ({ faces: own, added: additions[least[h]] }));
}

/** What comes with patches, each once, with the number of its first vertex, and how many vertices there are in all. */
export function additionsOf(all: readonly Patch[]): { readonly starts: ReadonlyMap<Addition, number>; readonly count: number } {
  const starts = new Map<Addition, number>();
  let count = 0;
  for (const { added } of all) {
    if (starts.has(added)) continue;
    starts.set(added, count);
    count += added.positions.length / 3;
  }
  return { starts, count };
}

/** The mesh with patches, old vertices and faces first and as they were, but for those that had to be split. */
export function withPatches({ positions, faces, attributes }: Whole, all: readonly Patch[]): MeshShape {
  const n = positions.length / 3;
  const { starts, count } = additionsOf(all);
  const parts = all.map((patch) => ({ start: starts.get(patch.added) ?? 0, corners: patch.faces }));
  const points = new Float32Array(positions.length + 3 * count);
  const old = faces.slice();
  points.set(positions);
  for (const [{ positions: own, split }, start] of starts) {
    points.set(own, positions.length + 3 * start);
    for (const { face, pieces } of split) {
      old.set(pieces.subarray(0, 3).map((vertex) => (vertex < n ? vertex : vertex + start)), 3 * face);
      parts.push({ start, corners: pieces.subarray(3) });
    }
  }
  const corners = new Uint32Array(parts.reduce((sum, part) => sum + part.corners.length, old.length));
  corners.set(old);
  let to = old.length;
  for (const { start, corners: own } of parts) for (const vertex of own) corners[to++] = vertex < n ? vertex : vertex + start;
  return { positions: points, faces: corners, ...(attributes && joined([{ attributes }, ...starts.keys()])) };
}
