// Models as objects of the document, and how fine they are meshed.
import type { Model } from 'soapfilm/surfaces';
import type { Group } from '../../state/document.ts';
import { groupOf } from '../../state/store.ts';

/** The name of the mode, and of the kind of its objects. */
export const kMode = 'surface';
export const kModel = 'model';

export interface ModelShape {
  readonly model: Model;
}

export interface SurfaceSettings {
  /** Most distance of mesh and surface, in shares of the model's diagonal. */
  readonly relative: number;
  /** Most turn along an edge, in degrees. */
  readonly angle: number;
  /** How long cells may be for their width; 0: any length. */
  readonly aspect: number;
  /** Whether the mesh follows the camera, and within how many pixels. */
  readonly follows: boolean;
  readonly pixels: number;
  /** Whether faces with faults are left out. */
  readonly skips: boolean;
}

export const kMinRelative = 1e-5;
export const kMaxRelative = 0.05;
export const kMaxAngle = 90;
export const kMaxAspect = 20;
export const kMaxPixels = 20;

export const kSettings: SurfaceSettings = { relative: 1e-3, angle: 20, aspect: 3, follows: false, pixels: 1, skips: true };

/** Whether the mode can work with settings of the right types. */
export function areSurfaceSettings({ relative, angle, aspect, pixels }: SurfaceSettings): boolean {
  const isWithin = (value: number, from: number, to: number): boolean => value >= from && value <= to;
  return (
    isWithin(relative, kMinRelative, kMaxRelative) &&
    isWithin(angle, 1, kMaxAngle) &&
    (aspect === 0 || isWithin(aspect, 1, kMaxAspect)) &&
    isWithin(pixels, 0.1, kMaxPixels)
  );
}

/** The models of the document. */
export const surfaceGroup: { readonly value: Group<SurfaceSettings>; peek(): Group<SurfaceSettings> } = groupOf(kMode, kSettings);
