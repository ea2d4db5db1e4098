// Points of surfaces: where handles are, and how far meshes are off.
import type { ModelFace, NurbsCurve } from 'soapfilm/surfaces';
import { dot, scale, subtract, type Point } from '../../shapes/vec.ts';

type Numbers = ArrayLike<number | null>;
type Surface = ModelFace['surface'];
type Uv = readonly [u: number, v: number];

/** The functions of one parameter that are not 0 at a value of it (The NURBS Book, A2.1 and A2.2). */
class Basis {
  /** Of the first of the poles that count. */
  first = 0;
  readonly values: Float64Array;
  readonly from: number;
  readonly to: number;
  private readonly knots: Float64Array;
  private readonly left: Float64Array;
  private readonly right: Float64Array;

  constructor(
    private readonly degree: number,
    knots: Numbers,
    private readonly count: number,
  ) {
    this.knots = Float64Array.from(knots as ArrayLike<number>);
    this.from = this.knots[degree];
    this.to = this.knots[count];
    this.values = new Float64Array(degree + 1);
    this.left = new Float64Array(degree + 1);
    this.right = new Float64Array(degree + 1);
  }

  /** Outside of the domain: as at its end. */
  at(parameter: number): void {
    const { degree, count, knots, values, left, right } = this;
    const t = Math.min(this.to, Math.max(this.from, parameter));
    let [low, high] = [degree, count - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (knots[middle] <= t) low = middle;
      else high = middle - 1;
    }
    values[0] = 1;
    for (let k = 1; k <= degree; k++) {
      left[k] = t - knots[low + 1 - k];
      right[k] = knots[low + k] - t;
      let carried = 0;
      for (let r = 0; r < k; r++) {
        const width = right[r + 1] + left[k - r];
        const share = width > 0 ? values[r] / width : 0;
        values[r] = carried + right[r + 1] * share;
        carried = left[k - r] * share;
      }
      values[k] = carried;
    }
    this.first = low - degree;
  }
}

/** A surface made ready for many points. */
class Evaluator {
  private readonly u: Basis;
  private readonly v: Basis;
  private readonly columns: number;
  /** Times the weights, which come last. */
  private readonly poles: Float64Array;

  constructor({ degreeU, degreeV, knotsU, knotsV, countU, countV, poles, weights }: Surface) {
    this.u = new Basis(degreeU, knotsU, countU);
    this.v = new Basis(degreeV, knotsV, countV);
    this.columns = countV;
    this.poles = new Float64Array(4 * poles.length);
    poles.forEach((pole, i) => {
      const weight = weights?.[i] ?? 1;
      for (let axis = 0; axis < 3; axis++) this.poles[4 * i + axis] = (pole[axis] as number) * weight;
      this.poles[4 * i + 3] = weight;
    });
  }

  at(parameterU: number, parameterV: number): Point {
    const { u, v, poles, columns } = this;
    u.at(parameterU);
    v.at(parameterV);
    let [x, y, z, w] = [0, 0, 0, 0];
    for (let i = 0; i < u.values.length; i++) {
      for (let j = 0; j < v.values.length; j++) {
        const share = u.values[i] * v.values[j];
        const at = 4 * ((u.first + i) * columns + v.first + j);
        x += share * poles[at];
        y += share * poles[at + 1];
        z += share * poles[at + 2];
        w += share * poles[at + 3];
      }
    }
    return [x / w, y / w, z / w];
  }

  /** A small share of the domain. */
  get step(): Uv {
    return [(this.u.to - this.u.from) * 1e-5, (this.v.to - this.v.from) * 1e-5];
  }
}

const known = new WeakMap<Surface, Evaluator>();

function evaluatorOf(surface: Surface): Evaluator {
  const found = known.get(surface);
  if (found) return found;
  const made = new Evaluator(surface);
  known.set(surface, made);
  return made;
}

/** The point of a surface; parameters outside of the domain are taken to its border. */
export const pointOn = (surface: Surface, [u, v]: Uv): Point => evaluatorOf(surface).at(u, v);

/** The step in the domain that moves a point of a surface by about so much in space. */
export function stepOn(surface: Surface, [u, v]: Uv, by: Point): Uv {
  const of = evaluatorOf(surface);
  const [du, dv] = of.step;
  const slope = (a: Point, b: Point, width: number): Point => scale(subtract(b, a), 1 / width);
  const su = slope(of.at(u - du, v), of.at(u + du, v), 2 * du);
  const sv = slope(of.at(u, v - dv), of.at(u, v + dv), 2 * dv);
  const [a, b, c, p, q] = [dot(su, su), dot(su, sv), dot(sv, sv), dot(su, by), dot(sv, by)];
  const area = a * c - b * b;
  return area > 1e-12 * a * c ? [(c * p - b * q) / area, (a * q - b * p) / area] : [0, 0];
}

export const poleOf = ({ poles }: NurbsCurve, k: number): Uv => [poles[k][0] as number, poles[k][1] as number];
