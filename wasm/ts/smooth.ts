// smoothSurface: checks its arguments, and computes.
import { optionsOf } from './check.js';
import { computeSmooth } from './compute_smooth.js';
import { flattenMesh } from './hole_input.js';
import { kSmoothOptions } from './options.js';
import { tellLast } from './report.js';
import { smoothOf, smoothWorkOf } from './smooth_input.js';
import type { MeshInput, SmoothOptions, SmoothSurface } from './types.js';

/**
 * Smooths a surface between its boundary, which stays where it is: a soap film of least area, or a plate that bends
 * least. It begins from any triangulation, such as one of `spanLoops`, and refines it first.
 *
 * @param surface manifold, oriented, with a boundary
 * @throws SoapfilmError `not-loaded`; `bad-mesh` with a `face` that keeps it from being such a surface, and the `edgeVertices` of an edge at
 *   fault, `not-finite`;
 *   `bad-option`, `bad-normals`; `too-large`, `out-of-memory`, `time-limit`; `crashed`
 */
export function smoothSurface(surface: MeshInput, options: SmoothOptions = {}): SmoothSurface {
  const flat = flattenMesh(surface, false, 'surface');
  const work = smoothWorkOf(optionsOf(options, kSmoothOptions), flat, false);
  const smooth = smoothOf(computeSmooth(flat, work));
  tellLast(() => work.onProgress?.(1));
  return smooth;
}
