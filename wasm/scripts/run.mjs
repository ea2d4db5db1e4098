// Starting programs and saying what happens: what the other scripts share.
import { spawn } from 'node:child_process';
import { availableParallelism } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

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

/**
 * Runs a program to its end; it dies with this process.
 *   options.capture  collect the output instead of passing it through
 *   options.allowFailure  resolve with the code instead of throwing a Failure
 *   options.seconds  kill it after that long
 * Resolves to { code, output }; code is 128 + n after signal n.
 */
export function run(command, args, options = {}) {
  const { capture = false, allowFailure = false, seconds, cwd = root, env = {} } = options;
  return new Promise((resolve, reject) => {
    const child = spawn(command, args, {
      cwd,
      env: { ...process.env, ...env },
      stdio: ['ignore', capture ? 'pipe' : 'inherit', capture ? 'pipe' : 'inherit'],
    });
    running.add(child);
    let output = '';
    let late = false;
    child.stdout?.setEncoding('utf8').on('data', (text) => (output += text));
    child.stderr?.setEncoding('utf8').on('data', (text) => (output += text));
    const timer =
      seconds &&
      setTimeout(() => {
        late = true;
        child.kill('SIGKILL');
      }, seconds * 1000);
    child.on('error', (error) => {
      running.delete(child);
      clearTimeout(timer);
      if (allowFailure) resolve({ code: 127, output: `${output}${error.message}\n` });
      else reject(new Failure(`${command}: ${error.message}`));
    });
    child.on('close', (status, signal) => {
      running.delete(child);
      clearTimeout(timer);
      if (late) output += `${command} was stopped after ${seconds} s\n`;
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
    for (const child of running) child.kill(signal);
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
