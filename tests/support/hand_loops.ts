// Loops as hands draw them and scanners leave them. The same families as in tests/cpp/support/hand_loops.h.
import {
  add,
  circle,
  closedSurface,
  cross,
  dot,
  meshLoops,
  scale,
  subtract,
  type Loop,
  type Random,
} from './generators.js';
import type { Point } from 'soapfilm';

/**
 * - stroke: one closed stroke, its spacing jittered, noise of 0 to .2 of its radius, tilted
 * - pair, several: two strokes, one above the other; three to six around a centre
 * - self-approaching: horseshoes, gaps of some noise
 * - dense curve: smooth in space
 * - rims: of one mesh, of very different sizes
 * - many small: 20 to 40 loops of 3 to 8 vertices, flat or noisy
 */
export const kHands = [
  'stroke',
  'pair',
  'several',
  'self-approaching',
  'dense curve',
  'rims',
  'linked',
  'knot',
  'many small',
] as const;
export type Hand = (typeof kHands)[number];

const kTurn = 2 * Math.PI;

const normalDeviate = (random: Random): number =>
  Math.sqrt(-2 * Math.log(1 - random.unit())) * Math.cos(kTurn * random.unit());

/** n parameters from 0 to 1 round a loop, each moved by up to 30 % of a step. */
const places = (n: number, random: Random): number[] =>
  Array.from({ length: n }, (_, i) => (i + 0.3 * random.range(-1, 1)) / n);

/** Normal in each coordinate, with `noise` as its deviation: strong noise has loops insert vertices. */
const noisy = (loop: Loop, noise: number, random: Random): Loop =>
  loop.map((p) => p.map((x) => x + noise * normalDeviate(random)) as unknown as Point);

const someNoise = (random: Random): number => (random.chance(0.2) ? 0 : random.range(0, 0.2));

/**
 * A closed stroke of n points: radius 1 + Σ aₖ cos((k + 2)t + φₖ), k < 4, aₖ normal with deviation
 * .25 / (k + 1); noise in all coordinates; in the plane across `axis`.
 */
export function handStroke(n: number, noise: number, centre: Point, axis: Point, random: Random): Loop {
  const waves = [0, 1, 2, 3].map((k) => ({
    k,
    a: (0.25 / (k + 1)) * normalDeviate(random),
    phase: random.range(0, kTurn),
  }));
  const side: Point = Math.abs(axis[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const across = subtract(side, scale(dot(side, axis), axis));
  const u = scale(1 / Math.hypot(...across), across);
  const v = cross(axis, u);
  const loop = places(n, random).map((s): Point => {
    const t = kTurn * s;
    const r = waves.reduce((sum, { k, a, phase }) => sum + a * Math.cos((k + 2) * t + phase), 1);
    return add(centre, add(scale(r * Math.cos(t), u), scale(r * Math.sin(t), v)));
  });
  return noisy(loop, noise, random);
}

function horseshoe(n: number, random: Random): Loop {
  const gap = random.range(0.02, 0.4);
  const turn = random.range(1, 1.9) * Math.PI;
  const width = random.range(0.05, 0.5);
  const loop = places(n, random).map((t): Point => {
    const isBack = t >= 0.5;
    const along = isBack ? 2 - 2 * t : 2 * t;
    const r = 1 + (isBack ? width : 0) + gap * Math.sin(7 * along);
    return [r * Math.cos(turn * along), r * Math.sin(turn * along), 0.3 * along * along];
  });
  return noisy(loop, random.unit() * Math.min(width, kTurn / n), random);
}

function denseCurve(n: number, random: Random): Loop {
  const triple = (k: number): Point => {
    const size = 1 / ((k + 1) * (k + 1));
    return [0, 0, 0].map(() => size * normalDeviate(random)) as unknown as Point;
  };
  const waves = [0, 1, 2, 3].map((k) => [triple(k), triple(k)] as const);
  return Array.from({ length: n }, (_, i) =>
    waves.reduce<Point>(
      (p, [a, b], k) => {
        const t = (kTurn * (k + 1) * i) / n;
        return add(p, add(scale(Math.cos(t), a), scale(Math.sin(t), b)));
      },
      [0, 0, 0],
    ),
  );
}

function torusKnot(n: number, random: Random): Loop {
  const kinds = [
    [2, 3],
    [3, 2],
    [2, 5],
    [3, 4],
  ] as const;
  const [p, q] = kinds[random.below(4)];
  const loop = places(n, random).map((s): Point => {
    const t = kTurn * s;
    const r = 1 + 0.4 * Math.cos(q * t);
    return [r * Math.cos(p * t), r * Math.sin(p * t), 0.4 * Math.sin(q * t)];
  });
  return noisy(loop, 0.2 * someNoise(random), random);
}

function manySmall(random: Random): Loop[] {
  const k = 20 + random.below(21);
  const side = Math.ceil(Math.cbrt(k));
  const isFlat = random.chance(0.4);
  const noise = isFlat ? 0 : random.range(0, 0.07);
  return Array.from({ length: k }, (_, c) => {
    const centre: Point = isFlat
      ? [c % 7, Math.floor(c / 7), 0]
      : [c % side, Math.floor(c / side) % side, Math.floor(c / side / side)];
    const axis: Point = isFlat ? [0, 0, 1] : random.direction();
    return noisy(circle(3 + random.below(6), { r: 0.35, centre, axis }), noise, random);
  });
}

/** Loops of one kind with about `size` vertices in all, at least 3 each. */
export function handLoops(kind: Hand, size: number, random: Random): Loop[] {
  const n = Math.max(3, size);
  const z: Point = [0, 0, 1];
  const noise = someNoise(random);
  switch (kind) {
    case 'stroke':
      return [handStroke(n, noise, [0, 0, 0], z, random)];
    case 'pair': {
      const first = Math.max(3, Math.floor(n * random.range(0.2, 0.8)));
      return [
        handStroke(first, noise, [0, 0, 0], z, random),
        handStroke(Math.max(3, n - first), noise, [0, 0, 1.2], z, random),
      ];
    }
    case 'several': {
      const k = 3 + random.below(4);
      return Array.from({ length: k }, (_, c) => {
        const t = (kTurn * (c + 0.3 * random.unit())) / k;
        const axis: Point = [Math.cos(t), Math.sin(t), 0];
        return handStroke(Math.max(3, Math.floor(n / k)), noise, scale(1.6 + 0.3 * k, axis), axis, random);
      });
    }
    case 'self-approaching':
      return [horseshoe(n, random)];
    case 'dense curve':
      return [denseCurve(n, random)];
    case 'rims': {
      const large = Math.max(3, Math.floor(0.7 * n));
      return meshLoops(closedSurface(3, random), [large, Math.max(3, Math.floor(0.2 * n)), 3], random);
    }
    case 'linked':
      return [0, 1].map((c) =>
        noisy(
          circle(Math.max(3, Math.floor(n / 2)), {
            centre: [1.1 * c, 0.01 * c, 0.02],
            axis: c === 0 ? [0, 0, 1] : [0, 1, 0],
          }),
          0.3 * noise,
          random,
        ),
      );
    case 'knot':
      return [torusKnot(n, random)];
    case 'many small':
      return manySmall(random);
  }
}
