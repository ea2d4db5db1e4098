// Holes, what became of them, and what is wrong with a mesh, in the words of the page.
import type { DefectKind, HoleReason, MeshDefect } from 'soapfilm';
import { countOf } from '../../app/files.ts';
import { plainFailure, type Failure } from '../../state/work.ts';
import type { Hole } from './grouping.ts';
import type { Patch } from './patches.ts';

const kReasons: Record<HoleReason, string> = {
  'no-surface': 'no surface fits its rims',
  'rims-intersect': 'its rims cross each other',
  'repeated-vertex': 'two of its vertices lie at the same place',
  'duplicate-face': 'the only triangle that fits is there already',
  'too-large': 'it is too large',
  'inserted-vertices': 'its rim would have to be split',
  'opposed-rims': 'a part of the mesh around it is inside out',
  'time-limit': 'it would take too long',
  'stitched': 'its sides touch each other, and were sewn',
  'too-many-vertices': 'its rims have too many vertices',
  'too-long': 'its rim is too long',
  'not-asked-for': 'it was not asked for',
};

export const reasonIn = ({ result }: Patch): string =>
  result.reason === undefined ? 'it could not be filled' : kReasons[result.reason];

/** Whether a hole has a surface. */
export const isFilled = ({ faces }: Patch): boolean => faces.length > 0;

/** What a hole is: its rims and how many there are. */
export function kindOfHole({ loops, why, isOpenRim }: Hole): string {
  if (isOpenRim) return loops.length > 1 ? 'open rims' : 'open rim';
  if (loops.length === 1) return 'hole';
  if (why === 'band') return 'band';
  return why === 'island' ? `with ${countOf(loops.length - 1, 'island')}` : `${loops.length} rims`;
}

const face = (count: number): string => countOf(count, 'face');
const kIs = (count: number): string => (count === 1 ? 'is' : 'are');

const kDefects: Record<DefectKind, (defect: MeshDefect) => string> = {
  'non-manifold-edge': ({ edges }) => `${countOf(edges.length / 2, 'edge')} ${kIs(edges.length / 2)} shared by more than two faces`,
  'non-manifold-vertex': ({ vertices }) => `At ${countOf(vertices.length, 'vertex', 'vertices')} parts of the mesh touch`,
  flipped: ({ faces }) => `${face(faces.length)} ${kIs(faces.length)} wound the other way round`,
  'duplicate-face': ({ faces }) => `${face(faces.length)} ${kIs(faces.length)} there twice`,
  'degenerate-face': ({ faces }) => `${face(faces.length)} ${faces.length === 1 ? 'has' : 'have'} no area`,
  'not-orientable': () => 'The mesh has no two sides',
  'unused-vertex': ({ vertices }) => `${countOf(vertices.length, 'vertex', 'vertices')} ${kIs(vertices.length)} in no face`,
};

/** A defect as a sentence. */
export const wordsForDefect = (defect: MeshDefect): string => `${kDefects[defect.kind](defect)}: kept as ${isOne(defect) ? 'it is' : 'they are'}.`;

function isOne({ kind, faces, edges, vertices }: MeshDefect): boolean {
  if (kind === 'not-orientable') return true;
  const count = kind === 'non-manifold-edge' ? edges.length / 2 : kind === 'non-manifold-vertex' || kind === 'unused-vertex' ? vertices.length : faces.length;
  return count === 1;
}

/** What to tell of work that failed. */
export function explain(error: unknown): Failure {
  const plain = plainFailure(error);
  const isTooMuch = plain.code === 'too-large' || plain.code === 'out-of-memory';
  return isTooMuch ? { ...plain, message: 'This mesh is too large for the memory of the page.' } : plain;
}
