// Errors that come too late for their call to throw them.
import type { NoSpan, ProgressListener, Span } from './types.js';

/** Reports an error that no caller is left to catch, in the way the host reports uncaught errors. */
export function report(error: unknown): void {
  const { reportError } = globalThis as { reportError?: (error: unknown) => void };
  if (reportError) reportError(error);
  else console.error(error);
}

/** Tells a listener that the work is done. If that throws, the error is reported: the result is there all the same. */
export function tellLast(tell: () => void): void {
  try {
    tell();
  } catch (error) {
    report(error);
  }
}

/** Tells a listener that a surface was found. */
export function tellEnd(span: Span | NoSpan, onProgress: ProgressListener | undefined): void {
  if (span.found) tellLast(() => onProgress?.(1, span.cost, span.lowerBound));
}
