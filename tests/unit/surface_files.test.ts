// Trimmed surfaces from files and from other libraries.
import { load, type ErrorCode } from 'soapfilm';
import {
  fromGeomdl,
  fromOpenCascade,
  fromRhino,
  fromThree,
  parseTrimmedModel,
  TrimmedModel,
  TrimmedSurface,
  type Model,
  type NurbsCurve,
  type NurbsSurface,
  type OpenCascade,
  type Rhino,
  type RhinoBrep,
} from 'soapfilm/surfaces';
import { Vector3, Vector4 } from 'three';
import { NURBSSurface } from 'three/addons/curves/NURBSSurface.js';
import { beforeAll, describe, expect, test } from 'vitest';
import { errorOf } from '../support/errors.js';
import { box, measure, tube } from '../support/models.js';

beforeAll(() => load({ parts: ['surfaces'] }));

function meshOf(model: Model) {
  const opened = new TrimmedModel(model);
  const mesh = opened.tessellate({ tolerance: 1e-4 });
  opened.dispose();
  return mesh;
}

describe('parseTrimmedModel', () => {
  test('text, or what it says: the model, null for NaN', () => {
    const model = box();
    expect(parseTrimmedModel(JSON.stringify(model))).toEqual(model);
    expect(parseTrimmedModel(model)).toBe(model);
    const text = JSON.stringify(model).replace('"poles":[[0,0,0]', '"poles":[[null,0,0]');
    expect(errorOf(() => new TrimmedModel(parseTrimmedModel(text)))).toMatchObject({ code: 'not-finite', face: 0 });
  });

  const bad: [string, unknown, RegExp][] = [
    ['no JSON', '{ "schema": ', /JSON/],
    ['another schema', { schema: 'trimmed-nurbs/2', faces: [], edges: [] }, /trimmed-nurbs\/1.*trimmed-nurbs\/2/],
    ['no schema', { faces: [], edges: [] }, /schema/],
    ['a list', [], /object/],
    ['null', 'null', /object/],
    ['a number', 3, /object/],
    ['no faces', { schema: 'trimmed-nurbs/1', edges: [] }, /faces/],
    ['edges that are no list', { schema: 'trimmed-nurbs/1', faces: [], edges: {} }, /edges/],
  ];
  test.each(bad)('%s: bad-file', (_, json, message) => {
    const error = errorOf(() => parseTrimmedModel(json));
    expect(error.code).toBe('bad-file');
    expect(error.message).toMatch(message);
  });
});

describe('fromThree', () => {
  test('a rational surface: the same points as three has', () => {
    const { surface } = (tube(2).faces ?? [])[0];
    const weights = surface.weights as number[];
    const points = surface.poles.map((pole, i) => new Vector4(pole[0] as number, pole[1] as number, pole[2] as number, weights[i]));
    const rows = Array.from({ length: surface.countU }, (_, iu) => points.slice(iu * surface.countV, (iu + 1) * surface.countV));
    const nurbs = new NURBSSurface(2, 1, surface.knotsU as number[], surface.knotsV as number[], rows);
    const opened = new TrimmedSurface(fromThree(nurbs));
    const { positions, origin, uvs } = opened.tessellate();
    opened.dispose();
    const point = new Vector3();
    for (let i = 0; i < positions.length / 3; i++) {
      nurbs.getPoint(uvs[2 * i] / 4, uvs[2 * i + 1], point);
      point.toArray().forEach((x, k) => {
        expect(positions[3 * i + k] + origin[k]).toBeCloseTo(x, 5);
      });
    }
    expect(positions.length).toBeGreaterThan(100);
  });

  test('weights of 1: a surface that is not rational', () => {
    const rows = [0, 1].map((x) => [0, 1].map((y) => new Vector4(x, y, x * y, 1)));
    expect(fromThree(new NURBSSurface(1, 1, [0, 0, 1, 1], [0, 0, 1, 1], rows)).surface.weights).toBeNull();
  });

  test.each([null, 3, {}, { controlPoints: [] }, { controlPoints: [3] }])('%j: bad-model', (value) => {
    expect(errorOf(() => fromThree(value as never)).code).toBe('bad-model');
  });
});

