// Instances of the core's parts (each part is a WebAssembly module), and the one way to call them. Only this
// file knows pointers and memory.
import { kPlaceLength, readPlace, Status, type ArrayReader, type Place } from './border.js';
import { notLoaded, SoapfilmError } from './errors.js';
import { statusError } from './messages.js';
import { report } from './report.js';
import type { Part, ProgressListener } from './types.js';

/** An argument of an export. A number is passed as it is, an array is copied in, null means no array. */
export type CoreArgument = number | Float64Array | Uint32Array | Int32Array | Uint8Array | null;

/** The listeners of a call, what may end it early, and the form of its result. */
export interface Watch<T> {
  /** Called about every 30 ms. What it throws ends the work, and `callCore` throws it too. */
  readonly onProgress?: ProgressListener | undefined;
  /** Wall-clock seconds after which the call ends with `time-limit`. */
  readonly maxSeconds?: number | undefined;
  /** Seconds of these that an earlier call has used. */
  readonly spentSeconds?: number | undefined;
  /** Called with each better result while the call runs. If it throws, the same happens. */
  readonly onResult?: ((arrays: T) => void) | undefined;
  /** Whether a call that the time limit ends returns what the core has found until then. */
  readonly keepsResult?: boolean | undefined;
  /** Whether the arrays returned are views of the core's memory, valid until its next call. */
  readonly borrows?: boolean | undefined;
  /** The error for a status; default `statusError`. */
  readonly explain?: ((status: number, where: Place) => SoapfilmError) | undefined;
}

/**
 * The place of one instance of a part. The instance is made at the first call, and keeps what calls leave in
 * it for later ones. When it traps, all of that is lost.
 */
export class Home {
  /** @internal */
  core: Core | undefined;
  /** Whether its instance has trapped. Never set for `shared`, which get a new instance. */
  lost = false;
  /** @internal The buffers of copies that were lent. */
  copies: ArrayBuffer[] = [];
  /** @internal */
  idle?: ReturnType<typeof setTimeout>;
  readonly part: Part;

  constructor(part: Part) {
    this.part = part;
  }
}

/** The instances for calls that leave nothing behind. After a trap the next call gets a new one. */
export const shared: Readonly<Record<Part, Home>> = {
  loops: new Home('loops'),
  polygons: new Home('polygons'),
  meshes: new Home('meshes'),
  surfaces: new Home('surfaces'),
};

/** The default memory limit of a call; WebAssembly memory ends at 4 GiB. */
export const kDefaultMemoryBytes = 3 * 2 ** 30;
const kProgressMs = 30;
/**
 * WebAssembly memory never shrinks, so an instance that has grown beyond this is dropped when it has been
 * idle for a while. Not at once: large calls often follow each other, and growing again takes time.
 */
const kKeepBytes = 256 * 2 ** 20;
const kIdleMs = 1000;
/** If an instance that trapped cannot grow by this many 64 KiB pages, it ran out of memory. */
const kProbePages = 1024;
/** The head of each call's block: the place, the result's handle, and padding to a multiple of 8. */
const kHeadBytes = 4 * kPlaceLength + 8;

type Export = (...args: readonly number[]) => number;

interface Core {
  readonly memory: WebAssembly.Memory;
  /** The export of that name; throws `load-failed` if the core has none. */
  readonly find: (name: string) => Export;
  readonly alloc: Export;
  readonly free: Export;
  readonly resultData: Export;
  readonly resultLength: Export;
  readonly resultFree: Export;
  /** How many calls of exports have begun and not returned. After a trap, never 0 again. */
  entered: number;
  /** The handle of a result whose arrays are lent, or 0. The next call frees it. */
  lent: number;
}

