// Trimmed surfaces: models as they come in, instances, meshes as they come out.
import { load } from 'soapfilm';
import { TrimmedModel, TrimmedSurface, type Mesh, type Model, type ModelInstance, type Sampling, type TrimmedOptions } from 'soapfilm/surfaces';
import { beforeAll, describe, expect, test } from 'vitest';
import { errorOf } from '../support/errors.js';
import { box, lineOf, measure, modelOf, plate, tube } from '../support/models.js';

beforeAll(() => load({ parts: ['surfaces'] }));

function meshOf(model: Model, sampling?: Sampling, options?: TrimmedOptions): Mesh {
  const opened = new TrimmedModel(model, options);
  try {
    return opened.tessellate(sampling);
  } finally {
    opened.dispose();
  }
}

const triangle = [[0.25, 0.25], [0.75, 0.25], [0.5, 0.75]];

describe('meshes', () => {
  test('a box: two triangles a face, closed, of its area and volume, with normals outwards', () => {
    const mesh = meshOf(box(1, 2, 3));
    expect(mesh.triangles).toHaveLength(36);
    expect(Array.from(mesh.faceStarts)).toEqual([0, 2, 4, 6, 8, 10, 12]);
    expect(measure(mesh)).toEqual({ area: 22, volume: 6, open: 0 });
    expect(mesh.positions).toHaveLength(3 * 24);
    expect(new Set(mesh.same).size).toBe(8);
    expect(mesh.deviation).toBe(0);
    expect(mesh.reports).toEqual([]);
    for (let t = 0; t < 12; t++) {
      const outwards = [[0, 0, -1], [0, 0, 1], [0, -1, 0], [0, 1, 0], [-1, 0, 0], [1, 0, 0]][Math.floor(t / 2)];
      for (const vertex of mesh.triangles.subarray(3 * t, 3 * t + 3)) {
        expect(Array.from(mesh.normals.subarray(3 * vertex, 3 * vertex + 3), (x) => x + 0)).toEqual(outwards);
      }
    }
  });

  test('edges: each has the vertices along it, in its own direction', () => {
    const model = box();
    const { edges, edgeStarts, positions, origin } = meshOf(model);
    expect(edgeStarts).toHaveLength(13);
    (model.edges ?? []).forEach(({ curve3d }, e) => {
      const [from, to] = [edges[edgeStarts[e]], edges[edgeStarts[e + 1] - 1]];
      const at = (vertex: number) => [0, 1, 2].map((k) => positions[3 * vertex + k] + origin[k]);
      expect([at(from), at(to)]).toEqual(curve3d?.poles);
    });
  });

  test.each([false, true])('a tube, with loops and a seam: %s: its area by order 2, open at its two ends alone', (hasLoops) => {
    const errors = [1e-2, 1e-4].map((tolerance) => {
      const mesh = meshOf(tube(1, hasLoops), { tolerance, angle: Infinity });
      expect(mesh.deviation).toBeLessThanOrEqual(tolerance);
      const { area, open } = measure(mesh);
      const rims = mesh.same.reduce((count, first, vertex) => count + Number(first === vertex && mesh.positions[3 * vertex + 2] + mesh.origin[2] !== 0.5), 0);
      expect(open).toBeLessThanOrEqual(rims);
      return Math.abs(area - 2 * Math.PI);
    });
    expect(errors[0]).toBeLessThan(0.1);
    expect(errors[1]).toBeLessThan(errors[0] / 30);
  });

  test('holes: are left out, whichever way they run', () => {
    for (const hole of [triangle, [...triangle].reverse()]) {
      expect(measure(meshOf(modelOf(plate([hole])))).area).toBeCloseTo(1 - 0.125, 6);
    }
  });

  test('a reversed face: other normals, and triangles the other way', () => {
    const model = box();
    const mesh = meshOf({ ...model, faces: (model.faces ?? []).map((face) => ({ ...face, reversed: true })) });
    const { volume, open } = measure(mesh);
    expect([volume, open]).toEqual([-1, 0]);
    expect(mesh.normals[2]).toBe(1);
  });

  test('a surface: as a model of it alone', () => {
    const face = plate([triangle]);
    const surface = new TrimmedSurface(face);
    expect(surface.tessellate()).toEqual(meshOf(modelOf(face)));
    surface.dispose();
    const whole = new TrimmedSurface({ surface: (tube().faces ?? [])[0].surface });
    expect(whole.tessellate({ tolerance: 0.01 })).toEqual(meshOf(tube(), { tolerance: 0.01 }));
    whole.dispose();
  });

  test('relative: of the diagonal; the default is a thousandth; of it and a tolerance the lesser counts', () => {
    const opened = new TrimmedModel(tube(2));
    const diagonal = Math.hypot(4, 4, 1);
    expect(opened.tessellate().tolerance).toBeCloseTo(1e-3 * diagonal, 9);
    expect(opened.tessellate({ relative: 1e-2 }).tolerance).toBeCloseTo(1e-2 * diagonal, 9);
    expect(opened.tessellate({ relative: 1e-2, tolerance: 1e-3 }).tolerance).toBeCloseTo(1e-3, 9);
    expect(opened.tessellate({ tolerance: 0.5 }).tolerance).toBeCloseTo(0.5, 9);
    opened.dispose();
  });

  test('maxTriangles: the tolerance is raised, and that is told', () => {
    const { triangles, tolerance, reports } = meshOf(tube(), { tolerance: 1e-6, maxTriangles: 500 });
    expect(triangles.length / 3).toBeLessThanOrEqual(500);
    expect(reports).toContainEqual({ report: 'tolerance-raised', tolerance });
    expect(tolerance).toBeGreaterThan(1e-6);
  });

  test('onProgress: hears of the end; what it throws before ends the work', () => {
    const heard: number[] = [];
    meshOf(box(), { onProgress: (fraction) => heard.push(fraction) });
    expect(heard.at(-1)).toBe(1);
    const reason = new Error('enough');
    const many = { instances: Array.from({ length: 200 }, (_, i) => ({ part: tube(1 + i), matrix: [1, 0, 0, 3 * i, 0, 1, 0, 0, 0, 0, 1, 0] })) };
    const stop = (): never => {
      throw reason;
    };
    expect(() => meshOf(many, { relative: 1e-7, onProgress: stop })).toThrow(reason);
  });

  test('a camera: what it sees is fine, what it does not is coarse', () => {
    const model: Model = { instances: [0, 100].map((x): ModelInstance => ({ part: tube(), matrix: [1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0] })) };
    // Orthographic, from above, over the first tube alone.
    const viewProjection = [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, -0.1, 0, 0, 0, 0, 1];
    const camera = { eye: [0, 0, 10], viewProjection, width: 1000, height: 1000 };
    const [first, second] = [0, 1].map((face) => {
      const { faceStarts } = meshOf(model, { camera });
      return faceStarts[face + 1] - faceStarts[face];
    });
    expect(first).toBeGreaterThan(3 * second);
    expect(first).toBeGreaterThan(100);
  });
});

