// Starting programs and saying what happens: what the other scripts share.
import { AsyncLocalStorage } from 'node:async_hooks';
import { spawn } from 'node:child_process';
import { availableParallelism } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { killTree, watch } from './watch.mjs';

/** The repository, and the folder of all build trees and stamps. */
export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
export const buildRoot = path.join(root, 'wasm/build');

export const jobs = Math.max(1, availableParallelism());

/** A failure that is explained by its message alone: shown without a stack. */
export class Failure extends Error {}

export function say(message) {
  process.stdout.write(`${message}\n`);
}

const running = new Set();
const meters = new AsyncLocalStorage();

/**
 * Runs `body` and counts the processor time of the programs that it runs with `capture`.
 * Resolves to { value, processor }: what it resolves to, and seconds.
 */
export async function metered(body) {
  const meter = { seconds: 0 };
  const value = await meters.run(meter, body);
  return { value, processor: meter.seconds };
}

/** A shell that runs the program in its arguments and reports the processor time of it and its children. */
const kMeasured = '"$@"; code=$?; times >&3; exit $code';

/** Seconds in what a shell's `times` prints of its children: minutes and seconds, user and system. */
function secondsOf(times) {
  const spans = (times.trim().split('\n')[1] ?? '').matchAll(/(\d+)m([\d.]+)s/g);
  return [...spans].reduce((sum, [, minutes, seconds]) => sum + 60 * Number(minutes) + Number(seconds), 0);
}

/**
 * Runs a program to its end; it dies with this process.
 *   options.capture  collect the output instead of passing it through
 *   options.allowFailure  resolve with the code instead of throwing a Failure
 *   options.watched  kill it, and what it has started, once it is stuck: limits as in watch.mjs
 *   options.processor  seconds of processor time after which each of its processes is ended
 * Resolves to { code, output }; code is 128 + n after signal n.
 */
export function run(command, args, options = {}) {
  const { capture = false, allowFailure = false, watched, processor, cwd = root, env = {} } = options;
  const meter = capture && process.platform !== 'win32' ? meters.getStore() : undefined;
  const limit = processor ? `ulimit -t ${processor}; ` : '';
  const line = meter ? ['sh', '-c', limit + kMeasured, 'sh', command, ...args] : [command, ...args];
  const pipe = capture ? 'pipe' : 'inherit';
  return new Promise((resolve, reject) => {
    const child = spawn(line[0], line.slice(1), {
      cwd,
      env: { ...process.env, ...env },
      stdio: ['ignore', pipe, pipe, ...(meter ? ['pipe'] : [])],
    });
    running.add(child);
    let [output, times] = ['', ''];
    const watcher = watched && child.pid && watch(child.pid, watched);
    const collect = (text) => {
      output += text;
      if (watcher) watcher.progress();
    };
    child.stdout?.setEncoding('utf8').on('data', collect);
    child.stderr?.setEncoding('utf8').on('data', collect);
    child.stdio[3]?.setEncoding('utf8').on('data', (text) => (times += text));
    child.on('error', (error) => {
      running.delete(child);
      if (watcher) watcher.end();
      if (allowFailure) resolve({ code: 127, output: `${output}${error.message}\n` });
      else reject(new Failure(`${command}: ${error.message}`));
    });
    child.on('close', (status, signal) => {
      running.delete(child);
      if (meter) meter.seconds += secondsOf(times);
      const fault = watcher ? watcher.end() : '';
      if (fault) output += `\n${path.basename(command)} was stopped: ${fault}\n`;
      const code = status ?? (signal === 'SIGKILL' ? 137 : 128 + 6);
      if (code === 0 || allowFailure) resolve({ code, output });
      else
        reject(
          new Failure(`${output}${[command, ...args].join(' ')}\nended with exit code ${code}`),
        );
    });
  });
}

/** Runs a script of an npm dependency with this Node. */
export function runTool(script, args, options) {
  return run(process.execPath, [path.join(root, 'node_modules', script), ...args], options);
}

for (const signal of ['SIGINT', 'SIGTERM']) {
  process.on(signal, () => {
    for (const child of running) killTree(child.pid, signal);
    process.exit(signal === 'SIGINT' ? 130 : 143);
  });
}

/** Runs a script's main function; a Failure prints its message alone. Sets the exit code. */
export async function main(body) {
  try {
    const code = await body();
    if (typeof code === 'number') process.exitCode = code;
  } catch (error) {
    process.stderr.write(`\n${error instanceof Failure ? error.message : error.stack}\n`);
    process.exitCode = 1;
  }
}
