// Polygons through the package: forms of input, options, places of errors. The geometry itself is
// tested in tests/cpp; that both builds of the core agree, in polygon_checksums.test.ts.
import {
  load,
  SoapfilmError,
  triangulatePolygon,
  triangulatePolygons,
  type PolygonLike,
  type PolygonOptions,
} from 'soapfilm';
import { beforeAll, describe, expect, test } from 'vitest';
import { errorOf } from '../support/errors.js';
import { Random } from '../support/generators.js';
import {
  areaOf,
  flatPolygon,
  garbage,
  holeGrid,
  partitionRing,
  polygonArea,
  smallPolygon,
  staircaseRing,
  type Point2,
  type Polygon2,
} from '../support/polygons.js';
import {
  expectTriangulates,
  sortedTriangles,
  trianglesArea,
  trianglesOfStrips,
} from '../support/triangulation.js';

beforeAll(() => load());

const kSquare: Polygon2 = [
  [
    [0, 0],
    [10, 0],
    [10, 10],
    [0, 10],
  ],
  [
    [2, 2],
    [4, 2],
    [4, 4],
    [2, 4],
  ],
];

const square = (x: number, y: number, size: number): Point2[] => [
  [x, y],
  [x + size, y],
  [x + size, y + size],
  [x, y + size],
];

const kMethods = ['flooding', 'trapezoids'] as const;
const kAll: PolygonOptions[] = kMethods.flatMap((method) =>
  (['fast', 'delaunay'] as const).map((quality) => ({ method, quality })),
);

