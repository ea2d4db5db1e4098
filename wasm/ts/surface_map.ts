// Affine maps of space, by which instances of a model are placed.
import { guarded, isIndex, mustBe } from './check.js';
import { SoapfilmError } from './errors.js';

export class AffineMap {
  /** Whether it makes right hands left ones. */
  readonly mirrors: boolean;
  /** How much longer a line can become. */
  readonly stretch: number;
  readonly #rows: readonly number[];

  /** @param rows the 12 numbers of 3 rows */
  constructor(rows: readonly number[]) {
    this.#rows = rows;
    const [a, b, c, , d, e, f, , g, h, i] = rows;
    this.mirrors = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0;
    this.stretch = Math.sqrt(largestEigenvalue([
      a * a + d * d + g * g,
      a * b + d * e + g * h,
      a * c + d * f + g * i,
      b * b + e * e + h * h,
      b * c + e * f + h * i,
      c * c + f * f + i * i,
    ]));
  }

  /** The map that does `first`, and then this one. */
  after(first: AffineMap): AffineMap {
    const rows: number[] = [];
    for (let i = 0; i < 3; i++) {
      const row = this.#rows.slice(4 * i, 4 * i + 4);
      for (let k = 0; k < 4; k++) {
        const dot = [0, 1, 2].reduce((sum, j) => sum + row[j] * first.#rows[4 * j + k], 0);
        rows.push(k === 3 ? dot + row[3] : dot);
      }
    }
    return new AffineMap(rows);
  }

  /** Moves points of xyz in ranges of an array. @param ranges begins and ends by turns, counted from `base` */
  move(numbers: Float64Array, base: number, ranges: readonly number[]): void {
    const [a, b, c, p, d, e, f, q, g, h, i, r] = this.#rows;
    for (let range = 0; range < ranges.length; range += 2) {
      for (let at = base + ranges[range]; at < base + ranges[range + 1]; at += 3) {
        const [x, y, z] = [numbers[at], numbers[at + 1], numbers[at + 2]];
        numbers[at] = a * x + b * y + c * z + p;
        numbers[at + 1] = d * x + e * y + f * z + q;
        numbers[at + 2] = g * x + h * y + i * z + r;
      }
    }
  }
}

/** @throws SoapfilmError `bad-model` if it is no affine map, or one that makes space flat */
export function affineOf(matrix: unknown, name: string): AffineMap {
  const numbers = numbersOf(matrix, name);
  const what = '12 finite numbers of 3 rows, or 16 of 4 columns the last numbers of which are 0, 0, 0, 1';
  const isAffine = numbers?.length === 12 || [3, 7, 11, 15].every((at, i) => numbers?.[at] === Number(i === 3));
  if (!numbers || !isAffine || !numbers.every(Number.isFinite)) throw mustBe('bad-model', name, what, matrix);
  const rows = numbers.length === 12 ? numbers : Array.from({ length: 12 }, (_, at) => numbers[(at >> 2) + 4 * (at & 3)]);
  const [a, b, c, , d, e, f, , g, h, i] = rows;
  if (a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) === 0) {
    throw new SoapfilmError('bad-model', `\`${name}\` makes space flat: its determinant is 0`);
  }
  return new AffineMap(rows);
}

/** Its 12 or 16 numbers, if these are what it holds. */
function numbersOf(matrix: unknown, name: string): number[] | undefined {
  return guarded('bad-model', name, () => {
    if (!Array.isArray(matrix) && !ArrayBuffer.isView(matrix)) return undefined;
    const { length } = matrix as ArrayLike<unknown>;
    if (!isIndex(length) || (length !== 12 && length !== 16)) return undefined;
    const numbers = Array.from({ length }, (_, i) => (matrix as ArrayLike<unknown>)[i]);
    return numbers.every((x): x is number => typeof x === 'number') ? numbers : undefined;
  });
}

/** Of a symmetric matrix of 3 rows, none of whose eigenvalues is negative: xx, xy, xz, yy, yz, zz. By its characteristic polynomial. */
function largestEigenvalue([a, b, c, d, e, f]: readonly number[]): number {
  const mean = (a + d + f) / 3;
  const [p, q, r] = [a - mean, d - mean, f - mean];
  const size = Math.sqrt((p * p + q * q + r * r + 2 * (b * b + c * c + e * e)) / 6);
  if (size === 0) return mean;
  const half = (p * (q * r - e * e) - b * (b * r - e * c) + c * (b * e - q * c)) / (2 * size ** 3);
  return mean + 2 * size * Math.cos(Math.acos(Math.min(1, Math.max(-1, half))) / 3);
}
