// Errors in the words of the page: curves and vertices count from 1, as in its list of curves.
import { SoapfilmError } from 'soapfilm';
import { pointAt, pointCount, type Lines } from '../../shapes/lines.ts';
import type { Item } from '../../state/document.ts';
import { plainFailure, type Failure, type Fault } from '../../state/work.ts';
import type { FilmGroup } from './settings.ts';

/** A curve of the film by its number, and one of its vertices. */
interface Culprit {
  readonly curve: number;
  readonly vertex: number | undefined;
}

export function describeFailure(error: unknown, { items }: FilmGroup): Failure {
  if (!(error instanceof SoapfilmError)) return plainFailure(error);
  const isEdge = error.code === 'loops-intersect';
  const culprits: Culprit[] = [];
  const note = (curve: number | undefined, vertex: number | undefined) => {
    if (curve !== undefined && curve in items) culprits.push({ curve, vertex });
  };
  note(error.loop, error.vertex);
  note(error.otherLoop, error.otherVertex);
  const faults = culprits.map(
    ({ curve, vertex }): Fault => ({ place: { item: items[curve].id, part: 0, handle: vertex ?? null }, isEdge }),
  );
  const point = culprits.flatMap(({ curve, vertex }) => pointOf(items[curve], vertex)).at(0);
  return { code: error.code, message: messageOf(error, culprits), faults, ...(point && { point }) };
}

function pointOf({ shape }: Item, vertex: number | undefined) {
  const curve = shape as Lines;
  return vertex !== undefined && vertex < pointCount(curve) ? [pointAt(curve, vertex)] : [];
}

function messageOf(error: SoapfilmError, [first, second]: readonly (Culprit | undefined)[]): string {
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
  return plainFailure(error).message;
}

const placeOf = ({ curve, vertex }: Culprit): string => `vertex ${(vertex ?? 0) + 1} of curve ${curve + 1}`;