/** The call under way. */
interface Run {
  readonly watch: Pick<
    Watch<unknown>,
    'onProgress' | 'maxSeconds' | 'keepsResult' | 'borrows' | 'explain'
  >;
  /** Reads the result of this handle, and gives it to the listener. */
  readonly hear: (handle: number) => void;
  /** As if the earlier calls, whose seconds are spent, were part of this one. */
  readonly started: number;
  told: number;
  fraction: number;
  /** Why the work is to end. */
  stop?: Stop;
}

interface Stop {
  readonly reason: unknown;
  /** Whether what the core has found until then is still wanted. */
  readonly gently: boolean;
  /** Whether the core has been asked to end. If not, it was done first. */
  heard: boolean;
}

const modules: Partial<Record<Part, WebAssembly.Module>> = {};
let run: Run | undefined;
let lendsCopies = false;

/** Sets whether lent arrays are copies from now on; the next call of the same instance detaches these. */
export function lendCopies(yes: boolean): void {
  lendsCopies = yes;
}

/**
 * Starts an instance of `compiled`, which is the module of the part from now on.
 * @throws SoapfilmError `load-failed` if it is not soapfilm's
 */
export async function startCore(part: Part, compiled: WebAssembly.Module): Promise<void> {
  const started = await WebAssembly.instantiate(compiled, imports(compiled));
  shared[part].core = open(part, started);
  modules[part] = compiled;
}

