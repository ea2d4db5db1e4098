// findHoles, fillHoles: meshes with every fault are reported on, filled where they can be, and never changed.
import { fillHoles, findHoles, load, type DefectKind, type FillOptions, type FillResult, type Point } from 'soapfilm';
import { createWorker } from 'soapfilm/worker';
import { beforeAll, describe, expect, test } from 'vitest';
import { Random } from '../support/generators.ts';
import {
  areaOfNew,
  box,
  cut,
  directedEdges,
  expectClosed,
  expectKeeps,
  expectRanges,
  moebius,
  near,
  pointOf,
  sphere,
  toPoint,
  torus,
  tube,
  type Mesh,
} from '../support/meshes.ts';

beforeAll(() => load());

const kSphere = sphere(5);
const kPierced = cut(kSphere, (p) => near(p, [0, 0, 1], 0.5));

const withFaces = ({ positions, faces }: Mesh, ...more: number[]): Mesh => ({
  positions,
  faces: Uint32Array.from([...faces, ...more]),
});
const withVertices = ({ positions, faces }: Mesh, points: Point[], ...more: number[]): Mesh =>
  withFaces({ positions: Float64Array.from([...positions, ...points.flat()]), faces }, ...more);
const faceOf = ({ faces }: Mesh, f: number): number[] => [...faces.subarray(3 * f, 3 * f + 3)];
const n = kPierced.positions.length / 3;

/** Every face with vertices of its own. */
function soup({ positions, faces }: Mesh): Mesh {
  return {
    positions: Float64Array.from([...faces].flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)])),
    faces: faces.map((_, i) => i),
  };
}

/** A face given an opposite winding. */
function flipped({ positions, faces }: Mesh, ...which: number[]): Mesh {
  const turned = faces.slice();
  for (const f of which) [turned[3 * f + 1], turned[3 * f + 2]] = [faces[3 * f + 2], faces[3 * f + 1]];
  return { positions, faces: turned };
}

const [a, b, c] = faceOf(kPierced, 0);
const broken: [string, Mesh, DefectKind[]][] = [
  ['empty', { positions: new Float64Array(), faces: new Uint32Array() }, []],
  ['no faces', { positions: new Float64Array(9), faces: new Uint32Array() }, ['unused-vertex']],
  ['one triangle', { positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), faces: Uint32Array.of(0, 1, 2) }, []],
  ['a triangle on both sides', { positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), faces: Uint32Array.of(0, 1, 2, 0, 2, 1) }, ['duplicate-face']],
  ['an unused vertex', withVertices(kPierced, [[5, 5, 5]]), ['unused-vertex']],
  ['a duplicate face', withFaces(kPierced, a, b, c), ['duplicate-face']],
  ['a duplicate face, turned', withFaces(kPierced, a, c, b), ['duplicate-face']],
  ['a face with a vertex twice', withFaces(kPierced, a, b, b), ['degenerate-face']],
  ['a flipped face', flipped(kPierced, 7), ['flipped']],
  ['ten flipped faces', flipped(kPierced, ...Array.from({ length: 10 }, (_, i) => 17 * i)), ['flipped']],
  ['a fin', withVertices(kPierced, [[2, 2, 2]], a, b, n), ['non-manifold-edge']],
  ['two meshes that share a vertex', bowTie(), ['non-manifold-vertex']],
  ['a Möbius band', moebius(24), ['not-orientable']],
  ['a soup', soup(kPierced), []],
  ['all faces degenerate', { positions: kPierced.positions, faces: kPierced.faces.map((_, i) => Math.floor(i / 3) % n) }, ['degenerate-face']],
  ['all vertices in one place', { positions: new Float64Array(3 * n).fill(1), faces: kPierced.faces }, []],
  ['all vertices on a line', { positions: kPierced.positions.map((x, i) => (i % 3 === 0 ? x : 0)), faces: kPierced.faces }, []],
  ['all vertices in a plane', { positions: kPierced.positions.map((x, i) => (i % 3 === 2 ? 0 : x)), faces: kPierced.faces }, []],
  ['the same mesh twice', withVertices(kPierced, [...points(kPierced)], ...[...kPierced.faces].map((v) => v + n)), []],
  ['tiny coordinates', { positions: kPierced.positions.map((x) => x * 1e-150), faces: kPierced.faces }, []],
  ['huge coordinates', { positions: kPierced.positions.map((x) => x * 1e149), faces: kPierced.faces }, []],
  ['a T-junction', tJunction(), []],
];

