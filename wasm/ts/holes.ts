// findHoles, fillHoles: check their arguments, and compute.
import { optionsOf } from './check.js';
import { computeCrossings, computeHoles, computePatches } from './compute_holes.js';
import { closePatches, withCrossings } from './hole_crossings.js';
import { fillOptionsOf, flattenMesh, holeOptionsOf } from './hole_input.js';
import { filledOf, partListeners, patchesOf, planOf, reportOf } from './hole_results.js';
import { kFillOptions, kHoleOptions, limitsOf } from './options.js';
import type { FillOptions, FillResult, HoleOptions, HoleReport, MeshInput } from './types.js';

/**
 * Finds the holes of a mesh: loops of edges that have a face on one side alone, grouped with their islands. Rims that
 * are meant to be open are told apart. Whatever is wrong with the mesh is listed, and does no harm. The mesh is read,
 * and never changed. Time about proportional to its size.
 *
 * @throws SoapfilmError `not-loaded`; `bad-mesh` with the `face` at fault, `not-finite` with the `vertex`;
 *   `bad-option`; `too-large`, `out-of-memory`, `time-limit`; `crashed`
 */
export function findHoles(mesh: MeshInput, options: HoleOptions = {}): HoleReport {
  return reportOf(computeHoles(flattenMesh(mesh, false), holeOptionsOf(optionsOf(options, kHoleOptions))));
}

/**
 * Fills holes of a mesh: each group of loops gets the surface of least cost that goes on the faces around it (Zou, Ju,
 * Carr 2013, sec. 5), refined to the density of its surroundings and faired (Liepa 2003). Old vertices and faces come
 * first and stay exactly as they are. A patch that intersects something is told so, with the faces.
 *
 * @throws SoapfilmError those of `findHoles`; `bad-weights`; what `onProgress` throws
 */
export function fillHoles(mesh: MeshInput, options: FillOptions = {}): FillResult {
  const flat = flattenMesh(mesh, false);
  const given = fillOptionsOf(optionsOf(options, kFillOptions));
  const found = computeHoles(flat, given);
  const plan = planOf(reportOf(found), given, flat.single);
  const [onProgress] = partListeners(plan, [plan.work], given.onProgress);
  const filled = computePatches(found.mesh, { ...limitsOf(given), work: plan.work, spentSeconds: found.seconds, onProgress });
  let patches = patchesOf(found.mesh, plan, [filled.arrays]);
  const close = closePatches(found.mesh, patches);
  if (close) patches = withCrossings(patches, close, computeCrossings(close.mesh, { ...limitsOf(given), spentSeconds: filled.spentSeconds }));
  return filledOf(found.mesh, plan, patches, given);
}
