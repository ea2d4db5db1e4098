/// <reference lib="esnext.disposable" preserve="true" />
// TrimmedModel, TrimmedSurface: trimmed surfaces that stay in the core while they are tessellated.
import { optionsOf } from './check.js';
import { ModelKeeper, type PoleMove, type TessellationWork } from './compute_surfaces.js';
import { kDispose } from './dispose.js';
import type { SoapfilmError } from './errors.js';
import { MeshPatches } from './mesh_patches.js';
import type { Limits } from './options.js';
import { tellLast } from './report.js';
import { faultsOf, kSampling, kTrimmedOptions, tessellationOf, tessellationWorkOf, trimmedOptionsOf } from './sampling_input.js';
import { poleMoveOf, trimMoveOf } from './surface_edits.js';
import { flattenFace, flattenModel, type FlatModel } from './surface_input.js';
import type { Change, Face, Model, Sampling, Tessellation, TrimmedOptions } from './surface_types.js';
import type { Point2Like, PointLike } from './types.js';

/** What models and single faces have in common. */
class Trimmed {
  readonly #keeper: ModelKeeper;
  readonly #faults: readonly SoapfilmError[];
  readonly #limits: Pick<Limits, 'maxMemoryBytes'>;
  readonly #patches = new MeshPatches();

  constructor(flatten: () => FlatModel, options: TrimmedOptions) {
    const { skipInvalid, limits } = trimmedOptionsOf(optionsOf(options, kTrimmedOptions));
    const { faults, ...bare } = flatten();
    if (!skipInvalid && faults.length > 0) throw faults[0];
    this.#keeper = new ModelKeeper(bare, limits);
    this.#faults = faultsOf(faults, this.#keeper.opened.errors);
    this.#limits = limits;
    if (skipInvalid || this.#faults.length === 0) return;
    this.#keeper.dispose();
    throw this.#faults[0];
  }

  /** The number by which errors name it, counted together with those of sessions. */
  get id(): number {
    return this.#keeper.id;
  }

  /**
   * Tessellates all faces from scratch. Every point of the mesh is as near to its surface as `tolerance` says, and where a face
   * could not be made so, `reports` name it.
   * @throws SoapfilmError `bad-option`, `disposed`, `too-large`, `out-of-memory`, `crashed`; what `onProgress` throws
   */
  tessellate(sampling: Sampling = {}): Tessellation {
    return this.#mesh(sampling, (work) => {
      const mesh = this.#keeper.tessellate(work);
      this.#patches.lend(mesh);
      return tessellationOf(mesh, this.#faults);
    });
  }

  /**
   * Makes the mesh one of another sampling, from what there is: only what changes is made anew, in faces, grid lines, samples and
   * triangles. Vertices that stay keep their numbers. With a camera, what is finer than needed stays until it is a fifth too fine,
   * so that little changes from frame to frame. The first call tessellates.
   * @throws SoapfilmError as `tessellate`
   */
  update(sampling: Sampling = {}): Change {
    return this.#mesh(sampling, (work) => this.#patches.apply(this.#keeper.update(work, true), this.#faults));
  }

  /**
   * Moves a pole of a face's surface; the next `update` or `tessellate` follows. All edges of the face must be of this face alone;
   * from then on they lie where the surface has them.
   * @param pole its index in `surface.poles`
   * @param weight positive; default: as it was
   * @throws SoapfilmError `bad-edge` if another face shares an edge; `bad-option`; `disposed`. All is then as before
   */
  movePole(face: number, pole: number, at: PointLike, weight?: number): void {
    this.#move(() => poleMoveOf(face, pole, at, weight));
  }

  /**
   * Moves a pole of a trimming curve in the domain of its face; the next `update` or `tessellate` follows. The edge must have this
   * use alone. At an end of the curve the next curve of the loop moves along.
   * @param pole its index in `pcurve.poles`
   * @throws SoapfilmError `bad-edge`; `trim-outside`, `trim-self-intersects`, `trims-cross`, `hole-outside`, `degenerate`;
   *   `bad-option`; `disposed`. All is then as before
   */
  moveTrim(face: number, loop: number, use: number, pole: number, at: Point2Like): void {
    this.#move(() => trimMoveOf(face, loop, use, pole, at));
  }

  /** Frees its memory. Any other use of it afterwards throws `disposed`. */
  dispose(): void {
    this.#keeper.dispose();
  }

  [kDispose](): void {
    this.dispose();
  }

  #mesh<T>(sampling: Sampling, make: (work: TessellationWork) => T): T {
    this.#keeper.alive();
    const work = tessellationWorkOf(optionsOf(sampling, kSampling), this.#keeper.opened, this.#limits);
    const made = make(work);
    tellLast(() => work.onProgress?.(1));
    return made;
  }

  #move(moveOf: () => PoleMove): void {
    this.#keeper.alive();
    for (const error of this.#keeper.move(moveOf()).errors) throw error;
  }
}

/**
 * Trimmed surfaces that share edges, such as the faces of a part from a file of CAD. The model is read once, checked, and kept
 * in the core; the object given is not looked at again.
 *
 * Faces are meshed in strips of a grid where trimming curves leave room for it, and with Delaunay triangles along these
 * (Kumar). Edges are sampled once for all their faces, so that there are no cracks.
 *
 * It holds memory of the core: `dispose` frees it at once; one that is no longer referred to is freed in time. Crashes are as
 * for `PolygonSession`.
 */
export class TrimmedModel extends Trimmed {
  /**
   * @throws SoapfilmError `not-loaded` if the part 'surfaces' is not; of a face with a fault its code, and `face`, `loop`, `use`,
   *   `otherLoop`, `edge` where they apply: `bad-model` for what is not as `Model` says, `bad-knots`, `bad-weights`,
   *   `not-finite`, `bad-edge`, `bad-domain`, `trim-outside`, `trim-open`, `edge-apart`, `trim-self-intersects`,
   *   `trims-cross`, `hole-outside`, `degenerate`; `bad-option`; `too-large`, `out-of-memory`; `crashed`
   */
  constructor(model: Model, options: TrimmedOptions = {}) {
    super(() => flattenModel(model), options);
  }
}

/** One trimmed surface: as a `TrimmedModel` of a single face. */
export class TrimmedSurface extends Trimmed {
  /** @throws SoapfilmError those of `TrimmedModel`; `face` is 0 */
  constructor(face: Face, options: TrimmedOptions = {}) {
    super(() => flattenFace(face), options);
  }
}
