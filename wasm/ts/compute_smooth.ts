// smoothSurface, once the arguments are checked: asks the core. Threads need only this half.
import { packSmoothSettings, readSmoothArrays, type SmoothArrays } from './border.js';
import { argumentsOf, fractionsFor, type BareMesh } from './compute_holes.js';
import { meshError } from './messages.js';
import type { Limits } from './options.js';
import { callCore, kDefaultMemoryBytes, shared } from './runtime.js';

/** Settings as the core takes them, and the limits. */
export interface SmoothWork extends Limits {
  readonly settings: Omit<Parameters<typeof packSmoothSettings>[0], 'maxBytes'>;
  /** Vertices that stay. */
  readonly fixed: Uint32Array;
  readonly boundaryNormals: Float64Array | undefined;
  readonly onProgress?: (fraction: number) => void;
}

export function computeSmooth(surface: BareMesh, work: SmoothWork): SmoothArrays {
  const { settings, fixed, boundaryNormals: normals, maxSeconds, maxMemoryBytes: maxBytes = kDefaultMemoryBytes, onProgress } = work;
  const args = [
    ...argumentsOf(surface),
    fixed,
    fixed.length,
    normals ?? null,
    normals ? normals.length / 3 : 0,
    packSmoothSettings({ ...settings, maxBytes }),
  ];
  const watch = {
    maxSeconds,
    explain: meshError,
    onProgress: fractionsFor(onProgress),
  };
  return callCore(shared.meshes, 'sf_smooth_surface', args, readSmoothArrays, watch).arrays;
}
