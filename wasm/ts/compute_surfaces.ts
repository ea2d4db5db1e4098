// A model that stays in the core while it is tessellated, once the arguments are checked. Threads need only this half.
import {
  kFaceFaultLength,
  packSamplingSettings,
  readChangeArrays,
  readFaceFault,
  readMoveArrays,
  readSurfacesArrays,
  readTessellationArrays,
  Status,
  type ArrayReader,
  type ChangeArrays,
  type Place,
  type TessellationArrays,
} from './border.js';
import { fractionsFor } from './compute_holes.js';
import { SoapfilmError } from './errors.js';
import { statusError } from './messages.js';
import type { Limits } from './options.js';
import { kDefaultMemoryBytes } from './runtime.js';
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

/** A pole's move: of a surface, or of a trimming curve. */
export interface PoleMove {
  readonly kind: 'pole' | 'trim';
  /** As the export of that kind takes them. */
  readonly args: readonly number[];
}

/** The core's half of a model. It is freed when it is garbage. */
export class ModelKeeper {
  readonly opened: OpenedModel;
  readonly #session: Session;
  readonly #limit: number;

  constructor({ shape, numbers }: BareModel, { maxMemoryBytes = kDefaultMemoryBytes }: Pick<Limits, 'maxMemoryBytes'>, id?: number) {
    this.#session = new Session('surfaces', 'sf_close_surfaces', id);
    this.#limit = maxMemoryBytes;
    const args = [shape, shape.length, numbers, numbers.length, maxMemoryBytes];
    const { faults, box } = this.#session.open(this, 'sf_open_surfaces', args, readSurfacesArrays, ({ session }) => session[0]);
    this.opened = { box, errors: errorsOf(faults) };
  }

  get id(): number {
    return this.#session.id;
  }

  /** @throws SoapfilmError `disposed`; `crashed` if it is lost */
  alive(): number {
    return this.#session.alive();
  }

  tessellate(work: TessellationWork): TessellationArrays {
    return this.#mesh('sf_tessellate_surfaces', work, readTessellationArrays, false);
  }

  /** @param borrows whether the arrays may be views of the core's memory, valid until its next call */
  update(work: TessellationWork, borrows: boolean): ChangeArrays {
    return this.#mesh('sf_update_surfaces', work, readChangeArrays, borrows);
  }

  /** Moves a pole. `errors` say why it did not. @throws SoapfilmError `bad-option` if there is none of that number */
  move({ kind, args }: PoleMove): { readonly errors: readonly SoapfilmError[] } {
    const { faults } = this.#session.call(`sf_move_${kind}`, [this.alive(), ...args, this.#limit], readMoveArrays, { explain: moveError });
    return { errors: errorsOf(faults) };
  }

  #mesh<T>(
    name: string,
    { settings, maxMemoryBytes = this.#limit, onProgress }: TessellationWork,
    read: (array: ArrayReader) => T,
    borrows: boolean,
  ): T {
    const args = [this.alive(), packSamplingSettings(settings), maxMemoryBytes];
    return this.#session.call(name, args, read, { onProgress: fractionsFor(onProgress), borrows });
  }

  dispose(): void {
    this.#session.dispose();
  }
}

function errorsOf(faults: Uint32Array): SoapfilmError[] {
  const errors: SoapfilmError[] = [];
  for (let at = 0; at < faults.length; at += kFaceFaultLength) errors.push(faceFaultError(readFaceFault(faults, at)));
  return errors;
}

function moveError(status: number, where: Place): SoapfilmError {
  if (status !== Status.BadOption) return statusError(status, where);
  return new SoapfilmError('bad-option', 'There is no such pole in the model, or its face is left out');
}

/** A model for a thread, which may have it open under that name already. */
export interface NamedModel {
  readonly name: number;
  /** Left out if the thread has it. */
  readonly mesh?: BareModel & {
    readonly limits: Pick<Limits, 'maxMemoryBytes'>;
    /** What has been moved since the model was given. */
    readonly moves: readonly PoleMove[];
  };
}

/** The one model that this thread keeps open between calls. */
let kept: { readonly name: number; readonly keeper: ModelKeeper } | undefined;

/** Does something with a model that stays open in this thread; after an error none does. */
function withModel<T>({ name, mesh }: NamedModel, use: (keeper: ModelKeeper) => T): T {
  try {
    if (mesh) {
      kept?.keeper.dispose();
      kept = { name, keeper: new ModelKeeper(mesh, mesh.limits, name) };
      for (const move of mesh.moves) kept.keeper.move(move);
    }
    return use((kept as NonNullable<typeof kept>).keeper);
  } catch (error) {
    const left = kept;
    kept = undefined;
    left?.keeper.dispose();
    throw error;
  }
}

export const computeOpenModel = (model: NamedModel): OpenedModel => withModel(model, ({ opened }) => opened);

export const computeTessellation = (model: NamedModel, work: TessellationWork): TessellationArrays =>
  withModel(model, (keeper) => keeper.tessellate(work));

export const computeUpdate = (model: NamedModel, work: TessellationWork): ChangeArrays => withModel(model, (keeper) => keeper.update(work, false));

export const computeMove = (model: NamedModel, move: PoleMove): ReturnType<ModelKeeper['move']> => withModel(model, (keeper) => keeper.move(move));
