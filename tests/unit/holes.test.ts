// findHoles, fillHoles: regions are cut out of surfaces that formulas give; what is filled in is closed, keeps the old
// part to the bit, crosses nothing, and lies where the surface was.
import { fillHoles, findHoles, load, type FillOptions, type MeshAttribute, type Point, type Weights } from 'soapfilm';
import { createWorker, type Film } from 'soapfilm/worker';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { errorOf, rejectionOf } from '../support/errors.js';
import { dot, Random, scale } from '../support/generators.ts';
import {
  areaOfNew,
  box,
  crossings,
  cut,
  expectClosed,
  expectKeeps,
  expectRanges,
  moebius,
  near,
  openEdges,
  rmsOfNew,
  saddle,
  shaken,
  sheet,
  sphere,
  together,
  toPoint,
  torus,
  tube,
  turned,
  type Mesh,
} from '../support/meshes.ts';

let film: Film;
beforeAll(async () => {
  await load();
  film = await createWorker();
});
afterAll(() => {
  film.dispose();
});

/** The angle at the origin between a point and a direction. */
const angle = (p: Point, direction: Point): number => Math.acos(dot(p, direction) / Math.hypot(...p) / Math.hypot(...direction));
const kUp: Point = [0, 0, 1];
const kSide: Point = [0.3, -1, 0.2];

const kSphere = sphere(12);
const kTorus = torus(36, 16);
const kTube = tube(24, 16);
const kTwoCaps = cut(kSphere, (p) => angle(p, kUp) < 0.35 || angle(p, kSide) < 0.3);
const fromSphere = (p: Point): number => Math.hypot(...p) - 1;
const fromTorus = (p: Point): number => Math.hypot(Math.hypot(p[0], p[1]) - 1, p[2]) - 0.4;
const fromTube = (p: Point): number => Math.hypot(p[0], p[1]) - 1;
const fromBox = (p: Point): number => Math.max(...p.map(Math.abs)) - 1;

interface Cut {
  mesh: Mesh;
  /** The groups: how many loops each has, and what they are. */
  groups: string[];
  /** Of the filled mesh. */
  euler: number;
  distance: (p: Point) => number;
  /** The bound on the root mean square of the distance. */
  rms: number;
}

const cuts: [string, Cut][] = [
  ['a sphere, two caps', { mesh: kTwoCaps, groups: ['alone 1', 'alone 1'], euler: 2, distance: fromSphere, rms: 1e-3 }],
  [
    'a sphere inside out',
    { mesh: turned(kTwoCaps), groups: ['alone 1', 'alone 1'], euler: 2, distance: fromSphere, rms: 1e-3 },
  ],
  [
    'a sphere, a ring around an island',
    {
      mesh: cut(kSphere, (p) => angle(p, kUp) < 0.7 && angle(p, kUp) > 0.25),
      groups: ['island 2'],
      euler: 2,
      distance: fromSphere,
      rms: 1e-3,
    },
  ],
  [
    'a sphere, a cap with two islands',
    {
      mesh: cut(kSphere, (p) => angle(p, kUp) < 0.9 && !near(p, [0.35, 0, 0.93], 0.22) && !near(p, [-0.4, 0, 0.9], 0.22)),
      groups: ['island 3'],
      euler: 2,
      distance: fromSphere,
      rms: 1e-3,
    },
  ],
  ['half a sphere', { mesh: cut(kSphere, (p) => p[2] > 0), groups: ['alone 1'], euler: 2, distance: fromSphere, rms: 5e-3 }],
  [
    'a sphere without its equator',
    { mesh: cut(kSphere, (p) => Math.abs(p[2]) < 0.2), groups: ['band 2'], euler: 2, distance: fromSphere, rms: 1e-3 },
  ],
  [
    'a torus, two discs',
    {
      mesh: cut(kTorus, (p) => near(p, [1, 0, 0.4], 0.3) || near(p, [-1.4, 0, 0], 0.3)),
      groups: ['alone 1', 'alone 1'],
      euler: 0,
      distance: fromTorus,
      rms: 6e-3,
    },
  ],
  [
    'a side of a box',
    { mesh: cut(box(8), (p) => near(p, [0, 0, 1], 0.5)), groups: ['alone 1'], euler: 2, distance: fromBox, rms: 1e-12 },
  ],
  [
    'an edge of a box',
    { mesh: cut(box(8), (p) => near(p, [1, 0, 1], 0.5)), groups: ['alone 1'], euler: 2, distance: fromBox, rms: 1e-12 },
  ],
  [
    'a corner of a box',
    { mesh: cut(box(8), (p) => near(p, [1, 1, 1], 0.5)), groups: ['alone 1'], euler: 2, distance: fromBox, rms: 1e-12 },
  ],
  [
    'noise on a sphere',
    {
      mesh: shaken(cut(kSphere, (p) => angle(p, kUp) < 0.35), 0.02, new Random(1)),
      groups: ['alone 1'],
      euler: 2,
      distance: fromSphere,
      rms: 0.02,
    },
  ],
  [
    'a sphere in a sphere, a cap of each',
    {
      mesh: together(
        cut(kSphere, (p) => angle(p, kUp) < 0.35),
        turned(cut(scaled(sphere(8), 0.5), (p) => angle(p, kSide) < 0.4)),
      ),
      groups: ['alone 1', 'alone 1'],
      euler: 4,
      distance: (p) => Math.min(Math.abs(fromSphere(p)), Math.abs(Math.hypot(...p) - 0.5)),
      rms: 2e-3,
    },
  ],
];