describe('models', () => {
  test('numbers: of typed arrays as of lists', () => {
    const face = plate([triangle]);
    const { surface, loops = [], edges = [] } = face;
    const typed = {
      ...face,
      surface: {
        ...surface,
        knotsU: Float64Array.from([0, 0, 1, 1]),
        knotsV: Float32Array.from([0, 0, 1, 1]),
        poles: surface.poles.map((pole) => Float64Array.from(pole as number[])),
      },
      edges: edges.map((edge) => ({ ...edge, range: Float32Array.of(0, 1) })),
      loops,
    };
    expect(meshOf(modelOf(typed))).toEqual(meshOf(modelOf(face)));
  });

  test('ids of edges: uses name edges by them, in any order', () => {
    const { faces = [], edges = [] } = box();
    const count = edges.length;
    const named: Model = {
      faces: faces.map((face) => ({
        ...face,
        loops: (face.loops ?? []).map(({ uses }) => ({ uses: uses.map((use) => ({ ...use, edge: 100 + use.edge })) })),
      })),
      edges: edges.map((edge, id) => ({ ...edge, id: 100 + id })).reverse(),
    };
    expect(measure(meshOf(named))).toEqual({ area: 6, volume: 1, open: 0 });
    const twice: Model = { ...named, edges: (named.edges ?? []).map((edge) => ({ ...edge, id: 100 })) };
    expect(errorOf(() => new TrimmedModel(twice))).toMatchObject({ code: 'bad-model' });
    const unnamed: Model = { ...named, edges: [...edges.slice(0, count - 1), { ...edges[count - 1], id: 7 }] };
    expect(errorOf(() => new TrimmedModel(unnamed)).message).toMatch(/`id`/);
  });

  test('a model without faces: an empty mesh', () => {
    for (const model of [{ faces: [], edges: [] }, { instances: [] }]) {
      const mesh = meshOf(model);
      expect([mesh.triangles.length, mesh.positions.length, mesh.faceStarts.length]).toEqual([0, 0, 1]);
    }
  });

  test('the object given: is not looked at again, and not changed', () => {
    const model = box();
    const before = structuredClone(model);
    const opened = new TrimmedModel(model);
    const mesh = opened.tessellate();
    expect(model).toEqual(before);
    (model.faces as unknown[]).length = 0;
    expect(opened.tessellate()).toEqual(mesh);
    opened.dispose();
  });

  test('disposed: whatever is asked of it is disposed', () => {
    const opened = new TrimmedModel(box());
    opened.dispose();
    opened.dispose();
    for (const use of [
      () => opened.tessellate(),
      () => opened.update(),
      () => {
        opened.movePole(0, 0, [0, 0, 0]);
      },
      () => {
        opened.moveTrim(0, 0, 0, 0, [0, 0]);
      },
    ]) {
      expect(errorOf(use).code).toBe('disposed');
    }
  });
});