describe('triangulatePolygon', () => {
  test.each(kAll)('$method, $quality: covers random polygons exactly, certified', (options) => {
    const seed = 4711;
    const random = new Random(seed);
    for (let i = 0; i < 150; i++) {
      const polygon = smallPolygon(random);
      const { positions, starts } = flatPolygon(polygon);
      const { triangles } = triangulatePolygon({ positions, starts }, { ...options, verify: true });
      expectTriangulates(polygon, positions, triangles);
    }
  });

  test('nested, flat and as earcut takes them: the same triangles', () => {
    const polygon = holeGrid(3, 2, false, new Random(1));
    const flat = flatPolygon(polygon);
    const { triangles } = triangulatePolygon(flat);
    const holeIndices = Array.from(flat.starts.subarray(1, -1));
    const typed = polygon.map((ring) => ring.map((point) => Float64Array.from(point)));
    const others: PolygonLike[] = [
      polygon,
      typed,
      { coordinates: Array.from(flat.positions), holeIndices },
      { coordinates: flat.positions, holeIndices: Uint32Array.from(holeIndices), dim: 2 },
      { coordinates: Float32Array.from(flat.positions).map((x) => x), holeIndices },
    ];
    for (const other of others.slice(0, 4)) {
      expect(triangulatePolygon(other).triangles).toEqual(triangles);
    }
    // Single precision moves the vertices a little.
    expect(triangulatePolygon(others[4]).triangles.length).toBe(triangles.length);
    const [outer] = polygon;
    expect(triangulatePolygon({ coordinates: outer.flat() }).triangles).toEqual(
      triangulatePolygon([outer]).triangles,
    );
  });

  test('rings that run the other way, or repeat their first vertex: the same polygon', () => {
    const turned = kSquare.map((ring) => [...ring].reverse());
    expectTriangulates(turned, flatPolygon(turned).positions, triangulatePolygon(turned).triangles);
    const closed = kSquare.map((ring) => [...ring, ring[0]]);
    const { triangles } = triangulatePolygon(closed);
    const area = trianglesArea(flatPolygon(closed).positions, triangles);
    expect(area).toBe(polygonArea(kSquare));
  });

  test('isolated points: become vertices of triangles', () => {
    const points = Float64Array.of(6, 6, 7, 3, 1, 1);
    for (const method of kMethods) {
      const flat = flatPolygon(kSquare);
      const { triangles } = triangulatePolygon({ ...flat, points }, { method });
      expect(triangles.length / 3).toBe(8 + 2 * 3);
      expect(new Set(triangles).size).toBe(11);
      const positions = Float64Array.of(...flat.positions, ...points);
      expect(trianglesArea(positions, triangles)).toBe(96);
    }
  });

  test('strips: are the triangles, as OpenGL draws them', () => {
    const polygon = [partitionRing(200, new Random(5))];
    for (const method of kMethods) {
      const { triangles, strips, stripStarts } = triangulatePolygon(polygon, { method, output: 'strips' });
      expect(stripStarts[0]).toBe(0);
      expect(stripStarts[stripStarts.length - 1]).toBe(strips.length);
      const drawn = trianglesOfStrips(strips, stripStarts).flat();
      expect(sortedTriangles(drawn)).toEqual(sortedTriangles(triangles));
    }
    const plain = triangulatePolygon(polygon);
    expect(plain.strips.length + plain.trace.length + plain.added.length).toBe(0);
  });

  test('delaunay: no vertex of a neighbour lies inside the circle around a triangle', () => {
    const polygon: Polygon2 = [square(0, 0, 8), square(3, 3, 2)];
    const points = Float64Array.from(
      { length: 40 },
      (_, i) => ((i * 37) % 101) / 40 + 0.3 + (i % 2 ? 0 : 0.01 * i),
    );
    const flat = flatPolygon(polygon);
    const positions = Float64Array.of(...flat.positions, ...points);
    for (const method of kMethods) {
      const { triangles } = triangulatePolygon({ ...flat, points }, { method, quality: 'delaunay' });
      expect(deepestInCircle(positions, triangles, flat.starts)).toBeLessThan(1e-9);
    }
  });

  test('trace: actions of flooding, whose triangles add up', () => {
    const { trace, triangles } = triangulatePolygon(kSquare, { trace: true });
    expect(trace[0]).toMatchObject({ action: 'start', triangles: 0 });
    const counts = trace.map((step) => step.triangles);
    expect(counts).toEqual([...counts].sort((a, b) => a - b));
    expect(counts[counts.length - 1]).toBe(triangles.length / 3);
    const actions = new Set(trace.map(({ action }) => action));
    for (const action of ['raise', 'bridge', 'spill', 'jump'] as const) {
      expect(actions).toContain(action);
    }
  });

  test('repair: a bow-tie becomes two triangles that meet in an added point', () => {
    const bowTie: Polygon2 = [
      [
        [0, 0],
        [2, 2],
        [2, 0],
        [0, 2],
      ],
    ];
    for (const repair of ['even-odd', 'nonzero'] as const) {
      const { triangles, added, addedOn } = triangulatePolygon(bowTie, { repair });
      expect(triangles.length).toBe(6);
      expect(added).toEqual(Float64Array.of(1, 1));
      expect(Array.from(addedOn).sort()).toEqual([0, 2]);
      expect(trianglesArea(Float64Array.of(...bowTie.flat(2), ...added), triangles)).toBe(2);
    }
  });

  test('repair: garbage gives what winds, whichever method; a valid polygon stays as it is', () => {
    const random = new Random(99);
    for (let i = 0; i < 60; i++) {
      const polygon = garbage(1 + random.below(3), 3 + random.below(20), i % 2 ? 6 : 0, random);
      const areas = (['even-odd', 'nonzero'] as const).map((repair) => {
        const found = kMethods.map((method) => {
          const { triangles, added } = triangulatePolygon(polygon, { repair, method });
          return trianglesArea(Float64Array.of(...polygon.flat(2), ...added), triangles);
        });
        expect(found[1]).toBeCloseTo(found[0], 9);
        return found[0];
      });
      expect(areas[0]).toBeLessThanOrEqual(areas[1] + 1e-9);
    }
    for (let i = 0; i < 40; i++) {
      const polygon = smallPolygon(random);
      const { triangles, added } = triangulatePolygon(polygon, { repair: 'even-odd' });
      expect(added.length).toBe(0);
      expectTriangulates(polygon, flatPolygon(polygon).positions, triangles);
    }
  });

  test('borrow: views of the same triangles, and the library goes on as before', () => {
    const own = triangulatePolygon(kSquare).triangles;
    const { triangles, added } = triangulatePolygon(kSquare, { borrow: true });
    expect(triangles).toEqual(own);
    expect(triangles.buffer.byteLength).toBeGreaterThan(triangles.byteLength);
    expect(added.length).toBe(0);
    for (let i = 0; i < 1000; i++) triangulatePolygon(kSquare, { borrow: i % 3 > 0 });
    expect(triangulatePolygon(kSquare).triangles).toEqual(own);
  });

  test('results: fresh arrays, input untouched', () => {
    const flat = flatPolygon(kSquare);
    const before = structuredClone(flat);
    const first = triangulatePolygon(flat).triangles;
    const second = triangulatePolygon(flat).triangles;
    expect(second).toEqual(first);
    expect(second.buffer).not.toBe(first.buffer);
    expect(flat).toEqual(before);
  });

  test('maxSeconds: a large polygon ends with time-limit', () => {
    const polygon = flatPolygon([partitionRing(50_000, new Random(2))]);
    expect(errorOf(() => triangulatePolygon(polygon, { maxSeconds: 0 })).code).toBe('time-limit');
    expect(errorOf(() => triangulatePolygon(polygon, { maxMemoryBytes: 1000 })).code).toBe(
      'out-of-memory',
    );
    expect(triangulatePolygon(polygon).triangles.length / 3).toBe(49_998);
  });
});

