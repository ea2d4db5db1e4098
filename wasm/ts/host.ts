// What the library needs of its surroundings. Browsers are the default; `node_host.ts` is Node's.

/** A thread that runs `worker_thread.ts`. */
export interface Thread {
  post(message: unknown, transfer: ArrayBuffer[]): void;
  terminate(): void;
  /** Whether the thread is a reason for the process to stay alive; nothing in a browser. */
  keepAlive(yes: boolean): void;
}

/** How a thread reports: its messages, and that it has broken down for good. */
export interface ThreadListener {
  message(data: unknown): void;
  failed(cause: unknown): void;
}

export interface Host {
  /** The bytes of the file at a URL, or a path where the surroundings have paths. */
  read(source: URL | string): Promise<Response | BufferSource>;
  /** Starts the thread; `source` is its script as text, to be used where files fail. */
  startThread(listener: ThreadListener, source?: string): Thread;
}

/** Where a browser finds the thread's script; written out in full so that bundlers see it. */
const startWorker = (): Worker =>
  new Worker(new URL('./worker_thread.js', import.meta.url), { type: 'module' });

function startFromText(source: string): Worker {
  const url = URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
  try {
    return new Worker(url, { type: 'module' });
  } finally {
    URL.revokeObjectURL(url);
  }
}

const browser: Host = {
  read: (source) => fetch(source),
  startThread(listener, source) {
    const worker = source === undefined ? startWorker() : startFromText(source);
    worker.onmessage = ({ data }) => {
      listener.message(data);
    };
    worker.onmessageerror = (event) => {
      listener.failed(event);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      listener.failed(event.message || event);
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
  },
};

let current = browser;

export function host(): Host {
  return current;
}

/** Replaces the browser's way of doing things. */
export function setHost(other: Host): void {
  current = other;
}
