// The functions for meshes of `soapfilm/worker`.
import type { SmoothArrays } from './border.js';
import { optionsOf } from './check.js';
import type { FilledHoles, FlatMesh, FoundHoles } from './compute_holes.js';
import { fillOptionsOf, flattenMesh, holeOptionsOf } from './hole_input.js';
import { filledOf, holeListener, planOf, reportOf } from './hole_results.js';
import { kFillOptions, kHoleOptions, kSmoothOptions, limitsOf, signalOf } from './options.js';
import type { Pool } from './pool.js';
import { smoothOf, smoothWorkOf } from './smooth.js';
import type { FillOptions, HoleOptions, SmoothOptions } from './types.js';
import type { CallOptions, Film } from './worker.js';

type MeshCalls = 'findHoles' | 'fillHoles' | 'smoothSurface';

/** Calls that check and copy here, have the pool compute, and make the results here. */
export function meshCalls(pool: Pool): Pick<Film, MeshCalls> {
  const find = async (mesh: FlatMesh, options: HoleOptions, signal: AbortSignal | undefined): Promise<FoundHoles> =>
    (await pool.call('findHoles', [mesh, holeOptionsOf(options)], { signal })) as FoundHoles;
  return {
    async findHoles(mesh, options = {}) {
      const flat = flattenMesh(mesh, true);
      const { signal, ...given } = optionsOf<HoleOptions & CallOptions>(options, { ...kHoleOptions, signal: true });
      return reportOf(await find(flat, holeOptionsOf(given), signalOf(signal)));
    },
    async fillHoles(mesh, options = {}) {
      const flat = flattenMesh(mesh, true);
      const { signal: aborts, ...rest } = optionsOf<FillOptions & CallOptions>(options, { ...kFillOptions, signal: true });
      const signal = signalOf(aborts);
      const given = fillOptionsOf(rest);
      const found = await find(flat, given, signal);
      const plan = planOf(reportOf(found), given, flat.single);
      // The mesh goes to the thread and comes back, twice, but is not copied.
      const patches = { ...limitsOf(given), work: plan.work, spentSeconds: found.seconds };
      const watch = { signal, onProgress: holeListener(plan, given.onProgress) };
      const filled = (await pool.call('fillHoles', [found.mesh, patches], watch)) as FilledHoles;
      return filledOf(filled.mesh, plan, filled.arrays, given);
    },
    async smoothSurface(surface, options = {}) {
      const flat = flattenMesh(surface, true, 'surface');
      const { signal, ...given } = optionsOf<SmoothOptions & CallOptions>(options, { ...kSmoothOptions, signal: true });
      const watch = { signal: signalOf(signal) };
      return smoothOf((await pool.call('smoothSurface', [flat, smoothWorkOf(given)], watch)) as SmoothArrays);
    },
  };
}