/** How far, relatively, an opposite corner lies inside a triangle's circle, over all inner edges. */
function deepestInCircle(p: Float64Array, triangles: Uint32Array, starts: Uint32Array): number {
  const isRingEdge = (a: number, b: number): boolean =>
    Array.from(starts.subarray(0, -1)).some((first, r) => {
      const next = (v: number) => (v + 1 === starts[r + 1] ? first : v + 1);
      return (
        a >= first && a < starts[r + 1] && b >= first && b < starts[r + 1] &&
        (next(a) === b || next(b) === a)
      );
    });
  const opposite = new Map<string, number>();
  for (let h = 0; h < triangles.length; h++) {
    const at = (k: number) => triangles[h - (h % 3) + ((h + k) % 3)];
    opposite.set(`${at(0)} ${at(1)}`, at(2));
  }
  let deepest = 0;
  for (const [edge, c] of opposite) {
    const [a, b] = edge.split(' ').map(Number);
    const d = opposite.get(`${b} ${a}`);
    if (d === undefined || isRingEdge(a, b)) continue;
    const rows = [a, b, c].map((v) => {
      const [x, y] = [p[2 * v] - p[2 * d], p[2 * v + 1] - p[2 * d + 1]];
      return [x, y, x * x + y * y];
    });
    const [[ax, ay, aa], [bx, by, bb], [cx, cy, cc]] = rows;
    const inCircle = ax * (by * cc - bb * cy) - ay * (bx * cc - bb * cx) + aa * (bx * cy - by * cx);
    deepest = Math.max(deepest, inCircle);
  }
  return deepest;
}

describe('polygons in space', () => {
  const tilts: [string, (p: Point2) => number[]][] = [
    ['flat', ([x, y]) => [x, y, 3]],
    ['upright', ([x, y]) => [x, 7, y]],
    ['upright, from behind', ([x, y]) => [-2, x, y]],
    ['tilted by whole numbers', ([x, y]) => [x + y, x - y, 2 * x + y]],
    ['tilted', ([x, y]) => [0.36 * x - 0.8 * y, 0.48 * x + 0.6 * y, 0.8 * x]],
    ['far away and small', ([x, y]) => [1e6 + x / 64, y / 64, 1e6 - (x + y) / 64]],
  ];
  test.each(tilts)('%s: as many triangles as in the plane, wound as the outer ring', (_, place) => {
    for (const options of kAll) {
      for (const polygon of [kSquare, [partitionRing(60, new Random(8))], [staircaseRing(6)]]) {
        for (const rings of [polygon, polygon.map((ring) => [...ring].reverse())]) {
          const { triangles } = triangulatePolygon(rings.map((ring) => ring.map(place)), options);
          expect(triangles.length / 3).toBe(rings.flat().length + 2 * rings.length - 4);
          // In the plane's own coordinates the areas show how the triangles are wound.
          const area = trianglesArea(flatPolygon(rings).positions, triangles);
          expect(area).toBeCloseTo(Math.sign(areaOf(rings[0])) * polygonArea(rings), 6);
        }
      }
    }
  });

  test('rings that touch: still do, at any tilt', () => {
    const polygon: Polygon2 = [square(0, 0, 9), [[3, 3], [9, 4], [4, 6]], [[3, 3], [2, 5], [1, 2]]];
    for (const [, place] of tilts.slice(0, 4)) {
      for (const options of kAll) {
        const space = polygon.map((ring) => ring.map(place));
        const { triangles } = triangulatePolygon(space, options);
        expect(trianglesArea(flatPolygon(polygon).positions, triangles)).toBe(polygonArea(polygon));
      }
    }
  });

  test('repair: added points lie in the plane', () => {
    const bowTie = [[[0, 0, 0], [2, 2, 4], [2, 0, 2], [0, 2, 2]]] as const;
    const { added, triangles } = triangulatePolygon(bowTie, { repair: 'even-odd' });
    expect(added).toEqual(Float64Array.of(1, 1, 2));
    expect(triangles.length).toBe(6);
  });

  test('errors: name the point in space', () => {
    const error = errorOf(() => triangulatePolygon([[[5, 0, 0], [5, 2, 2], [5, 2, 0], [5, 0, 2]]]));
    expect(error).toMatchObject({ code: 'self-intersecting', point: [5, 1, 1] });
    const nan = [[0, 0, 0], [1, 0, 0], [1, 1, NaN]];
    expect(errorOf(() => triangulatePolygon([nan]))).toMatchObject({ code: 'not-finite', loop: 0, vertex: 2 });
  });
});