/** As `exchange.export_json` of geomdl 5.3 writes it: control points are not multiplied by weights. */
const geomdlSurface = (trims: readonly object[]) => ({
  type: 'spline',
  rational: true,
  dimension: 3,
  degree_u: 2,
  degree_v: 1,
  knotvector_u: [0, 0, 0, 1, 1, 1],
  knotvector_v: [0, 0, 1, 1],
  size_u: 3,
  size_v: 2,
  control_points: {
    points: [[1, 0, 0], [1, 0, 2], [1, 1, 0], [1, 1, 2], [0, 1, 0], [0, 1, 2]],
    weights: [1, 1, Math.SQRT1_2, Math.SQRT1_2, 1, 1],
  },
  delta: [0.25, 0.25],
  ...(trims.length > 0 && { trims: { count: trims.length, data: trims } }),
});
const geomdlFile = (...surfaces: object[]) => ({ shape: { type: 'surface', count: surfaces.length, data: surfaces } });
const geomdlCurve = (points: number[][], more: object = {}) => ({
  type: 'spline',
  rational: false,
  dimension: 2,
  degree: 1,
  knotvector: [0, 0, ...points.slice(2).map((_, i) => (i + 1) / (points.length - 1)), 1, 1],
  control_points: { points },
  delta: 0.01,
  ...more,
});

describe('fromGeomdl', () => {
  /** A quarter of a tube of height 2; u and v of 0 to 1 over an angle of a quarter and this height. */
  const kWhole = Math.PI;
  /** The area of the part with v from 0.25 to 0.75 between angles whose u these are. */
  const kRight = [[0.5, 0.25], [1, 0.25], [1, 0.75], [0.5, 0.75], [0.5, 0.25]];
  const kWindow = [[0.5, 0.25], [0.75, 0.25], [0.75, 0.75], [0.5, 0.75]];
  const angleAt = (u: number): number => {
    const [a, b, c] = [(1 - u) ** 2, 2 * u * (1 - u) * Math.SQRT1_2, u * u];
    return Math.atan2(b + c, a + b);
  };
  const kWindowArea = angleAt(0.75) - angleAt(0.5);

  test('surfaces without trims: are whole, in text or not', () => {
    const file = geomdlFile(geomdlSurface([]), geomdlSurface([]));
    expect(fromGeomdl(JSON.stringify(file))).toEqual(fromGeomdl(file));
    const model = fromGeomdl(file);
    expect(model.faces).toHaveLength(2);
    expect(measure(meshOf(model)).area).toBeCloseTo(2 * kWhole, 3);
  });

  test('trims: cut away what is inside; splines, freeform, containers', () => {
    const [a, b, c, d] = kWindow;
    const trims = [
      geomdlCurve([...kWindow, a]),
      { type: 'freeform', dimension: 2, points: kWindow, name: 'freeform geometry' },
      { type: 'container', count: 2, data: [geomdlCurve([a, b, c]), geomdlCurve([c, d, a])] },
    ];
    for (const trim of trims) {
      expect(measure(meshOf(fromGeomdl(geomdlFile(geomdlSurface([trim]))))).area).toBeCloseTo(kWhole - kWindowArea, 3);
    }
  });

  test('a trim that is reversed: cuts away what is outside', () => {
    const hole = geomdlCurve([[0.6, 0.4], [0.7, 0.4], [0.7, 0.6], [0.6, 0.6], [0.6, 0.4]]);
    const outer = geomdlCurve([...kWindow, kWindow[0]], { reversed: 1 });
    const model = fromGeomdl(geomdlFile(geomdlSurface([hole, outer])));
    expect((model.faces ?? [])[0].outer).toBe(1);
    expect(measure(meshOf(model)).area).toBeCloseTo(kWindowArea - 0.4 * (angleAt(0.7) - angleAt(0.6)), 3);
  });

  test('a hole in a surface that closes: no crack along the seam', () => {
    const { surface } = (tube(1).faces ?? [])[0];
    const hole = geomdlCurve([[0.5, 0.25], [1.5, 0.25], [1.5, 0.75], [0.5, 0.75], [0.5, 0.25]]);
    const given = {
      ...geomdlSurface([hole]),
      knotvector_u: surface.knotsU,
      size_u: 9,
      control_points: { points: surface.poles, weights: surface.weights },
    };
    const mesh = meshOf(fromGeomdl(geomdlFile(given)));
    const rim = (vertex: number): boolean => [0, 1].includes(mesh.uvs[2 * vertex + 1]) || mesh.uvs[2 * vertex] % 4 !== 0;
    expect(measure(mesh).area).toBeLessThan(2 * Math.PI);
    // All vertices on the seam are there twice.
    for (let v = 0; v < mesh.same.length; v++) {
      if (!rim(v) && mesh.uvs[2 * v] === 4) expect(mesh.same.filter((first) => first === mesh.same[v]).length).toBe(2);
    }
  });

  const bad: [string, unknown, ErrorCode, RegExp][] = [
    ['curves', { shape: { type: 'curve', count: 0, data: [] } }, 'bad-file', /curve/],
    ['no shape', {}, 'bad-file', /shape/],
    ['no JSON', 'shape', 'bad-file', /JSON/],
    ['no data', { shape: { type: 'surface' } }, 'bad-file', /data/],
    ['a surface without points', geomdlFile({ degree_u: 1 }), 'bad-file', /data/],
    ['a trim of an unknown type', geomdlFile(geomdlSurface([{ type: 'analytic' }])), 'bad-file', /analytic/],
    ['two outer trims', geomdlFile(geomdlSurface([geomdlCurve(kRight, { reversed: 1 }), geomdlCurve(kRight, { reversed: 1 })])), 'bad-model', /several outer/],
  ];
  test.each(bad)('%s: an error', (_, json, code, message) => {
    const error = errorOf(() => fromGeomdl(json));
    expect(error.code).toBe(code);
    expect(error.message).toMatch(message);
  });
});

