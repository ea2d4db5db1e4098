// The document: curves and the settings of their span. Immutable; commands make the next one.
import type { CandidateSpace, LoopSet, SpanOptions } from 'soapfilm';
import { boundsOf, type Point } from '../shapes/vec.ts';

/** A closed curve: the last vertex joins the first. */
export type Curve = readonly Point[];

/**
 * Factors of the cost, relative to the size of the curves: `area` counts per squared bounding-box
 * diagonal and `perimeter` per diagonal, so that a setting means the same for small and large.
 */
export interface RelativeWeights {
  readonly area: number;
  readonly perimeter: number;
  readonly dihedral: number;
}

export interface Settings {
  readonly weights: RelativeWeights;
  readonly objective: 'sum' | 'worst-dihedral';
  readonly candidates: CandidateSpace;
}

export interface Document {
  readonly name: string;
  readonly curves: readonly Curve[];
  readonly settings: Settings;
}

export type Command =
  | { readonly type: 'add-curve'; readonly points: Curve }
  | { readonly type: 'move-vertex'; readonly curve: number; readonly vertex: number; readonly to: Point }
  | { readonly type: 'delete-curve'; readonly curve: number }
  | { readonly type: 'clear' }
  | { readonly type: 'open'; readonly name: string; readonly curves: readonly Curve[]; readonly settings?: Settings }
  | { readonly type: 'set'; readonly settings: Partial<Settings> };

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

export const kDefaultSettings: Settings = {
  weights: kPresets[0].weights,
  objective: 'sum',
  candidates: 'auto',
};

export const kEmptyDocument: Document = { name: 'Untitled', curves: [], settings: kDefaultSettings };

/** The document after a command; the same object where nothing changes. */
export function apply(document: Document, command: Command): Document {
  const { curves, settings } = document;
  switch (command.type) {
    case 'add-curve':
      return { ...document, curves: [...curves, command.points] };
    case 'move-vertex':
      return {
        ...document,
        curves: curves.map((curve, c) =>
          c === command.curve ? curve.map((p, v) => (v === command.vertex ? command.to : p)) : curve,
        ),
      };
    case 'delete-curve':
      if (!(command.curve in curves)) return document;
      return { ...document, curves: curves.filter((_, c) => c !== command.curve) };
    case 'clear':
      return curves.length === 0 ? document : { ...document, name: kEmptyDocument.name, curves: [] };
    case 'open':
      return { name: command.name, curves: command.curves, settings: command.settings ?? settings };
    case 'set':
      return withSettings(document, { ...settings, ...command.settings });
  }
}

function withSettings(document: Document, next: Settings): Document {
  const { weights, objective, candidates } = document.settings;
  const isSame = areEqual(weights, next.weights) && objective === next.objective && candidates === next.candidates;
  return isSame ? document : { ...document, settings: next };
}

const areEqual = (a: RelativeWeights, b: RelativeWeights): boolean =>
  a.area === b.area && a.perimeter === b.perimeter && a.dihedral === b.dihedral;

/** Whether two documents differ in where their vertices lie, and in nothing else. */
export function isReshaped(before: Document, after: Document): boolean {
  return (
    before.settings === after.settings &&
    before.name === after.name &&
    before.curves.length === after.curves.length &&
    before.curves.every((curve, c) => curve.length === after.curves[c].length)
  );
}

export function presetOf(weights: RelativeWeights): Preset | undefined {
  return kPresets.find((preset) => areEqual(preset.weights, weights));
}

export function toLoopSet(curves: readonly Curve[]): LoopSet {
  const starts = new Uint32Array(curves.length + 1);
  curves.forEach((curve, c) => (starts[c + 1] = starts[c] + curve.length));
  return { positions: Float64Array.from(curves.flat(2)), starts };
}

export function fromLoopSet({ positions, starts }: LoopSet): Curve[] {
  return Array.from({ length: starts.length - 1 }, (_, c) =>
    Array.from({ length: starts[c + 1] - starts[c] }, (_, i): Point => {
      const at = 3 * (starts[c] + i);
      return [positions[at], positions[at + 1], positions[at + 2]];
    }),
  );
}

/** The library's options for a document, its relative weights made absolute. */
export function spanOptions({ curves, settings }: Document): SpanOptions {
  const { area, perimeter, dihedral } = settings.weights;
  const size = boundsOf(curves).diagonal || 1;
  return {
    weights: { area: area / size ** 2, perimeter: perimeter / size, dihedral },
    objective: settings.objective,
    candidates: settings.candidates,
  };
}
