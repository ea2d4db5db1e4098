// Checks of what callers pass in, whatever it is. Each value is read once, by code that trusts none.
// A value that does not fit becomes an error that names the argument. No code of the caller's runs later.
import { SoapfilmError, type ErrorCode } from './errors.js';

/** A value in words, for a message. Runs no code of the caller's. */
export function show(value: unknown): string {
  switch (typeof value) {
    case 'string':
      return JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}…` : value);
    case 'bigint':
      return 'a BigInt';
    case 'object':
      if (value === null) return 'null';
      if (kindOf(value) !== undefined) return `${kindOf(value)}(${lengthOf(value)})`;
      return isArray(value) ? 'an array' : 'an object';
    case 'function':
    case 'symbol':
      return `a ${typeof value}`;
    default:
      return String(value);
  }
}

/** As `Array.isArray`, but false for revoked proxies, for which that throws. */
function isArray(value: unknown): boolean {
  try {
    return Array.isArray(value);
  } catch {
    return false;
  }
}

/** The error for the argument or option `name`, which must be `what`, but is `value`. */
export function mustBe(code: ErrorCode, name: string, what: string, value: unknown): SoapfilmError {
  return new SoapfilmError(code, `\`${name}\` must be ${what}, not ${show(value)}`);
}

/**
 * The result of `read`, which reads from the argument `name`.
 * @throws SoapfilmError the one that `read` throws. If it throws anything else, as getters and proxies may,
 *   one with `code`, and with that as its `cause`
 */
export function guarded<T>(code: ErrorCode, name: string, read: () => T): T {
  try {
    return read();
  } catch (cause) {
    if (cause instanceof SoapfilmError) throw cause;
    throw new SoapfilmError(code, `\`${name}\` cannot be read`, undefined, { cause });
  }
}

/** The names of all fields of a type; the compiler checks that none is missing. */
export type Names<T> = Readonly<Record<keyof T, true>>;

/** Fields as they were given, of any kind. */
export type Given<T> = Readonly<Partial<Record<keyof T, unknown>>>;

/** @throws SoapfilmError with that code if the argument is not an object with fields */
function checkFields(value: unknown, name: string, code: ErrorCode): void {
  const isFields = (): boolean =>
    typeof value === 'object' && value !== null && !Array.isArray(value) && !ArrayBuffer.isView(value);
  if (!guarded(code, name, isFields)) throw mustBe(code, name, 'an object', value);
}

/**
 * The named fields of an argument, each read once; those that are undefined are left out.
 * @param code of the error if the argument is not an object, or a field cannot be read
 */
export function fieldsOf<T extends object>(
  value: unknown,
  names: Names<T>,
  name: string,
  code: ErrorCode,
): Given<T> {
  checkFields(value, name, code);
  const path = name === 'options' ? '' : `${name}.`;
  const fields: Record<string, unknown> = {};
  for (const key of Object.keys(names)) {
    const field = guarded(code, path + key, () => (value as Record<string, unknown>)[key]);
    if (field !== undefined) fields[key] = field;
  }
  return fields as Given<T>;
}

/** As `fieldsOf`, but other fields are an error: a misspelt option would go unnoticed. */
export function optionsOf<T extends object>(
  value: unknown,
  names: Names<T>,
  name = 'options',
  code: ErrorCode = 'bad-option',
): Given<T> {
  const fields = fieldsOf(value, names, name, code);
  const keys = guarded(code, name, () => Object.keys(value as object));
  const unknown = keys.find((key) => !Object.hasOwn(names, key));
  if (unknown === undefined) return fields;
  const path = name === 'options' ? '' : `${name}.`;
  const list = Object.keys(names).join(', ');
  throw new SoapfilmError('bad-option', `\`${path}${unknown}\` is not an option here; there are ${list}`);
}

/**
 * The fields of an argument whose names are the caller's own, each read once; those that are undefined are left out.
 * Pairs, not an object: a field may be named `__proto__`.
 */
