// Threads, the calls that wait for them, and what happens to both when a call ends early.
import { SoapfilmError } from './errors.js';
import type { BareMesh } from './compute_holes.js';
import type { NamedModel } from './compute_surfaces.js';
import type { Launcher } from './launch.js';
import { buffersOf, copyOf, unpackError, type Calls, type Reply, type Request } from './protocol.js';
import { report } from './report.js';
import type { Thread } from './thread.js';
import type { ProgressListener } from './types.js';

/** The listeners of a call, and what may end it early. */
export interface CallWatch {
  readonly signal?: AbortSignal | undefined;
  readonly onProgress?: ProgressListener | undefined;
  /** Called with each better result while the call runs. */
  readonly onBest?: ((value: unknown) => void) | undefined;
  /** Whether a call that the signal ends returns the latest better result, if there is one. */
  readonly keepsBest?: boolean | undefined;
  /** The mesh or model that the call is about: the input is its name, and a copy goes to a thread that has not got it. */
  readonly mesh?: PooledMesh | undefined;
}

/** A mesh or model that threads keep open between calls. */
export interface PooledMesh {
  readonly name: number;
  /** Whether nobody needs it any more, once the calls under way are done. */
  isClosed: boolean;
  readonly copy: () => BareMesh | NonNullable<NamedModel['mesh']>;
}

interface Job {
  readonly request: Request & { readonly kind: 'call' };
  readonly watch: CallWatch;
  /** The latest better result. */
  best?: unknown;
  /** What a listener has thrown. */
  thrown?: { readonly reason: unknown };
  readonly resolve: (value: unknown) => void;
  readonly reject: (reason: unknown) => void;
}

/** A thread that has started, and its call. */
interface Member {
  readonly thread: Thread;
  job: Job | undefined;
  /** The mesh that it has open. */
  mesh?: number | undefined;
}

export class Pool {
  readonly launcher: Launcher;
  /** How many threads there may be for calls, and again for sessions. */
  readonly size: number;
  /** What ends with the pool. */
  readonly guests = new Set<{ readonly dispose: () => void }>();
  readonly #members = new Set<Member>();
  readonly #queue: Job[] = [];
  #starting = 0;
  #disposed = false;

  constructor(launcher: Launcher, size: number) {
    this.launcher = launcher;
    this.size = size;
  }