function scaled({ positions, faces }: Mesh, by: number): Mesh {
  return { positions: positions.map((x) => by * x), faces };
}

describe('round trips', () => {
  test.each(cuts)('%s: grouped, closed, nothing crosses, where the surface was', (_, { mesh, groups, euler, distance, rms }) => {
    const report = findHoles(mesh);
    expect(report.groups.map(({ why, loops }) => `${why} ${loops.length}`)).toEqual(groups);
    expect(report.groups.some(({ isOpenRim }) => isOpenRim)).toBe(false);
    expect(report.defects).toEqual([]);
    const result = fillHoles(mesh);
    expectClosed(mesh, result, euler);
    expect(crossings(result)).toEqual([]);
    expect(rmsOfNew(result, distance)).toBeLessThan(rms);
  });

  test.each(cuts)('%s: the same in a worker', async (_, { mesh }) => {
    expect(await film.findHoles(mesh)).toEqual(findHoles(mesh));
    const there = await film.fillHoles(mesh);
    expect(there).toEqual(fillHoles(mesh));
    expect(there.mesh.faces.byteLength).toBe(there.mesh.faces.buffer.byteLength);
  });

  test.each([0, 1, 2, 'auto'] as const)('fairness %s: closed, and told', (fairness) => {
    const result = fillHoles(kTwoCaps, { fairness });
    expectClosed(kTwoCaps, result, 2);
    expect(crossings(result)).toEqual([]);
    for (const { fairnessUsed, rimAngle, optimal, cost, lowerBound } of result.holes) {
      expect(fairnessUsed).toBe(fairness === 'auto' ? 2 : fairness);
      expect(optimal).toBe(true);
      expect(lowerBound).toBeCloseTo(cost, 9);
      if (fairness !== 0) expect(rimAngle.after).toBeLessThan(rimAngle.before);
    }
    expect(rmsOfNew(result, fromSphere)).toBeLessThan(fairness === 0 ? 0.05 : 2e-3);
  });

  test.each(['all', 'delaunay', 'near'] as const)('candidates %s: closed', (candidates) => {
    expectClosed(kTwoCaps, fillHoles(kTwoCaps, { candidates }), 2);
  });

  test('density 0: no new vertices; more density: more', () => {
    const counts = [0, 0.7, Math.SQRT2, 3].map((density) => {
      const result = fillHoles(kTwoCaps, { density });
      expectClosed(kTwoCaps, result, 2);
      return result.mesh.positions.length / 3 - result.oldVertices;
    });
    expect(counts[0]).toBe(0);
    for (let i = 1; i < counts.length; i++) expect(counts[i]).toBeGreaterThan(counts[i - 1]);
    const loops = findHoles(kTwoCaps).loops;
    const { mesh, oldFaces } = fillHoles(kTwoCaps, { density: 0 });
    expect(mesh.faces.length / 3 - oldFaces).toBe(loops.reduce((sum, { vertices }) => sum + vertices.length - 2, 0));
  });

  test('single positions: the same bits back, the patch rounded', () => {
    const mesh = { positions: Float32Array.from(kTwoCaps.positions), faces: kTwoCaps.faces };
    const result = fillHoles(mesh);
    expectClosed(mesh, result, 2);
    expect(result.mesh.positions).toBeInstanceOf(Float32Array);
    expect(crossings(result)).toEqual([]);
  });

  test('scaled, and far away: closed in the same way', () => {
    for (const factor of [1e-6, 1e6]) {
      const mesh = scaled(kTwoCaps, factor);
      const result = fillHoles(mesh);
      expectClosed(mesh, result, 2);
      expect(rmsOfNew(result, (p) => fromSphere(scale(1 / factor, p)))).toBeLessThan(1e-3);
    }
    const moved = { positions: kTwoCaps.positions.map((x) => x + 1e6), faces: kTwoCaps.faces };
    expectClosed(moved, fillHoles(moved), 2);
  });
});