export function entriesOf(value: unknown, name: string, code: ErrorCode): [key: string, field: unknown][] {
  checkFields(value, name, code);
  const keys = guarded(code, name, () => Object.keys(value as object));
  return keys.flatMap((key): [string, unknown][] => {
    const field = guarded(code, `${name}.${key}`, () => (value as Record<string, unknown>)[key]);
    return field === undefined ? [] : [[key, field]];
  });
}

/** The choice that an option names; the first one if it is left out. */
export function choiceOf<T>(name: string, choices: readonly T[], value: unknown, more = ''): T {
  if (value === undefined) return choices[0];
  const index = choices.indexOf(value as T);
  if (index >= 0) return choices[index];
  const list = choices.map((c) => (typeof c === 'string' ? `'${c}'` : String(c))).join(', ');
  throw mustBe('bad-option', name, `one of ${list}${more}`, value);
}

export const flagOf = (name: string, value: unknown): boolean => choiceOf(name, [false, true], value);

/** An option that must be a function, if it is given. */
export function functionOf(name: string, value: unknown): unknown {
  if (value === undefined || typeof value === 'function') return value;
  throw mustBe('bad-option', name, 'a function', value);
}

/** An option that is a number and not negative. */
export function amountOf(name: string, value: unknown, most = Infinity): number {
  if (typeof value === 'number' && value >= 0 && value <= most) return value;
  throw mustBe('bad-option', name, most < Infinity ? `a number from 0 to ${most}` : 'a number and not negative', value);
}

/** Whether a value is a whole number that fits into 32 bits. */
export const isIndex = (value: unknown): value is number =>
  typeof value === 'number' && value >>> 0 === value;

const arrayPrototype = Object.getPrototypeOf(Uint8Array.prototype) as object;

/** Reads a property of typed arrays that no field of the caller's can hide; undefined for other values. */
function getterOf(property: PropertyKey): (value: unknown) => unknown {
  const found = Object.getOwnPropertyDescriptor(arrayPrototype, property);
  return (value) => found?.get?.call(value) as unknown;
}
const [kindIn, bufferOf, offsetOf, lengthOf] = [
  getterOf(Symbol.toStringTag),
  getterOf('buffer'),
  getterOf('byteOffset'),
  getterOf('length'),
] as [(value: unknown) => string | undefined, (view: object) => ArrayBuffer, (view: object) => number, (view: object) => number];

/**
 * The kind of a typed array, such as 'Float64Array'; undefined for other values. Unlike `instanceof`, this is
 * right about arrays of other windows, and about objects that only inherit from arrays.
 */
export const kindOf = (value: unknown): string | undefined => kindIn(value);

const constructors = { Float32Array, Float64Array, Uint32Array, Uint8Array };
type Kind = keyof typeof constructors;

/**
 * A view of the same memory as a typed array of one of the kinds; undefined for other values. The view has no
 * fields or methods of the caller's.
 * @throws TypeError if the array's buffer is detached, or has shrunk so that it ends before the array
 */
export function viewOf<K extends Kind>(
  kinds: readonly K[],
  value: unknown,
): InstanceType<(typeof constructors)[K]> | undefined {
  const kind = kindOf(value) as K;
  if (!kinds.includes(kind)) return undefined;
  const view = value as object;
  // Throws also for an array outside of its buffer, which otherwise would only look empty.
  if (lengthOf(view) === 0) Uint8Array.prototype.keys.call(view);
  return new constructors[kind](bufferOf(view), offsetOf(view), lengthOf(view)) as InstanceType<
    (typeof constructors)[K]
  >;
}

/**
 * A typed array that is an argument or option: a view of the caller's memory, or with `own` a copy.
 * @param what what it must hold, for the message
 * @param fits whether a length is right
 */
export function arrayOf<K extends 'Float64Array' | 'Uint32Array'>(
  kind: K,
  value: unknown,
  own: boolean,
  code: ErrorCode,
  name: string,
  what: string,
  fits: (length: number) => boolean,
): InstanceType<(typeof constructors)[K]> {
  return guarded(code, name, () => {
    const view = viewOf([kind], value);
    if (!view || !fits(view.length)) throw mustBe(code, name, `a ${kind} of ${what}`, value);
    return (own ? view.slice() : view) as typeof view;
  });
}