/** A list as rhino3dm has them. */
const rhinoList = <T>(items: readonly T[]) => ({ count: items.length, get: (i: number) => items[i] });

/** Rhino leaves out the first and the last knot. */
const rhinoKnots = (knots: NurbsCurve['knots']) => rhinoList(Array.from(knots as number[]).slice(1, -1));
/** Rhino's poles are multiplied by weights. */
const rhinoPole = (pole: ArrayLike<number | null>, w = 1) => [...Array.from(pole as ArrayLike<number>, (x) => x * w), w];

const kLoopTypes: Rhino = { BrepLoopType: { Outer: { value: 1 }, Inner: { value: 2 } } };

/** A model of plain edges as a Brep; `freed` counts what was given back. */
function brepOf({ faces = [], edges = [] }: Model, freed: { count: number }, loopType = kLoopTypes.BrepLoopType.Outer): RhinoBrep {
  const remove = (): void => {
    freed.count++;
  };
  return {
    faces: () =>
      rhinoList(
        faces.map(({ surface, reversed = false, loops = [] }) => ({
          orientationIsReversed: reversed,
          underlyingSurface: () => ({ toNurbsSurface: () => rhinoSurface(surface, remove) }),
          loops: rhinoList(
            loops.map(({ uses }) => ({
              loopType,
              trims: rhinoList(uses.map(({ edge, reversed = false }) => ({ edgeIndex: edge, isReversed: reversed }))),
            })),
          ),
        })),
      ),
    edges: () =>
      rhinoList(
        edges.map(({ curve3d, range }) => ({
          domain: range as number[],
          pointAt: (t: number) => ((curve3d?.poles ?? []) as number[][]).reduce((a, b) => a.map((x, k) => x + t * (b[k] - x))),
          toNurbsCurve: () => rhinoCurve(curve3d as NurbsCurve, remove),
        })),
      ),
  };
}

const rhinoCurve = ({ degree, knots, poles, weights }: NurbsCurve, remove: () => void) => ({
  order: degree + 1,
  isRational: Boolean(weights),
  points: () => rhinoList(poles.map((pole, i) => rhinoPole(pole, (weights?.[i] ?? 1)))),
  knots: () => rhinoKnots(knots),
  delete: remove,
});

