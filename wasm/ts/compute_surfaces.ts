// A model that stays in the core while it is tessellated, once the arguments are checked. Threads need only this half.
import {
  kFaceFaultLength,
  packSamplingSettings,
  readFaceFault,
  readSurfacesArrays,
  readTessellationArrays,
  type TessellationArrays,
} from './border.js';
import { fractionsFor } from './compute_holes.js';
import type { SoapfilmError } from './errors.js';
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

/** The core's half of a model. It is freed when it is garbage. */
export class ModelKeeper {
  readonly opened: OpenedModel;
  readonly #session: Session;

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
    return this.#session.call('sf_tessellate_surfaces', args, readTessellationArrays, { onProgress: fractionsFor(onProgress) });
  }

  dispose(): void {
    this.#session.dispose();
  }
}
