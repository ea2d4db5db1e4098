// Faults of trimmed surfaces: each by its code, its place, and in words; faces with faults left out where that is asked for.
import { load, SoapfilmError, type ErrorCode } from 'soapfilm';
import { TrimmedModel, TrimmedSurface, type EdgeUse, type Face, type FaceLoop, type Model, type ModelEdge, type NurbsSurface } from 'soapfilm/surfaces';
import { beforeAll, describe, expect, test } from 'vitest';
import { errorOf } from '../support/errors.js';
import { Random } from '../support/generators.js';
import { box, lineOf, measure, modelOf, patchOf, plate, polygonOf, tube } from '../support/models.js';

beforeAll(() => load({ parts: ['surfaces'] }));

const kLow = [[0.1, 0.1], [0.4, 0.1], [0.4, 0.4], [0.1, 0.4]];
const kHigh = kLow.map(([u, v]) => [u + 0.5, v + 0.5]);
const kAcross = kLow.map(([u, v]) => [u + 0.2, v + 0.1]);

type Place = Partial<Pick<SoapfilmError, 'face' | 'loop' | 'use' | 'otherLoop' | 'edge'>>;

/** A plate with two holes, one thing of which is changed. */
const withSurface = (change: Partial<NurbsSurface>): Face => {
  const face = plate([kLow, kHigh]);
  return { ...face, surface: { ...face.surface, ...change } };
};
const withUse = (loop: number, use: number, change: Partial<Record<keyof EdgeUse, unknown>>): Face => {
  const face = plate([kLow, kHigh]);
  const loops = (face.loops ?? []).map(
    ({ uses }, l): FaceLoop => ({ uses: uses.map((given, u) => (l === loop && u === use ? ({ ...given, ...change } as EdgeUse) : given)) }),
  );
  return { ...face, loops };
};
const withEdge = (edge: number, change: Partial<Record<keyof ModelEdge, unknown>>): Face => {
  const face = plate([kLow, kHigh]);
  return { ...face, edges: (face.edges ?? []).map((given, e) => (e === edge ? ({ ...given, ...change } as ModelEdge) : given)) };
};
const cut = (hole: readonly (readonly number[])[]): Face => withUse(1, 0, { pcurve: polygonOf(hole) });

const kPoles = patchOf([0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0]).poles;
/** There and back again, by another way that is the same line. */
const kFlat: Face = {
  ...withUse(1, 0, {}),
  loops: [
    ...(plate().loops ?? []),
    { uses: [{ edge: 4, pcurve: lineOf([0.2, 0.2], [0.8, 0.8]) }, { edge: 5, pcurve: lineOf([0.8, 0.8], [0.2, 0.2]) }] },
  ],
};

const kOutside: Face = { ...plate([kLow]), loops: [{ uses: [{ edge: 0, pcurve: polygonOf(kLow.map(([u, v]) => [u - 0.3, v])) }] }] };

