// Closed lines of points, flat: what curves and polygons with holes are made of.
import { boxOfPoints, type Box, type Point } from './vec.ts';

/** Closed lines in space or in the plane: the last point of each joins the first. Nothing of it is ever changed. */
export interface Lines {
  readonly dim: 2 | 3;
  /** `[dim n]` the points of all lines, one after the other. */
  readonly positions: Float64Array;
  /** `[lines + 1]` where each line begins, and n. */
  readonly starts: Uint32Array;
}

/** Lines from lists of points; of plane ones only x and y count. */
export function linesOf(dim: 2 | 3, lists: readonly (readonly (readonly number[])[])[]): Lines {
  const starts = new Uint32Array(lists.length + 1);
  lists.forEach((list, i) => (starts[i + 1] = starts[i] + list.length));
  const positions = new Float64Array(dim * starts[lists.length]);
  let at = 0;
  for (const list of lists) for (const point of list) for (let axis = 0; axis < dim; axis++) positions[at++] = point[axis];
  return { dim, positions, starts };
}

export const pointCount = ({ starts }: Lines): number => starts[starts.length - 1];
export const lineCount = ({ starts }: Lines): number => starts.length - 1;

export function pointAt({ dim, positions }: Lines, i: number): Point {
  const at = dim * i;
  return [positions[at], positions[at + 1], dim === 3 ? positions[at + 2] : 0];
}

/** The number of the point after one in its line. */
export function nextPoint({ starts }: Lines, line: number, i: number): number {
  return i + 1 === starts[line + 1] ? starts[line] : i + 1;
}

/** The line that a point is of. */
export function lineOf({ starts }: Lines, i: number): number {
  let line = 0;
  while (starts[line + 1] <= i) line++;
  return line;
}

/** The lines with some points moved by a vector. */
export function moved(lines: Lines, points: Iterable<number>, by: Point): Lines {
  const positions = lines.positions.slice();
  for (const i of points) for (let axis = 0; axis < lines.dim; axis++) positions[lines.dim * i + axis] += by[axis];
  return { ...lines, positions };
}

/**
 * The lines without some of their points and without some lines as wholes. A line that would keep fewer than three
 * points goes as well, unless nothing is taken from it. Null where the first line goes: all others depend on it.
 */
export function without(lines: Lines, points: ReadonlySet<number>, whole: ReadonlySet<number>): Lines | null {
  const { dim, positions, starts } = lines;
  const kept = new Float64Array(positions.length);
  const keptStarts = [0];
  let count = 0;
  for (let line = 0; line < lineCount(lines); line++) {
    const first = count;
    for (let i = starts[line]; i < starts[line + 1]; i++) {
      if (points.has(i)) continue;
      for (let axis = 0; axis < dim; axis++) kept[dim * count + axis] = positions[dim * i + axis];
      count++;
    }
    const isTooShort = count - first < 3 && count - first < starts[line + 1] - starts[line];
    if (!whole.has(line) && !isTooShort) {
      keptStarts.push(count);
      continue;
    }
    if (line === 0) return null;
    count = first;
  }
  return { dim, positions: kept.slice(0, dim * count), starts: Uint32Array.from(keptStarts) };
}

export const boxOfLines = ({ dim, positions }: Lines): Box => boxOfPoints(positions, dim);

/** What has been saved as lines, if it still is such: none of them empty, all coordinates finite. */
export function readLines(dim: 2 | 3, saved: unknown): Lines | null {
  if (typeof saved !== 'object' || saved === null) return null;
  const { positions, starts } = saved as Partial<Lines>;
  if (!(positions instanceof Float64Array) || !(starts instanceof Uint32Array)) return null;
  if (starts.length < 2 || starts[0] !== 0 || positions.length !== dim * starts[starts.length - 1]) return null;
  if (starts.some((start, i) => i > 0 && start <= starts[i - 1])) return null;
  return positions.every(Number.isFinite) ? { dim, positions, starts } : null;
}
