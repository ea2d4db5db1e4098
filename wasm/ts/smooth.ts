// smoothSurface: checks its arguments, and computes.
import { kSurfaceKindChoices, readSmoothNumbers, type SmoothArrays } from './border.js';
import { choiceOf, optionsOf, type Given } from './check.js';
import { computeSmooth, type SmoothWork } from './compute_smooth.js';
import { flattenMesh, sizeOf } from './hole_input.js';
import { kSmoothOptions, limitsOf } from './options.js';
import { kDefaultMemoryBytes } from './runtime.js';
import type { MeshInput, SmoothOptions, SmoothSurface } from './types.js';

/**
 * Smooths a surface between its boundary, which stays where it is: a soap film of least area, or a plate that bends
 * least. It begins from any triangulation, such as one of `spanLoops`, and refines it first.
 *
 * @param surface manifold, oriented, with a boundary
 * @throws SoapfilmError `not-loaded`; `bad-mesh` with a `face` that keeps it from being such a surface, `not-finite`;
 *   `bad-option`; `too-large`, `out-of-memory`, `time-limit`; `crashed`
 */
export function smoothSurface(surface: MeshInput, options: SmoothOptions = {}): SmoothSurface {
  const flat = flattenMesh(surface, false, 'surface');
  return smoothOf(computeSmooth(flat, smoothWorkOf(optionsOf(options, kSmoothOptions))));
}

/** The options, checked, as the core takes them. @throws SoapfilmError `bad-option` */
export function smoothWorkOf(given: Given<SmoothOptions>): SmoothWork {
  const { maxSeconds, maxMemoryBytes = kDefaultMemoryBytes } = limitsOf(given);
  const { kind, density = Math.SQRT2, maxNewVertices = Infinity } = given;
  return {
    settings: {
      kind: kSurfaceKindChoices.indexOf(choiceOf('kind', kSurfaceKindChoices, kind)),
      density: sizeOf('density', density, 100),
      maxNewVertices: sizeOf('maxNewVertices', maxNewVertices),
      maxBytes: maxMemoryBytes,
    },
    maxSeconds,
  };
}

export function smoothOf({ positions, triangles, boundary, collapsed, numbers }: SmoothArrays): SmoothSurface {
  const { area, isMinimal } = readSmoothNumbers(numbers);
  return { positions, triangles, boundary, collapsed, area, isMinimal: isMinimal === 1 };
}
