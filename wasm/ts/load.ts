// load: the core's parts, compiled and started in this thread.
import { optionsOf } from './check.js';
import { compilePart, once, partsOf } from './compile.js';
import { kLoadOptions } from './options.js';
import { lendCopies, startCore } from './runtime.js';
import type { LoadOptions, Part, WasmSource } from './types.js';

const loading = new Map<Part, Promise<void>>();

/**
 * Loads the core, or only the named parts of it. Each of the other functions needs its part. A part is
 * loaded once: later calls wait for the same load, even if they name another source. After a failure the
 * next call tries again. `checks` takes effect at once, for parts loaded before as well.
 *
 * @throws SoapfilmError `load-failed`, with the reason as its `cause`; `bad-option`
 */
export async function load(options: LoadOptions = {}): Promise<void> {
  const start = async (part: Part, source?: WasmSource): Promise<void> =>
    startCore(part, await compilePart(part, source));
  const given = optionsOf(options, kLoadOptions);
  const parts = partsOf(given);
  if (given.checks !== undefined) lendCopies(given.checks === true);
  await Promise.all(parts.map(([part, source]) => once(loading, part, () => start(part, source))));
}
