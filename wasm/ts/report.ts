// Errors that come when the call that they are about can no longer throw them.
import type { NoSpan, ProgressListener, Span } from './types.js';

/** Has the surroundings tell of an error that no caller is left to catch, as they do of their own. */
export function report(error: unknown): void {
  const { reportError } = globalThis as { reportError?: (error: unknown) => void };
  if (reportError) reportError(error);
  else console.error(error);
}

/** Tells a listener that the work is done. What it throws cannot end that any more: it is reported. */
export function tellEnd(span: Span | NoSpan, onProgress: ProgressListener | undefined): void {
  if (!span.found) return;
  try {
    onProgress?.(1, span.cost, span.lowerBound);
  } catch (error) {
    report(error);
  }
}
