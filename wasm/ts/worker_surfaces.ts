// Trimmed models of `soapfilm/worker`. Each has a thread of its own, so that what is known of it stays from update to update.
import type { PoleMove, TessellationWork } from './compute_surfaces.js';
import { kDispose } from './dispose.js';
import type { SoapfilmError } from './errors.js';
import { Launcher } from './launch.js';
import { MeshPatches } from './mesh_patches.js';
import { callOptionsOf, type Limits } from './options.js';
import { disposed, Pool, type PooledMesh } from './pool.js';
import { unpackErrors } from './protocol.js';
import { tellLast } from './report.js';
import { faultsOf, kSampling, kTrimmedOptions, tessellationOf, tessellationWorkOf, trimmedOptionsOf } from './sampling_input.js';
import { newSessionId, sessionDisposed } from './session_id.js';
import { poleMoveOf, trimMoveOf } from './surface_edits.js';
import { flattenModel, type FlatModel } from './surface_input.js';
import type { Change, Sampling, Tessellation } from './surface_types.js';
import type { Point2Like, PointLike } from './types.js';
import type { CallOptions, Film, TrimmedModelHandle } from './worker.js';

/** @param pool whose threads the models' are besides; they end with it */
export function surfaceCalls(pool: Pool, module: WebAssembly.Module): Pick<Film, 'createTrimmedModel'> {
  const launcher = new Launcher({ surfaces: module });
  const open = new Set<Pool>();
  let isDisposed = false;
  pool.guests.add({
    dispose: () => {
      isDisposed = true;
      for (const own of open) own.dispose();
    },
  });
  const forgotten = new FinalizationRegistry<() => void>((close) => {
    close();
  });
  return {
    async createTrimmedModel(model, options = {}) {
      if (isDisposed) throw disposed();
      const [given, signal] = callOptionsOf(options, kTrimmedOptions);
      const { skipInvalid, limits } = trimmedOptionsOf(given);
      const flat = flattenModel(model);
      if (!skipInvalid && flat.faults.length > 0) throw flat.faults[0];
      const own = new Pool(launcher, 1);
      open.add(own);
      const close = (): void => {
        open.delete(own);
        own.dispose();
      };
      try {
        const remote = new RemoteModel(own, flat, limits, close);
        const faults = await remote.open(signal);
        if (!skipInvalid && faults.length > 0) throw faults[0];
        const handle = new ModelHandle(remote);
        forgotten.register(handle, close, remote);
        return handle;
      } catch (error) {
        close();
        throw error;
      }
    },
  };
}

/** A model in the only thread of a pool, which gets it anew when a call that was ended has taken the thread with it. */
class RemoteModel {
  readonly id = newSessionId();
  faults: readonly SoapfilmError[] = [];
  readonly #pool: Pool;
  readonly #limits: Pick<Limits, 'maxMemoryBytes'>;
  readonly #close: () => void;
  readonly #mesh: PooledMesh;
  readonly #moves: PoleMove[] = [];
  readonly #flat: FlatModel;
  #box: Float64Array = new Float64Array();
  #isOpen = true;
  #waiting = 0;

  constructor(pool: Pool, flat: FlatModel, limits: Pick<Limits, 'maxMemoryBytes'>, close: () => void) {
    this.#pool = pool;
    this.#flat = flat;
    this.#limits = limits;
    this.#close = close;
    const copy = () => ({ shape: flat.shape.slice(), numbers: flat.numbers.slice(), limits, moves: this.#moves });
    this.#mesh = { name: this.id, isClosed: false, copy };
  }

  /** Returns the faults of the model. */
  async open(signal: AbortSignal | undefined): Promise<readonly SoapfilmError[]> {
    const watch = { signal, mesh: this.#mesh };
    const { box, errors } = unpackErrors(await this.#pool.call('openModel', [{ name: this.id }], watch));
    this.#box = box;
    this.faults = faultsOf(this.#flat.faults, errors);
    return this.faults;
  }

  /** @throws SoapfilmError `disposed` */
  alive(): void {
    if (!this.#isOpen) throw sessionDisposed(this.id);
  }

  async make<T>(
    name: 'tessellateModel' | 'updateModel',
    sampling: (Sampling & CallOptions) | undefined,
    read: (made: never) => T,
  ): Promise<T> {
    this.alive();
    const [given, signal] = callOptionsOf(sampling ?? {}, kSampling);
    const { onProgress, ...work } = tessellationWorkOf(given, { box: this.#box }, this.#limits);
    const watch = { signal, mesh: this.#mesh, onProgress };
    const made = read((await this.#answered(this.#pool.call(name, [{ name: this.id }, work as TessellationWork], watch))) as never);
    tellLast(() => onProgress?.(1));
    return made;
  }

  async move(move: PoleMove): Promise<void> {
    const { errors } = unpackErrors(await this.#answered(this.#pool.call('moveInModel', [{ name: this.id }, move], { mesh: this.#mesh })));
    for (const error of errors) throw error;
    this.#moves.push(move);
  }

  /** Ends the thread once all calls before are answered. */
  dispose(): void {
    this.#isOpen = false;
    if (this.#waiting === 0) this.#close();
  }

  async #answered<T>(call: Promise<T>): Promise<T> {
    this.#waiting++;
    try {
      return await call;
    } finally {
      this.#waiting--;
      if (!this.#isOpen) this.dispose();
    }
  }
}

/** A TrimmedModel whose core's half is in a thread. */
class ModelHandle implements TrimmedModelHandle {
  readonly #remote: RemoteModel;
  readonly #patches = new MeshPatches();

  constructor(remote: RemoteModel) {
    this.#remote = remote;
  }

  get id(): number {
    return this.#remote.id;
  }

  tessellate(sampling?: Sampling & CallOptions): Promise<Tessellation> {
    return this.#remote.make('tessellateModel', sampling, (mesh) => {
      this.#patches.lend(mesh);
      return tessellationOf(mesh, this.#remote.faults);
    });
  }

  update(sampling?: Sampling & CallOptions): Promise<Change> {
    return this.#remote.make('updateModel', sampling, (change) => this.#patches.apply(change, this.#remote.faults));
  }

  async movePole(face: number, pole: number, at: PointLike, weight?: number): Promise<void> {
    this.#remote.alive();
    await this.#remote.move(poleMoveOf(face, pole, at, weight));
  }

  async moveTrim(face: number, loop: number, use: number, pole: number, at: Point2Like): Promise<void> {
    this.#remote.alive();
    await this.#remote.move(trimMoveOf(face, loop, use, pole, at));
  }

  dispose(): void {
    this.#remote.dispose();
  }

  [kDispose](): void {
    this.dispose();
  }
}
