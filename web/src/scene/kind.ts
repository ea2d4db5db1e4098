// What the scene knows of a kind of object, besides what the document does: how it is picked and drawn.
import type { Object3D } from 'three';
import type { Point } from '../shapes/vec.ts';
import type { Item, Kind, Place } from '../state/document.ts';
import type { Fault } from '../state/work.ts';
import type { Eye, Spot } from './eye.ts';
import type { Placement } from './placement.ts';
import type { Theme } from './theme.ts';

/** What lies under the pointer: a part of an object, or one of its handles. */
export interface Hit {
  readonly part: number;
  readonly handle: number | null;
  /** In CSS pixels, at most the reach. */
  readonly distance: number;
  /** The point of it nearest to the pointer. */
  readonly point: Point;
}

/** What is marked among objects. */
export interface Marks {
  readonly selection: readonly Place[];
  readonly hover: Place | null;
  readonly faults: readonly Fault[];
  /** Whether handles are shown that are not marked. */
  readonly vertices: boolean;
}

/** How the scene is drawn now. */
export interface Drawn {
  readonly placement: Placement;
  readonly pixelRatio: number;
  readonly theme: Theme;
}

/** All objects of a kind, as they are drawn. */
export interface Layer {
  readonly object: Object3D;
  update(items: readonly Item[], marks: Marks, drawn: Drawn): void;
}

export interface DrawnKind<S> extends Kind<S> {
  /** The nearest handle within reach (CSS pixels), else the nearest part; null where there is neither. */
  pick(shape: S, eye: Eye, at: Spot, reach: number): Hit | null;
  makeLayer(): Layer;
}

/** Whether objects look as others did, so that nothing is to be drawn anew. */
export function areSame(a: readonly Item[], b: readonly Item[]): boolean {
  return a.length === b.length && a.every((item, i) => item.shape === b[i].shape);
}