const at = (loop: number, vertex?: number, otherLoop?: number, otherVertex?: number) => ({
  loop,
  vertex,
  otherLoop,
  otherVertex,
});

describe('invalid polygons', () => {
  const outer = square(0, 0, 10);
  const invalid: [string, Polygon2, string, object][] = [
    ['a bow-tie', [[[0, 0], [2, 2], [2, 0], [0, 2]]], 'self-intersecting', { ...at(0, 0, 0, 2), point: [1, 1] }],
    ['holes that cross', [outer, square(2, 2, 3), square(4, 3, 3)], 'holes-overlap', {}],
    ['a hole across the outer ring', [outer, square(8, 4, 4)], 'hole-outside', {}],
    ['a hole outside', [outer, square(20, 4, 4)], 'hole-outside', at(1)],
    ['a hole in a hole', [outer, square(2, 2, 6), square(4, 4, 2)], 'nested-hole', at(2, undefined, 1)],
    ['two points', [[[0, 0], [1, 0]]], 'degenerate', at(0)],
    ['a spike', [[[0, 0], [4, 0], [4, 4], [4, 9], [4, 4], [0, 4]]], 'degenerate', at(0, 3)],
    ['an empty hole', [outer, []], 'degenerate', at(1)],
    ['NaN', [outer, [[1, 1], [2, NaN], [2, 2]]], 'not-finite', at(1, 1)],
    ['infinity', [[[0, 0], [1, 0], [1, -Infinity]]], 'not-finite', at(0, 2)],
  ];
  test.each(invalid)('%s', (_, polygon, code, place) => {
    for (const options of [...kAll, { verify: true }, { output: 'strips' as const }]) {
      const error = errorOf(() => triangulatePolygon(polygon, options));
      expect(error).toBeInstanceOf(SoapfilmError);
      expect(error).toMatchObject({ code, ...place });
      expect(error.polygon).toBeUndefined();
      expect(error.message).toMatch(/^[A-Z]/);
      expect(error.message).toMatch(/\b[Rr]ing \d/);
      expect(error.message).not.toMatch(/loop/i);
    }
    expect(triangulatePolygon(kSquare).triangles.length).toBe(24);
  });

  test('edges that cross: both are named, and the point where they do', () => {
    const error = errorOf(() => triangulatePolygon([outer, square(2, 2, 3), square(4, 3, 3)]));
    const { loop, vertex = 0, otherLoop, otherVertex = 0, point } = error;
    expect(new Set([loop, otherLoop])).toEqual(new Set([1, 2]));
    expect([[5, 3], [4, 5]]).toContainEqual(point);
    expect(vertex).toBeLessThan(4);
    expect(otherVertex).toBeLessThan(4);
  });
});

