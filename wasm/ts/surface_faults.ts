// What is wrong with faces of a model, in words.
import { kSurfaceFaultChoices, type FaceFault } from './border.js';
import { SoapfilmError, type ErrorPlace } from './errors.js';

type Fault = (typeof kSurfaceFaultChoices)[number];

const kNone = 0xffffffff;

const isTrim = ({ use }: ErrorPlace): boolean => use !== undefined;
const curveOf = (place: ErrorPlace): string => (isTrim(place) ? 'a curve of this edge' : 'the surface');

const kMessages: Readonly<Record<Fault, (place: ErrorPlace) => string>> = {
  'bad-knots': (place) =>
    `the knots of ${curveOf(place)} must never fall, be as many as degree and poles need, and inside the domain repeat ` +
    'at most `degree` times, or be from 1e-50 to 1e50 apart; the degree must be from 1 to 25',
  'bad-weights': (place) => `a weight of ${curveOf(place)} is not positive, or more than 1e10 times another`,
  'not-finite': (place) => `a number of ${curveOf(place)} is NaN, infinite or beyond 1e150, or a place beyond 1e37`,
  'bad-edge': () =>
    'there is no such edge, or it has neither `pcurve` nor `curve3d`, or faces share it and it has no `curve3d`, or it is a seam or a ' +
    'point and would be one no more',
  'bad-domain': () => "the edge's `range` is empty, or its curves have another domain",
  'trim-outside': () => "the trimming curve leaves the surface's domain",
  'trim-open': () => 'the trimming curve does not end where the next one of the loop begins',
  'edge-apart': () => "the trimming curve on the surface and the edge's curve in space are farther apart than the edge's `tolerance`",
  'trim-self-intersects': () => 'the loop crosses itself',
  'trims-cross': ({ otherLoop }) => `the loop crosses ${otherLoop === undefined ? 'another one' : `loop ${otherLoop}`}`,
  'hole-outside': () => 'the loop, a hole, is not inside the outer loop',
  degenerate: ({ loop }) => (loop === undefined ? 'the face has no outer loop, or all of the model is one point' : 'the loop has no area'),
};

/** "Face 3, loop 0, use 2 (edge 7)", as far as known. */
function where({ face, loop, use, edge }: ErrorPlace): string {
  const names = [`Face ${face}`];
  if (loop !== undefined) names.push(`loop ${loop}`);
  if (use !== undefined) names.push(`use ${use}`);
  return names.join(', ') + (edge === undefined ? '' : ` (edge ${edge})`);
}

/** The error for a fault that the core has found. */
export function faceFaultError({ fault, face, loop, use, otherLoop, edge }: FaceFault): SoapfilmError {
  const place: ErrorPlace = {
    face,
    ...(loop !== kNone && { loop }),
    ...(use !== kNone && { use }),
    ...(otherLoop !== kNone && { otherLoop }),
    ...(edge !== kNone && { edge }),
  };
  const code = kSurfaceFaultChoices[fault];
  return new SoapfilmError(code, `${where(place)}: ${kMessages[code](place)}`, place);
}

/** The error for a fault of which no more is known than the face. */
export const bareFaultError = (fault: number, face: number): SoapfilmError =>
  faceFaultError({ fault, face, loop: kNone, use: kNone, otherLoop: kNone, edge: kNone });