  /**
   * Runs one function in a thread. The buffers of its input are transferred, so nobody else may use them.
   * @throws SoapfilmError those of the function; `cancelled`, `disposed`, `crashed`; `load-failed` if no
   *   thread can be started. Also what a listener throws: it ends the work, or is reported if the work is
   *   done by then
   */
  call<N extends keyof Calls>(
    name: N,
    input: Parameters<Calls[N]>,
    watch: CallWatch,
  ): Promise<ReturnType<Calls[N]>> {
    const { signal, onProgress, keepsBest = false } = watch;
    return new Promise((resolve, reject) => {
      if (this.#disposed) throw disposed();
      if (signal?.aborted) throw cancelled(signal);
      const abort = (): void => {
        if (!signal) return;
        if (job.best !== undefined) job.resolve(job.best);
        this.#drop(job, cancelled(signal));
      };
      const ended = (): void => {
        signal?.removeEventListener('abort', abort);
      };
      const job: Job = {
        request: {
          kind: 'call',
          name,
          input,
          progress: onProgress !== undefined,
          results: keepsBest,
        },
        watch,
        resolve: (value) => {
          ended();
          resolve(value as ReturnType<Calls[N]>);
        },
        reject: (reason) => {
          ended();
          // eslint-disable-next-line @typescript-eslint/prefer-promise-reject-errors -- thrown on as it is
          reject(reason);
        },
      };
      signal?.addEventListener('abort', abort);
      this.#queue.push(job);
      this.#pump();
    });
  }

  /** Closes a mesh where it is open, and where calls that wait will have opened it. */
  forget(mesh: PooledMesh): void {
    mesh.isClosed = true;
    for (const member of this.#members) this.#close(member, mesh);
  }

  #close(member: Member, { name }: PooledMesh): void {
    if (member.mesh !== name) return;
    member.mesh = undefined;
    member.thread.post({ kind: 'forget', name }, []);
  }

  dispose(): void {
    this.#disposed = true;
    const jobs = [...this.#members].flatMap(({ job }) => job ?? []).concat(this.#queue.splice(0));
    for (const member of [...this.#members]) this.#end(member);
    for (const job of jobs) job.reject(disposed());
    for (const guest of this.guests) guest.dispose();
  }

  /** Hands waiting calls to free threads, and starts threads for the rest. */
  #pump(): void {
    const free = new Set([...this.#members].filter(({ job }) => !job));
    while (free.size > 0 && this.#queue.length > 0) {
      const job = this.#queue.shift() as Job;
      // One that has the mesh of the call, or none that another call may come for.
      const lacking = ({ mesh }: Member): number => (mesh === job.watch.mesh?.name ? 0 : mesh === undefined ? 1 : 2);
      const [member] = [...free].sort((a, b) => lacking(a) - lacking(b));
      free.delete(member);
      this.#assign(member, job);
    }
    while (this.#starting < this.#queue.length && this.#members.size + this.#starting < this.size) {
      this.start().catch(() => undefined);
    }
  }

  #assign(member: Member, job: Job): void {
    member.job = job;
    member.thread.keepAlive(true);
    try {
      const request = requestFor(member, job);
      member.thread.post(request, buffersOf(request.input));
      member.mesh = job.watch.mesh?.name ?? member.mesh;
    } catch (cause) {
      this.#release(member);
      job.reject(
        new SoapfilmError('out-of-memory', 'The input cannot be handed to a worker', undefined, { cause }),
      );
    }
  }

  #release(member: Member): void {
    member.job = undefined;
    member.thread.keepAlive(false);
    this.#pump();
  }

  #end(member: Member): void {
    member.thread.terminate();
    member.job = undefined;
    this.#members.delete(member);
  }

  /** Ends a call that waits or runs. A running one takes its thread with it, and a new thread starts. */
  #drop(job: Job, reason: unknown): void {
    const index = this.#queue.indexOf(job);
    if (index >= 0) this.#queue.splice(index, 1);
    for (const member of [...this.#members]) {
      if (member.job !== job) continue;
      this.#end(member);
      // Starts now, so that the next call need not wait for it.
      this.start().catch(() => undefined);
    }
    job.reject(reason);
  }

  /**
   * Starts one more thread and gives it work. If that fails and there is no other thread, the waiting
   * calls fail too.
   * @throws SoapfilmError `load-failed`, `disposed`
   */
  async start(): Promise<void> {
    this.#starting++;
    let member: Member | undefined = undefined;
    let thread: Thread;
    try {
      thread = await this.launcher.launch({
        hear: (reply) => {
          if (member?.job) this.#hear(member, member.job, reply);
        },
        failed: (cause) => {
          if (!member) return;
          const { job } = member;
          this.#end(member);
          job?.reject(new SoapfilmError('crashed', `The worker failed: ${cause.message}`, undefined, { cause }));
          this.#pump();
        },
      });
    } catch (error) {
      if (this.#members.size === 0 && this.#starting === 1) {
        for (const job of this.#queue.splice(0)) job.reject(error);
      }
      throw error;
    } finally {
      this.#starting--;
    }
    if (this.#disposed) {
      thread.terminate();
      throw disposed();
    }
    member = { thread, job: undefined };
    this.#members.add(member);
    this.#release(member);
  }

  /** Calls a listener. If it throws, the call ends, unless its result is already on the way here. */
  #tell(job: Job, listener: () => void): void {
    if (job.thrown) return;
    try {
      listener();
    } catch (reason) {
      job.thrown = { reason };
      setTimeout(() => {
        this.#drop(job, reason);
      });
    }
  }

  #hear(member: Member, job: Job, reply: Reply): void {
    switch (reply.kind) {
      case 'progress':
        this.#tell(job, () => job.watch.onProgress?.(...reply.values));
        break;
      case 'best':
        job.best = reply.value;
        this.#tell(job, () => job.watch.onBest?.(copyOf(reply.value)));
        break;
      case 'done':
        job.resolve(reply.value);
        if (job.watch.mesh?.isClosed) this.#close(member, job.watch.mesh);
        if (job.thrown) report(job.thrown.reason);
        this.#release(member);
        break;
      case 'error':
        // The thread has closed it.
        if (job.watch.mesh) member.mesh = undefined;
        job.reject(job.thrown ? job.thrown.reason : unpackError(reply.error));
        this.#release(member);
        break;
    }
  }
}

/** The call's request, with its mesh if the thread has not got that. */
function requestFor({ mesh: open }: Member, { request, watch: { mesh } }: Job): Job['request'] {
  if (!mesh || mesh.name === open) return request;
  const named = { name: mesh.name, mesh: mesh.copy() };
  return { ...request, input: [named, request.input[1]] as Job['request']['input'] };
}

export const disposed = (): SoapfilmError =>
  new SoapfilmError('disposed', 'The worker pool has been disposed of');

export const cancelled = (signal: AbortSignal): SoapfilmError =>
  new SoapfilmError('cancelled', 'The work was cancelled', undefined, { cause: signal.reason });