const rhinoSurface = (surface: NurbsSurface, remove: () => void) => ({
  orderU: surface.degreeU + 1,
  orderV: surface.degreeV + 1,
  isRational: Boolean(surface.weights),
  knotsU: () => rhinoKnots(surface.knotsU),
  knotsV: () => rhinoKnots(surface.knotsV),
  points: () => ({
    countU: surface.countU,
    countV: surface.countV,
    get: (u: number, v: number) => {
      const at = u * surface.countV + v;
      return rhinoPole(surface.poles[at], (surface.weights?.[at] ?? 1));
    },
  }),
  domain: () => [0, 1],
  pointAt: () => [0, 0, 0],
  isSingular: () => false,
  delete: remove,
});

/** What a model must be after it went through Rhino, which knows no curves in domains. */
const withoutTrims = ({ faces = [], edges = [] }: Model, tolerance: number): Model => ({
  faces: faces.map(({ surface, reversed = false, loops = [] }) => ({
    surface: { ...surface, domain: undefined as never },
    reversed,
    outer: 0,
    loops: loops.map(({ uses }) => ({ uses: uses.map(({ edge, reversed = false, seam = false }) => ({ edge, reversed, seam })) })),
  })),
  edges: edges.map(({ curve3d, range }) => ({ curve3d: { weights: null, ...(curve3d as NurbsCurve) }, range, tolerance })),
});

/** To 12 digits. */
const rounded = (model: Model): unknown =>
  JSON.parse(JSON.stringify(model), (_, value: unknown) => (typeof value === 'number' ? Number(value.toPrecision(12)) : value));

describe('fromRhino', () => {
  test.each([['a box', box()], ['a tube with a seam', tube(2, true)]])('%s: faces, loops and edges, with weights divided out and all knots', (_, model) => {
    const freed = { count: 0 };
    const got = fromRhino(brepOf(model, freed), kLoopTypes, { tolerance: 1e-3 });
    expect(rounded(got)).toEqual(rounded(withoutTrims(model, 1e-3)));
    expect(freed.count).toBe((model.faces ?? []).length + (model.edges ?? []).length);
  });

  test('a Brep of a version that tells no loops: bad-model that says so', () => {
    const faces = () => rhinoList([{ ...brepOf(box(), { count: 0 }).faces().get(0), loops: undefined }]);
    const error = errorOf(() => fromRhino({ ...brepOf(box(), { count: 0 }), faces } as never, kLoopTypes));
    expect(error.code).toBe('bad-model');
    expect(error.message).toMatch(/loops/);
  });

  test.each([null, {}, { faces: 3, edges: () => rhinoList([]) }])('%j: bad-model', (brep) => {
    expect(errorOf(() => fromRhino(brep as never, kLoopTypes)).code).toBe('bad-model');
  });
});

/** What C++ has made and what was given back. */
interface Heap {
  made: number;
  freed: number;
}

