// Meshes in the core, once the arguments are checked: asks it, and hands on its arrays. Threads need only this half.
import { readCarryArrays, readCrossingsArrays, readFillArrays, readHolesArrays, readWeldArrays, type ArrayReader, type FillArrays, type HolesArrays } from './border.js';
import { meshError } from './messages.js';
import type { Limits } from './options.js';
import { callCore, Home, isLarge, kDefaultMemoryBytes, shared, type CoreArgument, type Watch } from './runtime.js';
import type { MeshAttribute, ProgressListener } from './types.js';

/** A mesh whose arrays are of the right kinds. */
export interface FlatMesh {
  readonly positions: Float64Array;
  readonly faces: Uint32Array;
  /** Whether the caller's positions are single. */
  readonly single: boolean;
  readonly attributes?: Readonly<Record<string, MeshAttribute>>;
}

/** The part of a mesh that the core knows. */
export type BareMesh = Pick<FlatMesh, 'positions' | 'faces'>;

/** Groups of loops to fill, and the settings of each. */
export interface PatchWork {
  readonly starts: Uint32Array;
  readonly loops: Uint32Array;
  readonly settings: Float64Array;
}

/** Values to be carried on over faces. */
export interface CarryWork {
  /** Vertices with known values first. */
  readonly mesh: BareMesh;
  /** How many these are. */
  readonly fixed: number;
  /** `size` for each of them. */
  readonly values: Float64Array;
  readonly size: number;
}

/** Limits of a call of several, and who hears of it. */
export interface Budget extends Limits {
  /** Seconds of `maxSeconds` that are gone. */
  readonly spentSeconds?: number;
  readonly onProgress?: ProgressListener | undefined;
}

/** A listener that tells another one the share of the work alone. */
export function fractionsFor(onProgress: ((fraction: number) => void) | undefined): ProgressListener | undefined {
  return (
    onProgress &&
    ((fraction): void => {
      onProgress(fraction);
    })
  );
}

/** What a call has taken and given. */
export interface Timed<T> {
  readonly value: T;
  readonly seconds: number;
}

/** Calls an export of meshes.wasm in one of its instances. */
export type MeshCall = <T>(name: string, args: readonly CoreArgument[], read: (array: ArrayReader) => T, watch: Watch<T>) => T;

const callShared: MeshCall = (name, args, read, watch) => callCore(shared.meshes, name, args, read, watch).arrays;

/** A mesh as the first arguments of an export. */
export const argumentsOf = ({ positions, faces }: BareMesh): CoreArgument[] => [positions, positions.length / 3, faces, faces.length / 3];

function timed<T>(run: (watch: Omit<Watch<never>, 'onResult'>, memory: number) => T, { maxSeconds, maxMemoryBytes = kDefaultMemoryBytes, spentSeconds, onProgress }: Budget): Timed<T> {
  const started = performance.now();
  const value = run({ maxSeconds, spentSeconds, onProgress, explain: meshError }, maxMemoryBytes);
  return { value, seconds: (performance.now() - started) / 1000 };
}

/** The mesh with vertices made one that are within `weld` of each other. */
export function computeWeld(mesh: BareMesh, { weld, ...budget }: Budget & { readonly weld: number }): Timed<BareMesh & { readonly vertexMap: Uint32Array }> {
  return timed((watch, memory) => callShared('sf_weld_mesh', [...argumentsOf(mesh), weld, memory], readWeldArrays, watch), budget);
}

/** Pairs of faces of a mesh that intersect: [2p]. */
export function computeCrossings(mesh: BareMesh, budget: Budget): Timed<Uint32Array> {
  return timed((watch, memory) => callShared('sf_find_crossings', [...argumentsOf(mesh), memory], readCrossingsArrays, watch).pairs, budget);
}

