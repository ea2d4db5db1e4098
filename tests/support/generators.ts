// Loops to test with: the same generators, fed by the same random numbers, as in
// tests/cpp/support/generators.h.
import type { LoopSet, Point } from 'soapfilm';

export type Loop = Point[];

/** Uniform numbers from a 32-bit xorshift (Marsaglia 2003), alike on every machine. */
export class Random {
  private state: number;

  constructor(seed: number) {
    this.state = (Math.imul(seed, 2654435769) + 0x6d2b79f5) | 0 || 1;
    for (let i = 0; i < 8; i++) this.bits();
  }
  bits(): number {
    this.state ^= this.state << 13;
    this.state ^= this.state >>> 17;
    this.state ^= this.state << 5;
    return this.state >>> 0;
  }
  below(n: number): number {
    return Math.floor((this.bits() * n) / 2 ** 32);
  }
  unit(): number {
    return this.bits() / 2 ** 32;
  }
  range(low: number, high: number): number {
    return low + (high - low) * this.unit();
  }
  chance(p: number): boolean {
    return this.unit() < p;
  }
  inCube(half: number): Point {
    return [this.range(-half, half), this.range(-half, half), this.range(-half, half)];
  }
  direction(): Point {
    for (;;) {
      const p = this.inCube(1);
      const r = Math.hypot(...p);
      if (r > 0.1 && r <= 1) return scale(1 / r, p);
    }
  }
}

export const add = (a: Point, b: Point): Point => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (s: number, a: Point): Point => [s * a[0], s * a[1], s * a[2]];
export const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Nested loops as flat arrays. */
export function loopSet(loops: readonly Loop[]): LoopSet {
  const starts = [0];
  for (const loop of loops) starts.push(starts[starts.length - 1] + loop.length);
  return {
    positions: Float64Array.from(loops.flat(2)),
    starts: Uint32Array.from(starts),
  };
}

const steps = (n: number, phase = 0): number[] =>
  Array.from({ length: n }, (_, i) => (2 * Math.PI * (i + phase)) / n);

export interface CircleOptions {
  r?: number;
  centre?: Point;
  /** Unit vector across the circle's plane. */
  axis?: Point;
}

/** n points at equal angles on a circle. */
export function circle(
  n: number,
  { r = 1, centre = [0, 0, 0], axis = [0, 0, 1] }: CircleOptions = {},
): Loop {
  const side: Point = Math.abs(axis[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const across = subtract(side, scale(dot(side, axis), axis));
  const u = scale(1 / Math.hypot(...across), across);
  const v = cross(axis, u);
  return steps(n).map((t) =>
    add(centre, scale(r, add(scale(Math.cos(t), u), scale(Math.sin(t), v)))),
  );
}

/** (cos t, sin t, cos(3t) / 2) at n equal steps. */
export const monkeySaddle = (n: number): Loop =>
  steps(n).map((t): Point => [Math.cos(t), Math.sin(t), Math.cos(3 * t) / 2]);

/** Rotation of p by an angle about a unit axis. */
export function rotate(p: Point, axis: Point, angle: number): Point {
  const along = scale(dot(axis, p), axis);
  const turned = add(
    scale(Math.cos(angle), subtract(p, along)),
    scale(Math.sin(angle), cross(axis, p)),
  );
  return add(along, turned);
}

/** k (at most 6) saddle curves facing outward at the corners of a regular octahedron, each turned
 * and moved a little. */
export function regularSaddles(k: number, n: number, random: Random): Loop[] {
  const corners: Point[] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [-1, 0, 0],
    [0, -1, 0],
    [0, 0, -1],
  ];
  return corners.slice(0, k).map((axis, c) => {
    const u = corners[(c + 1) % 3];
    const v = cross(axis, u);
    const tilt = random.direction();
    const angle = random.range(-0.2, 0.2);
    const centre = add(axis, random.inCube(0.05));
    return steps(n, 0.5).map((t) => {
      const inPlane = scale(0.5, add(scale(Math.cos(t), u), scale(Math.sin(t), v)));
      const p = add(inPlane, scale(0.15 * Math.cos(2 * t), axis));
      return add(centre, rotate(p, tilt, angle));
    });
  });
}

/** Loops of random points in unit cubes, each moved by `apart` along a direction of its own. */
export const randomLoops = (sizes: readonly number[], apart: number, random: Random): Loop[] =>
  sizes.map((size) => {
    const centre = scale(apart, random.direction());
    return Array.from({ length: size }, () => add(centre, random.inCube(0.5)));
  });

/** A circle whose points are moved by up to `noise`. */
export const noisyCircle = (n: number, noise: number, random: Random): Loop =>
  circle(n).map((p) => add(p, random.inCube(noise)));
