// What the page shows of its state, read-only, to its own tests and to a look from the console.
import type { ReadonlySignal } from '@preact/signals';
import type { Span } from 'soapfilm';
import type { Place } from './state/document.ts';
import type { Notice } from './state/notice.ts';
import type { Tool } from './state/store.ts';
import type { Failure } from './state/work.ts';

/** `window.__soapfilm`: the page, and the mode of films. */
export interface Inspection {
  readonly document: {
    readonly name: string;
    readonly curves: readonly (readonly (readonly number[])[])[];
    readonly settings: {
      readonly weights: { readonly area: number; readonly perimeter: number; readonly dihedral: number };
      readonly candidates: unknown;
    };
  };
  readonly solve: { readonly phase: string } | ({ readonly phase: 'failed' } & Failure);
  readonly surface: { readonly span: Span } | null;
  readonly isStale: boolean;
  readonly isGrowing: boolean;
  /** What was chosen last. */
  readonly selection: { readonly curve: number; readonly vertex: number | null } | null;
  readonly places: readonly Place[];
  readonly mode: string;
  readonly tool: Tool;
  readonly notice: Notice | null;
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  /** Where a vertex appears, in CSS pixels of the window. */
  whereIs(curve: number, vertex: number): { x: number; y: number };
}

declare global {
  interface Window {
    __soapfilm?: Inspection;
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
