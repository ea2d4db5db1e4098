// What `npm run bench` measures: the one list of cases, for the native program and for WebAssembly.
// Inputs come from the generators of tests/support, or are curve files on which the program of the
// paper's authors was measured.
import {
  add,
  closedSurface,
  closedWalk,
  harmonicLoop,
  manySaddles,
  meshLoops,
  monkeySaddle,
  Random,
  randomLoops,
  regularSaddles,
  scale,
  withNoise,
  type Loop,
} from '../support/generators.ts';

/** What to reach, or what another program took. */
export interface Figures {
  readonly seconds: number;
  readonly megabytes: number;
}

/** Limits and the wish for the best surface within them. */
export interface Limits {
  readonly maxSeconds: number;
  readonly maxMemoryBytes: number;
}

export interface Case {
  /** Unique; words of the command line are looked for in it. */
  readonly id: string;
  /** Cases of one series differ in size alone: their times give a scaling exponent. Null: of none. */
  readonly series: string | null;
  /** A curve file below tests, or loops to write into one of that name. */
  readonly curves: string;
  readonly loops?: readonly Loop[];
  readonly k: number;
  /** Vertices, of all loops together. */
  readonly n: number;
  readonly space: 'auto' | 'all' | 'delaunay' | 'near';
  readonly objective: 'sum' | 'worst-dihedral';
  /** Weights of area, perimeter and dihedral; null: the default ones. */
  readonly weights: readonly [number, number, number] | null;
  /** Return the best surface within these limits. */
  readonly bestSoFar?: Limits;
  readonly goal?: Figures;
  /** The program of the paper's authors, on the same input. */
  readonly authors?: Figures;
}

type Weighing = 'dihedral' | 'area' | 'worst' | 'default';
type Space = Case['space'];

const kWeights: Record<Weighing, Case['weights']> = {
  dihedral: [0, 0, 1],
  area: [1, 0, 0],
  worst: [0, 0, 1],
  default: null,
};

function make(
  family: string,
  size: string,
  input: { readonly curves: string; readonly loops?: readonly Loop[]; k: number; n: number },
  space: Space,
  weighing: Weighing,
  more: Partial<Case> = {},
): Case {
  const kind = `${space} ${weighing}`;
  return {
    id: `${family} ${size} ${kind}`,
    series: space === 'auto' ? null : `${family} ${input.k} ${kind}`,
    ...input,
    space,
    objective: weighing === 'worst' ? 'worst-dihedral' : 'sum',
    weights: kWeights[weighing],
    ...more,
  };
}

function generated(name: string, loops: readonly Loop[]) {
  return { curves: name, loops, k: loops.length, n: loops.flat().length };
}

type Goals = Readonly<Record<string, readonly [seconds: number, megabytes: number]>>;

/** To reach, by size, space and weights; "12 x 10" is 12 loops of 10 vertices each. */
const kGoals: Goals = {
  '1x100 all dihedral': [0.03, 10],
  '1x400 all dihedral': [2.5, 100],
  '1x1000 all area': [1.2, 40],
  '1x2000 delaunay dihedral': [0.06, 20],
  '1x100000 delaunay dihedral': [5, 250],
  '2x20 all dihedral': [0.4, 30],
  '2x40 all dihedral': [15, 100],
  '3x6 all dihedral': [1, 100],
  '2x100 delaunay dihedral': [0.06, 20],
  '2x250 delaunay dihedral': [0.5, 60],
  '3x60 delaunay dihedral': [0.2, 40],
  '6x10 delaunay dihedral': [2, 200],
  '1x2000 near default': [1, 250],
};

function withGoal(size: string, space: Space, weighing: Weighing): Partial<Case> {
  const key = `${size} ${space} ${weighing}`;
  if (!(key in kGoals)) return {};
  const [seconds, megabytes] = kGoals[key];
  return { goal: { seconds, megabytes } };
}

/** Monkey saddles, uniformly sampled (section 4.1 of the paper, figure 7). */
function monkeys(space: Space, weighing: Weighing, sizes: readonly number[]): Case[] {
  return sizes.map((n) => {
    const size = `1x${n}`;
    const input = generated(`monkey_${n}`, [monkeySaddle(n)]);
    return make('monkey', size, input, space, weighing, withGoal(size, space, weighing));
  });
}

