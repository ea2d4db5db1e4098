// Surfaces of three.js.
import { guarded, mustBe } from './check.js';
import type { Face } from './surface_types.js';

/** A `NURBSSurface` of `three/addons/curves/NURBSSurface.js`, whose types tell nothing of its fields. */
export interface ThreeSurface {
  getPoint(...args: never[]): unknown;
}

/** Control points are not multiplied by their weights `w`. */
interface Fields {
  readonly degree1: number;
  readonly degree2: number;
  readonly knots1: readonly number[];
  readonly knots2: readonly number[];
  readonly controlPoints: readonly (readonly { readonly x: number; readonly y: number; readonly z: number; readonly w: number }[])[];
}

/**
 * The face that is all of a surface of three.js.
 * @throws SoapfilmError `bad-model` if it is no such surface
 */
export function fromThree(nurbsSurface: ThreeSurface): Face {
  return guarded('bad-model', 'nurbsSurface', () => {
    const given: unknown = nurbsSurface;
    if (typeof given !== 'object' || given === null) throw mustBe('bad-model', 'nurbsSurface', 'a NURBSSurface of three.js', given);
    const { degree1, degree2, knots1, knots2, controlPoints } = given as Fields;
    const points = controlPoints.flatMap((row) => Array.from(row));
    return {
      surface: {
        degreeU: degree1,
        degreeV: degree2,
        knotsU: Array.from(knots1),
        knotsV: Array.from(knots2),
        countU: controlPoints.length,
        countV: controlPoints[0].length,
        poles: points.map(({ x, y, z }) => [x, y, z]),
        weights: points.some(({ w }) => w !== 1) ? points.map(({ w }) => w) : null,
      },
    };
  });
}
