// Points of splines, for handles: by de Boor's scheme, a few at a time.
import type { ModelFace, NurbsCurve } from 'soapfilm/surfaces';
import { scale, subtract, type Point } from '../../shapes/vec.ts';

type Numbers = ArrayLike<number | null>;

/** The span of a parameter: the last one that begins at it or before, within the domain. */
function spanOf(degree: number, knots: Numbers, count: number, t: number): number {
  let span = degree;
  while (span < count - 1 && (knots[span + 1] as number) <= t) span++;
  return span;
}

/** Of poles that are multiplied by weights, which come last. */
function deBoor(degree: number, knots: Numbers, poles: readonly (readonly number[])[], t: number): readonly number[] {
  const span = spanOf(degree, knots, poles.length, t);
  const row = Array.from({ length: degree + 1 }, (_, k) => poles[span - degree + k]);
  for (let level = 1; level <= degree; level++) {
    for (let k = degree; k >= level; k--) {
      const low = knots[span - degree + k] as number;
      const high = knots[span + 1 + k - level] as number;
      const share = high > low ? (t - low) / (high - low) : 0;
      row[k] = row[k].map((x, axis) => (1 - share) * row[k - 1][axis] + share * x);
    }
  }
  return row[degree];
}

const weighed = (pole: Numbers, weight: number): number[] => [...Array.from(pole, (x) => (x as number) * weight), weight];

type Surface = ModelFace['surface'];

/** The point of a surface; parameters outside of the domain are taken to its border. */
export function pointOn(surface: Surface, [u, v]: readonly [number, number]): Point {
  const { degreeU, degreeV, knotsU, knotsV, countU, countV, poles, weights } = surface;
  const within = (t: number, degree: number, knots: Numbers, count: number): number =>
    Math.min(knots[count] as number, Math.max(knots[degree] as number, t));
  const s = within(u, degreeU, knotsU, countU);
  const t = within(v, degreeV, knotsV, countV);
  const column = Array.from({ length: countU }, (_, i) => {
    const row = Array.from({ length: countV }, (_, j) => weighed(poles[i * countV + j], (weights?.[i * countV + j] ?? 1)));
    return deBoor(degreeV, knotsV, row, t);
  });
  const [x, y, z, w] = deBoor(degreeU, knotsU, column, s);
  return [x / w, y / w, z / w];
}

/** The step in the domain that moves a point of a surface by about so much in space. */
export function stepOn(surface: Surface, uv: readonly [number, number], by: Point): readonly [number, number] {
  const { degreeU, degreeV, knotsU, knotsV, countU, countV } = surface;
  const ends = (degree: number, knots: Numbers, count: number): number => ((knots[count] as number) - (knots[degree] as number)) * 1e-5;
  const [du, dv] = [ends(degreeU, knotsU, countU), ends(degreeV, knotsV, countV)];
  const slope = (a: readonly [number, number], b: readonly [number, number], width: number): Point =>
    scale(subtract(pointOn(surface, b), pointOn(surface, a)), 1 / width);
  const [u, v] = uv;
  const su = slope([u - du, v], [u + du, v], 2 * du);
  const sv = slope([u, v - dv], [u, v + dv], 2 * dv);
  const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const [a, b, c, p, q] = [dot(su, su), dot(su, sv), dot(sv, sv), dot(su, by), dot(sv, by)];
  const area = a * c - b * b;
  return area > 1e-12 * a * c ? [(c * p - b * q) / area, (a * q - b * p) / area] : [0, 0];
}

export const poleOf = ({ poles }: NurbsCurve, k: number): readonly [number, number] => [poles[k][0] as number, poles[k][1] as number];