function points({ positions }: Mesh): Point[] {
  return Array.from({ length: positions.length / 3 }, (_, i) => [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]]);
}

/** Two tetrahedra without a face each, at one vertex. */
function bowTie(): Mesh {
  return {
    positions: Float64Array.of(0, 0, 0, 1, 0, 1, 0, 1, 1, -1, -1, 1, 1, 0, -1, 0, 1, -1, -1, -1, -1),
    faces: Uint32Array.of(0, 2, 1, 0, 3, 2, 0, 1, 3, 0, 4, 5, 0, 5, 6, 0, 6, 4),
  };
}

/** An edge that has a vertex in its middle on one side alone. */
function tJunction(): Mesh {
  const { positions, faces } = box(4);
  const [p, q, r] = [...faces.subarray(0, 3)];
  const middle = toPoint([0, 1, 2].map((i) => (positions[3 * p + i] + positions[3 * q + i]) / 2));
  const m = positions.length / 3;
  return withVertices({ positions, faces: faces.slice(3) }, [middle], p, m, r, m, q, r);
}

/** Expects what holds of every result, whatever the mesh. */
function expectSound(mesh: Mesh, options: FillOptions): FillResult {
  const report = findHoles(mesh);
  const named = report.groups.flatMap(({ loops }) => loops).sort((x, y) => x - y);
  expect(named).toEqual(report.loops.map((_, i) => i));
  const result = fillHoles(mesh, options);
  expectKeeps(mesh, result);
  expectRanges(result);
  expect(result.defects).toEqual(report.defects);
  // A filled hole has each edge of its rim once more, and no edge of its own more than once each way.
  result.holes.forEach(({ status, faces: [from, to], group }) => {
    if (status !== 'filled' && status !== 'self-intersecting') {
      expect(from).toBe(to);
      return;
    }
    const edges = directedEdges(result.mesh.faces.subarray(3 * from, 3 * to));
    const open = new Set<string>();
    for (const [edge, count] of edges) {
      expect(count).toBe(1);
      if (!edges.has(edge.split(' ').reverse().join(' '))) open.add(edge);
    }
    const rim = report.groups[group].loops.flatMap((loop) => {
      const { vertices } = report.loops[loop];
      return Array.from(vertices, (v, i) => `${v} ${vertices[(i + 1) % vertices.length]}`);
    });
    expect([...open].sort()).toEqual(rim.sort());
  });
  return result;
}

