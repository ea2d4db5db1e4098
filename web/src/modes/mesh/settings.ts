// Meshes as objects of the document, and what is to become of their holes: settings of the group, so that undo works.
import type { HoleFillOptions } from 'soapfilm';
import type { Attributes } from './attributes.ts';
import type { Group, Id } from '../../state/document.ts';
import { groupOf } from '../../state/store.ts';

/** The name of the mode, and of the kind of its objects. */
export const kMode = 'mesh';
export const kMesh = 'mesh';

export interface MeshShape {
  /** `[3n]` */
  readonly positions: Float32Array;
  /** `[3m]` */
  readonly faces: Uint32Array;
  /** Of the vertices, by name. `color`, of 3 or 4 numbers from 0 to 1 as on the screen, is drawn. */
  readonly attributes?: Attributes;
}

/** Words in place of the library's numbers, since drafts are checked by types. */
export type Smoothness = 'none' | 'direction' | 'curvature' | 'auto';

/** What has been decided about loops, by their numbers in the report. */
export interface Choices {
  /** Loops of holes that are to be filled. */
  readonly filled: readonly number[];
  /** Loops of holes that are to stay open: filling all passes them over. */
  readonly left: readonly number[];
  /** Groups in place of those found. */
  readonly groups: readonly (readonly number[])[];
}

export interface MeshSettings extends Choices {
  readonly smoothness: Smoothness;
  /** How much denser than its surroundings a patch is; 0: without new vertices. */
  readonly density: number;
  readonly candidates: NonNullable<HoleFillOptions['candidates']>;
  /** Whether creases go on through holes, and from which angle in degrees on an edge is one. */
  readonly creases: boolean;
  readonly creaseAngle: number;
  /** Whether filling all fills open rims as well. */
  readonly openRims: boolean;
  /** The objects that the choices are about: of others their loops mean nothing. */
  readonly of: readonly Id[];
}

export type MeshGroup = Group<MeshSettings>;

export const kMaxDensity = 3;
export const kMinCrease = 5;
export const kMaxCrease = 120;
export const kNoChoices: Choices = { filled: [], left: [], groups: [] };

export const kSettings: MeshSettings = {
  smoothness: 'auto',
  density: Math.SQRT2,
  candidates: 'auto',
  creases: true,
  creaseAngle: 40,
  openRims: false,
  of: [],
  ...kNoChoices,
};

/** Whether the mode can work with settings of the right types. */
export function areMeshSettings({ smoothness, density, candidates, creaseAngle, of, filled, left, groups }: MeshSettings): boolean {
  const areNumbers = (list: unknown): boolean => Array.isArray(list) && list.every((x) => Number.isInteger(x) && (x as number) >= 0);
  return (
    ['none', 'direction', 'curvature', 'auto'].includes(smoothness) &&
    density >= 0 &&
    density <= kMaxDensity &&
    ['auto', 'all', 'delaunay', 'near'].includes(candidates) &&
    creaseAngle >= kMinCrease &&
    creaseAngle <= kMaxCrease &&
    [of, filled, left, ...groups].every(areNumbers)
  );
}

/** The meshes of the document. */
export const meshGroup = groupOf(kMode, kSettings);
