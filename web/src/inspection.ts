// `window.__soapfilm`: the page's state, read-only, for its own tests and for a look from the console.
import type { ReadonlySignal } from '@preact/signals';
import type { Stage } from './scene/stage.ts';
import type { Point2 } from './shapes/plane.ts';
import type { Document } from './state/document.ts';
import type { Flooding, PolygonDocument, RingPlace, Triangulated } from './state/polygon.ts';
import { isStale, solve, surface, type Solve, type Surface } from './state/solving.ts';
import { canRedo, canUndo, doc, isGrowing, notice, selection, tool, type Notice, type Selection, type Tool } from './state/store.ts';

export interface Inspection {
  readonly document: Document;
  readonly solve: Solve;
  readonly surface: Surface | null;
  readonly isStale: boolean;
  readonly isGrowing: boolean;
  readonly selection: Selection | null;
  readonly tool: Tool;
  readonly notice: Notice | null;
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  /** Where a vertex appears, in CSS pixels of the window. */
  whereIs(curve: number, vertex: number): { x: number; y: number };
}

/** `window.__polygons`: the same for the mode of polygons, once it has been opened. */
export interface PolygonInspection {
  readonly document: PolygonDocument;
  readonly triangulated: Triangulated | null;
  readonly flooding: Flooding | null;
  readonly selection: RingPlace | null;
  /** Where a point of the plane appears, in CSS pixels of the window. */
  whereIs(point: Point2): { x: number; y: number };
}

declare global {
  interface Window {
    __soapfilm?: Inspection;
    __polygons?: PolygonInspection;
  }
}

type Signals = Readonly<Record<string, ReadonlySignal<unknown>>>;
type Values<S extends Signals> = { readonly [K in keyof S]: S[K]['value'] };

/** An object whose properties are the signals' values at the time. */
export function valuesOf<S extends Signals>(signals: S): Values<S> {
  const values = {};
  for (const [name, signal] of Object.entries<ReadonlySignal<unknown>>(signals)) {
    Object.defineProperty(values, name, { enumerable: true, get: () => signal.peek() });
  }
  return values as Values<S>;
}

/** A place on a canvas as one in the window, in CSS pixels. */
export function inWindow(canvas: HTMLCanvasElement, x: number, y: number): { x: number; y: number } {
  const { left, top } = canvas.getBoundingClientRect();
  return { x: left + x, y: top + y };
}

export function exposeForInspection({ view }: Stage): void {
  const whereIs: Inspection['whereIs'] = (curve, vertex) => {
    const { x, y } = view.project(doc.peek().curves[curve][vertex]);
    return inWindow(view.canvas, x, y);
  };
  const now = valuesOf({ document: doc, solve, surface, isStale, isGrowing, selection, tool, notice, canUndo, canRedo });
  window.__soapfilm = Object.assign(now, { whereIs });
}
