// What `npm run bench -- polygons` measures.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { feature } from 'topojson-client';
import { Random } from '../support/generators.ts';
import {
  blobRing,
  blobWithGrid,
  combRing,
  doubleCombRing,
  holeGrid,
  interleavedCombRing,
  kochRing,
  partitionRing,
  smallPolygon,
  spiralRing,
  starRing,
  starsInHoles,
  type Point2,
  type Polygon2,
} from '../support/polygons.ts';

export interface PolygonCase {
  /** Unique; words of the command line are looked for in it. */
  readonly id: string;
  /** Cases of one family differ in size alone: their times give a scaling exponent. */
  readonly family: string;
  readonly make: (seed: number) => { readonly polygons: Polygon2[]; readonly points?: Point2[] };
  /** Inputs of several seeds are taken in turn: else processors learn a small one by heart. */
  readonly inTurn?: boolean;
  /** The largest time of flooding as a share of earcut's that is wanted. */
  readonly ratio?: number;
  /** What is wanted of flooding by itself. */
  readonly limit?: { readonly seconds: number; readonly megabytes?: number };
  /** Ratios above are wanted for the batch; also measure a call a polygon. */
  readonly oneByOne?: boolean;
  /** Rounding has made some rings cross themselves: such polygons are left out for all, */
  readonly validOnly?: boolean;
  /** or repaired by us, while the others give what they give. */
  readonly repairs?: boolean;
  /** Whether angles, degrees and strips are looked at. */
  readonly quality?: boolean;
  /** What it is called in the README's table, where it is in that. */
  readonly title?: string;
}

export const kSeed = 20_250;

const one = (polygon: Polygon2): { polygons: Polygon2[] } => ({ polygons: [polygon] });

function series(
  family: string,
  sizes: readonly number[],
  make: (n: number, random: Random) => Polygon2,
  facts: (n: number) => Partial<PolygonCase> = () => ({}),
): PolygonCase[] {
  return sizes.map((n) => ({
    id: `${family} ${n}`,
    family,
    make: (seed) => one(make(n, new Random(seed))),
    inTurn: true,
    ...facts(n),
  }));
}

const upTo = (limit: number, ratio: number) => (n: number) =>
  n >= 1000 && n <= limit ? { ratio } : {};

/** The polygons of a map of the world's countries, in degrees. */
function countries(scale: string): Polygon2[] {
  const file = createRequire(import.meta.url).resolve(`world-atlas/countries-${scale}.json`);
  const atlas = JSON.parse(readFileSync(file, 'utf8')) as Parameters<typeof feature>[0];
  const found = feature(atlas, atlas.objects.countries);
  const polygons = found.features.flatMap(({ geometry }): Polygon2[] => {
    if (geometry?.type === 'Polygon') return [geometry.coordinates as Polygon2];
    return geometry?.type === 'MultiPolygon' ? (geometry.coordinates as Polygon2[]) : [];
  });
  // Without the end that repeats the beginning, which some of the others cannot take.
  return polygons.map((rings) => rings.map((ring) => ring.slice(0, -1)));
}

const kDecades = [1e2, 1e3, 1e4, 1e5, 1e6];
const kLarge = [1e3, 1e4, 1e5, 1e6];

export function polygonCases(): PolygonCase[] {
  const random = new Random(kSeed);
  return [
    {
      id: 'small 5000',
      family: 'small',
      make: () => ({ polygons: Array.from({ length: 5000 }, () => smallPolygon(random)) }),
      ratio: 0.8,
      oneByOne: true,
      title: '5 000 polygons of 4 to 108 vertices, at once',
    },
    ...['110m', '50m', '10m'].map((scale) => ({
      id: `countries ${scale}`,
      family: 'countries',
      make: () => ({ polygons: countries(scale) }),
      validOnly: true,
      ...(scale === '50m' && { ratio: 0.6, oneByOne: true, title: 'the countries of the world, 1 : 50 million' }),
    })),
    {
      id: 'all countries 50m',
      family: 'all countries',
      make: () => ({ polygons: countries('50m') }),
      repairs: true,
    },
    ...series('simple', kDecades, (n, r) => [partitionRing(n, r)], (n) => ({
      ...upTo(1e4, 0.6)(n),
      ...(n === 1e6 && { limit: { seconds: 3, megabytes: 300 } }),
      quality: n === 1000,
      ...(n >= 1e3 && n !== 1e5 && { title: 'random polygon' }),
    })),
    ...series('star', kLarge, (n, r) => [starRing(n, 1, r)], upTo(1e4, 0.6)),
    ...series('blob', kLarge, (n, r) => [blobRing(n, r)], (n) => ({
      ...upTo(1e4, 0.6)(n),
      ...(n === 1e4 && { title: 'smooth curve' }),
    })),
    ...series('comb', kLarge, (n, r) => [combRing(Math.round(n / 3), r)], (n) => ({
      ...upTo(1e4, 0.6)(n),
      ...(n === 1e4 && { title: 'comb' }),
    })),
    ...series('double comb', kLarge, (n, r) => [doubleCombRing(Math.round(n / 6), r)], upTo(1e4, 0.6)),
    ...series('interleaved comb', kLarge, (n, r) => [interleavedCombRing(Math.round(n / 6), r)], (n) =>
      n === 1e4 ? { ratio: 0.1 } : {},
    ),
    ...series('spiral', kLarge, (n) => [spiralRing(n, 10)], (n) => (n === 1e4 ? { ratio: 0.1 } : {})),
    ...series('koch', [4, 6, 8], (n) => [kochRing(n)]),
    ...series('aligned holes', [1, 10, 100, 1000, 10_000], (n) => gridOf(n, true)),
    ...series('turned holes', [1, 10, 100, 1000, 10_000], (n) => gridOf(n, false), (n) => ({
      ...(n >= 1000 && { ratio: 0.1 }),
      ...(n === 10_000 && { limit: { seconds: 0.1 } }),
      ...(n >= 1000 && { title: `${n === 1000 ? '1 000' : '10 000'} square holes, each turned` }),
    })),
    ...series('stars in holes', [3, 10, 32], (n, r) => starsInHoles(n, n, 20, r)),
    ...[10, 20, 40].map((columns): PolygonCase => ({
      id: `blob with grid ${columns}`,
      family: 'blob with grid',
      make: (seed) => {
        const { polygon, inner } = blobWithGrid(5 * columns, columns, new Random(seed));
        return { polygons: [polygon], points: inner };
      },
      quality: true,
    })),
  ];
}

function gridOf(holes: number, aligned: boolean): Polygon2 {
  const columns = Math.ceil(Math.sqrt(holes));
  const [outer, ...all] = holeGrid(columns, Math.ceil(holes / columns), aligned, new Random(kSeed));
  return [outer, ...all.slice(0, holes)];
}

/** What sessions are measured on: a vertex of these is moved. */
export function sessionCases() {
  const { polygon, inner } = blobWithGrid(100, 20, new Random(kSeed));
  return [
    { id: '100 samples + 20 × 20 grid', goal: 10, ring: polygon[0], inner },
    { id: '10⁴ vertices', goal: 50, ring: blobRing(10_000, new Random(kSeed)), inner: [] },
  ];
}
