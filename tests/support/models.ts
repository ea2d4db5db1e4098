// Models of trimmed surfaces that are easy to know everything of.
import type { EdgeUse, Face, Mesh, Model, ModelEdge, ModelFace, NurbsCurve, NurbsSurface } from 'soapfilm/surfaces';

type Point = readonly number[];

export const lineOf = (...poles: Point[]): NurbsCurve => ({ degree: 1, knots: [0, 0, 1, 1], poles });

/** Bilinear, with corners in the order (0, 0), (0, 1), (1, 0), (1, 1) of parameters. */
export const patchOf = (...poles: Point[]): NurbsSurface => ({
  degreeU: 1,
  degreeV: 1,
  knotsU: [0, 0, 1, 1],
  knotsV: [0, 0, 1, 1],
  countU: 2,
  countV: 2,
  poles,
  weights: null,
});

/** The closed polygon through points of a domain. */
export const polygonOf = (points: readonly Point[]): NurbsCurve => {
  const poles = [...points, points[0]];
  const inner = points.map((_, i) => i / points.length);
  return { degree: 1, knots: [0, ...inner, 1, 1], poles };
};

/** The square of that side from the origin in the plane of x and y, with polygons for holes in its domain of 0 to 1. */
export function plate(holes: readonly (readonly Point[])[] = [], side = 1): Face {
  const corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
  const around = corners.map((from, i) => lineOf(from, corners[(i + 1) % 4]));
  const edges: ModelEdge[] = [...around, ...holes].map(() => ({ range: [0, 1], tolerance: 0 }));
  return {
    surface: patchOf([0, 0, 0], [0, side, 0], [side, 0, 0], [side, side, 0]),
    outer: 0,
    loops: [
      { uses: around.map((pcurve, edge) => ({ edge, pcurve })) },
      ...holes.map((hole, i) => ({ uses: [{ edge: 4 + i, pcurve: polygonOf(hole) }] })),
    ],
    edges,
  };
}

export const modelOf = ({ edges = [], ...face }: Face): Model => ({ schema: 'trimmed-nurbs/1', faces: [face], edges });

/** A box with one corner at the origin: 6 faces, 12 edges that two faces share each. */
export function box(x = 1, y = 1, z = 1): Model {
  const corner = (i: number): Point => [i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0];
  const edges: ModelEdge[] = [];
  const known = new Map<string, number>();
  const useOf = (a: number, b: number, pcurve: NurbsCurve): EdgeUse => {
    const key = [a, b].sort().join();
    const reversed = a > b;
    const edge = known.get(key) ?? edges.push({ range: [0, 1], tolerance: 0, curve3d: lineOf(corner(Math.min(a, b)), corner(Math.max(a, b))) }) - 1;
    known.set(key, edge);
    return { edge, reversed, pcurve: reversed ? lineOf(...[...pcurve.poles].reverse() as Point[]) : pcurve };
  };
  // Corners counter-clockwise seen from outside.
  const sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  const faces = sides.map((side): ModelFace => {
    const [a, b, c, d] = side.map(corner);
    const domain = [[0, 0], [1, 0], [1, 1], [0, 1]];
    const uses = side.map((from, i) => useOf(from, side[(i + 1) % 4], lineOf(domain[i], domain[(i + 1) % 4])));
    return { surface: patchOf(a, d, b, c), reversed: false, outer: 0, loops: [{ uses }] };
  });
  return { schema: 'trimmed-nurbs/1', faces, edges };
}

const kHalf = Math.SQRT1_2;

/** A round tube of that radius around z, from z = 0 to 1, that closes in u; without loops, or with them and a seam. */
export function tube(radius = 1, hasLoops = false): Model {
  const around = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
  const knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4];
  const weights = around.map((_, i) => (i % 2 ? kHalf : 1));
  const ring = (z: number): NurbsCurve => ({ degree: 2, knots, poles: around.map(([x, y]) => [radius * x, radius * y, z]), weights });
  const surface: NurbsSurface = {
    degreeU: 2,
    degreeV: 1,
    knotsU: knots,
    knotsV: [0, 0, 1, 1],
    countU: 9,
    countV: 2,
    poles: around.flatMap(([x, y]) => [0, 1].map((z) => [radius * x, radius * y, z])),
    weights: weights.flatMap((w) => [w, w]),
    domain: [0, 4, 0, 1],
  };
  if (!hasLoops) return { faces: [{ surface }], edges: [] };
  const across = (v: number): NurbsCurve => ({ degree: 1, knots: [0, 0, 4, 4], poles: [[0, v], [4, v]] });
  const along = (u: number): NurbsCurve => lineOf([u, 0], [u, 1]);
  const uses: EdgeUse[] = [
    { edge: 0, pcurve: across(0) },
    { edge: 2, seam: true, pcurve: along(4) },
    { edge: 1, reversed: true, pcurve: across(1) },
    { edge: 2, reversed: true, seam: true, pcurve: along(0) },
  ];
  const edges: ModelEdge[] = [
    { range: [0, 4], curve3d: ring(0) },
    { range: [0, 4], curve3d: ring(1) },
    { range: [0, 1], curve3d: lineOf([radius, 0, 0], [radius, 0, 1]) },
  ];
  return { faces: [{ surface, outer: 0, loops: [{ uses }] }], edges };
}

/** Area and volume within a mesh, and how many of its sides meet no other, once vertices at the same place are joined. */
export function measure({ positions, origin, triangles, same }: Pick<Mesh, 'positions' | 'origin' | 'triangles' | 'same'>) {
  const at = (vertex: number): number[] => [0, 1, 2].map((k) => positions[3 * vertex + k] + origin[k]);
  let [area, volume] = [0, 0];
  const sides = new Map<string, number>();
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = Array.from(triangles.subarray(t, t + 3));
    const [a, b, c] = corners.map(at);
    const [u, v] = [b, c].map((p) => p.map((x, k) => x - a[k]));
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    area += Math.hypot(...normal) / 2;
    volume += a[0] * normal[0] + a[1] * normal[1] + a[2] * normal[2];
    corners.forEach((corner, k) => {
      const [from, to] = [same[corner], same[corners[(k + 1) % 3]]];
      if (from === to) return;
      const key = from < to ? `${from} ${to}` : `${to} ${from}`;
      sides.set(key, (sides.get(key) ?? 0) + (from < to ? 1 : -1));
    });
  }
  return { area, volume: volume / 6, open: [...sides.values()].filter((count) => count !== 0).length };
}