describe('findHoles', () => {
  test('loops: run along open edges the way faces that fill them do', () => {
    const open = new Set(openEdges(kTwoCaps.faces));
    const { loops } = findHoles(kTwoCaps);
    for (const { vertices, length, diameter, openness, component, isSeam } of loops) {
      for (let i = 0; i < vertices.length; i++) {
        const [a, b] = [vertices[i], vertices[(i + 1) % vertices.length]];
        expect(open.delete(`${b} ${a}`)).toBe(true);
      }
      expect(length).toBeGreaterThan(2 * diameter);
      expect(openness).toBeLessThan(0.3);
      expect(component).toBe(0);
      expect(isSeam).toBe(false);
    }
    expect(open.size).toBe(0);
  });

  test('a closed mesh: no holes, and filling gives it back', () => {
    expect(findHoles(kSphere)).toEqual({ loops: [], groups: [], defects: [] });
    const result = fillHoles(kSphere);
    expect(result).toMatchObject({ closed: true, holes: [] });
    expect(result.mesh.faces).toEqual(kSphere.faces);
    expect(result.mesh.faces).not.toBe(kSphere.faces);
  });

  test('components: loops tell theirs', () => {
    const mesh = together(kTwoCaps, cut(scaled(kSphere, 0.3), (p) => angle(p, kUp) < 0.4));
    expect(new Set(findHoles(mesh).loops.map(({ component }) => component))).toEqual(new Set([0, 1]));
  });
});

describe('open rims', () => {
  const pierced = cut(kTube, (p) => near(p, [1, 0, 0], 0.5));

  test('a tube: its ends stay open, its hole is filled', () => {
    const { groups } = findHoles(pierced);
    expect(groups.map(({ isOpenRim }) => isOpenRim)).toEqual([true, false, true]);
    const result = fillHoles(pierced);
    expectKeeps(pierced, result);
    expectRanges(result);
    expect(result.holes.map(({ status }) => status)).toEqual(['open-rim', 'filled', 'open-rim']);
    expect(result.closed).toBe(false);
    expect(openEdges(result.mesh.faces).length).toBe(48);
    expect(rmsOfNew(result, fromTube)).toBeLessThan(6e-3);
  });

  test('fillOpenRims, or their numbers: fills them too', () => {
    expectClosed(pierced, fillHoles(pierced, { fillOpenRims: true }), 2);
    expectClosed(pierced, fillHoles(pierced, { holes: [0, 1, 2] }), 2);
    const { holes } = fillHoles(pierced, { holes: [2] });
    expect(holes.map(({ status }) => status)).toEqual(['skipped', 'skipped', 'filled']);
  });

  test('a band of a tube: is one hole between two rims', () => {
    const mesh = cut(kTube, (p) => Math.abs(p[2]) < 0.4);
    const result = fillHoles(mesh);
    expect(result.holes.map(({ status }) => status)).toEqual(['open-rim', 'filled', 'open-rim']);
    expect(crossings(result)).toEqual([]);
    expect(rmsOfNew(result, fromTube)).toBeLessThan(6e-3);
    expect(fillHoles(mesh, { fillOpenRims: true }).closed).toBe(true);
  });

  test('a saddle: its rim stays open', () => {
    const mesh = cut(saddle(20), (p) => near(p, [0, 0, 0], 0.35));
    const result = fillHoles(mesh);
    expect(result.holes.map(({ status }) => status)).toEqual(['open-rim', 'filled']);
    expect(rmsOfNew(result, ([x, y, z]) => z - 0.4 * (x * x - y * y))).toBeLessThan(1e-3);
    expect(openEdges(result.mesh.faces).length).toBe(80);
  });

  test('a Möbius band: has an open rim, and is not orientable', () => {
    const { groups, defects } = findHoles(moebius(24));
    expect(groups).toMatchObject([{ isOpenRim: true }]);
    expect(defects.map(({ kind }) => kind)).toContain('not-orientable');
  });
});