/** The same poses for every size. */
const kPoses = 1;

/** k saddles of n vertices each at corners of an octahedron (figure 8). */
function saddles(k: number, space: Space, sizes: readonly number[], pose = kPoses): Case[] {
  const family = pose === kPoses ? 'saddles' : `saddles (pose ${pose})`;
  return sizes.map((n) => {
    const size = `${k}x${n}`;
    const input = generated(`saddles_${pose}_${size}`, regularSaddles(k, n, new Random(pose)));
    return make(family, size, input, space, 'dihedral', withGoal(size, space, 'dihedral'));
  });
}

/** Jagged loops along the edges of a closed surface (figure 9). */
function meshCases(): Case[] {
  const inputs = [100, 200, 400].map((n, i) => {
    const random = new Random(100 + i);
    return { size: `1x${n}`, loops: meshLoops(closedSurface(5, random), [n], random) };
  });
  const random = new Random(200);
  inputs.push({ size: '2x15', loops: meshLoops(closedSurface(3, random), [15, 15], random) });
  const spaces: Space[] = ['all', 'near', 'delaunay', 'auto'];
  return inputs.flatMap(({ size, loops }) =>
    spaces.map((space) => {
      const weighing = space === 'auto' ? 'default' : 'dihedral';
      return make('mesh', size, generated(`mesh_${size}`, loops), space, weighing);
    }),
  );
}

/** A long noisy loop, for which all triples are too many. */
function noisyCases(): Case[] {
  const random = new Random(500);
  const loop = withNoise(harmonicLoop(2000, 4, random), 0.5, random);
  const input = generated('noisy_2000', [loop]);
  return [make('noisy', '1x2000', input, 'near', 'default', withGoal('1x2000', 'near', 'default'))];
}

/** Many loops: the best surface within limits of time and memory. */
function manyLoops(): Case[] {
  return [8, 12].map((k) => {
    const input = generated(`many_${k}x10`, manySaddles(k, 10, new Random(kPoses)));
    const limits = { maxSeconds: 10, maxMemoryBytes: 1e9 };
    return make('many', `${k}x10`, input, 'delaunay', 'dihedral', { bestSoFar: limits });
  });
}

/** Committed inputs, and the seconds and megabytes of the authors' program where it has ended. */
const kAuthors: readonly [string, Space, Weighing, number, number?, number?][] = [
  ['monkey_50', 'all', 'dihedral', 50, 1.06, 40.6],
  ['monkey_100', 'all', 'dihedral', 100, 20.3, 162.7],
  ['monkey_150', 'all', 'dihedral', 150, 124.6, 639.8],
  ['monkey_100', 'all', 'area', 100, 19.4, 72.9],
  ['monkey_500', 'delaunay', 'dihedral', 500, 0.0865, 33.8],
  ['saddle2_10', 'all', 'dihedral', 20, 3.07, 67.5],
  ['saddle2_15', 'all', 'dihedral', 30, 66.6, 478.3],
  ['saddle2_20', 'all', 'dihedral', 40],
  ['saddle2_40', 'all', 'dihedral', 80],
  ['saddle3_4', 'all', 'dihedral', 12, 1.43, 62.0],
  ['saddle3_5', 'all', 'dihedral', 15, 16.4, 384.8],
  ['saddle2_100', 'delaunay', 'dihedral', 200, 0.17, 36],
  ['saddle2_250', 'delaunay', 'dihedral', 500, 5.4, 162.2],
  ['saddle3_40', 'delaunay', 'dihedral', 120, 1.54, 75.3],
  ['saddle3_60', 'delaunay', 'dihedral', 180, 4.21, 128.3],
  ['saddle4_10', 'delaunay', 'dihedral', 40, 0.533, 44.9],
  ['saddle6_6', 'delaunay', 'dihedral', 36, 8.02, 170.5],
  ['saddle6_8', 'delaunay', 'dihedral', 48, 26.5, 531.6],
  ['saddle6_10', 'delaunay', 'dihedral', 60, 53.5, 780.6],
];
const kOwnCurves = ['monkey_150', 'saddle2_250', 'saddle3_60'];

