// The functions for meshes of `soapfilm/worker`.
import type { FlatMesh, FoundHoles } from './compute_holes.js';
import { closePatches, withCrossings } from './hole_crossings.js';
import { fillOptionsOf, flattenMesh, holeOptionsOf } from './hole_input.js';
import { filledOf, partListeners, partsOf, patchesOf, planOf, reportOf } from './hole_results.js';
import { callOptionsOf, kFillOptions, kHoleOptions, kSmoothOptions, limitsOf } from './options.js';
import type { Pool } from './pool.js';
import { smoothOf, smoothWorkOf } from './smooth_input.js';
import type { HoleOptions } from './types.js';
import type { Film } from './worker.js';

type MeshCalls = 'findHoles' | 'fillHoles' | 'smoothSurface';

/** Calls that check and copy here, have the pool compute, and make the results here. */
export function meshCalls(pool: Pool): Pick<Film, MeshCalls> {
  const find = (mesh: FlatMesh, options: HoleOptions, signal: AbortSignal | undefined): Promise<FoundHoles> =>
    pool.call('findHoles', [mesh, options], { signal });
  return {
    async findHoles(mesh, options = {}) {
      const flat = flattenMesh(mesh, true);
      const [given, signal] = callOptionsOf(options, kHoleOptions);
      return reportOf(await find(flat, holeOptionsOf(given), signal));
    },
    async fillHoles(mesh, options = {}) {
      const flat = flattenMesh(mesh, true);
      const [all, signal] = callOptionsOf(options, kFillOptions);
      const given = fillOptionsOf(all);
      // No more than finding needs: listeners cannot be sent.
      const found = await find(flat, holeOptionsOf(given), signal);
      const plan = planOf(reportOf(found), given, flat.single);
      const parts = partsOf(plan.work, plan, pool.size);
      const listeners = partListeners(plan, parts, given.onProgress);
      // One thread is handed the mesh itself, the others copies.
      const { positions, faces, single } = found.mesh;
      const copy = (): FlatMesh => ({ positions: positions.slice(), faces: faces.slice(), single });
      const meshes = parts.map((_, i) => (i === 0 ? found.mesh : copy()));
      const filled = await together(signal, parts, (work, i, ends) => {
        const patches = { ...limitsOf(given), work, spentSeconds: found.seconds };
        return pool.call('fillHoles', [meshes[i], patches], { signal: ends, onProgress: listeners[i] });
      });
      const old = filled[0]?.mesh ?? found.mesh;
      let patches = patchesOf(old, plan, filled.map(({ arrays }) => arrays));
      const close = closePatches(old, patches);
      if (close) {
        const limits = { ...limitsOf(given), spentSeconds: Math.max(...filled.map(({ spentSeconds }) => spentSeconds)) };
        const pairs = await pool.call('findCrossings', [close.mesh, limits], { signal });
        patches = withCrossings(patches, close, pairs);
      }
      return filledOf(old, plan, patches, given);
    },
    async smoothSurface(surface, options = {}) {
      const flat = flattenMesh(surface, true, 'surface');
      const [given, signal] = callOptionsOf(options, kSmoothOptions);
      return smoothOf(await pool.call('smoothSurface', [flat, smoothWorkOf(given, flat, true)], { signal }));
    },
  };
}

/** Starts work on all parts at once. The first that fails, or the signal, ends the others. */
async function together<P, R>(
  signal: AbortSignal | undefined,
  parts: readonly P[],
  start: (part: P, number: number, ends: AbortSignal) => Promise<R>,
): Promise<R[]> {
  const ends = new AbortController();
  const abort = (): void => {
    ends.abort(signal?.reason);
  };
  if (signal?.aborted) abort();
  signal?.addEventListener('abort', abort);
  try {
    return await Promise.all(parts.map((part, i) => start(part, i, ends.signal)));
  } catch (error) {
    ends.abort();
    throw error;
  } finally {
    signal?.removeEventListener('abort', abort);
  }
}
