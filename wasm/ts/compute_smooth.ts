// smoothSurface, once the arguments are checked: asks the core. Threads need only this half.
import { packSmoothSettings, readSmoothArrays, type SmoothArrays } from './border.js';
import type { FlatMesh } from './compute_holes.js';
import { meshError } from './messages.js';
import { callCore, shared } from './runtime.js';

/** Settings as the core takes them, and the limit in time. */
export interface SmoothWork {
  readonly settings: Parameters<typeof packSmoothSettings>[0];
  readonly maxSeconds?: number | undefined;
}

export function computeSmooth({ positions, faces }: FlatMesh, { settings, maxSeconds }: SmoothWork): SmoothArrays {
  const args = [positions, positions.length / 3, faces, faces.length / 3, packSmoothSettings(settings)];
  return callCore(shared.meshes, 'sf_smooth_surface', args, readSmoothArrays, { maxSeconds, explain: meshError }).arrays;
}