describe('broken meshes', () => {
  const options: FillOptions[] = [{}, { fillOpenRims: true }, { fillOpenRims: true, density: 0, fairness: 0 }];
  test.each(broken)('%s: is told, and no harm', (_, mesh, kinds) => {
    const told = findHoles(mesh).defects.map(({ kind }) => kind);
    for (const kind of kinds) expect(told).toContain(kind);
    for (const each of options) expectSound(mesh, each);
  });

  test('faults beside a hole: it is filled all the same', () => {
    for (const mesh of [withFaces(kPierced, a, b, c), withFaces(kPierced, a, b, b), withVertices(kPierced, [[5, 5, 5]])]) {
      expect(fillHoles(mesh).holes.map(({ status }) => status)).toEqual(['filled']);
    }
  });

  test('holes that share two vertices: no edge is in both patches', () => {
    const positions = [
      -0.19, -0.878, -2.109, -0.632, -0.738, -1.696, -0.358, -1.018, -1.481, 0.26, -1.055, -1.542,
      -0.875, -0.475, -1.18, -0.713, -0.906, -1.151, -0.204, -0.861, -1.132, -0.555, -0.695, -0.915,
    ];
    const mesh = { positions: Float64Array.from(positions), faces: Uint32Array.of(0, 2, 1, 1, 5, 4, 1, 2, 6, 2, 3, 6, 5, 6, 7) };
    for (const density of [0, 1]) {
      const result = expectSound(mesh, { fillOpenRims: true, density });
      expect(result.closed).toBe(true);
      for (const [edge, count] of directedEdges(result.mesh.faces)) expect(count, edge).toBe(1);
    }
  });

  test('patches of different holes that cross: both are told', async () => {
    const positions = [
      -0.4, 0, 0.064, -0.6, 0.2, 0.128, -0.4, 0.2, 0.048, -0.8, 0.4, 0.192, -0.4, 0.4, 0, -1, 0.6, 0.256,
      -0.8, 0.6, 0.112, -0.6, 0.6, 0, -0.4, 0.6, -0.08, -0.2, 0.6, -0.128, -1, 0.8, 0.144, -0.8, 0.8, 0,
    ];
    const mesh = { positions: Float64Array.from(positions), faces: Uint32Array.of(0, 2, 1, 3, 6, 5, 4, 9, 8, 5, 11, 10, 6, 7, 11) };
    const film = await createWorker({ size: 2 });
    try {
      for (const output of ['mesh', 'patches'] as const) {
        const result = fillHoles(mesh, { fillOpenRims: true, output });
        expect(await film.fillHoles(mesh, { fillOpenRims: true, output })).toEqual(result);
        const crossed = result.holes.filter(({ status }) => status === 'self-intersecting');
        expect(crossed.length).toBe(2);
        for (const [one, other] of [crossed, [...crossed].reverse()]) {
          expect(one.intersections.length).toBeGreaterThan(0);
          one.intersections.forEach((face, i) => {
            const [from, to] = (i % 2 === 0 ? one : other).faces;
            expect(face).toBeGreaterThanOrEqual(from);
            expect(face).toBeLessThan(to);
          });
        }
        expect(result.closed).toBe(false);
      }
    } finally {
      film.dispose();
    }
  });

  test('an island that is inside out: is told, not filled against its direction', () => {
    const ring = cut(sphere(12), ([, , z]) => z > 0.4 && z < 0.75);
    const { positions, faces } = ring;
    const upper = Array.from({ length: faces.length / 3 }, (_, f) => f).filter((f) => positions[3 * faces[3 * f] + 2] > 0.5);
    const result = expectSound(flipped(ring, ...upper), { groups: [[0, 1]] });
    expect(result.holes).toMatchObject([{ status: 'failed', reason: 'opposed-rims' }]);
    expect(result.closed).toBe(false);
  });

  test('slits: are closed by faces without area, and what is open beside them is filled', () => {
    const nu = 24;
    const whole = torus(nu, 12);
    // Both sides of a row of edges have vertices of their own.
    const row = [5, 6, 7].map((i) => 3 * nu + i);
    const next = whole.positions.length / 3;
    const slit = withVertices(whole, row.map((v) => pointOf(whole, v)));
    const cellOf = (f: number): [number, number] => [Math.floor(f / 2) % nu, Math.floor(f / 2 / nu)];
    slit.faces.forEach((v, k) => {
      const i = row.indexOf(v);
      if (i >= 0 && cellOf(Math.floor(k / 3))[1] === 3) slit.faces[k] = next + i;
    });
    const isOfCell = (f: number, i: number) => cellOf(f)[0] === i && [2, 3].includes(cellOf(f)[1]);
    for (const gone of [[], [4], [7], [4, 7]]) {
      const mesh = cut(slit, (_, f) => gone.some((u) => isOfCell(f, u)));
      const result = expectSound(mesh, {});
      expect(result.holes).toMatchObject([{ status: 'filled', reason: 'stitched' }]);
      expectClosed(mesh, result, 0);
    }
    expect(areaOfNew(fillHoles(slit))).toBeLessThan(1e-12);
  });

  test('sides that touch where faces are already: no face and no edge comes once more', () => {
    const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0);
    for (const faces of [Uint32Array.of(0, 1, 2, 0, 2, 3), Uint32Array.of(0, 1, 2), Uint32Array.of(0, 1, 3, 1, 2, 3)]) {
      for (const points of [positions, Float32Array.from(positions, (x, i) => (i % 3 === 0 ? 1e9 : 0) + x)]) {
        const { mesh, holes } = fillHoles({ positions: points, faces }, { fillOpenRims: true });
        expect([...directedEdges(mesh.faces).values()].every((count) => count === 1)).toBe(true);
        expect(new Set(Array.from({ length: mesh.faces.length / 3 }, (_, f) => mesh.faces.slice(3 * f, 3 * f + 3).sort().join())).size).toBe(mesh.faces.length / 3);
        expect(holes).toHaveLength(1);
      }
    }
  });

  test('places of defects: are the faces, edges and vertices at fault', () => {
    const last = kPierced.faces.length / 3;
    const placeOf = (mesh: Mesh, kind: DefectKind) => findHoles(mesh).defects.find((defect) => defect.kind === kind);
    expect([...(placeOf(withFaces(kPierced, a, b, c), 'duplicate-face')?.faces ?? [])]).toContain(last);
    expect([...(placeOf(withFaces(kPierced, a, b, b), 'degenerate-face')?.faces ?? [])]).toEqual([last]);
    expect([...(placeOf(withVertices(kPierced, [[5, 5, 5]]), 'unused-vertex')?.vertices ?? [])]).toEqual([n]);
    expect([...(placeOf(flipped(kPierced, 7), 'flipped')?.faces ?? [])]).toEqual([7]);
    expect([...(placeOf(bowTie(), 'non-manifold-vertex')?.vertices ?? [])]).toEqual([0]);
    const fin = placeOf(withVertices(kPierced, [[2, 2, 2]], a, b, n), 'non-manifold-edge');
    expect([...(fin?.edges ?? [])].sort((x, y) => x - y)).toEqual([a, b].sort((x, y) => x - y));
  });
});

