// Polygons to test and to measure with: the generators of tests/cpp/support/polygon_generators.h,
// which take the same random numbers in the same order. Those without sines and cosines give the same
// coordinates to the last bit.
import { Random } from './generators.ts';

export type Point2 = [x: number, y: number];
export type Ring2 = Point2[];
/** Rings, the outer one first. */
export type Polygon2 = Ring2[];

const polar = (radius: number, angle: number, centre: Point2 = [0, 0]): Point2 => [
  centre[0] + radius * Math.cos(angle),
  centre[1] + radius * Math.sin(angle),
];
const indices = (n: number): number[] => Array.from({ length: n }, (_, i) => i);
const backwards = (n: number): number[] => indices(n).reverse();

export const areaOf = (ring: Ring2): number =>
  ring.reduce((sum, [x, y], i) => {
    const [u, v] = ring[(i + 1) % ring.length];
    return sum + (x * v - y * u) / 2;
  }, 0);

/** The area of a polygon whose holes lie inside it, however its rings run. */
export const polygonArea = ([outer, ...holes]: Polygon2): number =>
  holes.reduce((sum, hole) => sum - Math.abs(areaOf(hole)), Math.abs(areaOf(outer)));

export const regularRing = (n: number, radius: number, centre: Point2, turn = 0): Ring2 =>
  indices(n).map((i) => polar(radius, turn + (2 * Math.PI * i) / n, centre));

/** Random radii at random increasing angles. */
export const starRing = (
  n: number,
  roughness: number,
  random: Random,
  radius = 1,
  centre: Point2 = [0, 0],
): Ring2 =>
  indices(n).map((i) => {
    const angle = (2 * Math.PI * (i + 0.6 * random.unit())) / n;
    return polar(radius * (1 - roughness * 0.95 * random.unit()), angle, centre);
  });

/** A smooth curve about the origin. */
export function blobRing(n: number, random: Random): Ring2 {
  const waves = indices(4).map((k) => ({
    amplitude: random.range(0, 0.35 / (k + 1)),
    phase: random.range(0, 2 * Math.PI),
  }));
  return indices(n).map((i) => {
    const angle = (2 * Math.PI * i) / n;
    const radius = waves.reduce(
      (sum, { amplitude, phase }, k) => sum + amplitude * Math.cos((k + 1) * angle + phase),
      1,
    );
    return polar(radius, angle);
  });
}

/** Positive if c lies to the left of a → b. */
const turn = (a: Point2, b: Point2, c: Point2): number =>
  (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);

/** Moves the points that pass to the front of points[first, last), as std::partition does. */
function divide(points: Ring2, first: number, last: number, passes: (p: Point2) => boolean): number {
  for (;;) {
    while (first !== last && passes(points[first])) first++;
    if (first === last) return first;
    last--;
    while (first !== last && !passes(points[last])) last--;
    if (first === last) return first;
    [points[first], points[last]] = [points[last], points[first]];
    first++;
  }
}

/** Orders points[low..high], whose ends stay, as a chain of pieces with disjoint hulls. */
function partition(points: Ring2, low: number, high: number, random: Random): void {
  const todo: [number, number][] = [[low, high]];
  for (let next = todo.pop(); next; next = todo.pop()) {
    const [first, last] = next;
    if (last - first < 2) continue;
    const [a, b] = [points[first], points[last]];
    const chosen = first + 1 + random.below(last - first - 1);
    [points[first + 1], points[chosen]] = [points[chosen], points[first + 1]];
    const s = points[first + 1];
    const t = random.range(0.05, 0.95);
    const q: Point2 = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    const side = (p: Point2): number => Math.sign(turn(s, q, p));
    const sideOfA = side(a);
    if (sideOfA === 0 || side(b) !== -sideOfA) {
      todo.push([first, last]);
      continue;
    }
    const at = divide(points, first + 2, last, (p) => side(p) === sideOfA) - 1;
    [points[first + 1], points[at]] = [points[at], points[first + 1]];
    todo.push([first, at], [at, last]);
  }
}

