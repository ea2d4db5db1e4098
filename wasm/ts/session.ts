// Sessions: what stays in the core between calls. Each has an instance of its own while there are enough, so
// that a crash of one does not harm the others. It is freed when it is disposed of, or no longer referred to.
import type { ArrayReader } from './border.js';
import { SoapfilmError } from './errors.js';
import { callCore, Home, start, type CoreArgument, type Watch } from './runtime.js';
import { lostWith, newSessionId, sessionDisposed } from './session_id.js';
import type { Part } from './types.js';

/**
 * How many instances of a part sessions may have. One takes about 100 KiB, and a millisecond to make. It also
 * takes 8 GiB or more of address space. Some engines have enough for a hundred instances, others for some
 * thousands.
 */
const kMostRooms = 32;

/** An instance, and the sessions in it by their ids. */
class Room extends Home {
  readonly tenants = new Set<number>();
  /** The session whose call trapped. */
  culprit?: number;
}

const roomsOf: Readonly<Record<Part, Set<Room>>> = {
  loops: new Set(),
  polygons: new Set(),
  meshes: new Set(),
  surfaces: new Set(),
};

/** The room for a new session: a new room, or if there can be no more, the one with the fewest sessions. */
function roomFor(part: Part): Room {
  const rooms = roomsOf[part];
  if (rooms.size < kMostRooms) {
    const room = new Room(part);
    try {
      // The first room starts at its first call, and that throws if it cannot: there is no other room to use.
      if (rooms.size > 0) start(room);
      rooms.add(room);
      return room;
    } catch (error) {
      if (error instanceof SoapfilmError) throw error;
    }
  }
  return [...rooms].reduce((a, b) => (b.tenants.size < a.tenants.size ? b : a));
}

const forgotten = new FinalizationRegistry<Session>((session) => {
  try {
    session.dispose();
  } catch {
    // A crash. The sessions that it lost throw when they are used.
  }
});

/** A session as the core knows it: a number in one instance. */
export class Session {
  /** The number by which errors name it. */
  readonly id: number;
  readonly #room: Room;
  readonly #close: string;
  #number: number | undefined;

  /** @param close the export that ends a session, given its number */
  constructor(part: Part, close: string, id = newSessionId()) {
    this.id = id;
    this.#close = close;
    this.#room = roomFor(part);
    this.#room.tenants.add(this.id);
  }

  /**
   * Opens the session by a call of the core.
   * @param owner the session is freed when this is garbage; `read` and `numberOf` must not refer to it
   * @throws SoapfilmError those of `call`; the session can then not be used
   */
  open<T>(
    owner: object,
    name: string,
    args: readonly CoreArgument[],
    read: (array: ArrayReader) => T,
    numberOf: (arrays: T) => number,
    watch?: Watch<T>,
  ): T {
    try {
      const arrays = this.call(name, args, read, watch);
      this.#number = numberOf(arrays);
      forgotten.register(owner, this, this);
      return arrays;
    } catch (error) {
      this.#leave();
      throw error;
    }
  }

  /**
   * Its number in the core.
   * @throws SoapfilmError `disposed`; `crashed` if it is lost
   */
  alive(): number {
    if (this.#number === undefined) throw sessionDisposed(this.id);
    const { lost, culprit } = this.#room;
    if (!lost) return this.#number;
    const whose = culprit === this.id ? 'it' : `session ${String(culprit)}, which shared its memory,`;
    throw new SoapfilmError('crashed', `Session ${this.id} was lost when ${whose} crashed`);
  }

  /**
   * The arrays of a call in the session's instance.
   * @throws SoapfilmError those of `callCore`; one that ends the instance names all sessions that are lost
   */
  call<T>(
    name: string,
    args: readonly CoreArgument[],
    read: (array: ArrayReader) => T,
    watch?: Watch<T>,
  ): T {
    try {
      return callCore(this.#room, name, args, read, watch).arrays;
    } catch (error) {
      if (this.#room.lost && error instanceof SoapfilmError) throw this.#lose(error);
      throw error;
    }
  }

  /** Frees its memory in the core, once. */
  dispose(): void {
    if (this.#number === undefined) return;
    const { lost, tenants } = this.#room;
    // An instance's memory never shrinks, so the last session drops its instance.
    if (!lost && tenants.size > 1) this.call(this.#close, [this.#number], () => undefined);
    this.#number = undefined;
    forgotten.unregister(this);
    this.#leave();
  }

  #leave(): void {
    this.#room.tenants.delete(this.id);
    if (this.#room.tenants.size === 0) roomsOf[this.#room.part].delete(this.#room);
  }

  #lose({ code, message, cause }: SoapfilmError): SoapfilmError {
    roomsOf[this.#room.part].delete(this.#room);
    this.#room.culprit ??= this.id;
    const lost = lostWith(this.id, this.#room.tenants, 'memory');
    return new SoapfilmError(code, message + lost, undefined, { cause });
  }
}
