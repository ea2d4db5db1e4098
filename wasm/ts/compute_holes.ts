// Holes, once the arguments are checked: makes the core's settings from them, and reports from the core's arrays.
// Threads need only this half.
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
  readFillArrays,
  readFilledFacts,
  readGroupFacts,
  readHolesArrays,
  readLoopFacts,
} from './border.js';
import { SoapfilmError } from './errors.js';
import { meshError } from './messages.js';
import { callCore, kDefaultMemoryBytes, shared, type CoreArgument } from './runtime.js';
import type {
  FilledHole,
  FillOptions,
  FillResult,
  HoleFillOptions,
  HoleGroup,
  HoleLoop,
  HoleOptions,
  HoleReason,
  HoleReport,
  MeshDefect,
} from './types.js';

/** A mesh whose arrays are of the right kinds. */
export interface FlatMesh {
  readonly positions: Float64Array;
  readonly faces: Uint32Array;
  /** Whether the caller's positions are single. */
  readonly single: boolean;
}

const argumentsOf = ({ positions, faces }: FlatMesh): CoreArgument[] => [
  positions,
  positions.length / 3,
  faces,
  faces.length / 3,
];

/** `findHoles` for checked arguments. */
export function computeReport(mesh: FlatMesh, { maxSeconds, maxMemoryBytes }: HoleOptions): HoleReport {
  const { arrays } = callCore(
    shared.meshes,
    'sf_find_holes',
    [...argumentsOf(mesh), maxMemoryBytes ?? kDefaultMemoryBytes],
    readHolesArrays,
    { maxSeconds, explain: meshError },
  );
  const { loopStarts, loopVertices, loopFacts, groupStarts, groupLoops, groupFacts } = arrays;
  const loops = Array.from({ length: loopStarts.length - 1 }, (_, i): HoleLoop => ({
    vertices: loopVertices.slice(loopStarts[i], loopStarts[i + 1]),
    ...readLoopFacts(loopFacts, kLoopFactsLength * i),
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
  return { loops, groups, defects: readDefects(arrays.defects, arrays.defectPlaces) };
}

function readDefects(counts: Uint32Array, places: Uint32Array): MeshDefect[] {
  let at = 0;
  const take = (count: number): Uint32Array => places.slice(at, (at += count));
  return Array.from({ length: counts.length / kDefectCountsLength }, (_, i) => {
    const { kind, faces, edges, vertices } = readDefectCounts(counts, kDefectCountsLength * i);
    return { kind: kDefectKindChoices[kind], faces: take(faces), edges: take(edges), vertices: take(vertices) };
  });
}

/** `fillHoles` for checked arguments. */
export function computeFill(mesh: FlatMesh, options: FillOptions): FillResult {
  const { maxSeconds, maxMemoryBytes, output, onProgress } = options;
  const started = performance.now();
  const left = (): { maxSeconds?: number } =>
    maxSeconds === undefined ? {} : { maxSeconds: Math.max(0, maxSeconds - (performance.now() - started) / 1000) };
  const report = computeReport(mesh, options);
  const given = options.groups?.flat() ?? [];
  checkNumbers('groups', given, report.loops.length, 'loop');
  if (new Set(given).size < given.length) throw new SoapfilmError('bad-option', '`groups` names a loop twice');
  const groups = options.groups ? givenGroups(options.groups, report) : report.groups;
  if (Array.isArray(options.holes)) checkNumbers('holes', options.holes as number[], groups.length, 'hole');
  const todo: number[] = [];
  const holes: FilledHole[] = groups.map((group, g) => {
    const passed = whyNot(g, group, report, options);
    if (passed === undefined) todo.push(g);
    return { ...kNothing, group: g, status: 'skipped', ...passed };
  });
  const starts = new Uint32Array(todo.length + 1);
  todo.forEach((g, i) => (starts[i + 1] = starts[i] + groups[g].loops.length));
  const size = (packPatchSettings(patchSettings({})) as { length: number }).length;
  const settings = new Float64Array(size * todo.length);
  todo.forEach((g, i) => {
    settings.set(packPatchSettings(patchSettings({ ...options, ...options.perHole?.[g] })), size * i);
  });
  const { arrays } = callCore(
    shared.meshes,
    'sf_fill_holes',
    [
      ...argumentsOf(mesh),
      starts,
      todo.length,
      Uint32Array.from(todo.flatMap((g) => groups[g].loops)),
      settings,
      maxMemoryBytes ?? kDefaultMemoryBytes,
    ],
    readFillArrays,
    {
      ...left(),
      explain: meshError,
      onProgress:
        onProgress &&
        ((fraction) => {
          const hole = todo[Math.min(todo.length - 1, Math.floor(fraction * todo.length))];
          onProgress(fraction, hole, todo.length);
        }),
    },
  );
  let pair = 0;
  todo.forEach((g, i) => {
    const facts = readFilledFacts(arrays.holes, kFilledFactsLength * i);
    const reason = kFillReasonChoices[facts.reason];
    holes[g] = {
      group: g,
      status: kFillStatusChoices[facts.status],
      ...(reason !== 'none' && { reason }),
      faces: [facts.firstFace, facts.endFace],
      cost: facts.cost,
      lowerBound: facts.lowerBound,
      optimal: facts.optimal === 1,
      rimAngle: { before: facts.rimAngleBefore, after: facts.rimAngleAfter },
      intersections: arrays.pairs.slice(pair, (pair += 2 * facts.pairs)),
      fairnessUsed: Math.max(0, facts.fairnessUsed - 1) as 0 | 1 | 2,
      movedLess: facts.movedLess,
    };
  });
  const old = output === 'patches' ? { positions: new Float64Array(), faces: new Uint32Array() } : mesh;
  const positions = joined(new Float64Array(old.positions.length + arrays.positions.length), old.positions, arrays.positions);
  return {
    mesh: {
      positions: mesh.single ? Float32Array.from(positions) : positions,
      faces: joined(new Uint32Array(old.faces.length + arrays.faces.length), old.faces, arrays.faces),
    },
    oldVertices: mesh.positions.length / 3,
    oldFaces: mesh.faces.length / 3,
    closed: holes.every(({ status }) => status === 'filled') && countLoops(groups) === report.loops.length,
    holes,
    defects: report.defects,
  };
}

const kNothing = {
  faces: [0, 0] as readonly [number, number],
  cost: 0,
  lowerBound: 0,
  optimal: false,
  rimAngle: { before: 0, after: 0 },
  intersections: new Uint32Array(),
  fairnessUsed: 0 as const,
  movedLess: 0,
};

const countLoops = (groups: readonly HoleGroup[]): number => groups.reduce((sum, { loops }) => sum + loops.length, 0);

function joined<A extends Float64Array | Uint32Array>(all: A, first: ArrayLike<number>, second: ArrayLike<number>): A {
  all.set(first);
  all.set(second, first.length);
  return all;
}

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

function patchSettings({ weights, candidates = 'auto', fairness = 'auto', density, maxNewVertices }: HoleFillOptions) {
  // NaN: the core sets the default, which depends on the size of the hole.
  const { area = 0, perimeter = 0, dihedral = 0 } = weights ?? { area: NaN, dihedral: 1 };
  return {
    areaWeight: area,
    perimeterWeight: perimeter,
    dihedralWeight: dihedral,
    space: kSpaceChoices.indexOf(candidates),
    fairing: kFairingChoices.indexOf(kFairings[fairness]),
    density: density ?? Math.SQRT2,
    maxNewVertices: maxNewVertices ?? Infinity,
  };
}