describe('options', () => {
  test.each(cuts)('%s: patches are the tail of the whole mesh', (_, { mesh }) => {
    const whole = fillHoles(mesh);
    const { mesh: patches, ...rest } = fillHoles(mesh, { output: 'patches' });
    const { mesh: all, ...told } = whole;
    expect(rest).toEqual(told);
    expect(patches.positions).toEqual(all.positions.slice(mesh.positions.length));
    expect(patches.faces).toEqual(all.faces.slice(mesh.faces.length));
  });

  test('holes: only those named are filled, as they are with all', () => {
    const all = fillHoles(kTwoCaps);
    for (const hole of [0, 1]) {
      const result = fillHoles(kTwoCaps, { holes: [hole] });
      expectKeeps(kTwoCaps, result);
      expect(result.closed).toBe(false);
      expect(result.holes[1 - hole]).toMatchObject({ status: 'skipped', reason: 'not-asked-for', faces: [0, 0] });
      expect(result.holes[hole].cost).toBe(all.holes[hole].cost);
      // The other one's patch is neither near nor seen.
      const count = (of: typeof all) => of.holes[hole].faces[1] - of.holes[hole].faces[0];
      expect(count(result)).toBe(count(all));
    }
    expect(fillHoles(kTwoCaps, { holes: [] }).mesh).toEqual(kTwoCaps);
  });

  test('groups: in place of those that were found', () => {
    const ring = cut(kSphere, (p) => angle(p, kUp) < 0.7 && angle(p, kUp) > 0.25);
    const loops = findHoles(ring).groups[0].loops;
    const [outer, island] = loops;
    // The island's outside and the ring's are closed apart: two balls of a kind, Euler number 4.
    const apart = fillHoles(ring, { groups: [[outer], [island]] });
    expectKeeps(ring, apart);
    expect(apart.closed).toBe(true);
    expect(openEdges(apart.mesh.faces)).toEqual([]);
    // In any order.
    expectClosed(ring, fillHoles(ring, { groups: [[island, outer]] }), 2);
    const one = fillHoles(ring, { groups: [[island]] });
    expect(one.holes.length).toBe(1);
    expect(one.closed).toBe(false);
  });

  test('perHole: options of one hole over those of all', () => {
    const { holes } = fillHoles(kTwoCaps, { density: 0, perHole: { 1: { density: 2, fairness: 1 } } });
    const size = ({ faces: [from, to] }: (typeof holes)[number]) => to - from;
    expect(holes.map(({ fairnessUsed }) => fairnessUsed)).toEqual([0, 1]);
    expect(size(holes[0])).toBe(findHoles(kTwoCaps).loops[0].vertices.length - 2);
    expect(size(holes[1])).toBeGreaterThan(size(holes[0]));
  });

  test('maxVertices, maxLength: larger holes are skipped, and it is said why', () => {
    const { loops } = findHoles(kTwoCaps);
    const [a, b] = loops.map(({ vertices }) => vertices.length);
    expect(a).not.toBe(b);
    const cases: [FillOptions, string][] = [
      [{ maxVertices: Math.min(a, b) }, 'too-many-vertices'],
      [{ maxLength: Math.min(loops[0].length, loops[1].length) }, 'too-long'],
    ];
    for (const [options, reason] of cases) {
      const { holes, closed } = fillHoles(kTwoCaps, options);
      expect(closed).toBe(false);
      expect(holes[a < b ? 0 : 1].status).toBe('filled');
      expect(holes[a < b ? 1 : 0]).toMatchObject({ status: 'skipped', reason });
    }
  });

  test('maxNewVertices: no more', () => {
    for (const maxNewVertices of [0, 1, 7, 20]) {
      const result = fillHoles(kTwoCaps, { maxNewVertices, density: 4, holes: [0] });
      expect(result.mesh.positions.length / 3 - result.oldVertices).toBeLessThanOrEqual(maxNewVertices);
      expect(result.holes[0].status).toBe('filled');
    }
  });

  test('weights: area alone has less area, angles alone less bending', () => {
    const bump = cut(sheet(20, (x, y) => Math.exp(-4 * (x * x + y * y))), (p) => near(p, [0, 0, 0.9], 0.6));
    const filled = (weights: Weights) => fillHoles(bump, { weights, density: 0, fairness: 0 });
    const [area, bending] = [filled({ area: 1 }), filled({ dihedral: 1 })];
    for (const { holes } of [area, bending]) expect(holes.map(({ status }) => status)).toEqual(['open-rim', 'filled']);
    expect(area.mesh.faces).not.toEqual(bending.mesh.faces);
    expect(areaOfNew(area)).toBeCloseTo(area.holes[1].cost, 9);
    expect(areaOfNew(area)).toBeLessThan(areaOfNew(bending));
    expect(bending.holes[1].rimAngle.after).toBeLessThan(area.holes[1].rimAngle.after);
  });

  test('weights: what they cost across the edge of a box', () => {
    const mesh = cut(box(8), (p) => near(p, [1, 0, 1], 0.5));
    const filled = (weights: Weights) => fillHoles(mesh, { weights, density: 0, fairness: 0, creases: false });
    const [area, bending] = [filled({ area: 1 }), filled({ dihedral: 1 })];
    for (const result of [area, bending]) expectClosed(mesh, result, 2);
    expect(area.holes[0].cost).toBeLessThan(1);
    expect(bending.holes[0].cost).toBeCloseTo(Math.PI / 2, 9);
    expect(area.mesh.faces).not.toEqual(bending.mesh.faces);
  });
});

