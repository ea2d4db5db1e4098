// Finding and filling holes, step by step: the same here and in `soapfilm/worker`. The caller's half.
import { carryWorkOf, seamsOf, weldedAttributes, type Seams } from './attributes.js';
import type { FillArrays, HolesArrays } from './border.js';
import { fractionsFor, type BareMesh, type Budget, type CarryWork, type FlatMesh, type PatchWork, type Timed } from './compute_holes.js';
import { closePatches, withCrossings, type Patches } from './hole_crossings.js';
import { partListeners, partsOf, planAgain, planOf, type FillPlan } from './hole_plan.js';
import { filledOf, patchesOf, reportOf, type GivenMesh } from './hole_results.js';
import { joined, splitRims, type RimSplits, type SplitMesh } from './hole_splits.js';
import { limitsOf } from './options.js';
import { tellLast } from './report.js';
import { wait, type Answer, type Steps } from './steps.js';
import type { FillOptions, FillResult, HoleOptions, HoleReport, ProgressListener } from './types.js';

/** A mesh that the core has open. */
export interface OpenMesh {
  /** How many parts of work can be done at once. */
  readonly size: number;
  /** Fills holes, part by part or at once. */
  readonly fill: (parts: readonly PatchWork[], budget: CallBudget, listeners: readonly (ProgressListener | undefined)[]) => Answer<Timed<FillArrays>[]>;
  readonly close: () => void;
}

/** The limits of a call, and what may end it. In this thread nothing does. */
export interface CallBudget extends Budget {
  readonly signal?: AbortSignal | undefined;
}

/** Where the core is. */
export interface MeshPlace {
  weld(mesh: BareMesh, budget: CallBudget & { readonly weld: number }): Answer<Timed<BareMesh & { readonly vertexMap: Uint32Array }>>;
  find(mesh: BareMesh, budget: CallBudget): Answer<Timed<HolesArrays>>;
  /** The mesh must not change. */
  open(mesh: BareMesh, budget: CallBudget): Answer<Timed<{ readonly open: OpenMesh; readonly holes: HolesArrays }>>;
  crossings(mesh: BareMesh, budget: CallBudget): Answer<Timed<Uint32Array>>;
  carryOn(work: CarryWork, budget: CallBudget): Answer<Timed<Float64Array>>;
}

/** A mesh that is open, and what was found in it. */
export interface OpenHoles extends GivenMesh {
  readonly open: OpenMesh;
  /** How long that took. */
  readonly seconds: number;
}

/** The holes of a mesh, which is not kept. */
export function* reportSteps(place: MeshPlace, given: FlatMesh, options: HoleOptions, signal?: AbortSignal): Steps<HoleReport> {
  const limits = { ...limitsOf(options), signal };
  const { mesh, vertexMap, seconds } = yield* weldSteps(place, given, options.weld, limits);
  const { value } = yield* wait(place.find(mesh, { ...limits, spentSeconds: seconds, onProgress: fractionsFor(options.onProgress) }));
  const report = reportOf(value, vertexMap);
  tellLast(() => options.onProgress?.(1));
  return report;
}

/** Welds the mesh if that is asked for, and opens it. */
export function* openSteps(
  place: MeshPlace,
  given: FlatMesh,
  options: Omit<HoleOptions, 'onProgress'>,
  signal?: AbortSignal,
  onProgress?: HoleOptions['onProgress'],
): Steps<OpenHoles> {
  const limits = { ...limitsOf(options), signal };
  const { mesh, vertexMap, seams, seconds } = yield* weldSteps(place, given, options.weld, limits);
  const opened = yield* wait(place.open(mesh, { ...limits, spentSeconds: seconds, onProgress: fractionsFor(onProgress) }));
  const { open, holes } = opened.value;
  const found = { mesh, seams, open, report: reportOf(holes, vertexMap), seconds: seconds + opened.seconds };
  tellLast(() => onProgress?.(1));
  return found;
}


interface Welded {
  readonly mesh: FlatMesh;
  readonly vertexMap?: Uint32Array;
  readonly seams?: Seams | undefined;
  readonly seconds: number;
}