describe('instances', () => {
  const kShift = [1, 0, 0, 10, 0, 1, 0, 20, 0, 0, 1, 30];
  /** x to y, y to z, z to x, each stretched by another factor. */
  const kTurn = [0, 0, 4, 0, 2, 0, 0, 0, 0, 3, 0, 0];
  const columns = (rows: readonly number[]): number[] =>
    [0, 1, 2, 3].flatMap((column) => [...[0, 1, 2].map((row) => rows[4 * row + column]), Number(column === 3)]);
  const boundsOf = ({ positions, origin }: Mesh): number[][] => {
    const of = (k: number): number[] => Array.from(positions.filter((_, i) => i % 3 === k), (x) => x + origin[k]);
    return [0, 1, 2].map((k) => [Math.min(...of(k)), Math.max(...of(k))]);
  };

  test('a matrix of 12 or of 16 numbers, in a list or a typed array: moves all of a part', () => {
    for (const matrix of [kShift, columns(kShift), Float64Array.from(kShift), Float32Array.from(columns(kShift))]) {
      const mesh = meshOf({ instances: [{ part: box(1, 2, 3), matrix }] });
      expect(boundsOf(mesh)).toEqual([[10, 11], [20, 22], [30, 33]]);
      expect(measure(mesh)).toMatchObject({ area: 22, open: 0 });
      expect(measure(mesh).volume).toBeCloseTo(6, 9);
    }
    const mesh = meshOf({ instances: [{ part: box(), matrix: kTurn }] });
    expect(boundsOf(mesh)).toEqual([[0, 4], [0, 2], [0, 3]]);
    expect(measure(mesh)).toEqual({ area: 2 * (8 + 12 + 6), volume: 24, open: 0 });
  });

  test('a mirror: normals stay outside', () => {
    const mirrored = { instances: [{ part: box(), matrix: [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0] }] };
    const mesh = meshOf(mirrored);
    expect(measure(mesh)).toEqual({ area: 6, volume: 1, open: 0 });
    expect(boundsOf(mesh)[0]).toEqual([-1, 0]);
    const twice = { instances: [{ part: mirrored, matrix: [1, 0, 0, 0, 0, -2, 0, 0, 0, 0, 1, 0] }] };
    expect(measure(meshOf(twice))).toEqual({ area: 10, volume: 2, open: 0 });
  });

  test('many: faces of the model first, then of each instance; parts by name, by number, within parts', () => {
    const own = box();
    const pair: Model = { instances: [{ part: box() }, { part: box(), matrix: kTurn }] };
    const one: Model = { ...own, instances: [{ part: pair, matrix: kShift }] };
    const numbered: Model = { parts: [box()], instances: [{ part: 0 }, { part: 0, matrix: kTurn }] };
    const named: Model = { ...own, parts: { box: box(), pair: numbered }, instances: [{ part: 'pair', matrix: kShift }] };
    const mesh = meshOf(one);
    expect(mesh.faceStarts).toHaveLength(19);
    expect(mesh.edgeStarts).toHaveLength(37);
    expect(measure(mesh).area).toBeCloseTo(6 + 6 + 52, 5);
    expect(boundsOf(mesh)).toEqual([[0, 14], [0, 22], [0, 33]]);
    expect(meshOf(named)).toEqual(mesh);
  });

  test("an edge's tolerance: grows with the part", () => {
    const model = box();
    // An edge off by 4e-5 of the diagonal, as it says.
    const off = (edges: Model['edges'] = []) =>
      edges.map((edge, e) => (e === 0 ? { ...edge, tolerance: 1e-4, curve3d: lineOf([7e-5, 0, 0], [7e-5, 1, 0]) } : edge));
    const bad = { ...model, edges: off(model.edges) };
    const large = [100, 0, 0, 0, 0, 100, 0, 0, 0, 0, 1, 0];
    expect(() => meshOf({ instances: [{ part: bad, matrix: large }] })).not.toThrow();
    const none = { ...bad, edges: bad.edges.map((edge) => ({ ...edge, tolerance: 0 })) };
    expect(errorOf(() => meshOf({ instances: [{ part: none, matrix: large }] }))).toMatchObject({ code: 'edge-apart' });
  });

  test('a fault in a part: is one of each instance, whose number the message has', () => {
    const part = { ...box(), faces: (box().faces ?? []).map((face, f) => (f === 2 ? { ...face, surface: { ...face.surface, knotsU: [0, 0, 1] } } : face)) };
    const crooked = { ...box(), faces: (box().faces ?? []).map((face, f) => (f === 2 ? { ...face, outer: 'first' as never } : face)) };
    expect(errorOf(() => new TrimmedModel({ ...box(), instances: [{ part: box() }, { part }] }))).toMatchObject({ code: 'bad-knots', face: 14 });
    const error = errorOf(() => new TrimmedModel({ ...box(), instances: [{ part: box() }, { part: crooked }] }));
    expect(error).toMatchObject({ code: 'bad-model', face: 14 });
    expect(error.message).toMatch(/^Instance 1: .*faces\[2\]\.outer/);
    const mesh = meshOf({ instances: [{ part: crooked }, { part }] }, {}, { skipInvalid: true });
    expect(mesh.reports).toMatchObject([
      { report: 'left-out', face: 2, code: 'bad-model' },
      { report: 'left-out', face: 8, code: 'bad-knots' },
    ]);
    expect(mesh.triangles).toHaveLength(3 * 20);
  });

  const loop: Model = { instances: [] };
  (loop.instances as ModelInstance[]).push({ part: loop });
  /** 2^40 boxes. */
  const many = Array.from({ length: 40 }).reduce<Model>((part) => ({ instances: [{ part }, { part }] }), box());
  const bad: [string, Model, string, RegExp][] = [
    ['a part that there is none of', { parts: { a: box() }, instances: [{ part: 'b' }] }, 'bad-model', /instances\[0\]\.part.*"b"/],
    ['a part by the name of a method', { parts: {}, instances: [{ part: 'toString' }] }, 'bad-model', /"toString"/],
    ['a model within itself', loop, 'bad-model', /itself/],
    ['more than memory holds', many, 'too-large', /instances/],
    ['a matrix of 11 numbers', { instances: [{ part: box(), matrix: kShift.slice(1) }] }, 'bad-model', /matrix.*12/],
    ['a matrix with NaN', { instances: [{ part: box(), matrix: kShift.map((x) => x || NaN) }] }, 'bad-model', /matrix/],
    ['a matrix of a perspective', { instances: [{ part: box(), matrix: columns(kShift).fill(1, 3, 4) }] }, 'bad-model', /matrix/],
    ['a matrix that makes all flat', { instances: [{ part: box(), matrix: kShift.map((x, i) => (i === 10 ? 0 : x)) }] }, 'bad-model', /flat/],
  ];
  test.each(bad)('%s: is an error that says so', (_, model, code, message) => {
    const error = errorOf(() => new TrimmedModel(model));
    expect(error.code).toBe(code);
    expect(error.message).toMatch(message);
  });
});

