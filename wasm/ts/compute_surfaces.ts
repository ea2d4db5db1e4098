// A model that stays in the core while it is tessellated, once the arguments are checked. Threads need only this half.
import {
  kFaceFaultLength,
  packSamplingSettings,
  readChangeArrays,
  readFaceFault,
  readMoveArrays,
  readSurfacesArrays,
  readTessellationArrays,
  type ChangeArrays,
  type TessellationArrays,
} from './border.js';
import { fractionsFor } from './compute_holes.js';
import type { SoapfilmError } from './errors.js';
import type { Limits } from './options.js';
import { kDefaultMemoryBytes } from './runtime.js';
import { MeshPatches } from './mesh_patches.js';
import { Session } from './session.js';
import { faceFaultError } from './surface_faults.js';

/** A model for the core. */
export interface BareModel {
  readonly shape: Uint32Array;
  readonly numbers: Float64Array;
}

/** Settings as the core takes them, and the limits. */
export interface TessellationWork extends Pick<Limits, 'maxMemoryBytes'> {
  readonly settings: Parameters<typeof packSamplingSettings>[0];
  readonly onProgress?: ((fraction: number) => void) | undefined;
}

/** What is known of a model once it is open. */
export interface OpenedModel {
  /** `[6]` least and greatest corner. */
  readonly box: Float64Array;
  /** Those of faces that are left out, in order. */
  readonly errors: readonly SoapfilmError[];
}

/** A mesh after an update, and where it was written. */
export interface UpdatedMesh extends Pick<ChangeArrays, 'vertexRanges' | 'indexRanges' | 'stripRanges' | 'faces'> {
  readonly mesh: TessellationArrays;
}

const copiesOf = <K extends string>(arrays: Readonly<Record<K, Uint32Array | Float64Array>>): Record<K, Uint32Array & Float64Array> =>
  Object.fromEntries(Object.entries<Uint32Array | Float64Array>(arrays).map(([name, array]) => [name, array.slice()])) as Record<
    K,
    Uint32Array & Float64Array
  >;

/** The core's half of a model. It is freed when it is garbage. */
export class ModelKeeper {
  readonly opened: OpenedModel;
  readonly #session: Session;
  readonly #patches = new MeshPatches();

  constructor({ shape, numbers }: BareModel, { maxMemoryBytes = kDefaultMemoryBytes }: Pick<Limits, 'maxMemoryBytes'>, id?: number) {
    this.#session = new Session('surfaces', 'sf_close_surfaces', id);
    const args = [shape, shape.length, numbers, numbers.length, maxMemoryBytes];
    const { faults, box } = this.#session.open(this, 'sf_open_surfaces', args, readSurfacesArrays, ({ session }) => session[0]);
    const errors: SoapfilmError[] = [];
    for (let at = 0; at < faults.length; at += kFaceFaultLength) errors.push(faceFaultError(readFaceFault(faults, at)));
    this.opened = { box, errors };
  }

  get id(): number {
    return this.#session.id;
  }

  /** @throws SoapfilmError `disposed`; `crashed` if it is lost */
  alive(): number {
    return this.#session.alive();
  }

  tessellate({ settings, maxMemoryBytes = kDefaultMemoryBytes, onProgress }: TessellationWork): TessellationArrays {
    const args = [this.alive(), packSamplingSettings(settings), maxMemoryBytes];
    const mesh = this.#session.call('sf_tessellate_surfaces', args, readTessellationArrays, { onProgress: fractionsFor(onProgress) });
    this.#patches.lend(mesh);
    return mesh;
  }

  update({ settings, maxMemoryBytes = kDefaultMemoryBytes, onProgress }: TessellationWork): UpdatedMesh {
    const args = [this.alive(), packSamplingSettings(settings), maxMemoryBytes];
    const watch = { onProgress: fractionsFor(onProgress), borrows: true };
    const change = this.#session.call('sf_update_surfaces', args, readChangeArrays, watch);
    const blocks = this.#patches.apply(change);
    // The others are views of the core's memory, soon to be void.
    const { vertexRanges, indexRanges, stripRanges, faces, faceStarts, stripStarts, edges, edgeStarts, same, reports, numbers } = change;
    const own = { faceStarts, stripStarts, edges, edgeStarts, same, reports };
    const mesh = { ...copiesOf(own), ...blocks, numbers: numbers.slice() };
    return { mesh, ...copiesOf({ vertexRanges, indexRanges, stripRanges, faces }) };
  }

  /** Moves a pole of a surface. @throws SoapfilmError why it is refused */
  movePole(face: number, pole: number, at: readonly number[], weight = 0): void {
    this.#move('sf_move_pole', [face, pole, ...at, weight]);
  }

  /** Moves a pole of a trimming curve. @throws SoapfilmError why it is refused */
  moveTrim(face: number, loop: number, use: number, pole: number, at: readonly number[]): void {
    this.#move('sf_move_trim', [face, loop, use, pole, ...at]);
  }

  #move(name: string, args: readonly number[]): void {
    const { faults } = this.#session.call(name, [this.alive(), ...args, kDefaultMemoryBytes], readMoveArrays);
    if (faults.length > 0) throw faceFaultError(readFaceFault(faults, 0));
  }

  dispose(): void {
    this.#session.dispose();
  }
}
