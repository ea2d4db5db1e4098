// Instances of the core's parts, which are modules, and the one way to call them. Only this file knows
// pointers and memory.
import { SoapfilmError } from './errors.js';
import { kNotFound, kOk, kStopped, statusError } from './messages.js';
import type { Part, ProgressListener } from './types.js';

/** An argument of an export: a number as it is; an array, copied in; null, no array. */
export type CoreArgument = number | Float64Array | Uint32Array | Int32Array | Uint8Array | null;

type ArrayType =
  | Float64ArrayConstructor
  | Uint32ArrayConstructor
  | Int32ArrayConstructor
  | Uint8ArrayConstructor;

/** The arrays that a call hands back, for the types asked for. */
export type Arrays<T extends readonly ArrayType[]> = { [I in keyof T]: InstanceType<T[I]> };

/** What may end a call early, and who is told how it goes. */
export interface Watch<T extends readonly ArrayType[]> {
  /** Called every 30 ms or so. What it throws ends the work and is thrown on by `callCore`. */
  readonly onProgress?: ProgressListener | undefined;
  /** Wall-clock seconds after which the call ends with `time-limit`. */
  readonly maxSeconds?: number | undefined;
  /** Called with each result that the work has on its way; what it throws is thrown on likewise. */
  readonly onResult?: ((arrays: Arrays<T>) => void) | undefined;
  /** Whether the time limit asks the core to end, and then takes what that hands back. */
  readonly keepsResult?: boolean | undefined;
  /** Whether the arrays handed back are views of the core's memory, good until its next call. */
  readonly borrows?: boolean | undefined;
  /** The error for a status; default `statusError`. */
  readonly explain?: ((status: number, where: Uint32Array) => SoapfilmError) | undefined;
}

/**
 * An instance of a part, made when it is first called, in which calls leave something for later ones.
 * It stays until it traps: then all that was in it is lost.
 */
export class Home {
  /** @internal */
  core: Core | undefined;
  lost = false;
  /** @internal */
  idle?: ReturnType<typeof setTimeout>;
  readonly part: Part;

  constructor(part: Part) {
    this.part = part;
  }
}

/** The instances that all calls share which leave nothing behind; a new one after each trap. */
export const shared: Readonly<Record<Part, Home>> = {
  loops: new Home('loops'),
  polygons: new Home('polygons'),
};

const kProgressMs = 30;
/**
 * WebAssembly memory never shrinks: an instance that has grown past this is given up once it has been
 * idle for a while. Not at once: large work often comes in a row, and growing anew takes its time.
 */
const kKeepBytes = 256 * 2 ** 20;
const kIdleMs = 1000;
/** Dying instances that cannot grow by this many 64 KiB pages have run out of memory. */
const kProbePages = 1024;

type Export = (...args: readonly number[]) => number;

interface Core {
  readonly memory: WebAssembly.Memory;
  /** The export of that name; throws `load-failed` where the core has none. */
  readonly find: (name: string) => Export;
  /** A result whose arrays are lent out, freed by the next call. */
  lent?: number | undefined;
}

/** The call under way. */
interface Run {
  readonly watch: Pick<Watch<[]>, 'onProgress' | 'maxSeconds' | 'keepsResult' | 'borrows' | 'explain'>;
  /** Hands a result on, by its handle. */
  readonly hear: (handle: number) => void;
  readonly started: number;
  told: number;
  fraction: number;
  /** Why the work is to end; `gently`: what it has until then is still wanted. */
  stop?: { readonly reason: unknown; readonly gently: boolean };
}

const modules: Partial<Record<Part, WebAssembly.Module>> = {};
let run: Run | undefined;

/**
 * Makes `compiled` the module of a part that is called from now on, and starts an instance of it.
 * @throws SoapfilmError `load-failed` when it is not soapfilm's
 */
export async function startCore(part: Part, compiled: WebAssembly.Module): Promise<void> {
  const started = await WebAssembly.instantiate(compiled, imports(compiled));
  shared[part].core = open(part, started);
  modules[part] = compiled;
}