/** A function for each import of the module: ours by name; all others do nothing. */
function imports(compiled: WebAssembly.Module): WebAssembly.Imports {
  const known: Record<string, (...args: number[]) => unknown> = {
    sf_host_progress: onHostProgress,
    sf_host_seconds: () => performance.now() / 1000,
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
  const known = new Map<string, Export>();
  const find = (name: string): Export => {
    let found = known.get(name);
    if (found) return found;
    const called = exports[name];
    if (typeof called !== 'function') throw lacks(`function \`${name}\``);
    found = (...args) => {
      core.entered++;
      const value = (called as Export)(...args);
      core.entered--;
      return value;
    };
    known.set(name, found);
    return found;
  };
  if (!(memory instanceof WebAssembly.Memory)) throw lacks('memory');
  const core: Core = {
    memory,
    find,
    alloc: find('sf_alloc'),
    free: find('sf_free'),
    resultData: find('sf_result_data'),
    resultLength: find('sf_result_length'),
    resultFree: find('sf_result_free'),
    entered: 0,
    lent: 0,
  };
  find('_initialize')();
  return core;
}

/**
 * Makes the instance of a home, if it has none.
 * @throws SoapfilmError `not-loaded`; also what the engine throws if it has no room for one
 */
export function start(home: Home): void {
  const module = modules[home.part];
  if (!module) throw lackOf(home.part);
  home.core ??= open(home.part, new WebAssembly.Instance(module, imports(module)));
}

/** The import that the core calls about every millisecond; never throws into the core. */
function onHostProgress(fraction: number, bestCost: number, lowerBound: number): 0 | 1 {
  if (!run) return 0;
  if (!run.stop) watchWork(run, fraction, bestCost, lowerBound);
  if (!run.stop) return 1;
  run.stop.heard = true;
  return 0;
}

/** Looks at the time and calls the listener; sets `stop` if the work is to end. */
function watchWork(run: Run, fraction: number, bestCost: number, lowerBound: number): void {
  const { watch, started } = run;
  const now = performance.now();
  if (watch.maxSeconds !== undefined && now - started >= watch.maxSeconds * 1000) {
    const text = `The work was not done within ${watch.maxSeconds} s (\`maxSeconds\`)`;
    const reason = new SoapfilmError('time-limit', text);
    run.stop = { reason, gently: watch.keepsResult === true, heard: false };
    return;
  }
  try {
    run.fraction = Math.min(1, Math.max(run.fraction, fraction));
    if (watch.onProgress && now - run.told >= kProgressMs) {
      watch.onProgress(run.fraction, bestCost, lowerBound);
      // The time after the call, so that a slow listener cannot use up all of it.
      run.told = performance.now();
    }
  } catch (reason) {
    run.stop = { reason, gently: false, heard: false };
  }
}

/** The import that the core calls with each better result; never throws into the core either. */
function onHostResult(handle: number): void {
  if (!run || run.stop) return;
  try {
    run.hear(handle);
  } catch (reason) {
    run.stop = { reason, gently: false, heard: false };
  }
}

/**
 * Calls an export `name(...args, where, result)` of a part and returns its result arrays. Whatever the
 * outcome, the memory of the call is freed. What the export is meant to keep stays in the core, and so do
 * lent arrays.
 *
 * @param home the instance to call: `shared[part]`, unless the call leaves something for later ones
 * @param read gives the arrays their names: one of the readers in `border.ts`
 * @returns copies of the arrays, unless borrowed; `found` is false for status 1, "no triangulation". If a
 *   listener throws when the core is already done, the result is returned, and the error is reported
 * @throws SoapfilmError `not-loaded`; the error for the core's status; `time-limit`; `out-of-memory` and
 *   `crashed`. After a trap, `shared` homes get a new instance at the next call; other homes are lost. Also
 *   what the listeners throw
 */
export function callCore<T>(
  home: Home,
  name: string,
  args: readonly CoreArgument[],
  read: (array: ArrayReader) => T,
  watch: Watch<T> = {},
): { readonly found: boolean; readonly arrays: T } {
  if (run) {
    throw new SoapfilmError('bad-option', 'No calls from within `onProgress` or `onBest`');
  }
  if (home.lost) throw new SoapfilmError('crashed', 'What was called for was lost in a crash');
  const now = performance.now();
  const hear = (handle: number): void => {
    if (home.core) watch.onResult?.(readArrays(home.core, handle, read));
  };
  const thisRun: Run = { watch, hear, started: now - 1000 * (watch.spentSeconds ?? 0), told: now, fraction: 0 };
  run = thisRun;
  try {
    start(home);
    const core = home.core as Core;
    takeBack(home, core);
    return callIn(home, core, name, args, read, thisRun);
  } catch (error) {
    // An instance that has not returned from a call is lost, whatever was thrown.
    if (home.core?.entered === 0 || error instanceof SoapfilmError) throw error;
    throw trapped(error, home);
  } finally {
    run = undefined;
    giveUpWhenIdle(shared[home.part]);
  }
}

/** Frees what the last call has lent. */
function takeBack(home: Home, core: Core): void {
  const { lent } = core;
  core.lent = 0;
  if (lent !== 0) core.resultFree(lent);
  if (home.copies.length === 0) return;
  for (const buffer of home.copies) structuredClone(buffer, { transfer: [buffer] });
  home.copies = [];
}

/** Whether the home has an instance that is too large to keep when nobody needs it. */
export const isLarge = ({ core }: Home): boolean => core !== undefined && core.memory.buffer.byteLength > kKeepBytes;

/** Drops a large shared instance after a while without calls. Its timer does not keep Node alive. */
function giveUpWhenIdle(home: Home): void {
  clearTimeout(home.idle);
  if (isLarge(home)) {
    home.idle = setTimeout(() => (home.core = undefined), kIdleMs);
    (home.idle as { unref?: () => void }).unref?.();
  }
}

function lackOf(part: Part): SoapfilmError {
  if (Object.keys(modules).length > 0) return notLoaded(part);
  return new SoapfilmError('not-loaded', 'Call `await load()` first');
}

/** `callCore` in one instance: arguments in, call, results out, everything freed. */
function callIn<T>(
  home: Home,
  core: Core,
  name: string,
  args: readonly CoreArgument[],
  read: (array: ArrayReader) => T,
  thisRun: Run,
): { found: boolean; arrays: T } {
  const { memory } = core;
  const entry = core.find(name);
  const { borrows = false, explain = statusError } = thisRun.watch;
  // One block: the place, the result's handle, padding, then the arrays. The sum is exact in doubles.
  let size = kHeadBytes;
  for (const arg of args) {
    if (arg !== null && typeof arg !== 'number') size += padded(arg.byteLength);
  }
  const block = size < 2 ** 32 ? core.alloc(size) >>> 0 : 0;
  if (block === 0) throw new SoapfilmError('out-of-memory', 'The input does not fit into memory');
  let handle = 0;
  let status: number;
  let arrays: T | undefined;
  let place: Place | undefined;
  try {
    const head = (): Uint32Array => new Uint32Array(memory.buffer, block, kPlaceLength + 1);
    let told = head().fill(-1);
    told[kPlaceLength] = 0;
    const values = copyIn(memory, block + kHeadBytes, args);
    status = entry(...values, block, block + 4 * kPlaceLength);
    if (told.length === 0) told = head(); // the memory has grown
    handle = told[kPlaceLength];
    if (status === Status.Ok || status === Status.NotFound) {
      arrays = readArrays(core, handle, read, borrows ? home : undefined);
      if (borrows && !lendsCopies) [core.lent, handle] = [handle, 0];
    } else {
      place = readPlace(told);
    }
  } finally {
    if (core.entered === 0) {
      if (handle !== 0) core.resultFree(handle);
      core.free(block);
    }
  }
  // During the call the host may have called the core again, and that inner call may have trapped.
  if (core.entered !== 0) throw trapped(thisRun.stop?.reason, home);
  const { stop } = thisRun;
  if (place) {
    if (stop) throw stop.reason;
    throw status === Status.Stopped
      ? new SoapfilmError('cancelled', 'The work was stopped')
      : explain(status, place);
  }
  if (stop?.heard && !stop.gently) throw stop.reason;
  if (stop && !stop.heard) report(stop.reason);
  return { found: status === Status.Ok, arrays: arrays as T };
}

/**
 * Copies arrays to where `next` points, and returns the arguments as the core takes them.
 * @throws SoapfilmError `bad-option` for an array whose memory is gone
 */
function copyIn(memory: WebAssembly.Memory, next: number, args: readonly CoreArgument[]): number[] {
  return args.map((arg) => {
    if (arg === null) return 0;
    if (typeof arg === 'number') return arg;
    const address = next;
    try {
      new Uint8Array(memory.buffer, address, arg.byteLength).set(
        new Uint8Array(arg.buffer, arg.byteOffset, arg.byteLength),
      );
    } catch (cause) {
      throw new SoapfilmError('bad-option', 'An array cannot be read', undefined, { cause });
    }
    next += padded(arg.byteLength);
    return address;
  });
}

type ResultArray = Float64Array | Float32Array | Uint32Array;

/**
 * The arrays of a result: copies, or lent by `lender`.
 * @throws SoapfilmError `out-of-memory` if there is no room for copies
 */
function readArrays<T>(
  core: Core,
  handle: number,
  read: (array: ArrayReader) => T,
  lender?: Home,
): T {
  const { memory, resultData, resultLength } = core;
  const array = (
    index: number,
    type: Float64ArrayConstructor | Float32ArrayConstructor | Uint32ArrayConstructor,
  ): ResultArray => {
    const length = resultLength(handle, index) >>> 0;
    if (length === 0) return new type(0);
    const view = new type(memory.buffer, resultData(handle, index) >>> 0, length);
    if (lender && !lendsCopies) return view;
    const copy = copyOf(view);
    lender?.copies.push(copy.buffer);
    return copy;
  };
  return read(array as ArrayReader);
}

function copyOf<V extends ResultArray>(view: V): V & { readonly buffer: ArrayBuffer } {
  try {
    return view.slice() as V & { readonly buffer: ArrayBuffer };
  } catch (cause) {
    throw new SoapfilmError('out-of-memory', 'The result does not fit into memory', undefined, {
      cause,
    });
  }
}

const padded = (bytes: number): number => Math.ceil(bytes / 8) * 8;

/** The error after a trap. Drops the instance, whose memory is in an unknown state. */
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