describe('weld', () => {
  const soup = {
    positions: Float64Array.from([...kTwoCaps.faces].flatMap((v) => [...kTwoCaps.positions.subarray(3 * v, 3 * v + 3)])),
    faces: kTwoCaps.faces.map((_, i) => i),
  };

  test.each([0, 1e-6])('%d: a soup of triangles is welded, and filled like the mesh', async (weld) => {
    const report = findHoles(soup, { weld });
    expect(report.groups.map(({ why }) => why)).toEqual(['alone', 'alone']);
    const result = fillHoles(soup, { weld });
    const { vertexMap, oldVertices, oldFaces, mesh } = result;
    expect(vertexMap).toEqual(report.vertexMap);
    expect(oldVertices).toBe(kTwoCaps.positions.length / 3);
    expect(oldFaces).toBe(kTwoCaps.faces.length / 3);
    expect(result.closed).toBe(true);
    expect(openEdges(mesh.faces)).toEqual([]);
    soup.faces.forEach((v, i) => {
      const to = vertexMap?.[v] as number;
      expect(mesh.faces[i]).toBe(to);
      expect(mesh.positions.subarray(3 * to, 3 * to + 3)).toEqual(soup.positions.subarray(3 * v, 3 * v + 3));
    });
    expect(rmsOfNew(result, fromSphere)).toBeLessThan(1e-3);
    expect(await film.findHoles(soup, { weld })).toEqual(report);
    expect(await film.fillHoles(soup, { weld })).toEqual(result);
  });

  test('not asked for: as many loops as faces, seams but for some at the holes, and no map', () => {
    const report = findHoles(soup);
    expect(report.loops.length).toBe(soup.faces.length / 3);
    const others = report.loops.filter(({ isSeam }) => !isSeam).length;
    expect(others).toBeLessThan(openEdges(kTwoCaps.faces).length / 2 + 1);
    expect(report.vertexMap).toBeUndefined();
  });
});

describe('creases', () => {
  // Without the corner itself, which no triangle on the rim alone has.
  const corner = cut(box(8), (p) => near(p, [1, 1, 1], 0.5));

  test('go on through a hole; not if they are not wanted, or turn too little', () => {
    for (const creases of [undefined, true, 40, 89]) {
      expect(rmsOfNew(fillHoles(corner, creases === undefined ? {} : { creases }), fromBox)).toBeLessThan(1e-12);
    }
    for (const creases of [false, 91]) {
      const result = fillHoles(corner, { creases });
      expectClosed(corner, result, 2);
      expect(rmsOfNew(result, fromBox)).toBeGreaterThan(1e-3);
    }
    const each = fillHoles(corner, { creases: false, perHole: { 0: { creases: true } } });
    expect(rmsOfNew(each, fromBox)).toBeLessThan(1e-12);
  });
});

