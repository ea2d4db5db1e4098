// Where the core's parts come from: sources, compilation, and the copies inside the library's own scripts.
import { SoapfilmError } from './errors.js';
import { readFrom } from './host.js';
import { badOption, checkNames, kParts } from './options.js';
import type { LoadOptions, Part, WasmSource } from './types.js';

/** Compiled parts, for other threads. */
export type Modules = Partial<Record<Part, WebAssembly.Module>>;

/** The file of each part beside this script, and the copy of it; bundlers look for just these words. */
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
};

const compiling = new Map<Part, Promise<WebAssembly.Module>>();

/**
 * The compiled parts, each compiled once, by this or by `load`.
 * @throws SoapfilmError `load-failed`, `bad-option`
 */
export async function compile(options: LoadOptions = {}): Promise<Modules> {
  const parts = partsOf(options).map(async ([part, source]) => [part, await compilePart(part, source)]);
  return Object.fromEntries(await Promise.all(parts)) as Modules;
}

/**
 * The parts wanted, each with where it is said to be.
 * @throws SoapfilmError `bad-option`
 */
export function partsOf({ parts = kParts, wasm, checks }: LoadOptions): [Part, WasmSource | undefined][] {
  if (checks !== undefined && typeof checks !== 'boolean') throw badOption('checks', [false, true]);
  const isPart = (part: Part): boolean => kParts.includes(part);
  if (!Array.isArray(parts) || parts.length === 0 || !parts.every(isPart)) {
    throw badOption('parts', kParts, ', or several, in an array');
  }
  const given = Object(wasm) as Partial<Record<Part, WasmSource>>;
  const isOne = !kParts.some((part) => part in given);
  if (!isOne) checkNames(given, { loops: true, polygons: true }, 'wasm.');
  const sources = isOne ? { [parts[0]]: wasm } : given;
  return parts.map((part: Part) => [part, sources[part]]);
}

/**
 * What is under way or done for a part, else what `begin` begins; a failure is forgotten, and with it
 * the part as compiled, which may be none of soapfilm.
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

/** The file beside this script, else (a bundler lost it, or nothing is served) its copy. */
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
