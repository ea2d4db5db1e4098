// A polygon that stays in the core while it is edited, once the arguments are checked. Threads need only this
// half.
import {
  kEditFactsLength,
  readEditArrays,
  readEditFacts,
  readOpenedArrays,
  readStateArrays,
  Status,
} from './border.js';
import type { SoapfilmError } from './errors.js';
import { ringError } from './messages.js';
import { kDefaultMemoryBytes } from './runtime.js';
import { Session } from './session.js';
import type { PolygonEdit, PolygonState } from './types.js';

/** What a session begins with. */
export interface EditedPolygon {
  readonly positions: Float64Array;
  readonly ringStarts: Uint32Array;
  readonly points?: Float64Array | undefined;
  readonly maxMemoryBytes?: number | undefined;
}

/** What comes of an edit. */
export interface EditAnswer {
  readonly edit?: PolygonEdit;
  /** Why it is refused, in the core's words; empty if it is not. */
  readonly errors: readonly SoapfilmError[];
}

const kWatch = { explain: ringError };

/** The core's half of a session. It is freed when it is garbage. */
export class PolygonEditor {
  readonly #session: Session;
  #triangles: Uint32Array;
  #count: number;
  /** Triangles that refused edits have changed. The next edit that succeeds names them. */
  readonly #untold = new Set<number>();

  constructor({ positions, ringStarts, points, maxMemoryBytes }: EditedPolygon, id?: number) {
    this.#session = new Session('polygons', 'sf_session_close', id);
    const { triangles } = this.#session.open(
      this,
      'sf_session_open',
      [
        positions,
        ringStarts,
        ringStarts.length - 1,
        points ?? null,
        points ? points.length / 2 : 0,
        maxMemoryBytes ?? kDefaultMemoryBytes,
      ],
      readOpenedArrays,
      ({ session }) => session[0],
      kWatch,
    );
    this.#triangles = triangles;
    this.#count = triangles.length;
  }

  get id(): number {
    return this.#session.id;
  }

  /**
   * Its number in the core.
   * @throws SoapfilmError `disposed`; `crashed` if it is lost
   */
  alive(): number {
    return this.#session.alive();
  }

  triangles(): Uint32Array {
    this.alive();
    return this.#triangles.slice(0, this.#count);
  }

  read(): PolygonState {
    const { certified, ...state } = this.#session.call('sf_session_read', [this.alive()], readStateArrays, kWatch);
    return { ...state, certified: certified[0] === 1 };
  }

  dispose(): void {
    this.#session.dispose();
  }

  /** @param action an index in `kEditActionChoices` */
  edit(action: number, vertex: number, x: number, y: number): EditAnswer {
    const args = [this.alive(), action, vertex, x, y];
    const { edit } = this.#session.call('sf_session_edit', args, readEditArrays, kWatch);
    const facts = readEditFacts(edit);
    const { triangleCount, status } = facts;
    const count = (edit.length - kEditFactsLength) / 4;
    // Views of one buffer that nothing else uses: copies would take a tenth of the time of an edit.
    let changed = edit.subarray(kEditFactsLength, kEditFactsLength + count);
    let triangles = edit.subarray(kEditFactsLength + count);
    this.#count = 3 * triangleCount;
    if (this.#triangles.length < this.#count) {
      const larger = new Uint32Array(2 * this.#count);
      larger.set(this.#triangles);
      this.#triangles = larger;
    }
    for (let i = 0; i < count; i++) {
      const t = changed[i];
      for (let k = 0; k < 3; k++) this.#triangles[3 * t + k] = triangles[3 * i + k];
      if (status !== Status.Ok) this.#untold.add(t);
    }
    if (status !== Status.Ok) {
      return { errors: [ringError(status, { ...facts, vertex: facts.atVertex })] };
    }
    if (this.#untold.size > 0) {
      const names = new Set([...this.#untold, ...changed]);
      changed = Uint32Array.from(names)
        .filter((t) => t < triangleCount)
        .sort();
      triangles = new Uint32Array(3 * changed.length);
      let at = 0;
      for (const t of changed) for (let k = 0; k < 3; k++) triangles[at++] = this.#triangles[3 * t + k];
      this.#untold.clear();
    }
    return { edit: { vertex: facts.vertex, triangleCount, changed, triangles }, errors: [] };
  }
}
