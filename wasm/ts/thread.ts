// Threads as the pool sees them: Web Workers, which `node_host.ts` replaces by Node's threads.

export interface Thread {
  post(message: unknown, transfer: ArrayBuffer[]): void;
  terminate(): void;
  /** Sets whether the thread keeps the process alive; does nothing in a browser. */
  keepAlive(yes: boolean): void;
}

export interface ThreadListener {
  message(data: unknown): void;
  /** Called when the thread can no longer be used. */
  failed(cause: Error): void;
}

/** Starts `worker_thread.ts` from its file, or from its text if that is given as `script`. */
export type ThreadStarter = (listener: ThreadListener, script?: string) => Thread;

let starter: ThreadStarter = startWorker;

export function startThread(listener: ThreadListener, script?: string): Thread {
  return starter(listener, script);
}

export function setThreadStarter(other: ThreadStarter): void {
  starter = other;
}

function startWorker(listener: ThreadListener, script?: string): Thread {
  const worker =
    script === undefined
      ? // As one expression, since bundlers look for this form.
        new Worker(new URL('./worker_thread.js', import.meta.url), { type: 'module' })
      : startFromText(script);
  worker.onmessage = ({ data }) => {
    listener.message(data);
  };
  worker.onmessageerror = () => {
    listener.failed(new Error('a message of the worker cannot be read'));
  };
  worker.onerror = (event) => {
    event.preventDefault();
    listener.failed(new Error(event.message || 'the script of the worker cannot be loaded'));
  };
  return {
    post: (message, transfer) => {
      worker.postMessage(message, transfer);
    },
    terminate: () => {
      worker.terminate();
    },
    keepAlive: () => undefined,
  };
}

function startFromText(script: string): Worker {
  const url = URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
  const worker = new Worker(url, { type: 'module' });
  for (const event of ['message', 'error']) {
    worker.addEventListener(
      event,
      () => {
        URL.revokeObjectURL(url);
      },
      { once: true },
    );
  }
  return worker;
}
