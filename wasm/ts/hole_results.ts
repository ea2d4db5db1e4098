// Holes: reports and filled meshes from the core's arrays. The caller's half: threads do without.
import {
  kDefectCountsLength,
  kDefectKindChoices,
  kFilledFactsLength,
  kFillReasonChoices,
  kFillStatusChoices,
  kGroupFactsLength,
  kGroupKindChoices,
  kLoopFactsLength,
  kRimSplitLength,
  readDefectCounts,
  readFilledFacts,
  readGroupFacts,
  readLoopFacts,
  readRimSplit,
  type FillArrays,
  type HolesArrays,
} from './border.js';
import { filledAttributes, type Attributes, type Seams } from './attributes.js';
import type { BareMesh, FlatMesh } from './compute_holes.js';
import type { Patches } from './hole_crossings.js';
import type { FillPlan } from './hole_plan.js';
import type { RimSplit, SplitMesh } from './hole_splits.js';
import { tellLast } from './report.js';
import type { FilledHole, FillOptions, FillResult, HoleGroup, HoleLoop, HoleReport, MeshDefect } from './types.js';

export function reportOf(arrays: HolesArrays, vertexMap?: Uint32Array): HoleReport {
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

/** The parts of the work, done, as one. */
export function patchesOf(mesh: BareMesh, plan: FillPlan, parts: readonly FillArrays[]): Patches {
  const oldVertices = mesh.positions.length / 3;
  const oldFaces = mesh.faces.length / 3;
  const holes = [...plan.holes];
  const splits = new Map<number, RimSplit[]>();
  const positions = new Float64Array(parts.reduce((sum, part) => sum + part.positions.length, 0));
  const faces = new Uint32Array(parts.reduce((sum, part) => sum + part.faces.length, 0));
  let [hole, newVertices, newFaces] = [0, 0, 0];
  for (const part of parts) {
    // What a part has numbered from the end of the mesh on, other parts come before.
    const faceOf = (face: number): number => (face < oldFaces ? face : face + newFaces);
    const vertexOf = (vertex: number): number => (vertex < oldVertices ? vertex : vertex + newVertices);
    let [pair, split] = [0, 0];
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
      if (facts.splits === 0) continue;
      const own = Array.from({ length: facts.splits }, (): RimSplit => {
        const parameter = part.splitParameters[split];
        return { ...readRimSplit(part.splits, kRimSplitLength * split++), parameter };
      });
      splits.set(group, own);
    }
    positions.set(part.positions, 3 * newVertices);
    faces.set(part.faces.map(vertexOf), 3 * newFaces);
    newVertices += part.positions.length / 3;
    newFaces += part.faces.length / 3;
  }
  return { holes, positions, faces, splits };
}

/** A mesh that was to be filled. */
export interface GivenMesh {
  readonly mesh: FlatMesh;
  readonly report: HoleReport;
  /** Where its attributes were not one, before it was welded. */
  readonly seams?: Seams | undefined;
}

/**
 * The result, and when it is made, the last call of `onProgress`.
 * @param split the mesh as it is filled
 * @param carried the attributes of new vertices, one after the other for each
 */
export function filledOf(
  given: GivenMesh,
  plan: FillPlan,
  split: SplitMesh,
  patches: Patches,
  carried: Float64Array,
  { output, onProgress }: FillOptions,
): FillResult {
  const { positions: old, faces: oldCorners, single } = given.mesh;
  const [oldVertices, oldFaces] = [old.length / 3, oldCorners.length / 3];
  const { mesh, splitFaces } = split;
  const isPart = output === 'patches';
  const [vertices, corners] = [isPart ? old.length : 0, isPart ? oldCorners.length : 0];
  const positions = new (single ? Float32Array : Float64Array)(mesh.positions.length - vertices + patches.positions.length);
  const faces = new Uint32Array(mesh.faces.length - corners + patches.faces.length);
  positions.set(mesh.positions.subarray(vertices));
  positions.set(patches.positions, mesh.positions.length - vertices);
  faces.set(mesh.faces.subarray(corners));
  faces.set(patches.faces, mesh.faces.length - corners);
  const attributes = given.mesh.attributes && filledAttributes(given.mesh.attributes, split.tails, carried, isPart ? oldVertices : 0);
  const holes = attributes ? withoutSeams(attributes, given, plan, split, patches) : patches.holes;
  if (plan.todo.length > 0) tellLast(() => onProgress?.(1, plan.todo[plan.todo.length - 1], plan.todo.length));
  const { vertexMap, defects, loops } = given.report;
  return {
    mesh: { positions, faces, ...(attributes && { attributes }) },
    oldVertices,
    oldFaces,
    splitFaces,
    closed: holes.every(({ status }) => status === 'filled' || status === 'self-intersecting') && countLoops(plan.groups) === loops.length,
    holes,
    defects,
    ...(vertexMap && { vertexMap }),
  };
}

/**
 * Sets to 0 what could not be carried on, and tells the holes of it.
 * @param attributes those of the new vertices come last
 */
function withoutSeams(
  attributes: Attributes,
  { report, seams }: GivenMesh,
  { groups }: FillPlan,
  { mesh }: SplitMesh,
  patches: Patches,
): readonly FilledHole[] {
  if (!seams) return patches.holes;
  const [old, all] = [mesh.positions.length / 3, (mesh.positions.length + patches.positions.length) / 3];
  const oldFaces = mesh.faces.length / 3;
  return patches.holes.map((hole) => {
    const rims = groups[hole.group].loops.flatMap((loop) => [...report.loops[loop].vertices]);
    const left = Object.keys(seams).filter((name) => rims.some((v) => seams[name][v] === 1));
    const { faces: [from, to] } = hole;
    if (left.length === 0 || from === to) return hole;
    for (const v of patches.faces.subarray(3 * (from - oldFaces), 3 * (to - oldFaces))) {
      if (v < old) continue;
      for (const { data, size } of left.map((name) => attributes[name])) {
        const at = data.length - size * (all - v);
        data.fill(0, at, at + size);
      }
    }
    return { ...hole, attributesLeft: left };
  });
}

const countLoops = (groups: readonly HoleGroup[]): number => groups.reduce((sum, { loops }) => sum + loops.length, 0);

