// A mesh in a file: what reading gives, and what readers and writers share.
import { SoapfilmError, type ErrorPlace } from './errors.js';
import type { MeshAttribute, MeshLike } from './types.js';

/**
 * - `obj`: Wavefront; text.
 * - `ply`: Stanford triangles; text or binary.
 * - `stl`: stereolithography; text or binary.
 * - `glb`: glTF 2.0 in one binary file.
 */
export type MeshFormat = 'obj' | 'ply' | 'stl' | 'glb';

/** A mesh that was read. `fillHoles` and `findHoles` take it as it is. */
export interface MeshFile extends MeshLike {
  readonly format: MeshFormat;
  /** What the file has and the mesh has not, in words. */
  readonly warnings: readonly string[];
}

/** Options of `readMesh`. */
export interface ReadMeshOptions {
  /**
   * What becomes of vertices with several texture coordinates, at the seams of a texture. `'join'` (default): the mesh is
   * whole, and there is no `uv`. `'split'`: there are several vertices at the same place, each with its `uv`, and `fillHoles`
   * needs `weld: 0`, so that seams are no holes.
   */
  readonly seams?: 'join' | 'split';
}

export const kSeamWarning = 'Some vertices have several texture coordinates: these are left out, for the mesh would have a seam there';

/** Attributes that mean the same in all formats: colours of 3 or 4 numbers, texture coordinates of 2. */
export const kColor = 'color';
export const kUv = 'uv';

/** @param reason goes on after the number of the line, and begins with a small letter */
export function badFile(reason: string, place: ErrorPlace = {}, options?: ErrorOptions): SoapfilmError {
  const message = place.line === undefined ? reason[0].toUpperCase() + reason.slice(1) : `Line ${place.line}: ${reason}`;
  return new SoapfilmError('bad-file', message, place, options);
}

/** The mesh with the attributes that there are: empty ones and those that are not finite are left out. */
export function meshFile(
  format: MeshFormat,
  { positions, faces }: MeshLike,
  attributes: readonly (readonly [name: string, attribute: MeshAttribute])[],
  warnings: readonly string[],
): MeshFile {
  const broken = attributes.filter(([, { data }]) => !data.every(Number.isFinite));
  const kept = attributes.filter((attribute) => !broken.includes(attribute));
  return {
    format,
    positions,
    faces,
    ...(kept.length > 0 && { attributes: Object.fromEntries(kept) }),
    warnings: [...warnings, ...broken.map(([name]) => `The attribute “${name}” has numbers that are not finite, and is left out`)],
  };
}

/** Colours from 0 to 1; files have them from 0 to 255 too, without a sign of it. Changes them in place. */
export function scaleColors({ data }: MeshAttribute): void {
  if (!data.some((x) => x > 1) || data.some((x) => x > 255)) return;
  for (let i = 0; i < data.length; i++) data[i] /= 255;
}
