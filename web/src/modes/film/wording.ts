// Errors in the words of the page: curves and vertices count from 1, as in its list of curves.
import { SoapfilmError } from 'soapfilm';
import type { Curve } from './document.ts';

/** A curve of the document, one of its vertices, or the edge from that vertex to the next. */
export interface Fault {
  readonly curve: number;
  readonly vertex?: number;
  readonly isEdge: boolean;
}

/** Why a span failed: its code, what to tell the user, and what to mark. */
export interface Failure {
  readonly code: string;
  readonly message: string;
  readonly faults: readonly Fault[];
}

export function describeFailure(error: unknown, curves: readonly Curve[]): Failure {
  if (!(error instanceof SoapfilmError)) return { code: 'crashed', message: String(error), faults: [] };
  const isEdge = error.code === 'loops-intersect';
  const faults: Fault[] = [];
  const note = (curve: number | undefined, vertex: number | undefined) => {
    if (curve === undefined || !(curve in curves)) return;
    faults.push(vertex === undefined ? { curve, isEdge } : { curve, vertex, isEdge });
  };
  note(error.loop, error.vertex);
  note(error.otherLoop, error.otherVertex);
  return { code: error.code, message: messageOf(error, faults), faults };
}

function messageOf(error: SoapfilmError, [first, second]: readonly (Fault | undefined)[]): string {
  switch (error.code) {
    case 'too-large':
    case 'out-of-memory':
      return 'These triangles are too many for the memory of the page. Take them from Delaunay, or use fewer vertices.';
    case 'loops-intersect':
      if (!first || !second) break;
      if (first.curve === second.curve) {
        return `Curve ${first.curve + 1} crosses or touches itself. A surface needs curves that do not.`;
      }
      return `Curves ${first.curve + 1} and ${second.curve + 1} cross or touch. A surface needs curves that do not.`;
    case 'repeated-vertex':
      if (!first || !second) break;
      return `Two vertices lie exactly on each other: ${placeOf(first)} and ${placeOf(second)}.`;
    case 'not-finite':
      if (!first) break;
      return `A coordinate is larger than can be reckoned with (1e150): ${placeOf(first)}.`;
    case 'too-few-vertices':
      if (!first) break;
      return `Curve ${first.curve + 1} has fewer than three vertices.`;
  }
  return error.message;
}

const placeOf = ({ curve, vertex }: Fault): string => `vertex ${(vertex ?? 0) + 1} of curve ${curve + 1}`;
