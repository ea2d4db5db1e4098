// The loop around all of a surface, for faces whose holes alone are given.
import type { EdgeUse, ModelEdge, NurbsCurve, NurbsSurface } from './surface_types.js';

type Poles = NurbsSurface['poles'];

/** How far poles may be apart and count as one place, as a share of the largest coordinate. */
const kSamePlace = 1e-9;

/**
 * The uses of the loop counter-clockwise around a surface, and their edges, numbered from `firstEdge`. Where the surface closes
 * two sides are one edge; where a side is a pole its edge is degenerate.
 */
export function loopAround(surface: NurbsSurface, firstEdge: number): { uses: EdgeUse[]; edges: ModelEdge[] } {
  const { degreeU, degreeV, knotsU, knotsV, countU, countV, poles } = surface;
  const [u0, u1, v0, v1] = [knotsU[degreeU], knotsU[countU], knotsV[degreeV], knotsV[countV]] as number[];
  const row = (iv: number): Poles => Array.from({ length: countU }, (_, iu) => poles[iu * countV + iv]);
  const column = (iu: number): Poles => poles.slice(iu * countV, (iu + 1) * countV);
  const corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]];
  // South and east as they run, north and west against that.
  const sides = [row(0), column(countU - 1), row(countV - 1), column(0)];
  const slack = kSamePlace * Math.max(...poles.flatMap((pole) => Array.from(pole, (x) => Math.abs(x ?? 0))));
  const edges: ModelEdge[] = [];
  const uses: EdgeUse[] = [];
  const edgeOf: number[] = [];
  sides.forEach((side, k) => {
    const degenerate = side.every((pole) => isNear(pole, side[0], slack));
    const closes = k >= 2 && !degenerate && side.every((pole, i) => isNear(pole, sides[k - 2][i], slack));
    const [from, to] = [corners[k], corners[(k + 1) % 4]];
    if (closes) {
      edgeOf.push(edgeOf[k - 2]);
      uses[k - 2] = { ...uses[k - 2], seam: true };
      uses.push({ edge: edgeOf[k], reversed: true, seam: true, pcurve: line(to, from) });
    } else {
      edgeOf.push(firstEdge + edges.length);
      edges.push({ degenerate, range: [0, 1] });
      uses.push({ edge: edgeOf[k], pcurve: line(from, to) });
    }
  });
  return { uses, edges };
}

const isNear = (a: ArrayLike<number | null>, b: ArrayLike<number | null>, slack: number): boolean =>
  [0, 1, 2].every((i) => Math.abs((a[i] ?? NaN) - (b[i] ?? NaN)) <= slack);

const line = (from: readonly number[], to: readonly number[]): NurbsCurve => ({ degree: 1, knots: [0, 0, 1, 1], poles: [from, to] });
