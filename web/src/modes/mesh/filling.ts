// Filling the holes that are to be filled, in the worker. Patches are kept: only those that are missing, or were made in
// another way, are computed.
import { computed, signal } from '@preact/signals';
import type { FilledHole, FillResult, HoleFillOptions, SplitFace } from 'soapfilm';
import { add, subtract, type Box } from '../../shapes/vec.ts';
import { createWork } from '../../state/work.ts';
import { found, holes, settings, wishFor } from './holes.ts';
import { joined, picked, type Attributes } from './attributes.ts';
import type { Hole } from './grouping.ts';
import { kMode, type MeshSettings, type MeshShape, type Smoothness } from './settings.ts';
import { boxOfLoops, type Found, type Whole } from './whole.ts';
import { explain } from './wording.ts';

/** What became of one hole. */
export interface Patch {
  readonly of: Whole;
  /** How it was made. */
  readonly manner: string;
  readonly result: FilledHole;
  /**
   * `[3m]` vertices of the whole mesh, and from its number of vertices on those of this patch. At the end the further
   * pieces of faces that had to be split for it.
   */
  readonly faces: Uint32Array;
  /** Faces that had to be split: each is its first piece now. */
  readonly split: readonly Pick<SplitFace, 'face' | 'corners'>[];
  /** `[3n]` the patch's own vertices. */
  readonly positions: Float32Array;
  /** Of its own vertices: those that the mesh has. */
  readonly attributes?: Attributes;
  /** Numbers of its faces that intersect something, and of the mesh's that it intersects. */
  readonly crossing: readonly number[];
  readonly crossed: readonly number[];
}

interface Job extends Found {
  readonly holes: readonly Hole[];
  readonly manner: string;
  readonly options: HoleFillOptions;
}

const kFairness: Record<Smoothness, NonNullable<HoleFillOptions['fairness']>> = { none: 0, direction: 1, curvature: 2, auto: 'auto' };

const keyOf = ({ loops }: Hole): string => loops.join(' ');
const optionsOf = ({ smoothness, density, candidates, creases, creaseAngle }: MeshSettings): HoleFillOptions => ({
  fairness: kFairness[smoothness],
  density,
  candidates,
  creases: creases && creaseAngle,
});
/** The same for settings that make the same patches. */
const mannerOf = (of: MeshSettings): string => JSON.stringify(optionsOf(of));

const kept = signal<ReadonlyMap<string, Patch>>(new Map());

const wanted = computed(() => holes.value.filter((hole) => wishFor(hole) === 'fill'));

/** Changes exactly where there is something else to do. */
const jobKey = computed(() => [mannerOf(settings.value), ...wanted.value.map(keyOf)].join('\n'));

const job = computed<Job | null>(() => {
  const now = found.value;
  if (now === null || jobKey.value.indexOf('\n') < 0) return null;
  return { ...now, holes: wanted.peek(), manner: mannerOf(settings.peek()), options: optionsOf(settings.peek()) };
});

/** The patch of a hole, if it is to have one and has: perhaps one that was made in another way. */
export function patchOf(hole: Hole): Patch | null {
  const patch = wishFor(hole) === 'fill' ? kept.value.get(keyOf(hole)) : undefined;
  return patch && patch.of === found.value?.of ? patch : null;
}

/** Those of all holes, in their order. */
export const patches = computed<readonly Patch[]>(() => wanted.value.flatMap((hole) => patchOf(hole) ?? []));

/** Whether every hole that is to be filled has what the settings ask for. */
export const isSettled = computed(() => {
  const manner = mannerOf(settings.value);
  return found.value !== null && wanted.value.every((hole) => patchOf(hole)?.manner === manner);
});

export const filling = createWork<Job, ReadonlyMap<string, Patch>>({
  mode: kMode,
  verb: 'Filling',
  input: job,
  part: 'meshes',
  async compute(_, of, watch) {
    const todo = missing(of);
    if (todo.length === 0) return new Map();
    const result = await of.session.fillHoles({
      ...of.options,
      groups: todo.map(({ loops }) => loops),
      // By name, so that open rims are filled too.
      holes: todo.map((_, i) => i),
      output: 'patches',
      signal: watch.signal,
      onProgress: (fraction) => { watch.progress(fraction); },
    });
    return new Map(patchesIn(result, of).map((patch) => [keyOf(todo[patch.result.group]), patch]));
  },
  show: (made, of) => {
    if (made === null || of === null) return;
    const others = [...kept.peek()].filter(([, patch]) => patch.of === of.of);
    kept.value = new Map([...others, ...made]);
  },
  explain,
});

