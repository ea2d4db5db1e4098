// Holes: reports and filled meshes from the core's arrays, and what to fill. The caller's half: threads do without.
import {
  kDefectCountsLength,
  kDefectKindChoices,
  kFairingChoices,
  kFilledFactsLength,
  kFillReasonChoices,
  kFillStatusChoices,
  kGroupFactsLength,
  kGroupKindChoices,
  kLoopFactsLength,
  kSpaceChoices,
  packPatchSettings,
  readDefectCounts,
  readFilledFacts,
  readGroupFacts,
  readLoopFacts,
  type FillArrays,
} from './border.js';
import { coreWeights } from './core_weights.js';
import { carriedOn, tailsOf, weldedAttributes } from './attributes.js';
import type { FlatMesh, FoundHoles, PatchWork } from './compute_holes.js';
import { SoapfilmError } from './errors.js';
import type { Patches } from './hole_crossings.js';
import { tellLast } from './report.js';
import type {
  FilledHole,
  FillOptions,
  FillResult,
  HoleFillOptions,
  HoleGroup,
  HoleLoop,
  HoleReason,
  HoleReport,
  MeshDefect,
  ProgressListener,
} from './types.js';

export function reportOf({ arrays, vertexMap }: Pick<FoundHoles, 'arrays' | 'vertexMap'>): HoleReport {
  const { loopStarts, loopVertices, loopFacts, groupStarts, groupLoops, groupFacts, ...rest } = arrays;
  const loops = Array.from({ length: loopStarts.length - 1 }, (_, i): HoleLoop => ({
    vertices: loopVertices.slice(loopStarts[i], loopStarts[i + 1]),
    ...readLoop(loopFacts, kLoopFactsLength * i),
  }));
  const groups = Array.from({ length: groupStarts.length - 1 }, (_, g): HoleGroup => {
    const { kind, score, isOpenRim } = readGroupFacts(groupFacts, kGroupFactsLength * g);
    return {
      loops: [...groupLoops.subarray(groupStarts[g], groupStarts[g + 1])],
      score,
      why: kGroupKindChoices[kind],
      isOpenRim: isOpenRim === 1,
    };
  });
  return { loops, groups, defects: readDefects(rest.defects, rest.defectPlaces), ...(vertexMap && { vertexMap }) };
}

function readLoop(facts: Float64Array, at: number): Omit<HoleLoop, 'vertices'> {
  const { isSeam, ...rest } = readLoopFacts(facts, at);
  return { ...rest, isSeam: isSeam === 1 };
}

function readDefects(counts: Uint32Array, places: Uint32Array): MeshDefect[] {
  let at = 0;
  const take = (count: number): Uint32Array => places.slice(at, (at += count));
  return Array.from({ length: counts.length / kDefectCountsLength }, (_, i) => {
    const { kind, faces, edges, vertices } = readDefectCounts(counts, kDefectCountsLength * i);
    return { kind: kDefectKindChoices[kind], faces: take(faces), edges: take(edges), vertices: take(vertices) };
  });
}

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
  const holes = groups.map((group, g): FilledHole => {
    const passed = whyNot(g, group, report, options);
    if (passed === undefined) todo.push(g);
    return { ...kNothing, group: g, status: 'skipped', intersections: new Uint32Array(), ...passed };
  });
  const starts = new Uint32Array(todo.length + 1);
  todo.forEach((g, i) => (starts[i + 1] = starts[i] + groups[g].loops.length));
  const settings = todo.map((g) => packPatchSettings(patchSettings({ ...options, ...perHole[g] }, single)));
  const size = settings[0]?.length ?? 0;
  const packed = new Float64Array(size * todo.length);
  settings.forEach((each, i) => {
    packed.set(each, size * i);
  });
  const loops = Uint32Array.from(todo.flatMap((g) => groups[g].loops));
  return { report, groups, todo, holes, work: { starts, loops, settings: packed } };
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

