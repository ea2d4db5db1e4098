// A few models to begin with, made by formulas.
import type { Face, Model, ModelFace, NurbsCurve } from 'soapfilm/surfaces';
import type { Point } from '../../shapes/vec.ts';
import { teapot } from './teapot.ts';

export interface Example {
  readonly title: string;
  /** From the model towards the viewer. */
  readonly view: Point;
  readonly model: () => Model;
}

type Uv = readonly [u: number, v: number];

const kAround: readonly Uv[] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
const kQuarters = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4];
const weightOf = (k: number): number => (k % 2 ? Math.SQRT1_2 : 1);

/** A circle of the plane, of four quarters, from 0 to 4. */
const circle = ([x, y]: Uv, a: number, b = a): NurbsCurve => ({
  degree: 2,
  knots: kQuarters,
  poles: kAround.map(([u, v]) => [x + a * u, y + b * v]),
  weights: kAround.map((_, k) => weightOf(k)),
});
const lifted = (flat: NurbsCurve, z: number): NurbsCurve => ({ ...flat, poles: flat.poles.map(([x, y]) => [x as number, y as number, z]) });
const segment = (from: Uv, to: Uv, a: number, b: number): NurbsCurve => ({ degree: 1, knots: [a, a, b, b], poles: [from, to] });

/** A smooth closed curve through the control points of a ring, of degree 3, unclamped. */
function ring(middle: Uv, radiusAt: (angle: number) => number, count: number): NurbsCurve {
  const poles = Array.from({ length: count + 3 }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    const r = radiusAt(angle);
    return [middle[0] + r * Math.cos(angle), middle[1] + r * Math.sin(angle)];
  });
  return { degree: 3, knots: Array.from({ length: count + 7 }, (_, k) => k), poles };
}
const rangeOf = ({ degree, knots, poles }: NurbsCurve): [number, number] => [knots[degree] as number, knots[poles.length] as number];

/** A surface of degree 3 in both directions over [0, 1]², poles from a formula. */
function bicubic(rows: number, columns: number, at: (s: number, t: number) => Point): ModelFace['surface'] {
  const knots = (count: number): number[] => [0, 0, 0, ...Array.from({ length: count - 2 }, (_, k) => k / (count - 3)), 1, 1, 1];
  const poles = Array.from({ length: rows * columns }, (_, k) => at(Math.floor(k / columns) / (rows - 1), (k % columns) / (columns - 1)));
  return { degreeU: 3, degreeV: 3, knotsU: knots(rows), knotsV: knots(columns), countU: rows, countV: columns, poles };
}

/** A face over [0, 1]² with holes, all of whose edges are its own. */
function sheet(surface: ModelFace['surface'], holes: readonly NurbsCurve[], reversed = false): Face {
  const corners: readonly Uv[] = [[0, 0], [1, 0], [1, 1], [0, 1]];
  return {
    surface,
    reversed,
    edges: [...corners.map(() => ({ range: [0, 1] })), ...holes.map((hole) => ({ range: rangeOf(hole) }))],
    loops: [
      { uses: corners.map((corner, k) => ({ edge: k, pcurve: segment(corner, corners[(k + 1) % 4], 0, 1) })) },
      ...holes.map((pcurve, k) => ({ uses: [{ edge: 4 + k, pcurve }] })),
    ],
  };
}

const modelOf = ({ edges = [], ...face }: Face): Model => ({ faces: [face], edges });

const lobed = (middle: Uv, r: number, lobes: number): NurbsCurve => ring(middle, (a) => r * (1 + 0.3 * Math.cos(lobes * a)), 8 * lobes);

function shell(): Model {
  const surface = bicubic(9, 9, (s, t) => {
    const angle = Math.PI * (1.1 * s - 0.05);
    const r = 1 + 0.25 * Math.sin(2 * Math.PI * t) + 0.1 * Math.cos(3 * angle);
    return [4 * t - 2, -r * Math.cos(angle), r * Math.sin(angle)];
  });
  const windows = [0.2, 0.5, 0.8].flatMap((u) => [0.25, 0.75].map((v) => lobed([u, v], 0.07, u === 0.5 ? 4 : 3)));
  return modelOf(sheet(surface, windows, true));
}

function waves(): Model {
  const surface = bicubic(12, 12, (s, t) => [6 * s - 3, 6 * t - 3, 0.5 * Math.sin(9 * s) * Math.cos(7 * t)]);
  const holes = [0, 1, 2, 3, 4].flatMap((i) => [0, 1, 2, 3, 4].map((j) => lobed([0.12 + 0.19 * i, 0.12 + 0.19 * j], 0.055, 2 + ((i + 2 * j) % 4))));
  return modelOf(sheet(surface, holes));
}

