// What is to be filled, with which settings, and in which parts. The caller's half: threads do without.
import { kFairingChoices, kSpaceChoices, packPatchSettings } from './border.js';
import type { PatchWork } from './compute_holes.js';
import { coreWeights } from './core_weights.js';
import { SoapfilmError } from './errors.js';
import type { RimSplits } from './hole_splits.js';
import type { FilledHole, FillOptions, HoleGroup, HoleReason, HoleReport, ProgressListener } from './types.js';

/** What is to be filled, and what becomes of each hole without that. */
export interface FillPlan {
  readonly report: HoleReport;
  readonly groups: readonly HoleGroup[];
  /** Numbers of the groups to fill. */
  readonly todo: readonly number[];
  /** By groups; of those to fill nothing is known yet. */
  readonly holes: readonly FilledHole[];
  /** The same for the core. */
  readonly work: PatchWork;
}

/** @throws SoapfilmError `bad-option` for numbers of loops or groups beyond those that there are */
export function planOf(report: HoleReport, options: FillOptions, single: boolean): FillPlan {
  const { groups: given, holes: named = 'all', perHole = {} } = options;
  if (given) {
    const all = given.flat();
    checkNumbers('groups', all, report.loops.length, 'loop');
    if (new Set(all).size < all.length) throw new SoapfilmError('bad-option', '`groups` names a loop twice');
  }
  const groups = given ? givenGroups(given, report) : report.groups;
  if (named !== 'all') checkNumbers('holes', named, groups.length, 'hole');
  checkNumbers('perHole', Object.keys(perHole).map(Number), groups.length, 'hole');
  const todo: number[] = [];
  // Groups that the caller made are as good as named.
  const isNamed = new Set(named !== 'all' ? named : given ? given.keys() : []);
  const holes = groups.map((group, g): FilledHole => {
    const passed = whyNot(group, report, options, named !== 'all', isNamed.has(g));
    if (passed === undefined) todo.push(g);
    return { ...kNothing, group: g, status: 'skipped', intersections: new Uint32Array(), ...passed };
  });
  return { report, groups, todo, holes, work: workOf(groups, todo, options, single) };
}

/**
 * What is left to fill once rims are split, in the mesh that has them so.
 * @param again what was found there
 * @param vertices how many the mesh had before
 */
export function planAgain(
  plan: FillPlan,
  again: HoleReport,
  vertices: number,
  splits: RimSplits,
  options: FillOptions,
  single: boolean,
): FillPlan {
  // A rim is the one with the same vertices in the same order, but for those that split it.
  const numbers = new Map(again.loops.map((loop, i) => [nameOf(loop.vertices.filter((v) => v < vertices)), i]));
  const groups = plan.groups.map((group, g) => {
    if (!splits.has(g)) return group;
    const loops = group.loops.map((loop) => numbers.get(nameOf(plan.report.loops[loop].vertices)) ?? -1);
    return { ...group, loops };
  });
  const todo = [...splits.keys()].filter((g) => groups[g].loops.every((loop) => loop >= 0));
  const perHole = Object.fromEntries(
    todo.map((g) => {
      const own = { ...options, ...options.perHole?.[g] };
      const { maxNewVertices = Infinity } = own;
      return [g, { ...own, maxNewVertices: maxNewVertices - (splits.get(g)?.length ?? 0) }];
    }),
  );
  return { ...plan, report: again, groups, todo, work: workOf(groups, todo, { ...options, perHole }, single) };
}

/** The same for a loop wherever it begins. */
function nameOf(vertices: Uint32Array): string {
  const first = vertices.indexOf(vertices.reduce((a, b) => Math.min(a, b), Infinity));
  return [...vertices.subarray(first), ...vertices.subarray(0, first)].join();
}

function workOf(groups: readonly HoleGroup[], todo: readonly number[], { perHole = {}, ...options }: FillOptions, single: boolean): PatchWork {
  const starts = new Uint32Array(todo.length + 1);
  todo.forEach((g, i) => (starts[i + 1] = starts[i] + groups[g].loops.length));
  const each = todo.map((g) => packPatchSettings(patchSettings({ ...options, ...perHole[g] }, single)));
  const size = each[0]?.length ?? 0;
  const settings = new Float64Array(size * todo.length);
  each.forEach((own, i) => {
    settings.set(own, size * i);
  });
  return { starts, loops: Uint32Array.from(todo.flatMap((g) => groups[g].loops)), settings };
}

/**
 * Cuts work into at most `count` parts, in order, that take about as long as each other. Holes do not depend
 * on each other, so the parts may be done anywhere.
 */
