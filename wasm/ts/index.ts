export { load } from './load.js';
export { SoapfilmError } from './errors.js';
export type * from './errors.js';
export type * from './types.js';