describe('what is no polygon', () => {
  const bad: [string, unknown, string, object][] = [
    ['nothing', undefined, 'bad-polygon', {}],
    ['null', null, 'bad-polygon', {}],
    ['a number', 7, 'bad-polygon', {}],
    ['numbers', [1, 2, 3], 'bad-polygon', { loop: 0 }],
    ['a point that is none', [[[0, 0], [1, 0], 5]], 'bad-polygon', { loop: 0, vertex: 2 }],
    ['a short point', [square(0, 0, 5), [[1, 1], [2], [2, 2]]], 'bad-polygon', { loop: 1, vertex: 1 }],
    ['points of two kinds', [[[0, 0], [1, 0], [1, 1, 1]]], 'bad-polygon', { loop: 0, vertex: 2 }],
    ['text for a number', [[[0, 0], ['1', 0], [1, 1]]], 'bad-polygon', { loop: 0, vertex: 1 }],
    ['arrays of the wrong type', { positions: [0, 0, 1, 0, 1, 1], starts: [0, 3] }, 'bad-polygon', {}],
    ['half a point', { positions: new Float64Array(5), starts: Uint32Array.of(0, 2) }, 'bad-polygon', {}],
    ['four dimensions', { coordinates: new Float64Array(12), dim: 4 }, 'bad-option', {}],
    ['coordinates that are text', { coordinates: ['0', 0, 1, 0, 1, 1] }, 'bad-polygon', {}],
    ['no starts', { positions: new Float64Array(6), starts: new Uint32Array() }, 'bad-starts', {}],
    ['starts that end early', { positions: new Float64Array(6), starts: Uint32Array.of(0, 2) }, 'bad-starts', {}],
    ['starts that fall', { positions: new Float64Array(6), starts: Uint32Array.of(0, 5, 3) }, 'bad-starts', {}],
    ['starts that begin late', { positions: new Float64Array(6), starts: Uint32Array.of(1, 3) }, 'bad-starts', {}],
    ['holes beyond the end', { coordinates: new Float64Array(6), holeIndices: [7] }, 'bad-starts', {}],
  ];
  test.each(bad)('%s', (_, polygon, code, place) => {
    const error = errorOf(() => triangulatePolygon(polygon as PolygonLike));
    expect(error).toMatchObject({ code, ...place });
  });

  test('no ring at all, or an empty one: no triangles, or degenerate', () => {
    expect(triangulatePolygon([]).triangles.length).toBe(0);
    expect(errorOf(() => triangulatePolygon([[]])).code).toBe('degenerate');
  });

  const options: object[] = [
    { method: 'ears' },
    { quality: 'best' },
    { output: 'fans' },
    { repair: true },
    { verify: 1 },
    { trace: 'yes' },
    { borrow: null },
    { maxSeconds: -1 },
    { maxMemoryBytes: NaN },
  ];
  test.each(options)('%o: bad-option', (option) => {
    expect(errorOf(() => triangulatePolygon(kSquare, option)).code).toBe('bad-option');
  });

  test('options that are none, and traces of what is not flooding: bad-option', () => {
    expect(errorOf(() => triangulatePolygon(kSquare, null as unknown as PolygonOptions)).code).toBe('bad-option');
    const trapezoids = { trace: true, method: 'trapezoids' } as const;
    expect(errorOf(() => triangulatePolygon(kSquare, trapezoids))).toMatchObject({
      code: 'bad-option',
      message: expect.stringContaining('`trace`') as string,
    });
    expect(errorOf(() => triangulatePolygons([kSquare, kSquare], { trace: true }))).toMatchObject({
      code: 'bad-option',
      message: expect.stringContaining('`trace`') as string,
    });
    const withPoint = { positions: Float64Array.of(0, 0, 2, 0, 0, 2), points: Float64Array.of(0.5, 0.5) };
    expect(errorOf(() => triangulatePolygon(withPoint, { repair: 'even-odd' }))).toMatchObject({
      code: 'bad-option',
      message: expect.stringContaining('`repair`') as string,
    });
  });
});