/** The values of the vertices that had none: `size` for each. */
export function computeCarry({ mesh, fixed, values, size }: CarryWork, budget: Budget): Timed<Float64Array> {
  const run = (watch: Omit<Watch<never>, 'onResult'>, memory: number): Float64Array =>
    callShared('sf_carry_on', [...argumentsOf(mesh), fixed, values, size, memory], readCarryArrays, watch).values;
  return timed(run, budget);
}

/** The holes of a mesh that is then forgotten. */
export const computeHoles = (mesh: BareMesh, budget: Budget): Timed<HolesArrays> => findIn(callShared, mesh, { keeps: false }, budget);

/** The holes of a mesh, which stays in the instance by the number that is the only one in `session`. */
export const openIn = (call: MeshCall, mesh: BareMesh, budget: Budget): Timed<HolesArrays> => findIn(call, mesh, { keeps: true }, budget);

/** @param groups whether holes are handed out; if not, there is a session alone */
function findIn(call: MeshCall, mesh: BareMesh, { keeps, groups = true }: { keeps: boolean; groups?: boolean }, budget: Budget): Timed<HolesArrays> {
  const flags = [Number(keeps), Number(groups)];
  return timed((watch, memory) => call('sf_find_holes', [...argumentsOf(mesh), ...flags, memory], readHolesArrays, watch), budget);
}

/** Fills holes of a mesh that is open. */
export function fillIn(call: MeshCall, session: number, { starts, loops, settings }: PatchWork, budget: Budget): Timed<FillArrays> {
  return timed(
    (watch, memory) => call('sf_fill_holes', [session, starts, starts.length - 1, loops, settings, memory], readFillArrays, watch),
    budget,
  );
}

/** Frees what the instance has of an open mesh. */
export const kClose = 'sf_close_mesh';

/** A mesh for a thread, which may have it open under that name already. */
export interface NamedMesh {
  readonly name: number;
  /** Left out if the thread has it. */
  readonly mesh?: BareMesh;
}

/** The one mesh that this thread keeps open between calls. */
let kept: { readonly name: number; readonly session: number } | undefined;
let keptHome = new Home('meshes');

const callKept: MeshCall = (name, args, read, watch) => callCore(keptHome, name, args, read, watch).arrays;

/** The holes of a mesh that stays open in this thread, in place of the one before. */
export const computeOpen = (mesh: NamedMesh, budget: Budget): Timed<HolesArrays> => keep(mesh, true, budget);

function keep({ name, mesh }: NamedMesh, groups: boolean, budget: Budget): Timed<HolesArrays> {
  if (kept) forgetMesh(kept.name);
  try {
    const opened = findIn(callKept, mesh as BareMesh, { keeps: true, groups }, budget);
    kept = { name, session: opened.value.session[0] };
    return opened;
  } finally {
    if (!kept) renewHome();
  }
}

/** Fills holes of a mesh that stays open in this thread; after an error none does. */
export function computePatches(mesh: NamedMesh, { work, ...budget }: Budget & { readonly work: PatchWork }): Timed<FillArrays> {
  const { spentSeconds = 0, onProgress, ...limits } = budget;
  try {
    const { seconds } = kept?.name === mesh.name ? { seconds: 0 } : keep(mesh, false, { ...limits, spentSeconds });
    const filled = fillIn(callKept, kept?.session as number, work, { ...limits, spentSeconds: spentSeconds + seconds, onProgress });
    return { value: filled.value, seconds: seconds + filled.seconds };
  } catch (error) {
    forgetMesh(mesh.name);
    throw error;
  }
}

/** Closes the mesh of that name, if it is open here. */
export function forgetMesh(name: number): void {
  if (kept?.name !== name) return;
  const { session } = kept;
  kept = undefined;
  if (!renewHome()) callKept(kClose, [session], () => undefined, {});
}

/** Gives up an instance that is lost, or large: memory of an instance never shrinks. Whether it did. */
function renewHome(): boolean {
  const isNeeded = keptHome.lost || isLarge(keptHome);
  if (isNeeded) keptHome = new Home('meshes');
  return isNeeded;
}