/** As much of opencascade.js 2 as reading a shape takes, for a model whose edges all have curves in domains. */
function openCascadeOf({ faces = [], edges = [] }: Model, heap: Heap): { oc: OpenCascade; shape: object } {
  const made = <T extends object>(thing: T): T & { delete(): void } => {
    heap.made++;
    return Object.assign(thing, {
      delete: () => {
        heap.freed++;
      },
    });
  };
  const [forward, backward] = [{ value: 0 }, { value: 1 }];
  interface Fake {
    kind: string;
    number: number;
    children: Fake[];
    reversed: boolean;
    face?: number;
    use?: number;
    loop?: number;
  }
  const shapeOf = (fake: Fake): object =>
    made({
      fake,
      Orientation_1: () => (fake.reversed ? backward : forward),
      Oriented: () => shapeOf({ ...fake, reversed: false }),
      IsSame: (other: { fake: Fake }) => other.fake.kind === fake.kind && other.fake.number === fake.number,
    });
  const fakeOf = (shape: unknown): Fake => (shape as { fake: Fake }).fake;
  let wires = 0;
  const whole: Fake = {
    kind: 'solid',
    number: 0,
    reversed: false,
    children: faces.map(({ reversed = false, loops = [] }, face) => ({
      kind: 'face',
      number: face,
      reversed,
      children: loops.map(({ uses }, loop) => ({
        kind: 'wire',
        number: wires++,
        reversed: false,
        children: uses.map((given, use) => ({ kind: 'edge', number: given.edge, reversed: given.reversed ?? false, children: [], face, loop, use })),
      })),
    })),
  };
  const found = (within: Fake, kind: string): Fake[] => within.children.flatMap((child) => (child.kind === kind ? [child] : found(child, kind)));
  const explorer = (all: Fake[]) => {
    let at = 0;
    return made({ More: () => at < all.length, Next: () => at++, Current: () => shapeOf(all[at]) });
  };
  const handle = (thing: object | null) => made({ IsNull: () => thing === null, get: () => thing });
  const point = (pole: ArrayLike<number | null>) => made({ X: () => pole[0], Y: () => pole[1], ...(pole.length > 2 && { Z: () => pole[2] }) });
  const distinct = (knots: ArrayLike<number | null>): number[] => [...new Set(Array.from(knots as ArrayLike<number>))];
  const times = (knots: ArrayLike<number | null>, i: number): number => Array.from(knots).filter((x) => x === distinct(knots)[i - 1]).length;
  const curve = ({ degree, knots, poles, weights }: NurbsCurve) => ({
    IsPeriodic: () => false,
    Degree: () => degree,
    NbPoles: () => poles.length,
    Pole: (i: number) => point(poles[i - 1]),
    IsRational: () => Boolean(weights),
    Weight: (i: number) => weights?.[i - 1],
    NbKnots: () => distinct(knots).length,
    Knot: (i: number) => distinct(knots)[i - 1],
    Multiplicity: (i: number) => times(knots, i),
  });
  const surface = (s: NurbsSurface) => ({
    IsUPeriodic: () => false,
    IsVPeriodic: () => false,
    UDegree: () => s.degreeU,
    VDegree: () => s.degreeV,
    NbUPoles: () => s.countU,
    NbVPoles: () => s.countV,
    Pole: (u: number, v: number) => point(s.poles[(u - 1) * s.countV + v - 1]),
    IsURational: () => Boolean(s.weights),
    IsVRational: () => false,
    Weight: (u: number, v: number) => s.weights?.[(u - 1) * s.countV + v - 1],
    NbUKnots: () => distinct(s.knotsU).length,
    UKnot: (i: number) => distinct(s.knotsU)[i - 1],
    UMultiplicity: (i: number) => times(s.knotsU, i),
    NbVKnots: () => distinct(s.knotsV).length,
    VKnot: (i: number) => distinct(s.knotsV)[i - 1],
    VMultiplicity: (i: number) => times(s.knotsV, i),
  });
  const copy = (shape: object) => shapeOf(fakeOf(shape));
  const oc = {
    TopAbs_ShapeEnum: { TopAbs_FACE: 'face', TopAbs_WIRE: 'wire', TopAbs_EDGE: 'edge', TopAbs_SHAPE: 'shape' },
    TopAbs_Orientation: { TopAbs_FORWARD: forward, TopAbs_REVERSED: backward },
    Convert_ParameterisationType: { Convert_TgtThetaOver2: {} },
    TopExp_Explorer_2: function (within: object, kind: string) {
      return explorer(found(fakeOf(within), kind));
    },
    BRepTools_WireExplorer_1: function () {
      let inner: ReturnType<typeof explorer>;
      const init = (wire: object): void => {
        inner = explorer(fakeOf(wire).children);
        heap.freed++;
      };
      return made({ Init_2: init, More: () => inner.More(), Next: (): number => inner.Next(), Current: () => inner.Current() });
    },
    TopTools_IndexedMapOfShape_1: function () {
      return made({
        Size: () => edges.length,
        FindKey: (i: number) => shapeOf({ kind: 'edge', number: i - 1, reversed: false, children: [] }),
        FindIndex: (edge: object) => fakeOf(edge).number + 1,
      });
    },
    BRepBuilderAPI_NurbsConvert_2: function () {
      return made({ Shape: () => shapeOf(whole) });
    },
    BRepAdaptor_Curve2d_2: function (edge: object) {
      const { face = 0, loop = 0, use = 0 } = fakeOf(edge);
      const pcurve = ((faces[face].loops ?? [])[loop].uses[use].pcurve) as NurbsCurve;
      const range = edges[fakeOf(edge).number].range;
      return made({ FirstParameter: () => range[0], LastParameter: () => range[1], Curve: () => handle(pcurve) });
    },
    TopExp: { MapShapes_1: () => undefined },
    TopoDS: { Face_1: copy, Wire_1: copy, Edge_1: copy },
    BRepTools: { OuterWire: (face: object) => shapeOf(fakeOf(face).children[faces[fakeOf(face).number].outer ?? 0]) },
    BRep_Tool: {
      Surface_2: (face: object) => handle(faces[fakeOf(face).number].surface),
      Curve_2: (edge: object) => handle(edges[fakeOf(edge).number].curve3d ?? null),
      Range_1: (edge: object, first: { current: unknown }, last: { current: unknown }) => {
        [first.current, last.current] = Array.from(edges[fakeOf(edge).number].range);
      },
      Tolerance_2: () => 1e-7,
      Degenerated: (edge: object) => edges[fakeOf(edge).number].degenerate ?? false,
      IsClosed_2: (edge: object, face: object) =>
        (faces[fakeOf(face).number].loops ?? []).flatMap(({ uses }) => uses).filter((use) => use.edge === fakeOf(edge).number).length > 1,
    },
    GeomConvert: {
      SurfaceToBSplineSurface: (given: { get(): NurbsSurface }) => handle(surface(given.get())),
      CurveToBSplineCurve: (given: { get(): NurbsCurve }) => handle(curve(given.get())),
    },
    Geom2dConvert: { CurveToBSplineCurve: (given: { get(): NurbsCurve }) => handle(curve(given.get())) },
  };
  return { oc: oc as unknown as OpenCascade, shape: shapeOf(whole) };
}