export function partsOf({ starts, loops, settings }: PatchWork, { report }: FillPlan, count: number): PatchWork[] {
  const holes = starts.length - 1;
  // Measured: the time for a hole grows about like the power 1.5 of its vertices.
  const effort = (hole: number): number =>
    loops.subarray(starts[hole], starts[hole + 1]).reduce((sum, loop) => sum + report.loops[loop].vertices.length, 0) ** 1.5;
  const sums = [0];
  for (let hole = 0; hole < holes; hole++) sums.push(sums[hole] + effort(hole));
  const parts: PatchWork[] = [];
  const size = settings.length / holes;
  for (let from = 0, part = 1; from < holes; part++) {
    let to = from + 1;
    while (to < holes && sums[to] + sums[to + 1] <= (2 * part * sums[holes]) / count) to++;
    parts.push({
      starts: starts.slice(from, to + 1).map((start) => start - starts[from]),
      loops: loops.slice(starts[from], starts[to]),
      settings: settings.slice(size * from, size * to),
    });
    from = to;
  }
  return parts;
}

/** Listeners for the parts of a plan's work, that together tell one listener for holes how far the whole is. */
export function partListeners(
  { todo }: FillPlan,
  parts: readonly PatchWork[],
  onProgress: FillOptions['onProgress'],
): (ProgressListener | undefined)[] {
  const done = parts.map(() => 0);
  let from = 0;
  return parts.map(({ starts }, part) => {
    if (!onProgress) return undefined;
    const [first, count] = [from, starts.length - 1];
    from += count;
    return (fraction) => {
      done[part] = fraction * count;
      const hole = first + Math.min(count - 1, Math.floor(done[part]));
      onProgress(done.reduce((sum, holes) => sum + holes, 0) / todo.length, todo[hole], todo.length);
    };
  });
}

const kNothing = {
  faces: [0, 0],
  cost: 0,
  lowerBound: 0,
  optimal: false,
  rimAngle: { before: 0, after: 0 },
  fairnessUsed: 0,
  movedLess: 0,
} as const;

/** @throws SoapfilmError `bad-option` for a number beyond those that there are */
function checkNumbers(name: string, numbers: readonly number[], count: number, what: string): void {
  const wrong = numbers.find((number) => number >= count);
  if (wrong === undefined) return;
  throw new SoapfilmError('bad-option', `\`${name}\` names ${what} ${wrong}, and there are ${count}`);
}

/** Groups that the caller has made. */
function givenGroups(given: readonly (readonly number[])[], { loops, groups }: HoleReport): HoleGroup[] {
  const openRims = new Set(groups.flatMap((group) => (group.isOpenRim ? group.loops : [])));
  return given.map((numbers) => ({
    // The outer rim first, as in the groups that are found.
    loops: [...numbers].sort((a, b) => loops[b].length - loops[a].length || a - b),
    score: 1,
    why: 'given',
    isOpenRim: numbers.every((loop) => openRims.has(loop)),
  }));
}

/** Why a hole is not filled; undefined if it is. */
function whyNot(
  { loops, isOpenRim }: HoleGroup,
  report: HoleReport,
  { fillOpenRims = false, maxVertices = Infinity, maxLength = Infinity }: FillOptions,
  areNamed: boolean,
  isNamed: boolean,
): { readonly status: 'open-rim' | 'skipped'; readonly reason?: HoleReason } | undefined {
  if (areNamed && !isNamed) return { status: 'skipped', reason: 'not-asked-for' };
  if (isOpenRim && !fillOpenRims && !isNamed) return { status: 'open-rim' };
  const vertices = loops.reduce((sum, loop) => sum + report.loops[loop].vertices.length, 0);
  if (vertices > maxVertices) return { status: 'skipped', reason: 'too-many-vertices' };
  if (report.loops[loops[0]].length > maxLength) return { status: 'skipped', reason: 'too-long' };
  return undefined;
}

const kFairings = { 0: 'none', 1: 'bending', 2: 'curvature', auto: 'auto' } as const;

/** From which angle in degrees on edges are creases. */
const kCrease = 40;

function patchSettings(options: FillOptions, single: boolean) {
  const { weights, candidates = 'auto', fairness = 'auto', density, maxNewVertices, creases = true, maxSecondsPerHole } = options;
  const degrees = creases === true ? kCrease : Number(creases);
  return {
    ...coreWeights(weights),
    space: kSpaceChoices.indexOf(candidates),
    fairing: kFairingChoices.indexOf(kFairings[fairness]),
    density: density ?? Math.SQRT2,
    maxNewVertices: maxNewVertices ?? Infinity,
    crease: (degrees * Math.PI) / 180,
    inFloats: Number(single),
    maxSeconds: maxSecondsPerHole ?? Infinity,
  };
}
