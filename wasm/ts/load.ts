// Where core.wasm comes from: sources, compilation, and the copy inside the library's own scripts.
import { SoapfilmError } from './errors.js';
import { readFrom } from './host.js';
import { compiledModule, startCore } from './runtime.js';
import type { LoadOptions } from './types.js';

let loading: Promise<void> | undefined;
let compiling: Promise<WebAssembly.Module> | undefined;

/**
 * Loads the core; every other function needs it. Calls after the first wait for the same load and
 * ignore their options; after a failure the next call tries again.
 *
 * @throws SoapfilmError `load-failed`, with the reason as its `cause`
 */
export function load(options: LoadOptions = {}): Promise<void> {
  loading ??= compile(options)
    .then(startCore)
    .catch((error: unknown) => {
      loading = undefined;
      compiling = undefined;
      throw failed(error);
    });
  return loading;
}

/**
 * The compiled core, for other threads; compiled once, by this or by `load`.
 * @throws SoapfilmError `load-failed`
 */
export function compile(options: LoadOptions = {}): Promise<WebAssembly.Module> {
  const done = compiledModule();
  if (done) return Promise.resolve(done);
  compiling ??= compileFrom(options.wasm).catch((error: unknown) => {
    compiling = undefined;
    throw failed(error);
  });
  return compiling;
}

async function compileFrom(source: LoadOptions['wasm']): Promise<WebAssembly.Module> {
  if (source === undefined) return compileDefault();
  if (source instanceof WebAssembly.Module) return source;
  const isPlace = typeof source === 'string' || source instanceof URL;
  return compileBytes(isPlace ? await readFrom(source) : source);
}

/** core.wasm beside this script, else (a bundler lost it, or nothing is served) the inline copy. */
async function compileDefault(): Promise<WebAssembly.Module> {
  try {
    return await compileBytes(await readFrom(new URL('./core.wasm', import.meta.url)));
  } catch (cause) {
    const { default: base64 } = await import('./core_inline.js').catch(() => {
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

function failed(cause: unknown): SoapfilmError {
  if (cause instanceof SoapfilmError) return cause;
  const reason = cause instanceof Error ? cause.message : String(cause);
  return new SoapfilmError('load-failed', `Loading soapfilm's core failed: ${reason}`, undefined, {
    cause,
  });
}
