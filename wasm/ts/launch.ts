// Starting threads that have the core's parts.
import type { Modules } from './compile.js';
import { SoapfilmError } from './errors.js';
import { unpackError, type Reply, type Request } from './protocol.js';
import { startThread, type Thread, type ThreadListener } from './thread.js';

/** Hears of a thread that has started. */
export interface ReplyListener extends Pick<ThreadListener, 'failed'> {
  hear(reply: Reply): void;
}

export class Launcher {
  readonly #modules: Modules;
  /** The thread's script as text, once its file has failed. */
  #script: string | undefined;

  constructor(modules: Modules) {
    this.#modules = modules;
  }

  /**
   * Starts a thread, from its file, or if that fails, from the copy within the library, and waits until it is
   * ready. It keeps the process alive.
   * @throws SoapfilmError `load-failed`
   */
  async launch(listener: ReplyListener): Promise<Thread> {
    try {
      return await this.#launchSomehow(listener);
    } catch (cause) {
      if (cause instanceof SoapfilmError) throw cause;
      const text = `No worker can be started: ${String(cause)}`;
      throw new SoapfilmError('load-failed', text, undefined, { cause });
    }
  }

  async #launchSomehow(listener: ReplyListener): Promise<Thread> {
    if (this.#script !== undefined) return this.#launch(listener, this.#script);
    try {
      return await this.#launch(listener);
    } catch (cause) {
      if (cause instanceof SoapfilmError) throw cause;
      // Bundlers may lose the file, and browsers refuse one from another origin.
      const { default: script } = await import('./worker_thread_inline.js').catch(() => {
        throw cause;
      });
      const thread = await this.#launch(listener, script);
      this.#script = script;
      return thread;
    }
  }

  #launch(listener: ReplyListener, script?: string): Promise<Thread> {
    return new Promise((resolve, reject) => {
      let ready = false;
      const fail = (cause: Error): void => {
        thread.terminate();
        if (ready) listener.failed(cause);
        else reject(cause);
      };
      const thread = startThread(
        {
          message: (data) => {
            const reply = data as Reply;
            if (ready) listener.hear(reply);
            else if (reply.kind === 'error') fail(unpackError(reply.error));
            else {
              ready = true;
              resolve(thread);
            }
          },
          failed: fail,
        },
        script,
      );
      const request: Request = { kind: 'start', modules: this.#modules };
      thread.post(request, []);
    });
  }
}