describe('fromOpenCascade', () => {
  test.each([['a box', box()], ['a tube with a seam', tube(2, true)]])('%s: the same mesh, and all that C++ made is freed', (_, model) => {
    const heap = { made: 0, freed: 0 };
    const { oc, shape } = openCascadeOf(model, heap);
    const before = heap.made;
    const got = fromOpenCascade(shape, oc);
    expect(heap.made).toBeGreaterThan(before);
    expect(heap.made - heap.freed).toBe(before);
    expect(meshOf(got)).toEqual(meshOf(model));
    expect((got.faces ?? []).map(({ loops = [] }) => loops.map(({ uses }) => uses.map(({ edge, reversed, seam }) => [edge, reversed, seam])))).toEqual(
      (model.faces ?? []).map(({ loops = [] }) => loops.map(({ uses }) => uses.map(({ edge, reversed = false, seam = false }) => [edge, reversed, seam]))),
    );
  });

  test('reversed faces and holes: are so', () => {
    const model = box();
    const turned = { ...model, faces: (model.faces ?? []).map((face) => ({ ...face, reversed: true })) };
    const { oc, shape } = openCascadeOf(turned, { made: 0, freed: 0 });
    expect(measure(meshOf(fromOpenCascade(shape, oc)))).toEqual({ area: 6, volume: -1, open: 0 });
  });

  test('what C++ throws, a number: bad-model with that as its cause', () => {
    const { oc, shape } = openCascadeOf(box(), { made: 0, freed: 0 });
    const broken = {
      ...oc,
      BRep_Tool: {
        ...oc.BRep_Tool,
        Surface_2: () => {
          // eslint-disable-next-line @typescript-eslint/only-throw-error -- as Emscripten does
          throw 5246528;
        },
      },
    };
    expect(errorOf(() => fromOpenCascade(shape, broken))).toMatchObject({ code: 'bad-model', cause: 5246528 });
  });
});
