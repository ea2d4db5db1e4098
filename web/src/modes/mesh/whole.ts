// All meshes of the group as one, as the library takes them, and the rims that were found in each.
import type { HoleReport } from 'soapfilm';
import type { MeshSessionHandle } from 'soapfilm/worker';
import { boxOfPoints, unionOf, type Box, type Point } from '../../shapes/vec.ts';
import type { Id, Item, Place } from '../../state/document.ts';
import { joined } from './attributes.ts';
import type { MeshShape } from './settings.ts';

/** One mesh: that of the only object, or those of several one after the other. */
export interface Whole extends MeshShape {
  readonly items: readonly Item[];
  /** `[items + 1]` where the vertices of each begin. */
  readonly starts: readonly number[];
}

export const shapeOf = (item: Item): MeshShape => item.shape as MeshShape;

/** Where a vertex is. */
export const vertexAt = ({ positions }: MeshShape, vertex: number): Point => [
  positions[3 * vertex],
  positions[3 * vertex + 1],
  positions[3 * vertex + 2],
];

/** A mesh as the library takes it. */
export const meshIn = ({ positions, faces, attributes }: MeshShape): MeshShape => ({ positions, faces, ...(attributes && { attributes }) });

/** What was found in a mesh. */
export interface Found {
  readonly of: Whole;
  readonly report: HoleReport;
  /** Where the mesh stays open, so that filling a hole costs what the hole does. */
  readonly session: MeshSessionHandle;
}

/** The least box around some of the loops that were found. */
export function boxOfLoops({ of, report }: Pick<Found, 'of' | 'report'>, loops: readonly number[]): Box {
  const points = loops.flatMap((loop) => Array.from(report.loops[loop].vertices, (vertex) => vertexAt(of, vertex)));
  return unionOf(points.map((point) => ({ low: point, high: point })));
}

export function wholeOf(items: readonly Item[]): Whole {
  const shapes = items.map(shapeOf);
  const starts = [0];
  for (const { positions } of shapes) starts.push(starts[starts.length - 1] + positions.length / 3);
  if (shapes.length === 1) return { ...shapes[0], items, starts };
  const positions = new Float32Array(3 * starts[shapes.length]);
  const faces = new Uint32Array(shapes.reduce((sum, shape) => sum + shape.faces.length, 0));
  let to = 0;
  shapes.forEach((shape, k) => {
    positions.set(shape.positions, 3 * starts[k]);
    for (const vertex of shape.faces) faces[to++] = starts[k] + vertex;
  });
  return { items, starts, positions, faces, ...joined(shapes) };
}

/** The rims of one mesh: its parts, as the document calls them, with their vertices as handles. */
export interface Rims {
  /** `[rims]` their numbers in the report. */
  readonly loops: readonly number[];
  /** The other way round: which rim a loop is. */
  readonly parts: ReadonlyMap<number, number>;
  /** `[rims + 1]` where each begins. */
  readonly starts: Uint32Array;
  /** The vertices of the mesh along the rims. */
  readonly vertices: Uint32Array;
  /** All rims in runs of neighbours in the list: a look at a box tells that the pointer is near none of many. */
  readonly runs: readonly RimRun[];
}

interface RimRun {
  /** From the first rim to before the second. */
  readonly from: number;
  readonly to: number;
  readonly box: Box;
}

/** A run ends at the rim with which it has so many vertices. */
const kRunVertices = 200;

const kNoRims: Rims = { loops: [], parts: new Map(), starts: new Uint32Array(1), vertices: new Uint32Array(), runs: [] };
const found = new WeakMap<object, Rims>();

/** What was found in a mesh; no rims until then. */
export const rimsOf = (shape: MeshShape): Rims => found.get(shape) ?? kNoRims;

/** Notes the rims of each mesh. A loop lies in one mesh, since meshes share no vertex. */
export function noteRims({ items, starts }: Whole, { loops }: HoleReport): void {
  items.forEach((item, k) => {
    const numbers = loops.flatMap(({ vertices }, i) => (vertices[0] >= starts[k] && vertices[0] < starts[k + 1] ? i : []));
    const ends = new Uint32Array(numbers.length + 1);
    numbers.forEach((i, rim) => (ends[rim + 1] = ends[rim] + loops[i].vertices.length));
    const vertices = new Uint32Array(ends[numbers.length]);
    numbers.forEach((i, rim) => {
      loops[i].vertices.forEach((vertex, at) => (vertices[ends[rim] + at] = vertex - starts[k]));
    });
    const parts = new Map(numbers.map((loop, part) => [loop, part]));
    const shape = shapeOf(item);
    found.set(shape, { loops: numbers, parts, starts: ends, vertices, runs: runsOf(shape, ends, vertices) });
  });
}

function runsOf({ positions }: MeshShape, starts: Uint32Array, vertices: Uint32Array): RimRun[] {
  const runs: RimRun[] = [];
  let from = 0;
  for (let to = 1; to < starts.length; to++) {
    if (starts[to] - starts[from] < kRunVertices && to + 1 < starts.length) continue;
    const points = new Float32Array(3 * (starts[to] - starts[from]));
    for (let i = 0; i < points.length; i++) points[i] = positions[3 * vertices[starts[from] + ((i / 3) | 0)] + (i % 3)];
    runs.push({ from, to, box: boxOfPoints(points, 3) });
    from = to;
  }
  return runs;
}

/** The number in the report of the loop at a place. */
export function loopAt({ items }: Whole, { item: id, part }: Place): number | undefined {
  const item = items.find((each) => each.id === id);
  return item && rimsOf(shapeOf(item)).loops.at(part);
}

export function placeOf({ items }: Whole, loop: number): Place | null {
  for (const item of items) {
    const part = rimsOf(shapeOf(item)).parts.get(loop);
    if (part !== undefined) return { item: item.id, part, handle: null };
  }
  return null;
}

export const idsOf = (items: readonly Item[]): readonly Id[] => items.map(({ id }) => id);
