// The functions for meshes of `soapfilm/worker`.
import type { BareMesh, PatchWork } from './compute_holes.js';
import { kDispose } from './dispose.js';
import { fillSteps, openSteps, reportSteps, type CallBudget, type MeshPlace } from './hole_filling.js';
import { fillOptionsOf, flattenMesh, holeOptionsOf } from './hole_input.js';
import { callOptionsOf, kFillOptions, kHoleOptions, kSessionFillOptions, kSmoothOptions, limitsOf } from './options.js';
import type { Pool, PooledMesh } from './pool.js';
import { copyOf } from './protocol.js';
import { tellLast } from './report.js';
import { newSessionId, sessionDisposed } from './session_id.js';
import { smoothOf, smoothWorkOf } from './smooth_input.js';
import { doInTime } from './steps.js';
import type { ProgressListener } from './types.js';
import type { Film, MeshSessionHandle } from './worker.js';

type MeshCalls = 'findHoles' | 'fillHoles' | 'createMeshSession' | 'smoothSurface';

/** Calls that check and copy here, have the pool compute, and make the results here. */
export function meshCalls(pool: Pool): Pick<Film, MeshCalls> {
  const place = placeIn(pool);
  const forgotten = new FinalizationRegistry<() => void>((close) => {
    close();
  });
  return {
    async findHoles(mesh, options = {}) {
      const flat = flattenMesh(mesh, true);
      const [given, signal] = callOptionsOf(options, kHoleOptions);
      return doInTime(reportSteps(place, flat, holeOptionsOf(given), signal));
    },
    async fillHoles(mesh, options = {}) {
      const flat = flattenMesh(mesh, true);
      const [all, signal] = callOptionsOf(options, kFillOptions);
      const given = fillOptionsOf(all);
      const opened = await doInTime(openSteps(place, flat, given, signal));
      try {
        return await doInTime(fillSteps(place, opened, given, opened.seconds, signal));
      } finally {
        opened.open.close();
      }
    },
    async createMeshSession(mesh, options = {}) {
      const flat = flattenMesh(mesh, true);
      const [all, signal] = callOptionsOf(options, kHoleOptions);
      const given = holeOptionsOf(all);
      const opened = await doInTime(openSteps(place, flat, given, signal, given.onProgress));
      const memory = limitsOf({ maxMemoryBytes: given.maxMemoryBytes });
      const id = newSessionId();
      let isOpen = true;
      const dispose = (): void => {
        isOpen = false;
        forgotten.unregister(handle);
        opened.open.close();
      };
      const handle: MeshSessionHandle = {
        id,
        // A copy: what the caller does to it is no matter.
        report: copyOf(opened.report),
        async fillHoles(options = {}) {
          if (!isOpen) throw sessionDisposed(id);
          const [all, signal] = callOptionsOf(options, kSessionFillOptions);
          return doInTime(fillSteps(place, opened, { ...memory, ...fillOptionsOf(all) }, 0, signal));
        },
        dispose,
        [kDispose]: dispose,
      };
      forgotten.register(handle, opened.open.close, handle);
      return handle;
    },
    async smoothSurface(surface, options = {}) {
      const flat = flattenMesh(surface, true, 'surface');
      const [given, signal] = callOptionsOf(options, kSmoothOptions);
      const { onProgress, ...work } = smoothWorkOf(given, flat, true);
      const smooth = smoothOf(await pool.call('smoothSurface', [flat, work], { signal, onProgress }));
      tellLast(() => onProgress?.(1));
      return smooth;
    },
  };
}

let names = 0;

/** Meshes in the threads of a pool. Those that are open are known to the threads by names. */
function placeIn(pool: Pool): MeshPlace {
  return {
    weld: (mesh, { signal, ...budget }) => pool.call('weldMesh', [bare(mesh), budget], { signal }),
    find: (mesh, { signal, onProgress, ...budget }) => pool.call('findHoles', [bare(mesh), budget], { signal, onProgress }),
    crossings: (mesh, { signal, ...budget }) => pool.call('findCrossings', [bare(mesh), budget], { signal }),
    carryOn: (work, { signal, ...budget }) => pool.call('carryOn', [work, budget], { signal }),
    async open(given, { signal, onProgress, ...budget }) {
      const copy = (): BareMesh => ({ positions: given.positions.slice(), faces: given.faces.slice() });
      const mesh: PooledMesh = { name: ++names, isClosed: false, copy };
      const input = { name: mesh.name };
      const { value: holes, seconds } = await pool.call('openMesh', [input, budget], { signal, mesh, onProgress });
      const fill = (parts: readonly PatchWork[], { signal, ...budget }: CallBudget, listeners: readonly (ProgressListener | undefined)[]) =>
        together(signal, parts, (work, i, ends) =>
          pool.call('fillHoles', [input, { ...budget, work }], { signal: ends, mesh, onProgress: listeners[i] }),
        );
      const close = (): void => {
        pool.forget(mesh);
      };
      return { value: { open: { size: pool.size, fill, close }, holes }, seconds };
    },
  };
}

/** What the core takes of a mesh. The buffers go to the thread: nobody else needs them. */
const bare = ({ positions, faces }: BareMesh): BareMesh => ({ positions, faces });

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
