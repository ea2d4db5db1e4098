// How fine a mesh is to be, as callers say it and as the core takes it; and meshes in the callers' words.
import {
  kSurfaceReportChoices,
  kSurfaceReportLength,
  readSurfaceReport,
  readTessellationNumbers,
  type SurfaceReport,
  type TessellationArrays,
} from './border.js';
import { amountOf, flagOf, guarded, mustBe, optionsOf, type Given, type Names } from './check.js';
import type { OpenedModel, TessellationWork } from './compute_surfaces.js';
import type { SoapfilmError } from './errors.js';
import { putPoints } from './flatten.js';
import { listenerOf } from './hole_input.js';
import { limitsOf, type Limits } from './options.js';
import { bareFaultError } from './surface_faults.js';
import type { Sampling, SamplingCamera, Tessellation, TessellationReport, TrimmedOptions } from './surface_types.js';

export const kTrimmedOptions: Names<TrimmedOptions> = { skipInvalid: true, maxMemoryBytes: true };

export const kSampling: Names<Sampling> = {
  tolerance: true,
  relative: true,
  angle: true,
  camera: true,
  aspect: true,
  maxTriangles: true,
  maxSeconds: true,
  maxMemoryBytes: true,
  onProgress: true,
};

const kDefaultRelative = 1e-3;
const kDefaultAngle = 0.35;
const kDefaultAspect = 3;

export interface CheckedTrimmedOptions {
  readonly skipInvalid: boolean;
  readonly limits: Pick<Limits, 'maxMemoryBytes'>;
}

/** @throws SoapfilmError `bad-option` */
export const trimmedOptionsOf = ({ skipInvalid, maxMemoryBytes }: Given<TrimmedOptions>): CheckedTrimmedOptions => ({
  skipInvalid: flagOf('skipInvalid', skipInvalid),
  limits: limitsOf({ maxMemoryBytes }),
});

/** The faults of a model whose faces are left out, those found here and those found by the core, in the order of faces. */
export function faultsOf(here: readonly SoapfilmError[], core: readonly SoapfilmError[]): readonly SoapfilmError[] {
  // The core knows of the first only that something is missing.
  const known = new Set(here.map(({ face }) => face));
  const faceOf = ({ face = Infinity }: SoapfilmError): number => face;
  return [...here, ...core.filter(({ face }) => !known.has(face))].sort((a, b) => faceOf(a) - faceOf(b));
}

/**
 * What the core is to do.
 * @throws SoapfilmError `bad-option`
 */
export function tessellationWorkOf(given: Given<Sampling>, { box }: Pick<OpenedModel, 'box'>, limits: Pick<Limits, 'maxMemoryBytes'>): TessellationWork {
  const { tolerance, relative, angle, camera, aspect = kDefaultAspect, maxTriangles = Infinity, maxSeconds = Infinity, maxMemoryBytes } = given;
  const picture = camera === undefined ? kNoCamera : pictureOf(camera);
  const diagonal = Math.hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]);
  const finest = Math.min(
    tolerance === undefined ? Infinity : positiveOf('tolerance', tolerance),
    // Of a model that has no size, any tolerance is right.
    relative === undefined ? Infinity : positiveOf('relative', relative) * (diagonal || 1),
  );
  const isOpen = tolerance === undefined && relative === undefined && camera === undefined;
  const turn = angle === undefined ? (camera === undefined ? kDefaultAngle : Infinity) : angle;
  return {
    settings: {
      tolerance: Math.max(Number.MIN_VALUE, isOpen ? kDefaultRelative * (diagonal || 1) : finest),
      angle: turn === Infinity ? turn : positiveOf('angle', turn),
      aspect: aspectOf(aspect),
      maxTriangles: amountOf('maxTriangles', maxTriangles),
      maxSeconds: amountOf('maxSeconds', maxSeconds),
      ...picture,
    },
    ...limits,
    ...limitsOf({ maxMemoryBytes }),
    ...listenerOf(given),
  };
}

type Picture = Omit<TessellationWork['settings'], 'tolerance' | 'angle' | 'aspect' | 'maxTriangles' | 'maxSeconds'>;

const kCamera: Names<SamplingCamera> = { eye: true, viewProjection: true, width: true, height: true, pixels: true };

