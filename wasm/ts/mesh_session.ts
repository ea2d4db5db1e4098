/// <reference lib="esnext.disposable" preserve="true" />
// MeshSession: a mesh that stays in the core while its holes are filled.
import { optionsOf } from './check.js';
import { kDispose } from './dispose.js';
import { fillSteps, openSteps, type OpenHoles } from './hole_filling.js';
import { fillOptionsOf, flattenMesh, holeOptionsOf } from './hole_input.js';
import { passingPlace, sessionPlace } from './mesh_place.js';
import { kHoleOptions, kSessionFillOptions, limitsOf, type Limits } from './options.js';
import { copyOf } from './protocol.js';
import type { Session } from './session.js';
import { doAtOnce } from './steps.js';
import type { FillResult, HoleOptions, HoleReport, MeshInput, SessionFillOptions } from './types.js';

/**
 * A mesh that stays in the core while its holes are looked at, and filled one by one or again with other options. What
 * `fillHoles` does anew for the whole mesh at each call is done once here: a call then takes time for its holes alone,
 * and with `output: 'patches'` no copy of the mesh.
 *
 * No call changes the mesh: each fills holes of the mesh that was given. `weld` and `maxSeconds` of the options
 * are for the opening; `maxMemoryBytes` also for each call that does not say otherwise.
 *
 * Crashes and memory are as for `PolygonSession`.
 */
export class MeshSession {
  readonly #opened: OpenHoles;
  readonly #report: HoleReport;
  readonly #limits: Limits;
  readonly #session: Session;

  /** @throws SoapfilmError those of `findHoles` */
  constructor(mesh: MeshInput, options: HoleOptions = {}) {
    const flat = flattenMesh(mesh, true);
    const given = holeOptionsOf(optionsOf(options, kHoleOptions));
    const place = sessionPlace(this);
    this.#opened = doAtOnce(openSteps(place, flat, given, undefined, given.onProgress));
    this.#limits = limitsOf({ maxMemoryBytes: given.maxMemoryBytes });
    this.#session = place.session as Session;
    // A copy: what the caller does to it is no matter.
    this.#report = copyOf(this.#opened.report);
  }

  /** The number by which errors name the session, counted together with those of polygons. */
  get id(): number {
    return this.#session.id;
  }

  /** What `findHoles` finds. */
  get report(): HoleReport {
    this.#session.alive();
    return this.#report;
  }

  /** As `fillHoles` of the whole package. @throws SoapfilmError those of `fillHoles`; `disposed` */
  fillHoles(options: SessionFillOptions = {}): FillResult {
    this.#session.alive();
    const given = fillOptionsOf(optionsOf(options, kSessionFillOptions));
    return doAtOnce(fillSteps(passingPlace, this.#opened, { ...this.#limits, ...given }));
  }

  /** Frees the session's memory. Any other use of it afterwards throws `disposed`. */
  dispose(): void {
    this.#session.dispose();
  }

  [kDispose](): void {
    this.dispose();
  }
}
