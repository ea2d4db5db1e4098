// Errors of polygons in the words of the page, where polygons and holes count from 1, and what of them is marked.
import type { ErrorCode, SoapfilmError } from 'soapfilm';
import type { Lines } from '../../shapes/lines.ts';
import type { Item } from '../../state/document.ts';
import type { Failure, Fault } from '../../state/work.ts';

const ring = (r: number): string => (r === 0 ? 'the outer ring' : `hole ${r}`);

/** What can be wrong with a polygon itself. */
const kWords: Partial<Record<ErrorCode, (error: SoapfilmError) => string>> = {
  'self-intersecting': ({ loop = 0 }) => `${ring(loop)} crosses or overlaps itself.`,
  'holes-overlap': ({ loop = 0, otherLoop = 0 }) => `${ring(loop)} and ${ring(otherLoop)} cross or overlap.`,
  'hole-outside': ({ loop = 0 }) => `${ring(loop)} is not inside the outer ring.`,
  'nested-hole': ({ loop = 0, otherLoop = 0 }) => `${ring(loop)} lies inside ${ring(otherLoop)}.`,
  degenerate: ({ loop = 0, vertex }) =>
    vertex === undefined ? `${ring(loop)} has fewer than three distinct points.` : `${ring(loop)} has a spike.`,
  'not-finite': ({ loop = 0 }) => `a coordinate of ${ring(loop)} is larger than can be reckoned with.`,
};

/** Whether an error is about a polygon, and not about the work. */
export const isOfPolygon = ({ code }: SoapfilmError): boolean => code in kWords;

function wordsFor(error: SoapfilmError, items: readonly Item[]): string {
  const of = items.length > 1 ? `Polygon ${(error.polygon ?? 0) + 1}: ` : '';
  const text = of + (kWords[error.code]?.(error) ?? error.message);
  return text[0].toUpperCase() + text.slice(1);
}

/** An error about one of the polygons. */
export function failureOf(error: SoapfilmError, items: readonly Item[]): Failure {
  const { code, polygon = 0, loop, vertex, otherLoop, otherVertex, point } = error;
  const item = items.at(polygon);
  const faults: Fault[] = [];
  const note = (part: number | undefined, at: number | undefined): void => {
    if (item === undefined || part === undefined) return;
    const { starts } = item.shape as Lines;
    if (part + 1 >= starts.length || starts[part] === starts[part + 1]) return;
    // Two vertices are the beginnings of two edges; one stands for itself.
    const isEdge = at !== undefined && otherVertex !== undefined;
    faults.push({ place: { item: item.id, part, handle: at === undefined ? null : starts[part] + at }, isEdge });
  };
  note(loop, vertex);
  note(otherLoop, otherVertex);
  const message = wordsFor(error, items);
  return { code, message, faults, ...(point && { point: [point[0], point[1], 0] as const }) };
}