describe('attributes', () => {
  const count = kTwoCaps.positions.length / 3;
  const attributes = {
    place: { data: Float32Array.from(kTwoCaps.positions), size: 3 },
    one: { data: new Float32Array(count).fill(0.25), size: 1 },
  };
  const mesh = { ...kTwoCaps, attributes };

  test('are kept, and go on over patches between the values of the rim', async () => {
    const result = fillHoles(mesh);
    expectClosed(mesh, result, 2);
    const { place, one } = result.mesh.attributes ?? {};
    const total = result.mesh.positions.length / 3;
    expect(place.data.length).toBe(3 * total);
    expect(place.data.slice(0, 3 * count)).toEqual(attributes.place.data);
    for (const x of one.data) expect(x).toBeCloseTo(0.25, 4);
    // Harmonic: as high as the rim, where the patch itself rises above it.
    for (let i = 3 * count; i < 3 * total; i++) {
      expect(Math.abs(place.data[i] - result.mesh.positions[i])).toBeLessThan(0.1);
    }
    expect(await film.fillHoles(mesh)).toEqual(result);
    expect(attributes.one.data.length).toBe(count);
  });

  test('of patches alone: the tail', () => {
    const { mesh: all } = fillHoles(mesh);
    const { mesh: patches } = fillHoles(mesh, { output: 'patches' });
    expect(patches.attributes?.place.data).toEqual(all.attributes?.place.data.slice(3 * count));
    expect(fillHoles(kTwoCaps).mesh.attributes).toBeUndefined();
  });

  /** A sphere with a wide cap cut off, and colours at random. */
  const wide = cut(sphere(16), (p) => angle(p, kUp) < 0.9);
  const colours = (mesh: Mesh, seed: number): Record<string, MeshAttribute> => {
    const random = new Random(seed);
    return { colour: { data: Float32Array.from({ length: (4 * mesh.positions.length) / 3 }, () => random.unit()), size: 4 } };
  };

  test('every new vertex is the mean of its neighbours, on a large patch too', async () => {
    console.log('seed 71');
    const mesh = { ...wide, attributes: colours(wide, 71) };
    const options: FillOptions = { density: 4, maxNewVertices: 20_000 };
    const result = fillHoles(mesh, options);
    const { faces, attributes } = result.mesh;
    const { data } = attributes?.colour as MeshAttribute;
    const { oldVertices: old, oldFaces } = result;
    const total = data.length / 4;
    expect(total - old).toBeGreaterThan(2000);
    const [sums, counts] = [new Float64Array(4 * total), new Uint32Array(total)];
    for (let f = 3 * oldFaces; f < faces.length; f += 3) {
      for (let i = 0; i < 3; i++) {
        for (const w of [faces[f + ((i + 1) % 3)], faces[f + ((i + 2) % 3)]]) {
          counts[faces[f + i]]++;
          for (let k = 0; k < 4; k++) sums[4 * faces[f + i] + k] += data[4 * w + k];
        }
      }
    }
    let most = 0;
    for (let v = old; v < total; v++) {
      for (let k = 0; k < 4; k++) most = Math.max(most, Math.abs(sums[4 * v + k] / counts[v] - data[4 * v + k]));
    }
    expect(most).toBeLessThan(1e-5);
    expect(await film.fillHoles(mesh, options)).toEqual(result);
  });

  test('of a hole: the same to the bit, whatever else is filled', () => {
    console.log('seed 73');
    const mesh = { ...kTwoCaps, attributes: colours(kTwoCaps, 73) };
    const both = fillHoles(mesh);
    const { oldVertices, oldFaces } = both;
    for (const hole of [0, 1]) {
      const one = fillHoles(mesh, { holes: [hole] });
      const { faces: [from, to] } = both.holes[hole];
      const corners = both.mesh.faces.subarray(3 * from, 3 * to);
      const single = one.mesh.faces.subarray(3 * oldFaces);
      expect(single.length).toBe(corners.length);
      corners.forEach((v, i) => {
        const of = ({ mesh }: typeof one, u: number) => mesh.attributes?.colour.data.slice(4 * u, 4 * u + 4);
        if (v >= oldVertices) expect(of(one, single[i])).toEqual(of(both, v));
      });
    }
  });

  test('the limits of the call hold for them too', async () => {
    const names = Array.from({ length: 40 }, (_, i) => `a${i}`);
    const data = new Float32Array((50 * wide.positions.length) / 3);
    const mesh = { ...wide, attributes: Object.fromEntries(names.map((name) => [name, { data, size: 50 }])) };
    const options: FillOptions = { maxMemoryBytes: 8e6 };
    expect(fillHoles(wide, options).closed).toBe(true);
    expect(errorOf(() => fillHoles(mesh, options)).code).toBe('out-of-memory');
    expect((await rejectionOf(film.fillHoles(mesh, options))).code).toBe('out-of-memory');
    expect(errorOf(() => fillHoles(mesh, { maxSeconds: 0 })).code).toBe('time-limit');
    expect(fillHoles(mesh).closed).toBe(true);
    const stop = new AbortController();
    const cancelled = film.fillHoles(mesh, { density: 4, signal: stop.signal, onProgress: () => { stop.abort('enough'); } });
    expect(await rejectionOf(cancelled)).toMatchObject({ code: 'cancelled', cause: 'enough' });
  });

  test('named as what objects inherit: kept like others', async () => {
    const odd = { ...kTwoCaps, attributes: JSON.parse('{ "__proto__": 0, "constructor": 0 }') as Record<string, MeshAttribute> };
    for (const name of Object.keys(odd.attributes)) Object.defineProperty(odd.attributes, name, { value: attributes.one });
    for (const { mesh: filled } of [fillHoles(odd), await film.fillHoles(odd)]) {
      const found = Object.entries(filled.attributes ?? {});
      expect(found.map(([name]) => name)).toEqual(['__proto__', 'constructor']);
      for (const [, { data }] of found) expect(data.length).toBe(filled.positions.length / 3);
    }
  });

  test('texture coordinates where charts meet at the rim: 0 and said; elsewhere they go on', () => {
    // Two charts, that meet where the sphere is cut by a plane through the first cap.
    const soup = { positions: new Float64Array(3 * kTwoCaps.faces.length), faces: kTwoCaps.faces.map((_, i) => i) };
    const uv = new Float32Array(2 * kTwoCaps.faces.length);
    for (let f = 0; f < kTwoCaps.faces.length; f += 3) {
      const corners = [...kTwoCaps.faces.subarray(f, f + 3)].map((v) => toPoint([...kTwoCaps.positions.subarray(3 * v, 3 * v + 3)]));
      const shift = 10 * Number(corners.reduce((sum, [x]) => sum + x, 0) > -0.6);
      corners.forEach((p, k) => {
        soup.positions.set(p, 3 * (f + k));
        uv.set([p[0] + shift, p[1]], 2 * (f + k));
      });
    }
    const colour = Float32Array.from(uv, (x) => x / 20);
    const attributes = { uv: { data: uv, size: 2 }, colour: { data: colour, size: 2 } };
    const { mesh, holes, oldFaces } = fillHoles({ ...soup, attributes }, { weld: 0 });
    const { oldVertices } = fillHoles(soup, { weld: 0 });
    const data = mesh.attributes?.uv.data ?? new Float32Array();
    const isCut = holes.map(({ faces: [from, to] }) => {
      const inside = [...mesh.faces.subarray(3 * from, 3 * to)].filter((v) => v >= oldVertices);
      return inside.every((v) => data[2 * v] === 0 && data[2 * v + 1] === 0);
    });
    expect(holes.map(({ attributesLeft }) => attributesLeft)).toEqual(isCut.map((is) => (is ? ['uv'] : undefined)));
    expect(isCut).toContain(true);
    expect(isCut).toContain(false);
    expect(oldFaces).toBe(soup.faces.length / 3);
    expect(mesh.attributes?.colour.data.subarray(2 * oldVertices).every((x) => x !== 0)).toBe(true);
  });

  test('not finite, or of another length: bad-attributes, with their name', () => {
    for (const data of [new Float32Array(count - 1), new Float32Array(count).fill(NaN)]) {
      const error = errorOf(() => fillHoles({ ...kTwoCaps, attributes: { one: { data, size: 1 } } }));
      expect(error.code).toBe('bad-attributes');
      expect(error.message).toContain('mesh.attributes.one');
    }
  });
});