/** A cylinder with two holes bored through its side, and discs at its ends: six edges that faces share. */
function cylinder(): Model {
  const [radius, height] = [1, 3];
  const flat = circle([0, 0], radius);
  const side: ModelFace['surface'] = {
    degreeU: 2,
    degreeV: 1,
    knotsU: kQuarters,
    knotsV: [0, 0, height, height],
    countU: 9,
    countV: 2,
    poles: kAround.flatMap(([x, y]) => [[radius * x, radius * y, 0], [radius * x, radius * y, height]]),
    weights: kAround.flatMap((_, k) => [weightOf(k), weightOf(k)]),
  };
  const disc = (z: number): ModelFace['surface'] => ({
    degreeU: 1,
    degreeV: 1,
    knotsU: [-2, -2, 2, 2],
    knotsV: [-2, -2, 2, 2],
    countU: 2,
    countV: 2,
    poles: [[-2, -2, z], [-2, 2, z], [2, -2, z], [2, 2, z]],
  });
  const holes = [circle([1.3, 1.1], 0.32, 0.5), circle([2.9, 2], 0.25, 0.4)];
  return {
    faces: [
      {
        surface: side,
        loops: [
          {
            uses: [
              { edge: 0, pcurve: segment([0, 0], [4, 0], 0, 4) },
              { edge: 2, seam: true, pcurve: segment([4, 0], [4, height], 0, height) },
              { edge: 1, reversed: true, pcurve: segment([0, height], [4, height], 0, 4) },
              { edge: 2, seam: true, reversed: true, pcurve: segment([0, 0], [0, height], 0, height) },
            ],
          },
          ...holes.map((pcurve, k) => ({ uses: [{ edge: 3 + k, pcurve }] })),
        ],
      },
      { surface: disc(height), loops: [{ uses: [{ edge: 1, pcurve: flat }] }] },
      { surface: disc(0), reversed: true, loops: [{ uses: [{ edge: 0, pcurve: flat }] }] },
    ],
    edges: [
      { range: [0, 4], curve3d: lifted(flat, 0) },
      { range: [0, 4], curve3d: lifted(flat, height) },
      { range: [0, height], curve3d: { degree: 1, knots: [0, 0, height, height], poles: [[radius, 0, 0], [radius, 0, height]] } },
      ...holes.map(() => ({ range: [0, 4] })),
    ],
  };
}

/** A torus without loops: faces are then all of their surface. */
function torus(): ModelFace {
  const poles = kAround.flatMap(([x, y]) => kAround.map(([r, z]) => [(1 + 0.4 * r) * x, (1 + 0.4 * r) * y, 0.4 * z]));
  const weights = kAround.flatMap((_, i) => kAround.map((__, k) => weightOf(i) * weightOf(k)));
  return { surface: { degreeU: 2, degreeV: 2, knotsU: kQuarters, knotsV: kQuarters, countU: 9, countV: 9, poles, weights } };
}

function assembly(): Model {
  const ring = { faces: [torus()], edges: [] };
  const post = cylinder();
  const instances = Array.from({ length: 6 }, (_, k) => {
    const angle = (Math.PI * k) / 3;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const size = 0.5 + 0.12 * k;
    return [
      { part: post, matrix: [c, -s, 0, 6 * c, s, c, 0, 6 * s, 0, 0, size, 0] },
      { part: ring, matrix: [1.1, 0, 0, 6 * c, 0, 1.1, 0, 6 * s, 0, 0, 1.1, 3 * size + 0.3] },
    ];
  }).flat();
  return { instances: [...instances, { part: shell(), matrix: [1.6, 0, 0, 0, 0, 1.6, 0, 0, 0, 0, 1.6, 0] }] };
}

/** With a window in each quarter of its belly. */
function pierced(): Model {
  const window = (curve: NurbsCurve) => ({ curve, range: rangeOf(curve) });
  return teapot((patch) => (patch >= 4 && patch < 8 ? window(lobed([0.5, 0.5], 0.2, 3 + (patch % 3))) : null));
}

export const kExamples: readonly Example[] = [
  { title: 'Drilled cylinder', view: [-1.6, 1.2, 0.8], model: cylinder },
  { title: 'Teapot', view: [0.5, -1.4, 0.7], model: pierced },
  { title: 'Lofted shell', view: [0.6, -1.2, 1.1], model: shell },
  { title: 'Waves', view: [0.5, -1, 1.3], model: waves },
  { title: 'Assembly', view: [0.4, -1.4, 0.9], model: assembly },
];
