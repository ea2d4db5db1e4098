// What a film should be: the settings of a group of curves, and the library's options for them.
import type { CandidateSpace, LoopSet, SmoothOptions, SpanOptions } from 'soapfilm';
import { linesOf, pointAt, pointCount, type Lines } from '../../shapes/lines.ts';
import { boundsOf } from '../../shapes/vec.ts';
import { boxOfGroup, isSame, type Group } from '../../state/document.ts';

/**
 * Factors of the cost, relative to the size of the curves: `area` counts per squared bounding-box
 * diagonal and `perimeter` per diagonal, so that a setting means the same for small and large.
 */
export interface RelativeWeights {
  readonly area: number;
  readonly perimeter: number;
  readonly dihedral: number;
}

export interface FilmSettings {
  readonly weights: RelativeWeights;
  readonly objective: 'sum' | 'worst-dihedral';
  readonly candidates: CandidateSpace;
  /** What the surface becomes between its curves, once it is spanned. */
  readonly smooth: SmoothKind | 'none';
}

export type SmoothKind = NonNullable<SmoothOptions['kind']>;

/** Curves and the settings of the film between them. */
export type FilmGroup = Group<FilmSettings>;

export interface Preset {
  readonly id: string;
  readonly label: string;
  readonly title: string;
  readonly weights: RelativeWeights;
}

/** `smooth` equals the library's default weights. */
export const kPresets: readonly Preset[] = [
  {
    id: 'smooth',
    label: 'Smooth',
    title: 'Least bending: the sum of dihedral angles, and a trace of area to settle flat ties',
    weights: { area: 0.001, perimeter: 0, dihedral: 1 },
  },
  {
    id: 'balanced',
    label: 'Balanced',
    title: 'Bending and area about equally',
    weights: { area: 30, perimeter: 0, dihedral: 1 },
  },
  {
    id: 'small',
    label: 'Small',
    title: 'Least area, as a soap film does',
    weights: { area: 1, perimeter: 0, dihedral: 0 },
  },
];

export const kDefaultSettings: FilmSettings = {
  weights: kPresets[0].weights,
  objective: 'sum',
  candidates: 'auto',
  smooth: 'none',
};

/** Whether a span can be asked for with such settings. */
export function areFilmSettings({ weights, objective, candidates, smooth }: FilmSettings): boolean {
  const all = [weights.area, weights.perimeter, weights.dihedral];
  return (
    all.every((weight) => weight >= 0 && weight < Infinity) &&
    all.some((weight) => weight > 0) &&
    ['none', 'soap-film', 'thin-plate', 'curvature'].includes(smooth) &&
    ['sum', 'worst-dihedral'].includes(objective) &&
    ['auto', 'delaunay', 'near', 'all'].includes(candidates)
  );
}

export function presetOf(weights: RelativeWeights): Preset | undefined {
  return kPresets.find((preset) => isSame(preset.weights, weights));
}

/** The curves of a group, in order; each is one closed line. */
export const curvesOf = ({ items }: Group): readonly Lines[] => items.map(({ shape }) => shape as Lines);

/** Whether two groups differ in where their vertices lie, and in nothing else. */
export function isReshaped(before: FilmGroup, after: FilmGroup): boolean {
  return (
    isSame(before.settings, after.settings) &&
    before.name === after.name &&
    before.items.length === after.items.length &&
    before.items.every(({ id, shape }, i) => {
      const other = after.items[i];
      return id === other.id && pointCount(shape as Lines) === pointCount(other.shape as Lines);
    })
  );
}

export function toLoopSet(curves: readonly Lines[]): LoopSet {
  const starts = new Uint32Array(curves.length + 1);
  curves.forEach((curve, c) => (starts[c + 1] = starts[c] + pointCount(curve)));
  const positions = new Float64Array(3 * starts[curves.length]);
  curves.forEach((curve, c) => {
    positions.set(curve.positions, 3 * starts[c]);
  });
  return { positions, starts };
}

export function fromLoopSet({ positions, starts }: LoopSet): Lines[] {
  return Array.from({ length: starts.length - 1 }, (_, c) => ({
    dim: 3,
    positions: Float64Array.from(positions.subarray(3 * starts[c], 3 * starts[c + 1])),
    starts: new Uint32Array([0, starts[c + 1] - starts[c]]),
  }));
}

/** The points of a curve as lists, as they are shown and written. */
export const listOf = (curve: Lines): number[][] => Array.from({ length: pointCount(curve) }, (_, i) => [...pointAt(curve, i)]);

export const curveOf = (points: readonly (readonly number[])[]): Lines => linesOf(3, [points]);

/** A weight of curves so small that their squared size is no number any more. */
const bounded = (weight: number): number => (Number.isNaN(weight) ? 0 : Math.min(weight, kMostWeight));
const kMostWeight = 1e300;

/** The library's options for a film, its relative weights made absolute. */
export function spanOptions(group: FilmGroup): SpanOptions {
  const { weights, objective, candidates } = group.settings;
  const size = boundsOf(boxOfGroup(group)).diagonal || 1;
  return {
    weights: { area: bounded(weights.area / size ** 2), perimeter: bounded(weights.perimeter / size), dihedral: weights.dihedral },
    objective,
    candidates,
  };
}
