// For what the page shows of its state, read-only, to its own tests and to a look from the console.
import type { ReadonlySignal } from '@preact/signals';

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
