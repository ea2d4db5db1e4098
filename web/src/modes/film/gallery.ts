// The gallery: curves from formulas, each with the settings and the view that suit it.
import type { Point } from '../../shapes/vec.ts';
import { kPresets, type FilmSettings } from './settings.ts';

export interface Example {
  readonly id: string;
  readonly title: string;
  readonly note: string;
  readonly settings: FilmSettings;
  /** From the curves towards the viewer. */
  readonly view: Point;
  /** Values of the parameter that `curves` takes, the default one first; none if it takes none. */
  readonly variants?: { readonly label: string; readonly values: readonly number[] };
  curves(variant?: number): readonly (readonly Point[])[];
}

const weightsOf = (id: string) => (kPresets.find((preset) => preset.id === id) ?? kPresets[0]).weights;
const kSmooth: FilmSettings = { weights: weightsOf('smooth'), objective: 'sum', candidates: 'auto', smooth: 'none' };

/** A closed curve of `count` vertices at t = 0 … 2π. */
const closed = (count: number, at: (t: number) => Point): Point[] =>
  Array.from({ length: count }, (_, i) => at((2 * Math.PI * i) / count));

/** The six corners of an octahedron, opposite ones paired, each with two axes across. */
const kCorners: readonly (readonly [out: Point, u: Point, v: Point])[] = [
  [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
  [[0, 0, -1], [0, 1, 0], [1, 0, 0]],
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  [[-1, 0, 0], [0, 0, 1], [0, 1, 0]],
  [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
  [[0, -1, 0], [1, 0, 0], [0, 0, 1]],
];

function octahedronSaddles(k: number): Point[][] {
  // What keeps each of them within a few seconds.
  const count = [32, 24, 16, 10, 8][k - 2];
  return kCorners.slice(0, k).map(([out, u, v]) =>
    closed(count, (t) => {
      const [x, y, z] = [0.62 * Math.cos(t), 0.62 * Math.sin(t), 1.25 + 0.18 * Math.cos(2 * t)];
      return [
        x * u[0] + y * v[0] + z * out[0],
        x * u[1] + y * v[1] + z * out[1],
        x * u[2] + y * v[2] + z * out[2],
      ];
    }),
  );
}

/** A rounded rectangle around (cu, cv): a superellipse of half sizes a and b. */
const superellipse = (cu: number, cv: number, a: number, b: number, t: number): [number, number] => {
  const power = (x: number) => Math.sign(x) * Math.abs(x) ** 0.5;
  return [cu + a * power(Math.cos(t)), cv + b * power(Math.sin(t))];
};

/** The point (u, v) of a bumper: a sheet bent around a car's corner lines and bulging outward. */
function onBumper([u, v]: [number, number]): Point {
  const turn = 1.15 * u;
  const bulge = 1 + 0.1 * (1 - v * v);
  return [2 * bulge * Math.sin(turn), 1.6 - 1.5 * bulge * Math.cos(turn), 0.5 * v - 0.08 * u * u];
}

export const kGallery: readonly Example[] = [
  {
    id: 'facing-saddles',
    title: 'Two facing saddles',
    note: 'A sleeve between two wavy rings',
    settings: kSmooth,
    view: [1.2, -2, 0.75],
    curves: () =>
      [1, -1].map((side) =>
        closed(32, (t) => [Math.cos(t), Math.sin(t), side * (0.75 + 0.28 * Math.cos(2 * t))]),
      ),
  },
  {
    id: 'monkey-saddle',
    title: 'Monkey saddle',
    note: 'One curve, three valleys',
    settings: kSmooth,
    view: [0.6, -1.5, 1.5],
    curves: () => [closed(60, (t) => [Math.cos(t), Math.sin(t), 0.38 * Math.cos(3 * t)])],
  },
  {
    id: 'tennis-ball',
    title: 'Tennis-ball seam',
    note: 'One curve on a sphere, two ways to fill it',
    settings: kSmooth,
    view: [1.4, -1.5, 0.9],
    curves: () => [
      closed(64, (t) => [
        0.75 * Math.cos(t) + 0.25 * Math.cos(3 * t),
        0.75 * Math.sin(t) - 0.25 * Math.sin(3 * t),
        0.866 * Math.sin(2 * t),
      ]),
    ],
  },
  {
    id: 'octahedron',
    title: 'Saddles on an octahedron',
    note: 'Curves at its corners, one surface through all',
    settings: { ...kSmooth, candidates: 'delaunay' },
    view: [1.5, -1.9, 1.1],
    variants: { label: 'Curves', values: [3, 2, 4, 5, 6] },
    curves: (variant = 3) => octahedronSaddles(variant),
  },
  {
    id: 'nested-rings',
    title: 'Nested rings with an island',
    note: 'A wavy rim, an island inside, a small hole beside it',
    settings: { ...kSmooth, candidates: 'delaunay' },
    view: [0.7, -1.8, 1.5],
    curves: () => [
      closed(40, (t) => {
        const r = 2 + 0.16 * Math.cos(5 * t);
        return [r * Math.cos(t), r * Math.sin(t), 0.12 * Math.sin(3 * t)];
      }),
      closed(18, (t) => [-0.35 + 0.75 * Math.cos(t), 0.1 + 0.75 * Math.sin(t), 0.7 + 0.08 * Math.cos(2 * t)]),
      closed(12, (t) => [1.12 + 0.3 * Math.cos(t), -0.4 + 0.3 * Math.sin(t), 0.4 - 0.12 * Math.cos(t + 0.3)]),
    ],
  },
  {
    id: 'bumper',
    title: 'Bumper',
    note: 'A long bent strip with a grille cut out',
    settings: { ...kSmooth, candidates: 'delaunay' },
    view: [0.9, -2, 0.8],
    curves: () => [
      closed(72, (t) => onBumper(superellipse(0, 0, 1.15, 1.1, t))),
      closed(36, (t) => onBumper(superellipse(0, -0.1, 0.5, 0.45, t))),
    ],
  },
];