describe('faces deleted at random', () => {
  const kinds: [string, Mesh][] = [
    ['sphere', sphere(4)],
    ['torus', torus(14, 8)],
    ['tube', tube(12, 8)],
    ['box', box(4)],
  ];
  const kRuns = 50;

  test.each(kinds)('%s: 50 times, filled or told why not', (name, mesh) => {
    for (let run = 0; run < kRuns; run++) {
      const seed = 1000 + run;
      const random = new Random(seed);
      const share = random.range(0, 0.6);
      const given = cut(mesh, () => random.chance(share));
      const options: FillOptions = { fillOpenRims: random.chance(0.5), ...(random.chance(0.3) && { density: 0 }) };
      try {
        const { mesh: filled } = expectSound(given, options);
        for (const [edge, count] of directedEdges(filled.faces)) expect(count, edge).toBe(1);
      } catch (cause) {
        throw new Error(`${name}, seed ${seed}`, { cause });
      }
    }
  });

  test.each(kinds)('%s: with flips, duplicates and wrong vertices, 20 times', (name, mesh) => {
    for (let run = 0; run < 20; run++) {
      const seed = 2000 + run;
      const random = new Random(seed);
      const { positions, faces } = cut(mesh, () => random.chance(0.1));
      const count = faces.length / 3;
      for (let i = 0; i < 6; i++) faces[random.below(faces.length)] = random.below(positions.length / 3);
      const more = Array.from({ length: 4 }, () => faceOf({ positions, faces }, random.below(count))).flat();
      const given = flipped(withFaces({ positions, faces }, ...more), random.below(count), random.below(count));
      try {
        expectSound(given, { fillOpenRims: random.chance(0.5) });
      } catch (cause) {
        throw new Error(`${name}, seed ${seed}`, { cause });
      }
    }
  });
});