/** The parts of the work, done, as one. */
export function patchesOf(mesh: FlatMesh, plan: FillPlan, parts: readonly FillArrays[]): Patches {
  const oldVertices = mesh.positions.length / 3;
  const oldFaces = mesh.faces.length / 3;
  const holes = [...plan.holes];
  const positions = new Float64Array(parts.reduce((sum, part) => sum + part.positions.length, 0));
  const faces = new Uint32Array(parts.reduce((sum, part) => sum + part.faces.length, 0));
  let [hole, newVertices, newFaces] = [0, 0, 0];
  for (const part of parts) {
    // What a part has numbered from the end of the mesh on, other parts come before.
    const faceOf = (face: number): number => (face < oldFaces ? face : face + newFaces);
    const vertexOf = (vertex: number): number => (vertex < oldVertices ? vertex : vertex + newVertices);
    let pair = 0;
    for (let at = 0; at < part.holes.length; at += kFilledFactsLength) {
      const group = plan.todo[hole++];
      const facts = readFilledFacts(part.holes, at);
      const reason = kFillReasonChoices[facts.reason];
      holes[group] = {
        group,
        status: kFillStatusChoices[facts.status],
        ...(reason !== 'none' && { reason }),
        faces: [faceOf(facts.firstFace), faceOf(facts.endFace)],
        cost: facts.cost,
        lowerBound: facts.lowerBound,
        optimal: facts.optimal === 1,
        rimAngle: { before: facts.rimAngleBefore, after: facts.rimAngleAfter },
        intersections: part.pairs.slice(pair, (pair += 2 * facts.pairs)).map(faceOf),
        fairnessUsed: Math.max(0, facts.fairnessUsed - 1) as 0 | 1 | 2,
        movedLess: facts.movedLess,
      };
    }
    positions.set(part.positions, 3 * newVertices);
    faces.set(part.faces.map(vertexOf), 3 * newFaces);
    newVertices += part.positions.length / 3;
    newFaces += part.faces.length / 3;
  }
  return { holes, positions, faces };
}

/** The result, and when it is made, the last call of `onProgress`. */
export function filledOf(mesh: FlatMesh, plan: FillPlan, patches: Patches, { output, onProgress }: FillOptions): FillResult {
  const { holes } = patches;
  const old = output === 'patches' ? { positions: new Float64Array(), faces: new Uint32Array() } : mesh;
  const positions = new (mesh.single ? Float32Array : Float64Array)(old.positions.length + patches.positions.length);
  const faces = new Uint32Array(old.faces.length + patches.faces.length);
  positions.set(old.positions);
  positions.set(patches.positions, old.positions.length);
  faces.set(old.faces);
  faces.set(patches.faces, old.faces.length);
  const { vertexMap } = plan.report;
  const oldVertices = mesh.positions.length / 3;
  const added = patches.positions.length / 3;
  let attributes = mesh.attributes;
  if (attributes && vertexMap) attributes = weldedAttributes(attributes, vertexMap, oldVertices);
  if (attributes) {
    attributes = carriedOn(attributes, oldVertices, added, patches.faces);
    if (output === 'patches') attributes = tailsOf(attributes, oldVertices);
  }
  if (plan.todo.length > 0) tellLast(() => onProgress?.(1, plan.todo[plan.todo.length - 1], plan.todo.length));
  return {
    mesh: { positions, faces, ...(attributes && { attributes }) },
    oldVertices,
    oldFaces: mesh.faces.length / 3,
    closed: holes.every(({ status }) => status === 'filled' || status === 'self-intersecting') && countLoops(plan.groups) === plan.report.loops.length,
    holes,
    defects: plan.report.defects,
    ...(vertexMap && { vertexMap }),
  };
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

const countLoops = (groups: readonly HoleGroup[]): number => groups.reduce((sum, { loops }) => sum + loops.length, 0);

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
  g: number,
  { loops, isOpenRim }: HoleGroup,
  report: HoleReport,
  { holes = 'all', fillOpenRims = false, maxVertices = Infinity, maxLength = Infinity }: FillOptions,
): { readonly status: 'open-rim' | 'skipped'; readonly reason?: HoleReason } | undefined {
  const isNamed = holes !== 'all' && holes.includes(g);
  if (holes !== 'all' && !isNamed) return { status: 'skipped', reason: 'not-asked-for' };
  if (isOpenRim && !fillOpenRims && !isNamed) return { status: 'open-rim' };
  const vertices = loops.reduce((sum, loop) => sum + report.loops[loop].vertices.length, 0);
  if (vertices > maxVertices) return { status: 'skipped', reason: 'too-many-vertices' };
  if (report.loops[loops[0]].length > maxLength) return { status: 'skipped', reason: 'too-long' };
  return undefined;
}

const kFairings = { 0: 'none', 1: 'bending', 2: 'curvature', auto: 'auto' } as const;

/** From which angle in degrees on edges are creases. */
const kCrease = 40;

function patchSettings(options: HoleFillOptions, single: boolean) {
  const { weights, candidates = 'auto', fairness = 'auto', density, maxNewVertices, creases = true } = options;
  const degrees = creases === true ? kCrease : Number(creases);
  return {
    ...coreWeights(weights),
    space: kSpaceChoices.indexOf(candidates),
    fairing: kFairingChoices.indexOf(kFairings[fairness]),
    density: density ?? Math.SQRT2,
    maxNewVertices: maxNewVertices ?? Infinity,
    crease: (degrees * Math.PI) / 180,
    inFloats: Number(single),
  };
}
