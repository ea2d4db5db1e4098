// Sessions in threads: which thread each lives in, what is asked of it there, and which are lost if it fails. The
// same for all kinds of session. These threads do no other calls: a call that is cancelled ends its thread.
import { SoapfilmError } from './errors.js';
import { cancelled, disposed, type Pool } from './pool.js';
import { buffersOf, unpackError, type Reply, type Resident, type SessionKinds, type SessionRequest } from './protocol.js';
import { lostWith, newSessionId, sessionDisposed } from './session_id.js';
import type { Thread } from './thread.js';

/** A thread without sessions ends after this time. Not at once: sessions may follow each other. */
const kIdleMs = 1000;

/** Who waits for an answer. */
interface Asker {
  readonly id: number;
  readonly resolve: (value: unknown) => void;
  readonly reject: (reason: unknown) => void;
}

/** A thread, the sessions in it, and what they wait for. */
class Host {
  readonly tenants = new Set<number>();
  /** The error of every later use. */
  gone?: (id: number) => SoapfilmError;
  readonly #hosts: Set<Host>;
  readonly #askers = new Map<number, Asker>();
  /** What is asked before the thread has started. */
  #waiting: SessionRequest[] = [];
  #thread: Thread | undefined;
  #calls = 0;
  #idle?: ReturnType<typeof setTimeout>;

  /** @param hosts has this one in it as long as it can be used */
  constructor(pool: Pool, hosts: Set<Host>) {
    this.#hosts = hosts;
    hosts.add(this);
    void this.#start(pool);
  }

  async #start(pool: Pool): Promise<void> {
    try {
      const thread = await pool.launcher.launch({
        hear: (reply) => {
          this.#hear(reply);
        },
        failed: (cause) => {
          const lost = (id: number): string => lostWith(id, this.tenants, 'thread');
          this.end(
            (id) => new SoapfilmError('crashed', `The worker failed: ${cause.message}${lost(id)}`, undefined, { cause }),
            (id) => new SoapfilmError('crashed', `Session ${id} was lost when its thread failed`),
          );
        },
      });
      if (this.gone) {
        thread.terminate();
        return;
      }
      this.#thread = thread;
      for (const request of this.#waiting.splice(0)) this.#post(request);
      this.#settle();
    } catch (error) {
      this.end(() => error);
    }
  }