const faults: [string, Face, ErrorCode, Place, RegExp][] = [
  ['knots that fall', withSurface({ knotsU: [0, 1, 0, 1] }), 'bad-knots', { face: 0 }, /^Face 0: the knots of the surface/],
  ['too few knots', withSurface({ knotsV: [0, 0, 1] }), 'bad-knots', { face: 0 }, /knots/],
  ['a degree of 0', withSurface({ degreeU: 0, knotsU: [0, 0.5, 1] }), 'bad-knots', { face: 0 }, /degree/],
  [
    'knots of a trimming curve that fall',
    withUse(1, 0, { pcurve: { degree: 1, knots: [0, 0, 0.7, 0.3, 1, 1], poles: kLow } }),
    'bad-knots',
    { face: 0, loop: 1, use: 0, edge: 4 },
    /^Face 0, loop 1, use 0 \(edge 4\): the knots of a curve of this edge/,
  ],
  [
    'knots of an edge that fall',
    withEdge(2, { curve3d: { degree: 1, knots: [0, 1, 0, 1], poles: [[1, 1, 0], [0, 1, 0]] } }),
    'bad-knots',
    { face: 0, loop: 0, use: 2, edge: 2 },
    /edge 2/,
  ],
  ['a weight of 0', withSurface({ weights: [1, 1, 0, 1] }), 'bad-weights', { face: 0 }, /weight of the surface/],
  [
    'a negative weight of a trimming curve',
    withUse(0, 1, { pcurve: { ...lineOf([1, 0], [1, 1]), weights: [1, -1] } }),
    'bad-weights',
    { face: 0, loop: 0, use: 1, edge: 1 },
    /weight of a curve/,
  ],
  ['too few weights', withSurface({ weights: [1, 1, 1] }), 'bad-weights', { face: 0 }, /`face\.surface\.weights` must be as many as there are poles, 4, not 3/],
  ['a pole that is null', withSurface({ poles: [[0, 0, null], ...kPoles.slice(1)] }), 'not-finite', { face: 0 }, /NaN/],
  ['a knot that is null', withSurface({ knotsU: [0, 0, 1, null] }), 'not-finite', { face: 0 }, /NaN/],
  [
    'an infinite pole of a trimming curve',
    withUse(0, 0, { pcurve: lineOf([0, 0], [Infinity, 0]) }),
    'not-finite',
    { face: 0, loop: 0, use: 0, edge: 0 },
    /NaN/,
  ],
  ['an edge that there is none of', withUse(0, 2, { edge: 99 }), 'bad-edge', { face: 0, loop: 0, use: 2 }, /`face\.loops\[0\]\.uses\[2\]\.edge`.*99/],
  ['an edge of a strange number', withUse(0, 2, { edge: -1 }), 'bad-edge', { face: 0, loop: 0, use: 2 }, /-1/],
  ['an edge without curves', withUse(0, 2, { pcurve: null }), 'bad-edge', { face: 0, loop: 0, use: 2, edge: 2 }, /neither `pcurve` nor `curve3d`/],
  ['an edge with another range', withEdge(1, { range: [0, 2] }), 'bad-domain', { face: 0, loop: 0, use: 1, edge: 1 }, /`range`/],
  ['an empty range', withEdge(1, { range: [1, 1] }), 'bad-domain', { face: 0, loop: 0, use: 1, edge: 1 }, /`range` is empty/],
  ['a domain that is not that of the knots', withSurface({ domain: [0, 1, 0, 2] }), 'bad-domain', { face: 0 }, /`face\.surface\.domain`.*0, 1, 0, 1/],
  ['a trim that leaves the domain', kOutside, 'trim-outside', { face: 0, loop: 0, use: 0, edge: 0 }, /leaves/],
  ['a gap', withUse(0, 1, { pcurve: lineOf([1, 0], [1, 0.9]) }), 'trim-open', { face: 0, loop: 0, use: 1, edge: 1 }, /next one/],
  ['a curve off its edge', withEdge(0, { curve3d: lineOf([0, 0, 0.5], [1, 0, 0.5]) }), 'edge-apart', { face: 0, loop: 0, use: 0, edge: 0 }, /`tolerance`/],
  [
    'a hole like an 8',
    cut([[0.1, 0.1], [0.4, 0.4], [0.4, 0.1], [0.1, 0.4]]),
    'trim-self-intersects',
    { face: 0, loop: 1, use: 0 },
    /^Face 0, loop 1, use 0.*crosses itself/,
  ],
  ['holes that cross', withUse(2, 0, { pcurve: polygonOf(kAcross) }), 'trims-cross', { face: 0, loop: 1, otherLoop: 2 }, /crosses loop 2/],
  [
    'a hole across the outer loop',
    { ...cut(kLow), loops: [{ uses: [{ edge: 0, pcurve: polygonOf(kAcross) }] }, ...(plate([kLow]).loops ?? []).slice(1)] },
    'trims-cross',
    { face: 0, loop: 0, otherLoop: 1 },
    /crosses/,
  ],
  [
    'a hole beside the outer loop',
    { ...cut(kLow), loops: [{ uses: [{ edge: 0, pcurve: polygonOf(kHigh) }] }, ...(plate([kLow]).loops ?? []).slice(1)] },
    'hole-outside',
    { face: 0, loop: 1 },
    /not inside/,
  ],
  ['a loop without area', kFlat, 'degenerate', { face: 0, loop: 1 }, /no area/],
  ['an outer loop that is not there', { ...plate([kLow]), outer: 2 }, 'degenerate', { face: 0 }, /no outer loop/],
  ['a hole along the border of the domain', { ...plate([kLow]), outer: -1 }, 'trim-outside', { face: 0, loop: 0 }, /leaves the surface's domain/],
];

describe('faults', () => {
  test.each(faults)('%s: code, place and words', (_, face, code, place, message) => {
    for (const open of [() => new TrimmedSurface(face), () => new TrimmedModel(modelOf(face))]) {
      const error = errorOf(open);
      expect(error).toMatchObject({ code, ...place });
      expect(error.message.replaceAll('model.faces[0]', 'face')).toMatch(message);
    }
  });

  test.each(faults)('%s, with skipInvalid: the face alone is left out, and named', (_, face, code, place) => {
    const { edges = [], ...bad } = face;
    const good = box();
    const first = good.edges?.length ?? 0;
    const movedUse = (use: EdgeUse): EdgeUse => ({ ...use, edge: use.edge < 0 ? use.edge : use.edge + first });
    const moved = { ...bad, loops: (bad.loops ?? []).map(({ uses }) => ({ uses: uses.map(movedUse) })) };
    const model: Model = { faces: [...(good.faces ?? []).slice(0, 2), moved, ...(good.faces ?? []).slice(2)], edges: [...(good.edges ?? []), ...edges] };
    const expected = { code, ...place, face: 2, ...(place.edge !== undefined && { edge: place.edge + first }) };
    expect(errorOf(() => new TrimmedModel(model))).toMatchObject(expected);
    const opened = new TrimmedModel(model, { skipInvalid: true });
    const mesh = opened.tessellate();
    expect(measure(mesh)).toEqual({ area: 6, volume: 1, open: 0 });
    expect(Array.from(mesh.faceStarts)).toEqual([0, 2, 4, 4, 6, 8, 10, 12]);
    expect(mesh.reports[0]).toMatchObject({ report: 'left-out', ...expected });
    expect(mesh.reports.filter(({ report }) => report === 'left-out')).toHaveLength(1);
    expect(opened.update().mesh.reports).toEqual(mesh.reports);
    opened.dispose();
  });

  test('holes only: the domain is around them', () => {
    const { loops = [], ...face } = plate([kLow, kHigh]);
    const opened = new TrimmedSurface({ ...face, loops: loops.slice(1), outer: -1 });
    const mesh = opened.tessellate();
    expect(mesh.reports).toEqual([]);
    expect(measure(mesh).area).toBeCloseTo(1 - 2 * 0.09, 6);
    opened.dispose();
  });

  test('several: the first face counts', () => {
    const { faces = [], edges = [] } = box();
    const weightsOf = (f: number): number[] | null => (f < 3 ? null : f === 3 ? [1, 1, 1, 0] : [1]);
    const model: Model = { faces: faces.map((face, f) => ({ ...face, surface: { ...face.surface, weights: weightsOf(f) } })), edges };
    // Those of counts are found before those of numbers.
    expect(errorOf(() => new TrimmedModel(model))).toMatchObject({ code: 'bad-weights', face: 4 });
    const opened = new TrimmedModel(model, { skipInvalid: true });
    expect(opened.tessellate().reports.map((report) => 'face' in report && report.face)).toEqual([3, 4, 5]);
    opened.dispose();
  });

  test('an edge at fault that no face uses: is an error, but harms nothing', () => {
    const { faces = [], edges = [] } = box();
    const model = { faces, edges: [...edges, { range: 'all' }] } as unknown as Model;
    const error = errorOf(() => new TrimmedModel(model));
    expect(error).toMatchObject({ code: 'bad-model', edge: 12 });
    expect(error.face).toBeUndefined();
    const opened = new TrimmedModel(model, { skipInvalid: true });
    expect(measure(opened.tessellate())).toEqual({ area: 6, volume: 1, open: 0 });
    expect(opened.tessellate().reports).toEqual([]);
    opened.dispose();
  });

  test('a model that is refused: leaves nothing behind', () => {
    const face = withSurface({ knotsU: [0, 1, 0, 1] });
    for (let i = 0; i < 100; i++) expect(errorOf(() => new TrimmedSurface(face)).code).toBe('bad-knots');
    const opened = new TrimmedSurface(plate());
    expect(opened.tessellate().triangles).toHaveLength(6);
    opened.dispose();
  });
});

describe('models spoilt at random', () => {
  const kWrong: readonly unknown[] = [null, 0, -1, 0.5, 2, 3, 1e-9, 1e160, 2 ** 32, -0, true, 'x', [], {}, [0], [[0, 0, 0]], [1, 0]];

  /** A copy of which one thing, or a few, are other things. */
  function spoilt(model: Model, random: Random): Model {
    const copy = structuredClone(model);
    for (let count = 1 + random.below(3); count > 0; count--) {
      let at = copy as Record<string, unknown>;
      for (let depth = 0; depth < 12; depth++) {
        const keys = Object.keys(at);
        if (keys.length === 0) break;
        const key = keys[random.below(keys.length)];
        const below = at[key];
        if (typeof below === 'object' && below !== null && !random.chance(0.05)) {
          at = below as Record<string, unknown>;
          continue;
        }
        const kind = random.below(4);
        if (kind === 0 && Array.isArray(at)) at.splice(Number(key), 1);
        else if (kind === 0) Reflect.deleteProperty(at, key);
        else if (kind === 1 && Array.isArray(at)) at.push(below);
        else if (kind === 2 && typeof below === 'number') at[key] = below + random.range(-1, 1);
        else at[key] = kWrong[random.below(kWrong.length)];
        break;
      }
    }
    return copy;
  }

  const models: [string, Model][] = [
    ['a plate', modelOf(plate([kLow, kHigh]))],
    ['a box', box()],
    ['a tube', tube(1, true)],
    ['instances', { ...box(), parts: { tube: tube(1, true) }, instances: [{ part: 'tube', matrix: [1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0] }] }],
  ];
  test.each(models)('%s: is meshed, or refused by code (seed 17)', (_, model) => {
    const random = new Random(17);
    const codes = new Map<string, number>();
    for (let i = 0; i < 400; i++) {
      const bad = spoilt(model, random);
      let code = 'fine';
      for (const skipInvalid of [false, true]) {
        try {
          const opened = new TrimmedModel(bad, { skipInvalid });
          const mesh = opened.tessellate({ relative: 1e-2, maxTriangles: 1e5, maxSeconds: 20 });
          opened.dispose();
          for (const numbers of [mesh.positions, mesh.normals, mesh.uvs]) {
            if (!numbers.every(Number.isFinite)) expect.fail(`${i}: a number of the mesh is not finite: ${JSON.stringify(bad)}`);
          }
          const vertices = mesh.positions.length / 3;
          if (mesh.triangles.some((vertex) => vertex >= vertices)) expect.fail(`${i}: a triangle has no such vertex`);
        } catch (error) {
          if (!(error instanceof SoapfilmError)) throw error;
          if (['crashed', 'out-of-memory'].includes(error.code)) expect.fail(`${i}: ${error.message}: ${JSON.stringify(bad)}`);
          if (!skipInvalid) code = error.code;
        }
      }
      codes.set(code, (codes.get(code) ?? 0) + 1);
    }
    expect(codes.size).toBeGreaterThan(5);
    expect(codes.get('fine')).toBeGreaterThan(5);
  });
});