/** Functions for all that the module imports: ours by name, the rest do nothing. */
function imports(compiled: WebAssembly.Module): WebAssembly.Imports {
  const known: Record<string, (...args: number[]) => unknown> = {
    sf_host_progress: onHostProgress,
    sf_host_result: onHostResult,
    proc_exit: (code) => {
      throw new Error(`the core exited with ${code}`);
    },
  };
  const result: Record<string, Record<string, WebAssembly.ImportValue>> = {};
  for (const { module: from, name, kind } of WebAssembly.Module.imports(compiled)) {
    if (kind === 'function') (result[from] ??= {})[name] = known[name] ?? (() => 0);
  }
  return result;
}

function open(part: Part, { exports }: WebAssembly.Instance): Core {
  const { memory } = exports;
  const lacks = (what: string): SoapfilmError =>
    new SoapfilmError('load-failed', `The module for '${part}' has no ${what}`);
  const find = (name: string): Export => {
    const found = exports[name];
    if (typeof found === 'function') return found as Export;
    throw lacks(`function \`${name}\``);
  };
  if (!(memory instanceof WebAssembly.Memory)) throw lacks('memory');
  find('sf_alloc');
  find('_initialize')();
  return { memory, find };
}

/** The import that the core calls about every millisecond; never throws into the core. */
function onHostProgress(fraction: number, bestCost: number, lowerBound: number): 0 | 1 {
  if (!run || run.stop) return 0;
  const { watch, started } = run;
  const now = performance.now();
  if (watch.maxSeconds !== undefined && now - started >= watch.maxSeconds * 1000) {
    const text = `The work was not done within ${watch.maxSeconds} s (\`maxSeconds\`)`;
    run.stop = {
      reason: new SoapfilmError('time-limit', text),
      gently: watch.keepsResult === true,
    };
    return 0;
  }
  try {
    run.fraction = Math.min(1, Math.max(run.fraction, fraction));
    if (watch.onProgress && now - run.told >= kProgressMs) {
      watch.onProgress(run.fraction, bestCost, lowerBound);
      // Taken afterwards, so that a slow listener cannot use up all the time.
      run.told = performance.now();
    }
    return 1;
  } catch (reason) {
    run.stop = { reason, gently: false };
    return 0;
  }
}

/** The import that hands over a result on the way; never throws into the core either. */
function onHostResult(handle: number): void {
  if (!run || run.stop) return;
  try {
    run.hear(handle);
  } catch (reason) {
    run.stop = { reason, gently: false };
  }
}

/**
 * Calls an export `name(...args, where, result)` of a part and hands back its result arrays.
 *
 * @param home the instance to call: `shared[part]`, unless the call leaves something for later ones
 * @param types type of each result array, in the order of `include/soapfilm.h`
 * @returns copies of the arrays, unless borrowed; `found` is false for status 1, "no triangulation"
 * @throws SoapfilmError `not-loaded`; what the core's status says; `time-limit`; `out-of-memory`
 *   and `crashed`, after which the next call has a new instance; what `onProgress` throws
 */
export function callCore<const T extends readonly ArrayType[]>(
  home: Home,
  name: string,
  args: readonly CoreArgument[],
  types: T,
  watch: Watch<T> = {},
): { readonly found: boolean; readonly arrays: Arrays<T> } {
  if (run) {
    throw new SoapfilmError('bad-option', 'No calls from within `onProgress`');
  }
  const module = modules[home.part];
  if (!module) throw notLoaded(home.part);
  if (home.lost) throw new SoapfilmError('crashed', 'The session was lost in a crash');
  const now = performance.now();
  const hear = (handle: number): void => {
    if (home.core) watch.onResult?.(readArrays(home.core, handle, types));
  };
  const thisRun: Run = { watch, hear, started: now, told: now, fraction: 0 };
  run = thisRun;
  try {
    const core = (home.core ??= open(
      home.part,
      new WebAssembly.Instance(module, imports(module)),
    ));
    const { lent } = core;
    core.lent = undefined;
    if (lent !== undefined) core.find('sf_result_free')(lent);
    return callIn(core, name, args, types, thisRun);
  } catch (error) {
    if (error instanceof SoapfilmError || (thisRun.stop && error === thisRun.stop.reason)) {
      throw error;
    }
    throw trapped(error, home);
  } finally {
    run = undefined;
    giveUpWhenIdle(shared[home.part]);
  }
}