/** The holes whose patches are missing, and those so near to them that the patches may meet. */
function missing({ of, report, holes: all, manner }: Job): Hole[] {
  const isMade = (hole: Hole): boolean => {
    const patch = kept.peek().get(keyOf(hole));
    return patch !== undefined && patch.of === of && patch.manner === manner;
  };
  const todo = all.filter((hole) => !isMade(hole));
  if (todo.length === 0 || todo.length === all.length) return todo;
  const reachOf = ({ loops }: Hole): Box => grown(boxOfLoops({ of, report }, loops));
  const boxes = todo.map(reachOf);
  return all.filter((hole) => {
    if (!isMade(hole)) return true;
    const own = reachOf(hole);
    return boxes.some((box) => doMeet(box, own));
  });
}

/** A box and half as much again all round, for what bulges. */
function grown({ low, high }: Box): Box {
  const more = Math.max(...subtract(high, low)) / 2;
  return { low: subtract(low, [more, more, more]), high: add(high, [more, more, more]) };
}

const doMeet = (a: Box, b: Box): boolean => a.low.every((x, axis) => x <= b.high[axis] && b.low[axis] <= a.high[axis]);

/** The patches in a result of only patches, each with its own vertices. */
function patchesIn(result: FillResult, { of: whole, manner }: Job): Patch[] {
  const { mesh, oldVertices, oldFaces, holes: results, splitFaces } = result;
  const cornersOf = (from: number, to: number): Uint32Array => mesh.faces.subarray(3 * (from - oldFaces), 3 * (to - oldFaces));
  const single = mesh.positions instanceof Float32Array ? mesh.positions : Float32Array.from(mesh.positions);
  const owners = results.map(({ faces }) => faces);
  const crossing = results.map((): Set<number> => new Set());
  const crossed = results.map((): Set<number> => new Set());
  results.forEach(({ intersections }, h) => {
    for (const face of intersections) {
      if (face < oldFaces) crossed[h].add(face);
      const owner = owners.findIndex(([from, to]) => face >= from && face < to);
      if (owner >= 0) crossing[owner].add(face - owners[owner][0]);
    }
  });
  return results.map((result, h) => {
    const made = cornersOf(...result.faces);
    const own = new Map<number, number>();
    const renumbered = (vertex: number): number => {
      if (vertex < oldVertices) return vertex;
      const number = own.get(vertex) ?? own.size;
      own.set(vertex, number);
      return oldVertices + number;
    };
    const splitHere = splitFaces.filter(({ corners }) => corners.some((vertex) => vertex >= oldVertices && made.includes(vertex)));
    const faces = Uint32Array.from([made, ...splitHere.map(({ first, count }) => cornersOf(first, first + count))].flatMap((part) => [...part]), renumbered);
    const split = splitHere.map(({ face, corners }) => ({ face, corners: corners.map(renumbered) }));
    const positions = new Float32Array(3 * own.size);
    for (const [vertex, number] of own) positions.set(single.subarray(3 * (vertex - oldVertices), 3 * (vertex - oldVertices) + 3), 3 * number);
    const attributes = picked(mesh.attributes, Array.from(own.keys(), (vertex) => vertex - oldVertices));
    return { of: whole, manner, result, faces, split, positions, ...attributes, crossing: [...crossing[h]], crossed: [...crossed[h]] };
  });
}

/** The mesh with patches, old vertices and faces first and as they were. */
export function withPatches({ positions, faces, attributes }: Whole, all: readonly Patch[]): MeshShape {
  const n = positions.length / 3;
  const more = (key: 'positions' | 'faces') => all.reduce((sum, patch) => sum + patch[key].length, 0);
  const points = new Float32Array(positions.length + more('positions'));
  const corners = new Uint32Array(faces.length + more('faces'));
  points.set(positions);
  corners.set(faces);
  let [first, to] = [n, faces.length];
  for (const patch of all) {
    points.set(patch.positions, 3 * first);
    const placed = (vertex: number): number => (vertex < n ? vertex : vertex - n + first);
    for (const { face, corners: piece } of patch.split) corners.set(piece.map(placed), 3 * face);
    for (const vertex of patch.faces) corners[to++] = placed(vertex);
    first += patch.positions.length / 3;
  }
  return { positions: points, faces: corners, ...(attributes && joined([{ attributes }, ...all])) };
}
