// The messages between the pool and its threads.
import { SoapfilmError, type ErrorCode, type ErrorPlace } from './errors.js';
import type { Modules } from './compile.js';
import type { PolygonEditor } from './compute_edits.js';
import type { FlatPolygons } from './flat_polygons.js';
import type { computeCarry, computeCrossings, computeHoles, computeOpen, computePatches, computeWeld } from './compute_holes.js';
import type { computeSmooth } from './compute_smooth.js';
import type { computeSpan } from './compute_span.js';
import type { computeMove, computeOpenModel, computeTessellation, computeUpdate } from './compute_surfaces.js';
import type { PolygonsOptions, PolygonTriangulation, PolygonsTriangulation } from './types.js';

/**
 * The functions that a thread can be asked for. Each takes an input and options, checked and made flat on
 * the caller's side.
 */
export interface Calls {
  readonly spanLoops: typeof computeSpan;
  readonly triangulatePolygon: (polygon: FlatPolygons, options: PolygonsOptions) => PolygonTriangulation;
  readonly triangulatePolygons: (polygons: FlatPolygons, options: PolygonsOptions) => PolygonsTriangulation;
  readonly weldMesh: typeof computeWeld;
  readonly findHoles: typeof computeHoles;
  readonly openMesh: typeof computeOpen;
  readonly fillHoles: typeof computePatches;
  readonly findCrossings: typeof computeCrossings;
  readonly carryOn: typeof computeCarry;
  readonly smoothSurface: typeof computeSmooth;
  readonly openModel: typeof computeOpenModel;
  readonly tessellateModel: typeof computeTessellation;
  readonly updateModel: typeof computeUpdate;
  readonly moveInModel: typeof computeMove;
}

/**
 * The kinds of session that a thread can be asked for. Each is made of a checked input and the session's id. Its
 * methods take and return plain data, and errors only in a list of `errors`.
 */
export interface SessionKinds {
  readonly polygon: typeof PolygonEditor;
}

/** Something that stays in a thread, and is freed there by `dispose`. */
export interface Resident {
  dispose(): void;
}

/** Opens a session, or calls a method of one that is open. Requests are answered in order. */
export interface SessionRequest {
  readonly kind: 'session';
  /** Comes back with the answer. */
  readonly call: number;
  readonly id: number;
  /** The kind of session to open; `input` is then the input alone. */
  readonly opens?: keyof SessionKinds | undefined;
  readonly method?: string | undefined;
  readonly input: readonly unknown[];
}

/**
 * To a thread: first the core's parts, then one call at a time, or any number of requests about sessions. A thread for
 * calls may have a mesh open after one; `forget` closes that, and has no answer.
 */
export type Request =
  | SessionRequest
  | { readonly kind: 'start'; readonly modules: Modules }
  | { readonly kind: 'forget'; readonly name: number }
  | {
      readonly kind: 'call';
      readonly name: keyof Calls;
      readonly input: Parameters<Calls[keyof Calls]>;
      /** Whether anyone listens to the progress. */
      readonly progress: boolean;
      /** Whether to send each better result: a call that is ended early returns the latest. */
      readonly results: boolean;
    };

/**
 * From a thread: `ready` once; for each call any number of `progress` and `best`, then the end; for each request
 * about sessions the end, with its number.
 */
export type Reply =
  | { readonly kind: 'ready' }
  | { readonly kind: 'progress'; readonly values: readonly [number, number, number] }
  | { readonly kind: 'best'; readonly value: unknown }
  | { readonly kind: 'done'; readonly value: unknown; readonly call?: number | undefined }
  | { readonly kind: 'error'; readonly error: PlainError; readonly call?: number | undefined };

/** A SoapfilmError as plain data: structured cloning loses classes. */
export interface PlainError {
  readonly code: ErrorCode;
  readonly message: string;
  readonly place: ErrorPlace;
}

export function packError(error: unknown): PlainError {
  if (!(error instanceof SoapfilmError)) {
    return { code: 'crashed', message: `The worker failed: ${String(error)}`, place: {} };
  }
  const { code, message } = error;
  // All other fields that it has are its place.
  const place = Object.entries(error).filter(([key, value]) => key !== 'code' && key !== 'name' && value !== undefined);
  return { code, message, place: Object.fromEntries(place) };
}

export function unpackError({ code, message, place }: PlainError): SoapfilmError {
  return new SoapfilmError(code, message, place);
}

/** The result, with its list of `errors` as plain data, if it has one. */
export function packErrors(result: object): object {
  if (!('errors' in result)) return result;
  return { ...result, errors: (result.errors as unknown[]).map(packError) };
}

/** The result that `packErrors` was given. */
export function unpackErrors<T extends { readonly errors: readonly unknown[] }>(result: T): T {
  return { ...result, errors: result.errors.map((error) => unpackError(error as PlainError)) };
}

const isTypedArray = (value: unknown): value is Float64Array =>
  ArrayBuffer.isView(value) && !(value instanceof DataView);

/** A deep copy of plain data, in which no array shares memory with another. */
export function copyOf<T>(value: T): T;
export function copyOf(value: unknown): unknown {
  if (isTypedArray(value)) return value.slice();
  if (Array.isArray(value)) return value.map((item: unknown) => copyOf(item));
  if (typeof value !== 'object' || value === null) return value;
  return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, copyOf(item)]));
}

/** The buffers of all typed arrays in plain data. */
export function buffersOf(value: unknown, found = new Set<ArrayBuffer>()): ArrayBuffer[] {
  if (isTypedArray(value)) {
    if (value.buffer instanceof ArrayBuffer) found.add(value.buffer);
  } else if (typeof value === 'object' && value !== null) {
    for (const item of Object.values(value)) buffersOf(item, found);
  }
  return [...found];
}
