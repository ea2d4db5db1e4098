// What the options of all functions have in common.
import { SoapfilmError } from './errors.js';

/** What the core may use unless told otherwise; WebAssembly memory ends at 4 GiB. */
const kDefaultMemoryBytes = 3 * 2 ** 30;

export interface Limits {
  readonly maxMemoryBytes?: number;
  readonly maxSeconds?: number;
}

/**
 * Checks the options that every function has, and returns how many bytes the core may use.
 * @throws SoapfilmError `bad-option`
 */
export function checkLimits(options: Limits): number {
  if (typeof (options as unknown) !== 'object' || (options as unknown) === null) {
    throw new SoapfilmError('bad-option', 'The options must be an object');
  }
  const { maxMemoryBytes, maxSeconds } = options;
  for (const [name, value] of Object.entries({ maxMemoryBytes, maxSeconds })) {
    if (value === undefined || (typeof value === 'number' && value >= 0)) continue;
    throw new SoapfilmError('bad-option', `\`${name}\` must be a number and not negative`);
  }
  return maxMemoryBytes ?? kDefaultMemoryBytes;
}

/** The error for an option that is none of the choices. */
export function badOption(name: string, choices: readonly unknown[], more = ''): SoapfilmError {
  const list = choices.map((c) => (typeof c === 'string' ? `'${c}'` : String(c))).join(', ');
  return new SoapfilmError('bad-option', `\`${name}\` must be one of ${list}${more}`);
}