describe('updates', () => {
  test('to and fro: each is the mesh that the ranges make of the one before', () => {
    const model = { instances: [0, 5, 9].map((x): ModelInstance => ({ part: tube(1 + x / 9), matrix: [1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0] })) };
    const opened = new TrimmedModel(model);
    const before: Partial<Record<'positions' | 'triangles' | 'strips', Float32Array | Uint32Array>> = {};
    for (const relative of [1e-2, 1e-3, 1e-3, 1e-4, 1e-2]) {
      const { mesh, vertexRanges, indexRanges, stripRanges } = opened.update({ relative });
      for (const [name, ranges, width] of [['positions', vertexRanges, 3], ['triangles', indexRanges, 1], ['strips', stripRanges, 1]] as const) {
        const patched = new (mesh[name].constructor as Float32ArrayConstructor)(mesh[name].length);
        const old = before[name];
        if (old) patched.set(old.subarray(0, patched.length));
        for (let i = 0; i < ranges.length; i += 2) patched.set(mesh[name].subarray(width * ranges[i], width * ranges[i + 1]), width * ranges[i]);
        expect(patched, name).toEqual(mesh[name]);
        before[name] = mesh[name].slice();
      }
      expect(mesh.deviation).toBeLessThanOrEqual(mesh.tolerance);
    }
    opened.dispose();
  });

  test("a tessellation's arrays: no update writes to them", () => {
    const opened = new TrimmedModel(tube());
    const mesh = opened.tessellate({ relative: 1e-2 });
    const copy = structuredClone(mesh);
    opened.update({ relative: 1e-4 });
    expect(mesh).toEqual(copy);
    opened.dispose();
  });

  test('movePole, moveTrim: as a model that was given so', () => {
    const opened = new TrimmedSurface(plate([triangle]));
    opened.update();
    opened.movePole(0, 3, [2, 1, 0]);
    opened.moveTrim(0, 1, 0, 1, { x: 0.75, y: 0.5 });
    const { mesh } = opened.update();
    expect(measure(mesh).area).toBeCloseTo(measure(opened.tessellate()).area, 6);
    expect(measure(mesh).area).toBeGreaterThan(1.2);
    const error = errorOf(() => {
      opened.moveTrim(0, 1, 0, 1, [3, 3]);
    });
    expect(error).toMatchObject({ face: 0, loop: 1 });
    expect(error.code).toMatch(/^trim/);
    expect(measure(opened.update().mesh)).toEqual(measure(mesh));
    opened.dispose();
  });

  test('a face that shares edges: its poles stay, bad-edge', () => {
    const opened = new TrimmedModel(box());
    const error = errorOf(() => {
      opened.movePole(1, 0, [0, 0, 5]);
    });
    expect(error).toMatchObject({ code: 'bad-edge', face: 1 });
    expect(measure(opened.tessellate())).toEqual({ area: 6, volume: 1, open: 0 });
    opened.dispose();
  });
});
