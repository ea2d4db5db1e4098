// A few polygons to begin with.
import { linesOf, type Lines } from '../../shapes/lines.ts';
import type { Point2 } from '../../shapes/plane.ts';

type Ring = readonly Point2[];

export interface Example {
  readonly title: string;
  /** One polygon. */
  readonly shape: () => Lines;
}

const circle = (x: number, y: number, radius: number, count: number, wave = 0, waves = 1): Ring =>
  Array.from({ length: count }, (_, i): Point2 => {
    const angle = (2 * Math.PI * i) / count;
    const r = radius * (1 + wave * Math.cos(waves * angle));
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  });

/** Teeth from below and above that reach between each other. */
function combs(teeth: number): Ring {
  const below = Array.from({ length: teeth }, (_, i): Point2[] => [[i - 0.1, 0], [i, 3.4], [i + 0.1, 0]]);
  const above = Array.from({ length: teeth }, (_, i): Point2[] => [[i + 0.6, 4], [i + 0.5, 0.6], [i + 0.4, 4]]);
  return [[-0.7, 0], ...below.flat(), [teeth, 0], [teeth, 4], ...above.reverse().flat(), [-0.7, 4]];
}

/** A star drawn in one stroke: each of `points` tips is joined to the third after it. */
const star = (points: number): Ring =>
  Array.from({ length: points }, (_, i): Point2 => [Math.sin((6 * Math.PI * i) / points), Math.cos((6 * Math.PI * i) / points)]);

const example = (title: string, rings: () => readonly Ring[]): Example => ({ title, shape: () => linesOf(2, rings()) });

export const kExamples: readonly Example[] = [
  example('Pond with islands', () => [
    circle(0, 0, 5, 72, 0.16, 5),
    circle(-1.9, 1.1, 0.9, 20, 0.2, 3),
    circle(1.6, 1.9, 0.7, 18),
    circle(0.7, -1.7, 1.3, 28, 0.15, 4),
  ]),
  example('Interleaved combs', () => [combs(9)]),
  example('Plate with holes', () => [
    [[0, 0], [10, 0], [10, 6], [7, 6], [7, 5], [0, 5]],
    ...[1, 2, 3, 4, 5, 6].flatMap((i) => [circle(1.4 * i, 1.4, 0.45, 16), circle(1.4 * i - 0.3, 3.4, 0.45, 6)]),
  ]),
  example('Crossing star', () => [star(7)]),
];
