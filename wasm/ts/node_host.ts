// Node's files and threads.
import { readFile } from 'node:fs/promises';
import { Worker } from 'node:worker_threads';
import { setReader } from './host.js';
import { setThreadStarter } from './thread.js';

setReader((source) => {
  const url = source instanceof URL || /^[a-z][a-z\d+.-]+:/i.test(source) ? new URL(source) : null;
  return url && url.protocol !== 'file:' ? fetch(url) : readFile(url ?? source);
});

/** Gives a script for browsers the port that it expects. */
const kPrelude = "globalThis.self = require('node:worker_threads').parentPort;\n";

setThreadStarter((listener, script) => {
  // Flags of this process, such as `--input-type`, are not for the thread.
  const execArgv: string[] = [];
  const worker =
    script === undefined
      ? new Worker(new URL('./worker_thread_node.js', import.meta.url), { execArgv })
      : new Worker(kPrelude + script, { eval: true, execArgv });
  let ended = false;
  const failed = (cause: Error): void => {
    if (!ended) listener.failed(cause);
    ended = true;
  };
  worker.on('message', (data: unknown) => {
    listener.message(data);
  });
  worker.on('messageerror', failed);
  worker.on('error', failed);
  worker.on('exit', (code) => {
    failed(new Error(`the thread ended with code ${code}`));
  });
  return {
    post: (message, transfer) => {
      worker.postMessage(message, transfer);
    },
    terminate: () => {
      ended = true;
      void worker.terminate();
    },
    keepAlive: (yes) => {
      if (yes) worker.ref();
      else worker.unref();
    },
  };
});