describe('limits and listeners', () => {
  /** Enough work for the core to look up several times. */
  const many = cut(sphere(40), (p) => {
    const directions = [0, 1, 2].flatMap((axis) => [-1, 1].map((side) => toPoint([0, 1, 2].map((i) => (i === axis ? side : 0)))));
    return directions.some((direction) => angle(p, direction) < 0.5);
  });

  test('maxSecondsPerHole: a hole that takes longer is given up or left coarse, and the others are filled', async () => {
    // A ring that takes long, for all pairs of its vertices are looked at, beside holes that take no time.
    const large = cut(sphere(24), (p) => angle(p, kUp) < 0.9 && angle(p, kUp) > 0.4);
    const { loops } = findHoles(large);
    const mesh = together(large, kTwoCaps);
    const options: FillOptions = { candidates: 'all', density: 1, maxSecondsPerHole: 0.05 };
    for (const { holes, closed } of [fillHoles(mesh, options), await film.fillHoles(mesh, options)]) {
      const [slow, ...quick] = holes;
      expect(slow.reason).toBe('time-limit');
      expect(slow.optimal).toBe(false);
      expect(['filled', 'self-intersecting', 'failed']).toContain(slow.status);
      expect(closed).toBe(slow.status !== 'failed');
      if (slow.status !== 'failed') expect(slow.faces[1] - slow.faces[0]).toBe(loops.reduce((sum, { vertices }) => sum + vertices.length, 0));
      expect(quick).toHaveLength(2);
      // At most: on a slow machine even these may take too long.
      for (const { reason, status } of quick) expect(reason === undefined ? status : reason).toBe(reason === undefined ? 'filled' : 'time-limit');
    }
    expect(errorOf(() => fillHoles(mesh, { maxSecondsPerHole: -1 }))).toMatchObject({ code: 'bad-option' });
  });

  test('maxSecondsPerHole that is never over: as without', () => {
    expect(fillHoles(kTwoCaps, { maxSecondsPerHole: 1e6 })).toEqual(fillHoles(kTwoCaps));
  });

  test('maxSeconds 0: time-limit, and the next call works', async () => {
    for (const options of [{ maxSeconds: 0 }, { maxSeconds: 1e-3 }]) {
      expect(errorOf(() => findHoles(many, options)).code).toBe('time-limit');
      expect(errorOf(() => fillHoles(many, options)).code).toBe('time-limit');
      expect((await rejectionOf(film.fillHoles(many, options))).code).toBe('time-limit');
    }
    expect(errorOf(() => fillHoles(many, { maxSeconds: 0 })).message).toContain('within 0 s');
    expect(fillHoles(kTwoCaps).closed).toBe(true);
    expect((await film.fillHoles(kTwoCaps)).closed).toBe(true);
  });

  test.each([0, 1000, 100_000])('maxMemoryBytes %i: too little, and the next call works', async (maxMemoryBytes) => {
    const error = errorOf(() => fillHoles(many, { maxMemoryBytes }));
    expect(['too-large', 'out-of-memory']).toContain(error.code);
    expect(error.message).toContain('maxMemoryBytes');
    expect((await rejectionOf(film.findHoles(many, { maxMemoryBytes }))).code).toBe(errorOf(() => findHoles(many, { maxMemoryBytes })).code);
    expect(fillHoles(kTwoCaps).closed).toBe(true);
  });

  test('four threads share the holes: the same result, progress that rises, a signal that ends all of it', async () => {
    const four = await createWorker({ size: 4 });
    try {
      for (const options of [{}, { output: 'patches' as const }, { perHole: { 2: { density: 0 } }, holes: [4, 0, 2] }]) {
        const heard: [number, number, number][] = [];
        const onProgress = (...values: [number, number, number]) => {
          heard.push(values);
        };
        expect(await four.fillHoles(many, { ...options, onProgress })).toEqual(fillHoles(many, options));
        const fractions = heard.map(([fraction]) => fraction);
        expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
        expect(fractions.at(-1)).toBe(1);
      }
      const stop = new AbortController();
      const onProgress = () => {
        stop.abort('enough');
      };
      const error = await rejectionOf(four.fillHoles(many, { signal: stop.signal, onProgress }));
      expect(error).toMatchObject({ code: 'cancelled', cause: 'enough' });
      const reason = new Error('of the listener');
      const thrown = four.fillHoles(many, { onProgress: () => { throw reason; } });
      await expect(thrown).rejects.toBe(reason);
      expect(await four.fillHoles(many)).toEqual(fillHoles(many));
    } finally {
      four.dispose();
    }
  });

  test('onProgress: rises to the end, and names the holes in turn', async () => {
    const heard: [string, [number, number, number][]][] = [['here', []], ['there', []]];
    const [here, there] = heard.map(([, calls]) => ({
      onProgress: (...values: [number, number, number]) => {
        calls.push(values);
      },
    }));
    const result = fillHoles(many, here);
    expect(result.closed).toBe(true);
    expect(await film.fillHoles(many, there)).toEqual(result);
    for (const [where, calls] of heard) {
      expect(calls.at(-1), where).toEqual([1, 5, 6]);
      calls.forEach(([fraction, hole, of], i) => {
        expect(fraction).toBeGreaterThanOrEqual(i === 0 ? 0 : calls[i - 1][0]);
        expect(hole).toBe(Math.min(5, Math.floor(6 * fraction)));
        expect(of).toBe(6);
      });
    }
  });

  test('onProgress: the last call comes when all is done', () => {
    const data = new Float32Array(kTwoCaps.positions.length / 3).fill(0.25);
    const mesh = { ...kTwoCaps, attributes: { one: { data, size: 1 } } };
    const expected = fillHoles(mesh);
    const onProgress = (fraction: number) => {
      if (fraction === 1) data.fill(1);
    };
    expect(fillHoles(mesh, { onProgress })).toEqual(expected);
    expect(data[0]).toBe(1);
  });

  test('onProgress: counts only the holes that are filled', () => {
    const calls: number[][] = [];
    fillHoles(many, { holes: [4], onProgress: (...values) => calls.push(values) });
    expect(calls.at(-1)).toEqual([1, 4, 1]);
    expect(new Set(calls.map(([, hole]) => hole))).toEqual(new Set([4]));
    const none: number[][] = [];
    fillHoles(many, { holes: [], onProgress: (...values) => none.push(values) });
    expect(none).toEqual([]);
  });

  test('an error in onProgress: ends the call, and the next one works', async () => {
    const reason = new Error('enough');
    const options = {
      density: 6,
      onProgress: () => {
        throw reason;
      },
    };
    let thrown: unknown;
    try {
      fillHoles(many, options);
    } catch (error) {
      thrown = error;
    }
    expect(thrown).toBe(reason);
    await expect(film.fillHoles(many, options)).rejects.toBe(reason);
    expect(fillHoles(kTwoCaps).closed).toBe(true);
    expect((await film.fillHoles(kTwoCaps)).closed).toBe(true);
  });

  test('signal: ends the work before it begins or while it runs, and the next call works', async () => {
    const why = new Error('no longer needed');
    const aborted = await rejectionOf(film.findHoles(many, { signal: AbortSignal.abort(why) }));
    expect(aborted).toMatchObject({ code: 'cancelled', cause: why });
    const controller = new AbortController();
    const onProgress = () => {
      controller.abort(why);
    };
    const error = await rejectionOf(film.fillHoles(many, { density: 6, signal: controller.signal, onProgress }));
    expect(error).toMatchObject({ code: 'cancelled', cause: why });
    expect((await film.fillHoles(kTwoCaps)).closed).toBe(true);
  });

  test('a pool without the part: not-loaded, with its name', async () => {
    const pool = await createWorker({ parts: ['loops'] });
    for (const call of [pool.findHoles(kTwoCaps), pool.fillHoles(kTwoCaps)]) {
      const error = await rejectionOf(call);
      expect(error.code).toBe('not-loaded');
      expect(error.message).toMatch(/'meshes'.*`parts`.*`createWorker`/);
    }
    pool.dispose();
  });

  test('many calls at once: each has its own mesh', async () => {
    const meshes = [kTwoCaps, kTube, kTorus, cut(kSphere, (p) => p[2] > 0)];
    const pool = await createWorker({ size: 2, parts: ['meshes'] });
    const results = await Promise.all(meshes.map((mesh) => pool.fillHoles(mesh)));
    results.forEach((result, i) => {
      expect(result).toEqual(fillHoles(meshes[i]));
    });
    pool.dispose();
  });
});