  /** Asks something of the session of that id. The buffers of the input are transferred. */
  ask(id: number, request: Pick<SessionRequest, 'opens' | 'method' | 'input'>): Promise<unknown> {
    clearTimeout(this.#idle);
    return new Promise((resolve, reject) => {
      const call = ++this.#calls;
      this.#askers.set(call, { id, resolve, reject });
      this.#thread?.keepAlive(true);
      this.#post({ kind: 'session', call, id, ...request });
    });
  }

  /** Ends a session: at once for this side, and in the thread after all that was asked before. */
  leave(id: number): void {
    this.tenants.delete(id);
    if (this.#thread) this.#post({ kind: 'session', call: 0, id, method: 'dispose', input: [] });
    // Not even open yet.
    for (const { call } of this.#waiting.filter((request) => request.id === id)) this.#askers.delete(call);
    this.#waiting = this.#waiting.filter((request) => request.id !== id);
    this.#settle();
  }

  /**
   * Ends the thread. What waits for an answer is rejected.
   * @param later the error of later uses, if it is another one
   */
  end(reason: (id: number) => unknown, later = reason as (id: number) => SoapfilmError): void {
    this.gone = later;
    this.#hosts.delete(this);
    clearTimeout(this.#idle);
    this.#thread?.terminate();
    this.#thread = undefined;
    for (const { id, reject } of this.#askers.values()) reject(reason(id));
    this.#askers.clear();
  }

  #post(request: SessionRequest): void {
    if (!this.#thread) {
      this.#waiting.push(request);
      return;
    }
    try {
      this.#thread.post(request, buffersOf(request.input));
    } catch (cause) {
      const text = 'The input cannot be handed to a worker';
      this.#take(request.call)?.reject(new SoapfilmError('out-of-memory', text, undefined, { cause }));
    }
  }

  #hear(reply: Reply): void {
    if (reply.kind !== 'done' && reply.kind !== 'error') return;
    const asker = this.#take(reply.call as number);
    if (reply.kind === 'done') asker?.resolve(reply.value);
    else asker?.reject(unpackError(reply.error));
  }

  #take(call: number): Asker | undefined {
    const asker = this.#askers.get(call);
    this.#askers.delete(call);
    this.#settle();
    return asker;
  }

  /** Lets the process end while nothing is under way, and the thread when it has no sessions for a while. */
  #settle(): void {
    clearTimeout(this.#idle);
    if (!this.#thread || this.#askers.size > 0) return;
    this.#thread.keepAlive(false);
    if (this.tenants.size > 0) return;
    this.#idle = setTimeout(() => {
      this.end(sessionDisposed);
    }, kIdleMs);
    (this.#idle as { unref?: () => void }).unref?.();
  }
}

/** The methods of a kind of session that give plain data. */
type Methods<S> = { readonly [N in keyof S as S[N] extends (...args: never[]) => object ? N : never]: S[N] };

/** A session in a thread, as this side knows it. */
export class RemoteSession<S extends Resident> {
  readonly id = newSessionId();
  readonly #host: Host;
  #disposed = false;

  constructor(host: Host) {
    this.#host = host;
    host.tenants.add(this.id);
  }

  /** @throws SoapfilmError `disposed`, `crashed` if the session cannot be used any more */
  alive(): void {
    if (this.#disposed) throw sessionDisposed(this.id);
    if (this.#host.gone) throw this.#host.gone(this.id);
  }

  /**
   * Calls a method in the thread, after all that was called before. Its arguments' buffers are transferred.
   * @returns what the method returns; `errors` in it are plain data still
   * @throws SoapfilmError those of the method; `disposed`, `crashed`
   */
  async call<N extends keyof Methods<S>>(
    method: N,
    ...input: Methods<S>[N] extends (...args: infer A) => unknown ? A : never
  ): Promise<Methods<S>[N] extends (...args: never[]) => infer R ? R : never> {
    this.alive();
    return (await this.#host.ask(this.id, { method: method as string, input })) as never;
  }

  /** Frees it in the thread. Calls before still get their answers. */
  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    this.#host.leave(this.id);
  }
}

type Opened<K extends keyof SessionKinds> = InstanceType<SessionKinds[K]>;

/** The threads for sessions of a pool, which end with it. */
export class SessionThreads {
  readonly #pool: Pool;
  readonly #hosts = new Set<Host>();
  readonly #forgotten = new FinalizationRegistry<RemoteSession<Resident>>((session) => {
    session.dispose();
  });
  #disposed = false;

  constructor(pool: Pool) {
    this.#pool = pool;
    pool.guests.add(this);
  }

  /**
   * Opens a session in the thread that has the fewest.
   * @param input checked; its buffers are transferred
   * @throws SoapfilmError those of the kind; `cancelled`, `disposed`, `crashed`, `load-failed`
   */
  open<K extends keyof SessionKinds>(
    kind: K,
    input: ConstructorParameters<SessionKinds[K]>[0],
    signal?: AbortSignal,
  ): Promise<RemoteSession<Opened<K>>> {
    return new Promise((resolve, reject) => {
      if (this.#disposed) throw disposed();
      if (signal?.aborted) throw cancelled(signal);
      const host = this.#hostForOne();
      const session = new RemoteSession<Opened<K>>(host);
      const abort = (): void => {
        session.dispose();
        reject(cancelled(signal as AbortSignal));
      };
      signal?.addEventListener('abort', abort, { once: true });
      host
        .ask(session.id, { opens: kind, input: [input] })
        .finally(() => signal?.removeEventListener('abort', abort))
        .then(
          () => {
            resolve(session);
          },
          (error: unknown) => {
            session.dispose();
            // eslint-disable-next-line @typescript-eslint/prefer-promise-reject-errors -- thrown on as it is
            reject(error);
          },
        );
    });
  }

  /** Frees the session when its owner is garbage; the session must not refer to it. */
  freeWith(owner: object, session: RemoteSession<Resident>): void {
    this.#forgotten.register(owner, session);
  }

  /** Ends all threads. What is under way and later uses fail with `disposed`. */
  dispose(): void {
    this.#disposed = true;
    for (const host of [...this.#hosts]) host.end(disposed);
  }

  #hostForOne(): Host {
    const hosts = [...this.#hosts].sort((a, b) => a.tenants.size - b.tenants.size);
    const [fewest] = hosts;
    const fits = hosts.length > 0 && (fewest.tenants.size === 0 || hosts.length >= this.#pool.size);
    return fits ? fewest : new Host(this.#pool, this.#hosts);
  }
}