function* weldSteps(place: MeshPlace, mesh: FlatMesh, weld: number | undefined, limits: CallBudget): Steps<Welded> {
  if (weld === undefined) return { mesh, seconds: 0 };
  const { value, seconds } = yield* wait(place.weld(mesh, { ...limits, weld }));
  const { positions, faces, vertexMap } = value;
  const { single, attributes } = mesh;
  const count = positions.length / 3;
  const welded = { positions, faces, single, ...(attributes && { attributes: weldedAttributes(attributes, vertexMap, count) }) };
  return { mesh: welded, vertexMap, seams: attributes && seamsOf(attributes, vertexMap, count), seconds };
}

/** Fills holes of a mesh that is open. @param spent seconds of the time limit that are gone */
export function* fillSteps(place: MeshPlace, given: OpenHoles, options: FillOptions, spent = 0, signal?: AbortSignal): Steps<FillResult> {
  const limits = { ...limitsOf(options), signal };
  const plan = planOf(given.report, options, given.mesh.single);
  const filled = yield* patchSteps(given.open, given.mesh, plan, { ...limits, spentSeconds: spent }, options.onProgress);
  let { patches } = filled;
  let split: SplitMesh = { mesh: given.mesh, splitFaces: [] };
  let spentSeconds = spent + filled.seconds;
  for (let { splits } = patches, round = 0; splits.size > 0 && round < kMostRounds; round++) {
    const again = yield* splitSteps(place, given, plan, splits, options, { ...limits, spentSeconds });
    spentSeconds += again.seconds;
    if (again.done.length === splits.size) {
      patches = joined(given.mesh, again.split, patches, again.patches, again.done);
      ({ split } = again);
      break;
    }
    // Without those that cannot be filled all the same: their faces stay whole, and they say what was wrong last.
    const all = splits;
    const holes = patches.holes.map((hole, g) => {
      const { reason } = again.patches.holes[g];
      return reason !== undefined && all.has(g) && !again.done.includes(g) ? { ...hole, reason } : hole;
    });
    patches = { ...patches, holes };
    splits = new Map(again.done.map((g) => [g, all.get(g) ?? []]));
  }
  const close = closePatches(split.mesh, patches);
  if (close) {
    const { value: pairs, seconds } = yield* wait(place.crossings(close.mesh, { ...limits, spentSeconds }));
    spentSeconds += seconds;
    patches = withCrossings(patches, close, pairs);
  }
  const { attributes } = given.mesh;
  const work = attributes && carryWorkOf(attributes, split.tails, split.mesh, patches);
  const carried = work ? (yield* wait(place.carryOn(work, { ...limits, spentSeconds }))).value : new Float64Array();
  return filledOf(given, plan, split, patches, carried, options);
}

function* patchSteps(
  open: OpenMesh,
  mesh: BareMesh,
  plan: FillPlan,
  budget: CallBudget,
  onProgress?: FillOptions['onProgress'],
): Steps<{ readonly patches: Patches; readonly seconds: number }> {
  const parts = partsOf(plan.work, plan, open.size);
  const filled = yield* wait(open.fill(parts, budget, partListeners(plan, parts, onProgress)));
  const patches = patchesOf(mesh, plan, filled.map(({ value }) => value));
  return { patches, seconds: Math.max(0, ...filled.map(({ seconds }) => seconds)) };
}

/** How often holes are filled again whose rims were split: each time takes a whole mesh. */
const kMostRounds = 3;

interface Refilled {
  readonly split: SplitMesh;
  /** Of the split mesh. */
  readonly patches: Patches;
  /** The groups that have one. */
  readonly done: readonly number[];
  readonly seconds: number;
}

/** Splits the rims of some holes, and fills these in the mesh that comes of it. */
function* splitSteps(
  place: MeshPlace,
  given: OpenHoles,
  plan: FillPlan,
  splits: RimSplits,
  options: FillOptions,
  budget: CallBudget,
): Steps<Refilled> {
  const split = splitRims(given.mesh, [...splits.values()].flat());
  const { value, seconds: finding } = yield* wait(place.open(split.mesh, budget));
  const { open, holes } = value;
  try {
    const { single, positions } = given.mesh;
    const again = planAgain(plan, reportOf(holes), positions.length / 3, splits, options, single);
    const { patches, seconds } = yield* patchSteps(open, split.mesh, again, { ...budget, spentSeconds: (budget.spentSeconds ?? 0) + finding });
    const done = again.todo.filter((g) => patches.holes[g].status !== 'failed');
    return { split, patches, done, seconds: finding + seconds };
  } finally {
    open.close();
  }
}