/** Lets a large shared instance go after a while without calls. Node does not wait for that. */
function giveUpWhenIdle(home: Home): void {
  clearTimeout(home.idle);
  if (home.core && home.core.memory.buffer.byteLength > kKeepBytes) {
    home.idle = setTimeout(() => (home.core = undefined), kIdleMs);
    (home.idle as { unref?: () => void }).unref?.();
  }
}

function notLoaded(part: Part): SoapfilmError {
  return new SoapfilmError(
    'not-loaded',
    Object.keys(modules).length === 0
      ? 'Call `await load()` first'
      : `The part '${part}' is not loaded: name it in \`parts\` of \`load\` or \`createWorker\``,
  );
}

/** `callCore` in one instance: arguments in, call, results out, everything freed. */
function callIn<const T extends readonly ArrayType[]>(
  called: Core,
  name: string,
  args: readonly CoreArgument[],
  types: T,
  thisRun: Run,
): { found: boolean; arrays: Arrays<T> } {
  const { memory, find } = called;
  const entry = find(name);
  // One block: `where` [4], `result` and 4 bytes of padding, then the arrays.
  let size = 24;
  for (const arg of args) {
    if (arg !== null && typeof arg !== 'number') size += padded(arg.byteLength);
  }
  const block = size < 2 ** 32 ? find('sf_alloc')(size) >>> 0 : 0;
  if (block === 0) throw new SoapfilmError('out-of-memory', 'The input does not fit into memory');
  const head = (): Uint32Array => new Uint32Array(memory.buffer, block, 6);
  let told = head().fill(-1, 0, 4);
  told[4] = 0;
  let next = block + 24;
  const values = args.map((arg) => {
    if (arg === null) return 0;
    if (typeof arg === 'number') return arg;
    const address = next;
    new Uint8Array(memory.buffer, address, arg.byteLength).set(
      new Uint8Array(arg.buffer, arg.byteOffset, arg.byteLength),
    );
    next += padded(arg.byteLength);
    return address;
  });
  const status = entry(...values, block, block + 16);
  if (told.length === 0) told = head(); // the memory has grown
  const handle = told[4];
  let arrays: Arrays<T> | undefined;
  const { borrows = false, explain = statusError } = thisRun.watch;
  try {
    if (status === kOk || status === kNotFound) {
      arrays = readArrays(called, handle, types, borrows);
    }
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError || error instanceof SoapfilmError) throw error;
    throw new SoapfilmError('out-of-memory', 'The result does not fit into memory', undefined, {
      cause: error,
    });
  } finally {
    if (arrays && borrows) called.lent = handle;
    else if (handle !== 0) find('sf_result_free')(handle);
  }
  if (!arrays) told = head().slice(0, 4);
  find('sf_free')(block);
  if (thisRun.stop && !(thisRun.stop.gently && arrays)) throw thisRun.stop.reason;
  if (!arrays) {
    throw status === kStopped
      ? new SoapfilmError('cancelled', 'The work was stopped')
      : explain(status, told);
  }
  return { found: status === kOk, arrays };
}

/** The arrays of a result: copies, or `borrowed` views. */
function readArrays<const T extends readonly ArrayType[]>(
  { memory, find }: Core,
  handle: number,
  types: T,
  borrowed = false,
): Arrays<T> {
  const [data, size] = [find('sf_result_data'), find('sf_result_length')];
  return types.map((type, i) => {
    const length = size(handle, i) >>> 0;
    if (length === 0) return new type(0);
    const address = data(handle, i) >>> 0;
    const view = new type(memory.buffer, address, length);
    return borrowed ? view : view.slice();
  }) as unknown as Arrays<T>;
}

const padded = (bytes: number): number => Math.ceil(bytes / 8) * 8;

/** After a trap: drops the instance, whose memory is in an unknown state, and names the trap. */
function trapped(error: unknown, home: Home): SoapfilmError {
  const full = home.core ? !canGrow(home.core.memory) : error instanceof RangeError;
  home.core = undefined;
  home.lost = home !== shared[home.part];
  const cause = { cause: error };
  return full
    ? new SoapfilmError('out-of-memory', 'WebAssembly memory ran out', undefined, cause)
    : new SoapfilmError('crashed', `The core failed: ${String(error)}`, undefined, cause);
}

function canGrow(memory: WebAssembly.Memory): boolean {
  try {
    memory.grow(kProbePages);
    return true;
  } catch {
    return false;
  }
}