function committedCases(): Case[] {
  return kAuthors.map(([name, space, weighing, n, seconds, megabytes]) => {
    const folder = kOwnCurves.includes(name) ? 'bench/curves' : 'fixtures/curves';
    const k = Number(/^saddle(\d)/.exec(name)?.[1] ?? 1);
    const input = { curves: `${folder}/${name}.curve`, k, n };
    const goal = withGoal(`${k}x${n / k}`, space, weighing);
    const authors = seconds && megabytes ? { authors: { seconds, megabytes } } : {};
    return make('committed', name, input, space, weighing, { ...goal, ...authors, series: null });
  });
}

/** All cases, in the order in which they are measured. */
export const allCases = (): Case[] => [
  ...monkeys('all', 'dihedral', [25, 50, 100, 150, 200, 300, 400]),
  ...monkeys('all', 'area', [125, 250, 500, 1000, 2000]),
  ...monkeys('all', 'worst', [50, 100, 200]),
  ...monkeys('delaunay', 'dihedral', [250, 500, 1000, 2000, 5000, 10_000, 30_000, 100_000]),
  ...saddles(2, 'all', [5, 7, 10, 15, 20, 30, 40]),
  ...saddles(3, 'all', [3, 4, 5, 6, 7]),
  ...saddles(2, 'delaunay', [10, 20, 40, 60, 100, 150, 250]),
  ...saddles(3, 'delaunay', [10, 20, 40, 60, 100]),
  ...saddles(4, 'delaunay', [6, 10, 15, 20, 30]),
  ...saddles(5, 'delaunay', [6, 8, 10, 12]),
  ...saddles(6, 'delaunay', [4, 6, 8, 10]),
  ...[2, 3, 4, 5, 6].flatMap((pose) => saddles(6, 'delaunay', [10], pose)),
  ...meshCases(),
  ...noisyCases(),
  ...manyLoops(),
  ...committedCases(),
];

/** The two loops of the interactive case. */
export const dragLoops = (): Loop[] => regularSaddles(2, 40, new Random(kPoses));

/** The randomised suite of figure 9: `count` single loops of 100 to 200 vertices, or pairs of 10 to 20. */
export function optimalityLoops(kind: 'single' | 'pairs', count: number): Loop[][] {
  const random = new Random(kind === 'single' ? 300 : 400);
  return Array.from({ length: count }, () => {
    const mesh = closedSurface(kind === 'single' ? 4 : 3, random);
    const size = () => (kind === 'single' ? 100 + random.below(101) : 10 + random.below(11));
    return meshLoops(mesh, kind === 'single' ? [size()] : [size(), size()], random);
  });
}

/** Noisy loops of four kinds, single ones of 100 to 400 vertices, pairs of 10 to 20 each or larger ones of
 * 20 to 40: on these the `near` space is compared with all triples. */
export function noisyLoops(kind: 'single' | 'pairs' | 'larger pairs', count: number): Loop[][] {
  return Array.from({ length: count }, (_, i) => {
    const random = new Random(600 + i);
    const noise = random.range(0.1, 1);
    const single = kind === 'single';
    const [least, most] = { single: [100, 400], pairs: [10, 20], 'larger pairs': [20, 40] }[kind];
    const size = () => least + random.below(most - least + 1);
    const sizes = single ? [size()] : [size(), size()];
    const harmonic = (n: number) => withNoise(harmonicLoop(n, single ? 4 : 2, random), noise, random);
    switch (i % 4) {
      case 0:
        return meshLoops(closedSurface({ single: 5, pairs: 3, 'larger pairs': 4 }[kind], random), sizes, random);
      case 1: {
        const apart = scale(random.range(0.3, 2), random.direction());
        return sizes.map((n, k) => harmonic(n).map((p) => add(p, scale(k, apart))));
      }
      case 2:
        return single
          ? [withNoise(monkeySaddle(sizes[0]), noise, random)]
          : regularSaddles(2, sizes[0], random).map((loop) => withNoise(loop, noise, random));
      default:
        return single ? [closedWalk(sizes[0], random)] : randomLoops(sizes, noise, random);
    }
  });
}

/** What the figures show above their charts: a monkey saddle, then 2 to 6 saddles. */
export const pictureLoops = (): Loop[][] => [
  [monkeySaddle(48)],
  ...[2, 3, 4, 5, 6].map((k) => regularSaddles(k, 16, new Random(kPoses))),
];
