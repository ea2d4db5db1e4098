// Where the core's parts come from: sources, compilation, and the copies inside the library's own scripts.
import { flagOf, guarded, mustBe, optionsOf, type Given } from './check.js';
import { SoapfilmError } from './errors.js';
import { readFrom } from './host.js';
import { kPartNames, kParts } from './options.js';
import type { LoadOptions, Part, WasmSource } from './types.js';

/** Compiled parts, for other threads. */
export type Modules = Partial<Record<Part, WebAssembly.Module>>;

/** The file of each part beside this script, and its copy. Bundlers look for exactly these expressions. */
const kFiles: Readonly<
  Record<Part, { file: () => URL; copy: () => Promise<{ readonly default: string }> }>
> = {
  loops: {
    file: () => new URL('./loops.wasm', import.meta.url),
    copy: () => import('./loops_inline.js'),
  },
  polygons: {
    file: () => new URL('./polygons.wasm', import.meta.url),
    copy: () => import('./polygons_inline.js'),
  },
  meshes: {
    file: () => new URL('./meshes.wasm', import.meta.url),
    copy: () => import('./meshes_inline.js'),
  },
  surfaces: {
    file: () => new URL('./surfaces.wasm', import.meta.url),
    copy: () => import('./surfaces_inline.js'),
  },
};

const compiling = new Map<Part, Promise<WebAssembly.Module>>();

/**
 * The compiled parts. Each is compiled once, by whichever of this and `load` is first.
 * @throws SoapfilmError `load-failed`, `bad-option`
 */
export async function compile(options: LoadOptions = {}): Promise<Modules> {
  const parts = partsOf(options).map(async ([part, source]) => [part, await compilePart(part, source)]);
  return Object.fromEntries(await Promise.all(parts)) as Modules;
}

/**
 * The parts that the options name, each with its source if they give one.
 * @throws SoapfilmError `bad-option`
 */
export function partsOf({ parts, wasm, checks }: Given<LoadOptions>): [Part, WasmSource | undefined][] {
  flagOf('checks', checks);
  const isPart = (part: unknown): part is Part => kParts.includes(part as Part);
  const named = guarded('bad-option', 'parts', () => {
    const list: readonly unknown[] = parts === undefined ? kParts : Array.isArray(parts) ? parts : [];
    const known: Part[] = [];
    // By index: array methods skip missing entries.
    for (let i = 0; i < list.length && isPart(list[i]); i++) known.push(list[i] as Part);
    if (known.length > 0 && known.length === list.length) return known;
    const names = kParts.map((part) => `'${part}'`).join(', ');
    throw mustBe('bad-option', 'parts', `one of ${names}, or several, in an array`, parts);
  });
  const sources: Given<Record<Part, WasmSource>> =
    wasm === undefined || isSource('wasm', wasm)
      ? { [named[0]]: wasm }
      : optionsOf<Record<Part, WasmSource>>(wasm, kPartNames, 'wasm');
  return named.map((part) => {
    const source = sources[part];
    if (source === undefined || isSource(`wasm.${part}`, source)) return [part, source];
    throw mustBe('bad-option', `wasm.${part}`, 'a URL, a response, bytes or a compiled module', source);
  });
}

function isSource(name: string, value: unknown): value is WasmSource {
  if (typeof value !== 'object' || value === null) return typeof value === 'string';
  const kind = guarded('bad-option', name, () => Object.prototype.toString.call(value));
  return ArrayBuffer.isView(value) || /^\[object (URL|Response|ArrayBuffer|WebAssembly\.Module)\]$/.test(kind);
}

/**
 * The promise that is known for a part, else a new one from `begin`. A failure is forgotten, so that the next
 * call tries again. The compiled part is forgotten with it: it may not be one of soapfilm.
 */
export function once<T>(known: Map<Part, Promise<T>>, part: Part, begin: () => Promise<T>): Promise<T> {
  const found =
    known.get(part) ??
    begin().catch((error: unknown) => {
      known.delete(part);
      compiling.delete(part);
      throw failed(part, error);
    });
  known.set(part, found);
  return found;
}

/** @throws SoapfilmError `load-failed` */
export function compilePart(part: Part, source: WasmSource | undefined): Promise<WebAssembly.Module> {
  return once(compiling, part, () => compileFrom(part, source));
}

async function compileFrom(part: Part, source: WasmSource | undefined): Promise<WebAssembly.Module> {
  if (source === undefined) return compileDefault(part);
  if (source instanceof WebAssembly.Module) return source;
  const isPlace = typeof source === 'string' || source instanceof URL;
  return compileBytes(isPlace ? await readFrom(source) : source);
}

/** The file beside this script; or its copy, if a bundler lost the file or no server has it. */
async function compileDefault(part: Part): Promise<WebAssembly.Module> {
  const { file, copy } = kFiles[part];
  try {
    return await compileBytes(await readFrom(file()));
  } catch (cause) {
    const { default: base64 } = await copy().catch(() => {
      throw cause;
    });
    return compileBytes(Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)));
  }
}

async function compileBytes(bytes: Response | BufferSource): Promise<WebAssembly.Module> {
  if (!(bytes instanceof Response)) return WebAssembly.compile(bytes);
  if (!bytes.ok) throw new Error(`${bytes.url}: ${bytes.status} ${bytes.statusText}`);
  // Streaming lets browsers keep the compiled code, but insists on the right type.
  return bytes.headers.get('content-type')?.startsWith('application/wasm')
    ? WebAssembly.compileStreaming(bytes)
    : WebAssembly.compile(await bytes.arrayBuffer());
}

function failed(part: Part, cause: unknown): SoapfilmError {
  if (cause instanceof SoapfilmError) return cause;
  const reason = cause instanceof Error ? cause.message : String(cause);
  return new SoapfilmError('load-failed', `Loading '${part}' failed: ${reason}`, undefined, { cause });
}
