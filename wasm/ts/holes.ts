// findHoles, fillHoles: check their arguments, and compute.
import { optionsOf } from './check.js';
import { fillSteps, openSteps, reportSteps } from './hole_filling.js';
import { fillOptionsOf, flattenMesh, holeOptionsOf } from './hole_input.js';
import { passingPlace } from './mesh_place.js';
import { kFillOptions, kHoleOptions } from './options.js';
import { doAtOnce } from './steps.js';
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
  const flat = flattenMesh(mesh, false);
  return doAtOnce(reportSteps(passingPlace, flat, holeOptionsOf(optionsOf(options, kHoleOptions))));
}

/**
 * Fills holes of a mesh: each group of loops gets the surface of least cost that goes on the faces around it (Zou, Ju,
 * Carr 2013, sec. 5), refined to the density of its surroundings and faired (Liepa 2003). Old vertices and faces come
 * first and stay exactly as they are, but for `splitFaces`. A patch that intersects something is told so, with the
 * faces. Who fills the holes of one mesh in several calls uses a `MeshSession`.
 *
 * @throws SoapfilmError those of `findHoles`; `bad-weights`; what `onProgress` throws
 */
export function fillHoles(mesh: MeshInput, options: FillOptions = {}): FillResult {
  const flat = flattenMesh(mesh, false);
  const given = fillOptionsOf(optionsOf(options, kFillOptions));
  const opened = doAtOnce(openSteps(passingPlace, flat, given));
  try {
    return doAtOnce(fillSteps(passingPlace, opened, given, opened.seconds));
  } finally {
    opened.open.close();
  }
}
