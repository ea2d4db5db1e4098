// Holes, once the arguments are checked: asks the core, and hands on its arrays. Threads need only this half.
import { readCrossingsArrays, readFillArrays, readHolesArrays, readWeldArrays, type FillArrays, type HolesArrays } from './border.js';
import { meshError } from './messages.js';
import type { Limits } from './options.js';
import { callCore, kDefaultMemoryBytes, shared, type CoreArgument } from './runtime.js';
import type { HoleOptions, MeshAttribute, ProgressListener } from './types.js';

/** A mesh whose arrays are of the right kinds. */
export interface FlatMesh {
  readonly positions: Float64Array;
  readonly faces: Uint32Array;
  /** Whether the caller's positions are single. */
  readonly single: boolean;
  readonly attributes?: Readonly<Record<string, MeshAttribute>>;
}

/** Groups of loops to fill, and the settings of each. */
export interface PatchWork {
  readonly starts: Uint32Array;
  readonly loops: Uint32Array;
  readonly settings: Float64Array;
}

/** Holes that were found, in the core's arrays; the mesh itself, which a caller in another thread has given away; and the time. */
export interface FoundHoles {
  readonly arrays: HolesArrays;
  /** With `weld`: the new number of each vertex; the mesh is the welded one then, still with the attributes of all. */
  readonly vertexMap: Uint32Array | undefined;
  readonly mesh: FlatMesh;
  readonly seconds: number;
}

/** A mesh as the first arguments of an export. */
export const argumentsOf = ({ positions, faces }: FlatMesh): CoreArgument[] => [
  positions,
  positions.length / 3,
  faces,
  faces.length / 3,
];

export function computeHoles(given: FlatMesh, options: HoleOptions): FoundHoles {
  const { weld, maxSeconds, maxMemoryBytes = kDefaultMemoryBytes } = options;
  const started = performance.now();
  const watch = { maxSeconds, explain: meshError };
  let [mesh, vertexMap]: [FlatMesh, Uint32Array | undefined] = [given, undefined];
  if (weld !== undefined) {
    const args = [...argumentsOf(given), weld, maxMemoryBytes];
    const { arrays } = callCore(shared.meshes, 'sf_weld_mesh', args, readWeldArrays, watch);
    vertexMap = arrays.vertexMap;
    mesh = { ...given, positions: arrays.positions, faces: arrays.faces };
  }
  const spent = (): number => (performance.now() - started) / 1000;
  const args = [...argumentsOf(mesh), maxMemoryBytes];
  const { arrays } = callCore(shared.meshes, 'sf_find_holes', args, readHolesArrays, { ...watch, spentSeconds: spent() });
  return { arrays, mesh, vertexMap, seconds: spent() };
}

/** Limits, listener and what is to be filled. */
export interface PatchOptions extends Limits {
  readonly work: PatchWork;
  /** Seconds of `maxSeconds` that are gone. */
  readonly spentSeconds: number;
  readonly onProgress?: ProgressListener | undefined;
}

/** Filled holes in the core's arrays, the mesh, and the seconds that are gone. */
export interface FilledHoles {
  readonly arrays: FillArrays;
  readonly mesh: FlatMesh;
  readonly spentSeconds: number;
}

export function computePatches(mesh: FlatMesh, options: PatchOptions): FilledHoles {
  const { work, maxMemoryBytes = kDefaultMemoryBytes, maxSeconds, spentSeconds, onProgress } = options;
  const { starts, loops, settings } = work;
  const started = performance.now();
  const args = [...argumentsOf(mesh), starts, starts.length - 1, loops, settings, maxMemoryBytes];
  const watch = { maxSeconds, spentSeconds, onProgress, explain: meshError };
  const { arrays } = callCore(shared.meshes, 'sf_fill_holes', args, readFillArrays, watch);
  return { arrays, mesh, spentSeconds: spentSeconds + (performance.now() - started) / 1000 };
}

/** Pairs of faces of a mesh that intersect: [2p]. */
export function computeCrossings(mesh: FlatMesh, options: Omit<PatchOptions, 'work'>): Uint32Array {
  const { maxSeconds, spentSeconds, maxMemoryBytes = kDefaultMemoryBytes } = options;
  const args = [...argumentsOf(mesh), maxMemoryBytes];
  const watch = { maxSeconds, spentSeconds, explain: meshError };
  return callCore(shared.meshes, 'sf_find_crossings', args, readCrossingsArrays, watch).arrays.pairs;
}
