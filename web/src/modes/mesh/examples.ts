// A few meshes with holes to begin with, made by formulas.
import { cross, dot, normalize, scale, subtract, add, length, type Point } from '../../shapes/vec.ts';
import type { MeshShape } from './settings.ts';

export interface Example {
  readonly title: string;
  /** From the mesh towards the viewer. */
  readonly view: Point;
  readonly shape: () => MeshShape;
}

/** A point, or a colour, for two parameters from 0 to 1. */
type OfParameters = (s: number, t: number) => Point;

/** Says whether the surface is missing at a point. */
type Cut = (p: Point) => boolean;

/** Faces within `radius` of a point are missing, but for islands: those within theirs, at some distance from there. */
function hole(at: Point, radius: number, wave: number, ...islands: readonly (readonly [along: number, across: number, radius: number])[]): Cut {
  const out = normalize(at);
  const u = normalize(cross(out, Math.abs(out[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  const v = cross(out, u);
  return (p) => {
    const from = subtract(p, at);
    const [x, y] = [dot(from, u), dot(from, v)];
    if (length(from) > 2 * radius) return false;
    const rim = radius * (1 + wave * Math.cos(5 * Math.atan2(y, x)));
    return Math.hypot(x, y) < rim && !islands.some(([a, b, r]) => Math.hypot(x - a * radius, y - b * radius) < r * radius);
  };
}

/** A grid of points over parameters, closed along the first and, where said so, along the second; what is cut is missing. */
function grid(rows: number, columns: number, isClosed: boolean, at: OfParameters, cuts: readonly Cut[], paint?: OfParameters): MeshShape {
  const last = isClosed ? columns : columns - 1;
  const over = (of: OfParameters) => Array.from({ length: rows * columns }, (_, v) => of(Math.floor(v / columns) / rows, (v % columns) / last));
  const points = over(at);
  const kept: number[] = [];
  for (let i = 0; i < rows; i++) {
    for (let j = 0; j < last; j++) {
      const [a, b] = [i * columns + j, i * columns + ((j + 1) % columns)];
      const [c, d] = [((i + 1) % rows) * columns + j, ((i + 1) % rows) * columns + ((j + 1) % columns)];
      for (const face of [[a, c, b], [b, c, d]]) {
        const middle = scale(face.map((vertex) => points[vertex]).reduce(add), 1 / 3);
        if (!cuts.some((cut) => cut(middle))) kept.push(...face);
      }
    }
  }
  const numbers = new Map<number, number>();
  const faces = Uint32Array.from(kept, (vertex) => {
    const number = numbers.get(vertex) ?? numbers.size;
    numbers.set(vertex, number);
    return number;
  });
  const own = (of: readonly Point[]) => new Float32Array([...numbers.keys()].flatMap((vertex) => of[vertex]));
  return { positions: own(points), faces, ...(paint && { attributes: { color: { data: own(over(paint)), size: 3 } } }) };
}

/** A point of a bumpy torus. */
function onTorus(s: number, t: number): Point {
  const [u, v] = [2 * Math.PI * s, 2 * Math.PI * t];
  const r = 0.42 + 0.035 * Math.cos(6 * u) * Math.cos(3 * v) + 0.02 * Math.sin(9 * u + 2 * v);
  return [(1 + r * Math.cos(v)) * Math.cos(u), (1 + r * Math.cos(v)) * Math.sin(u), r * Math.sin(v)];
}

/** A point of a pot, from its bottom's rim to its mouth. */
function onPot(s: number, t: number): Point {
  const u = 2 * Math.PI * s;
  const r = (0.55 + 0.35 * Math.sin(2.6 * t + 0.35)) * (1 + 0.025 * Math.cos(8 * u));
  return [r * Math.cos(u), r * Math.sin(u), 1.7 * t - 0.85];
}

/** A point of a tube around a trefoil knot. */
function onKnot(s: number, t: number): Point {
  const [u, v] = [2 * Math.PI * s, 2 * Math.PI * t];
  const out = 2 + Math.cos(3 * u);
  const along: Point = [
    -3 * Math.sin(3 * u) * Math.cos(2 * u) - 2 * out * Math.sin(2 * u),
    -3 * Math.sin(3 * u) * Math.sin(2 * u) + 2 * out * Math.cos(2 * u),
    3 * Math.cos(3 * u),
  ];
  const aside = normalize(cross(along, [0, 0, 1]));
  const up = normalize(cross(aside, along));
  const r = 0.55 * (1 + 0.06 * Math.sin(12 * u + v));
  return add([out * Math.cos(2 * u), out * Math.sin(2 * u), Math.sin(3 * u)], add(scale(aside, r * Math.cos(v)), scale(up, r * Math.sin(v))));
}

/** The colours of a rainbow along the tube, between pale stripes that wind round it. */
function rainbow(s: number, t: number): Point {
  const [u, v] = [2 * Math.PI * s, 2 * Math.PI * t];
  const pale = 0.5 + 0.5 * Math.tanh(4 * (Math.cos(9 * u + v) - 0.7));
  const [r, g, b] = [0, 1, 2].map((k) => 0.5 + 0.45 * Math.cos(u - (2 * Math.PI * k) / 3) * (1 - pale) + 0.4 * pale);
  return [r, g, b];
}

export const kExamples: readonly Example[] = [
  {
    title: 'Torn torus',
    view: [0.55, -1.6, 1.35],
    shape: () =>
      grid(130, 50, true, onTorus, [
        hole(onTorus(0.75, 0.21), 0.27, 0.1, [0.1, 0.05, 0.42]),
        hole(onTorus(0.9, 0.14), 0.16, 0.12),
        hole(onTorus(0.61, 0.2), 0.17, 0.08),
        hole(onTorus(0.67, 0.98), 0.16, 0.05, [0, 0, 0.4]),
        hole(onTorus(0.83, 0.97), 0.13, 0.1),
        hole(onTorus(0.13, 0.2), 0.3, 0.08, [-0.4, 0.2, 0.25], [0.35, -0.2, 0.3]),
        hole(onTorus(0.36, 0.25), 0.15, 0.15),
        ([x, y]) => x < 0 && Math.abs(y + 0.05 * Math.cos(12 * x)) < 0.09,
      ]),
  },
  {
    title: 'Pot with a mouth',
    view: [0.9, -1.9, 0.8],
    shape: () =>
      grid(96, 56, false, onPot, [
        hole(onPot(0.72, 0.5), 0.3, 0.1, [-0.3, 0.1, 0.32], [0.45, 0, 0.2]),
        hole(onPot(0.88, 0.75), 0.13, 0.1),
        hole(onPot(0.6, 0.22), 0.12, 0.1),
        hole(onPot(0.3, 0.5), 0.35, 0.05),
      ]),
  },
  {
    title: 'Painted knot',
    view: [0.4, -1.1, 2],
    shape: () =>
      grid(
        260,
        36,
        true,
        onKnot,
        [
          hole(onKnot(0.02, 0.2), 0.55, 0.1, [0.1, 0, 0.35]),
          hole(onKnot(0.2, 0.3), 0.45, 0.12),
          hole(onKnot(0.42, 0.22), 0.4, 0.1),
          hole(onKnot(0.58, 0.28), 0.5, 0.1),
          hole(onKnot(0.77, 0.2), 0.5, 0.08, [-0.2, 0.1, 0.3]),
          hole(onKnot(0.9, 0.95), 0.35, 0.15),
        ],
        rainbow,
      ),
  },
];