describe('triangulatePolygons', () => {
  const random = new Random(12);
  const polygons = Array.from({ length: 200 }, () => smallPolygon(random));
  const flat = flatPolygon(polygons.flat());
  const polygonStarts = new Uint32Array(polygons.length + 1);
  polygons.forEach((polygon, p) => (polygonStarts[p + 1] = polygonStarts[p] + polygon.length));
  const batch = { positions: flat.positions, ringStarts: flat.starts, polygonStarts };
  const firstVertex = (p: number): number => flat.starts[polygonStarts[p]];

  test.each(kAll)('$method, $quality: each polygon as by itself', (options) => {
    const { triangles, triangleStarts, errors } = triangulatePolygons(batch, options);
    expect(errors).toEqual([]);
    expect(triangleStarts.length).toBe(polygons.length + 1);
    expect(triangleStarts[polygons.length]).toBe(triangles.length / 3);
    polygons.forEach((polygon, p) => {
      const alone = triangulatePolygon(polygon, options).triangles.map((v) => v + firstVertex(p));
      const own = triangles.subarray(3 * triangleStarts[p], 3 * triangleStarts[p + 1]);
      expect(Array.from(own)).toEqual(Array.from(alone));
    });
    expect(triangulatePolygons(polygons, options).triangles).toEqual(triangles);
  });

  test('strips: those of each polygon apart', () => {
    const options = { method: 'trapezoids', output: 'strips' } as const;
    const found = triangulatePolygons(batch, options);
    const { triangles, triangleStarts, strips, stripStarts, polygonStrips } = found;
    expect(polygonStrips[polygons.length]).toBe(stripStarts.length - 1);
    polygons.forEach((_, p) => {
      const starts = stripStarts.subarray(polygonStrips[p], polygonStrips[p + 1] + 1);
      const drawn = trianglesOfStrips(strips, starts).flat();
      const own = triangles.subarray(3 * triangleStarts[p], 3 * triangleStarts[p + 1]);
      expect(sortedTriangles(drawn)).toEqual(sortedTriangles(own));
    });
  });

  test('repair: added points are numbered after all vertices', () => {
    const cross: Polygon2 = [[[0, 0], [2, 2], [2, 0], [0, 2]]];
    const found = triangulatePolygons([kSquare, cross, cross, kSquare], { repair: 'even-odd' });
    const { triangles, triangleStarts, added, addedOn } = found;
    expect(added).toEqual(Float64Array.of(1, 1, 1, 1));
    const positions = Float64Array.of(...[kSquare, cross, cross, kSquare].flat(3), ...added);
    const areas = [0, 1, 2, 3].map((p) =>
      trianglesArea(positions, triangles.subarray(3 * triangleStarts[p], 3 * triangleStarts[p + 1])),
    );
    expect(areas).toEqual([96, 2, 2, 96]);
    expect(Array.from(addedOn.subarray(2)).sort()).toEqual([12, 14]);
  });

  test('an invalid one: throws with its number, or is skipped', () => {
    const bowTie: Polygon2 = [[[0, 0], [2, 2], [2, 0], [0, 2]]];
    const mixed = [kSquare, bowTie, kSquare, [square(0, 0, 1), square(5, 5, 1)]];
    for (const options of kAll) {
      const error = errorOf(() => triangulatePolygons(mixed, options));
      expect(error).toMatchObject({ code: 'self-intersecting', polygon: 1, ...at(0, 0, 0, 2), point: [1, 1] });
      const { triangles, triangleStarts, errors } = triangulatePolygons(mixed, { ...options, skipInvalid: true });
      expect(Array.from(triangleStarts)).toEqual([0, 8, 8, 16, 16]);
      expect(triangles.length).toBe(48);
      expect(errors.map(({ code, polygon, loop }) => [code, polygon, loop])).toEqual([
        ['self-intersecting', 1, 0],
        ['hole-outside', 3, 1],
      ]);
      expect(errors[0]).toBeInstanceOf(SoapfilmError);
    }
  });

  test('in space: each in its own plane', () => {
    const upright = kSquare.map((ring) => ring.map(([x, y]) => [x, 0, y]));
    const sloping = kSquare.map((ring) => ring.map(([x, y]) => [x, y, x]));
    const { triangles, triangleStarts } = triangulatePolygons([upright, sloping]);
    expect(Array.from(triangleStarts)).toEqual([0, 8, 16]);
    const positions = flatPolygon([...kSquare, ...kSquare]).positions;
    expect(Math.abs(trianglesArea(positions, triangles.subarray(0, 24)))).toBe(96);
  });

  test('none, empty ones, and what is none', () => {
    expect(triangulatePolygons([]).triangles.length).toBe(0);
    expect(Array.from(triangulatePolygons([[], kSquare]).triangleStarts)).toEqual([0, 0, 8]);
    const bad = (polygons: unknown) => errorOf(() => triangulatePolygons(polygons as [])).code;
    expect(bad(undefined)).toBe('bad-polygon');
    expect(bad([5])).toBe('bad-polygon');
    expect(bad({ ...batch, polygonStarts: Uint32Array.of(0, 5) })).toBe('bad-starts');
    expect(bad({ ...batch, polygonStarts: Uint32Array.of(0, 9, 5, flat.starts.length - 1) })).toBe('bad-starts');
    expect(errorOf(() => triangulatePolygons([kSquare, kSquare], { trace: true })).code).toBe('bad-option');
    const error = errorOf(() => triangulatePolygons([kSquare, [square(0, 0, 1), [[1, 2], [3]]]]));
    expect(error).toMatchObject({ code: 'bad-polygon', polygon: 1, loop: 1, vertex: 1 });
  });
});
