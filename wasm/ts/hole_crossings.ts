// Patches of different holes that cross each other: which are near enough to be tested, and what the test tells.
import type { BareMesh } from './compute_holes.js';
import type { RimSplits } from './hole_splits.js';
import type { FilledHole } from './types.js';

/** The new part of a filled mesh. */
export interface Patches {
  readonly holes: readonly FilledHole[];
  /** Numbered on from the vertices of the mesh. */
  readonly positions: Float64Array;
  /** Numbered on from the faces of the mesh, with vertices of the whole. */
  readonly faces: Uint32Array;
  /** For holes that are not filled, where their rims would have to be split. */
  readonly splits: RimSplits;
}

/** Patches whose boxes overlap, as a mesh of their own. */
interface ClosePatches {
  readonly mesh: BareMesh;
  /** By its faces: their numbers in the filled mesh. */
  readonly faces: Uint32Array;
  /** By its faces: the number of the hole. */
  readonly holes: Uint32Array;
}

/** Undefined if no two boxes overlap. Few do: then no more than the boxes is computed. */
export function closePatches(old: BareMesh, patches: Patches): ClosePatches | undefined {
  const oldFaces = old.faces.length / 3;
  const close = overlapping(patches.holes.filter(({ faces: [from, to] }) => from < to).map((hole) => [hole, boxOf(old, patches, hole)]));
  if (close.length === 0) return undefined;
  const numbers = new Map<number, number>();
  const positions: number[] = [];
  const faces: number[] = [];
  const holes: number[] = [];
  const vertices: number[] = [];
  for (const { group, faces: [from, to] } of close) {
    for (let face = from; face < to; face++) {
      faces.push(face);
      holes.push(group);
      for (const v of patches.faces.subarray(3 * (face - oldFaces), 3 * (face - oldFaces) + 3)) {
        let number = numbers.get(v);
        if (number === undefined) {
          number = numbers.size;
          numbers.set(v, number);
          for (let axis = 0; axis < 3; axis++) positions.push(coordinate(old, patches, 3 * v + axis));
        }
        vertices.push(number);
      }
    }
  }
  const mesh = { positions: Float64Array.from(positions), faces: Uint32Array.from(vertices) };
  return { mesh, faces: Uint32Array.from(faces), holes: Uint32Array.from(holes) };
}

/** The patches with pairs of faces of different ones, of which each hole is told. */
export function withCrossings(patches: Patches, close: ClosePatches, pairs: Uint32Array): Patches {
  const more = patches.holes.map((): number[] => []);
  for (let i = 0; i < pairs.length; i += 2) {
    const [a, b] = [pairs[i], pairs[i + 1]];
    const [one, other] = [close.holes[a], close.holes[b]];
    // What crosses itself is known.
    if (one === other) continue;
    more[one].push(close.faces[a], close.faces[b]);
    more[other].push(close.faces[b], close.faces[a]);
  }
  const holes = patches.holes.map((hole, h): FilledHole => {
    if (more[h].length === 0) return hole;
    return { ...hole, status: 'self-intersecting', intersections: Uint32Array.from([...hole.intersections, ...more[h]]) };
  });
  return { ...patches, holes };
}

type Box = readonly [low: readonly number[], high: readonly number[]];

/** A number of the filled mesh's positions. */
const coordinate = (old: BareMesh, { positions }: Patches, i: number): number =>
  i < old.positions.length ? old.positions[i] : positions[i - old.positions.length];

function boxOf(old: BareMesh, patches: Patches, { faces: [from, to] }: FilledHole): Box {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (const v of patches.faces.subarray(3 * from - old.faces.length, 3 * to - old.faces.length)) {
    for (let axis = 0; axis < 3; axis++) {
      const x = coordinate(old, patches, 3 * v + axis);
      if (x < low[axis]) low[axis] = x;
      if (x > high[axis]) high[axis] = x;
    }
  }
  return [low, high];
}

/** Those with a box that overlaps another's, swept along x. */
function overlapping<T>(items: readonly (readonly [T, Box])[]): T[] {
  const order = items.map((_, i) => i).sort((i, j) => items[i][1][0][0] - items[j][1][0][0]);
  const isClose = items.map(() => false);
  let open: number[] = [];
  for (const i of order) {
    const [low, high] = items[i][1];
    open = open.filter((j) => items[j][1][1][0] >= low[0]);
    for (const j of open) {
      const [from, to] = items[j][1];
      if (low[1] <= to[1] && from[1] <= high[1] && low[2] <= to[2] && from[2] <= high[2]) isClose[i] = isClose[j] = true;
    }
    open.push(i);
  }
  return items.filter((_, i) => isClose[i]).map(([item]) => item);
}