const pictureWith = (hasCamera: number, eye: ArrayLike<number>, m: ArrayLike<number>, size: readonly number[]): Picture => ({
  hasCamera,
  eyeX: eye[0],
  eyeY: eye[1],
  eyeZ: eye[2],
  m0: m[0],
  m1: m[1],
  m2: m[2],
  m3: m[3],
  m4: m[4],
  m5: m[5],
  m6: m[6],
  m7: m[7],
  m8: m[8],
  m9: m[9],
  m10: m[10],
  m11: m[11],
  m12: m[12],
  m13: m[13],
  m14: m[14],
  m15: m[15],
  width: size[0],
  height: size[1],
  pixels: size[2],
});

const kNoCamera = pictureWith(0, [0, 0, 0], new Float64Array(16), [0, 0, 0]);

function pictureOf(camera: unknown): Picture {
  const { eye, viewProjection, width, height, pixels = 1 } = optionsOf<SamplingCamera>(camera, kCamera, 'camera');
  const at = new Float64Array(3);
  const isPoint = guarded('bad-option', 'camera.eye', () => putPoints([eye], 1, 3, true, at, 0) === 1 && at.every(Number.isFinite));
  if (!isPoint) throw mustBe('bad-option', 'camera.eye', '[x, y, z] or { x, y, z } of finite numbers', eye);
  const size = Object.entries({ width, height, pixels }).map(([name, value]) => positiveOf(`camera.${name}`, value));
  return pictureWith(1, at, matrixOf(viewProjection), size);
}

function matrixOf(value: unknown): Float64Array {
  return guarded('bad-option', 'camera.viewProjection', () => {
    const isList = Array.isArray(value) || ArrayBuffer.isView(value);
    const list = value as ArrayLike<unknown>;
    const numbers = isList && list.length === 16 ? Array.from({ length: 16 }, (_, i) => list[i]) : [];
    if (numbers.length === 16 && numbers.every(Number.isFinite)) return Float64Array.from(numbers as number[]);
    throw mustBe('bad-option', 'camera.viewProjection', '16 finite numbers', value);
  });
}

/** @throws SoapfilmError `bad-option` */
export function positiveOf(name: string, value: unknown): number {
  if (typeof value === 'number' && value > 0 && value < Infinity) return value;
  throw mustBe('bad-option', name, 'a positive number', value);
}

function aspectOf(value: unknown): number {
  if (typeof value === 'number' && value >= 1) return value;
  throw mustBe('bad-option', 'aspect', 'a number from 1 on', value);
}

/** A mesh of the core. @param faults of the model, as `faultsOf` has them */
export function tessellationOf({ reports, numbers, ...arrays }: TessellationArrays, faults: readonly SoapfilmError[]): Tessellation {
  const { originX, originY, originZ, deviation, tolerance } = readTessellationNumbers(numbers);
  const known = new Set(faults.map(({ face }) => face));
  const told: TessellationReport[] = faults.flatMap((fault) => leftOut(fault));
  for (let at = 0; at < reports.length; at += kSurfaceReportLength) {
    const report = readSurfaceReport(reports, at);
    const isKnown = kSurfaceReportChoices[report.report] === 'left-out' && known.has(report.face);
    if (!isKnown) told.push(...reportOf(report));
  }
  return { ...arrays, origin: [originX, originY, originZ], deviation, tolerance, reports: told };
}

function leftOut({ code, message, face, loop, use, otherLoop, edge }: SoapfilmError): TessellationReport[] {
  // An edge that no face uses is missed by none.
  if (face === undefined) return [];
  const place = {
    ...(loop !== undefined && { loop }),
    ...(use !== undefined && { use }),
    ...(otherLoop !== undefined && { otherLoop }),
    ...(edge !== undefined && { edge }),
  };
  return [{ report: 'left-out', code, message, face, ...place }];
}

function reportOf({ report, face, fault, value }: SurfaceReport): TessellationReport[] {
  const name = kSurfaceReportChoices[report];
  const place = face < 0 ? {} : { face };
  switch (name) {
    case 'left-out':
      return leftOut(bareFaultError(fault, face));
    case 'crossing-samples':
      return [{ report: name, ...place, count: value }];
    case 'tolerance-raised':
      return [{ report: name, tolerance: value }];
    case 'above-tolerance':
      return [{ report: name, face, deviation: value }];
    case 'time-over':
      return [{ report: name, ...place }];
  }
}