/** A random polygon through n random points of the unit square, by space partition. */
export function partitionRing(n: number, random: Random): Ring2 {
  const points = indices(n).map((): Point2 => [random.unit(), random.unit()]);
  if (n < 4) return points;
  const [a, b] = points;
  const middle = divide(points, 2, n, (p) => turn(a, b, p) < 0);
  points.splice(1, 1);
  points.splice(middle - 1, 0, b);
  const at = middle - 1;
  points.push(a);
  partition(points, 0, at, random);
  partition(points, at, n, random);
  points.pop();
  return areaOf(points) < 0 ? points.reverse() : points;
}

/** Spikes upward on a common base. */
export const combRing = (teeth: number, random: Random): Ring2 => [
  [0, -0.5],
  [teeth, -0.5],
  ...backwards(teeth).flatMap((i): Ring2 => [
    [i + 0.95, random.range(-0.1, 0.1)],
    [i + random.range(0.3, 0.7), random.range(3, 5)],
    [i + 0.05, random.range(-0.1, 0.1)],
  ]),
];

/** Teeth up and down from a common bar. */
export const doubleCombRing = (teeth: number, random: Random): Ring2 => [
  ...indices(teeth).flatMap((i): Ring2 => [
    [i + 0.05, -0.5 + random.range(-0.1, 0.1)],
    [i + random.range(0.3, 0.7), random.range(-5, -3)],
    [i + 0.95, -0.5 + random.range(-0.1, 0.1)],
  ]),
  ...backwards(teeth).flatMap((i): Ring2 => [
    [i + 0.95, 0.5 + random.range(-0.1, 0.1)],
    [i + random.range(0.3, 0.7), random.range(3, 5)],
    [i + 0.05, 0.5 + random.range(-0.1, 0.1)],
  ]),
];

/** A corridor that winds between teeth from above and from below: every sag sees another gorge. */
export const interleavedCombRing = (teeth: number, random: Random): Ring2 => [
  [-1, 0],
  ...indices(teeth).flatMap((i): Ring2 => [
    [i - 0.1, random.range(-0.01, 0.01)],
    [i + random.range(-0.05, 0.05), random.range(8.5, 9.5)],
    [i + 0.1, random.range(-0.01, 0.01)],
  ]),
  [teeth, 0],
  [teeth, 10],
  ...backwards(teeth).flatMap((i): Ring2 => [
    [i + 0.6, 10 + random.range(-0.01, 0.01)],
    [i + random.range(0.45, 0.55), random.range(0.5, 1.5)],
    [i + 0.4, 10 + random.range(-0.01, 0.01)],
  ]),
  [-1, 10],
];

export function spiralRing(n: number, turns: number): Ring2 {
  const perTurn = Math.max(3, Math.floor(n / 2 / turns));
  const samples = Math.max(2, perTurn * turns);
  const at = (i: number, offset: number): Point2 =>
    polar(1 + i / perTurn + offset, (2 * Math.PI * (i % perTurn)) / perTurn);
  return [...indices(samples).map((i) => at(i, 0.5)), ...backwards(samples).map((i) => at(i, 0))];
}

/** A Koch snowflake of 3 · 4^levels vertices. */
export function kochRing(levels: number): Ring2 {
  let ring = regularRing(3, 1, [0, 0], 0.3);
  const h = Math.sqrt(3) / 2;
  for (let level = 0; level < levels; level++) {
    ring = ring.flatMap((a, i): Ring2 => {
      const b = ring[(i + 1) % ring.length];
      const [dx, dy] = [(b[0] - a[0]) / 3, (b[1] - a[1]) / 3];
      return [
        a,
        [a[0] + dx, a[1] + dy],
        [a[0] + 1.5 * dx + h * dy, a[1] + 1.5 * dy - h * dx],
        [a[0] + 2 * dx, a[1] + 2 * dy],
      ];
    });
  }
  return ring;
}

/** Rising steps on either side: collinear and equal coordinates. */
export const staircaseRing = (steps: number): Ring2 => [
  ...indices(steps).flatMap((i): Ring2 => [
    [i + 2, i],
    [i + 2, i + 1],
  ]),
  ...backwards(steps).flatMap((i): Ring2 => [
    [i, i + 1],
    [i, i],
  ]),
];

/** A zigzag band. */
export function zigzagRing(n: number, random: Random): Ring2 {
  const half = Math.max(2, Math.floor(n / 2));
  const heights = indices(half).map(() => random.range(-2, 2));
  return [
    ...indices(half).map((i): Point2 => [i, heights[i] - 0.3]),
    ...backwards(half).map((i): Point2 => [i, heights[i] + 0.3]),
  ];
}

const rectangle = (width: number, height: number): Ring2 => [
  [0, 0],
  [width, 0],
  [width, height],
  [0, height],
];

/** A rectangle with columns × rows square holes, each turned by its own angle unless aligned. */
export const holeGrid = (
  columns: number,
  rows: number,
  aligned: boolean,
  random: Random,
): Polygon2 => [
  rectangle(columns, rows),
  ...indices(rows).flatMap((j) =>
    indices(columns).map((i) => {
      const angle = aligned ? Math.PI / 4 : random.range(0, 2 * Math.PI);
      return regularRing(4, 0.45, [i + 0.5, j + 0.5], angle);
    }),
  ),
];

/** The same with stars for holes. */
export const starsInHoles = (
  columns: number,
  rows: number,
  corners: number,
  random: Random,
): Polygon2 => [
  rectangle(columns, rows),
  ...indices(rows).flatMap((j) =>
    indices(columns).map((i) => starRing(corners, 0.9, random, 0.48, [i + 0.5, j + 0.5])),
  ),
];

/** A blob, and the points of a columns × columns grid inside it that keep clear of its edges. */
export function blobWithGrid(
  samples: number,
  columns: number,
  random: Random,
): { polygon: Polygon2; inner: Point2[] } {
  const ring = blobRing(samples, random);
  const isInside = ([x, y]: Point2): boolean => {
    let inside = false;
    for (let i = 0; i < ring.length; i++) {
      const [a, b] = [ring[i], ring[(i + 1) % ring.length]];
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
      const cross = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
      if (Math.abs(cross) < 1e-6 * length) return false;
      if (a[1] > y !== b[1] > y && cross > 0 === b[1] > a[1]) inside = !inside;
    }
    return inside;
  };
  const at = (i: number): number => -2 + (4 * (i + 0.5)) / columns;
  const grid = indices(columns).flatMap((j) => indices(columns).map((i): Point2 => [at(i), at(j)]));
  return { polygon: [ring], inner: grid.filter(isInside) };
}

/** A random polygon of 5 to about 100 vertices of the kinds above. */
export function smallPolygon(random: Random): Polygon2 {
  const n = 5 + random.below(random.chance(0.2) ? 96 : 30);
  switch (random.below(12)) {
    case 0:
      return [starRing(n, random.unit(), random)];
    case 1:
      return [blobRing(n, random)];
    case 2:
      return [combRing(1 + Math.floor(n / 4), random)];
    case 3:
      return [doubleCombRing(1 + Math.floor(n / 6), random)];
    case 4:
      return [interleavedCombRing(1 + Math.floor(n / 6), random)];
    case 5:
      return [spiralRing(n, 1 + random.below(3))];
    case 6:
      return [staircaseRing(2 + Math.floor(n / 4))];
    case 7:
      return [zigzagRing(n, random)];
    case 8:
      return holeGrid(1 + random.below(3), 1 + random.below(3), random.chance(0.3), random);
    case 9:
      return starsInHoles(1 + random.below(2), 1 + random.below(2), 5 + Math.floor(n / 5), random);
    default:
      return [partitionRing(n, random)];
  }
}

/** Closed rings of random points that cross at will: on a coarse lattice if `lattice` is not 0. */
export const garbage = (
  rings: number,
  pointsEach: number,
  lattice: number,
  random: Random,
): Polygon2 =>
  indices(rings).map(() =>
    indices(pointsEach).map((): Point2 =>
      lattice > 0
        ? [random.below(lattice), random.below(lattice)]
        : [random.unit(), random.unit()],
    ),
  );

/** Flat arrays of a polygon. */
export function flatPolygon(polygon: Polygon2): { positions: Float64Array; starts: Uint32Array } {
  const starts = new Uint32Array(polygon.length + 1);
  polygon.forEach((ring, r) => (starts[r + 1] = starts[r] + ring.length));
  const positions = new Float64Array(2 * starts[polygon.length]);
  polygon.flat().forEach((point, v) => {
    positions.set(point, 2 * v);
  });
  return { positions, starts };
}
