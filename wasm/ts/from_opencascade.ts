// Shapes of opencascade.js.
import { guarded } from './check.js';
import { SoapfilmError } from './errors.js';
import type { EdgeUse, FaceLoop, Model, ModelEdge, ModelFace, NurbsCurve, NurbsSurface } from './surface_types.js';

/** What C++ has made for the caller, who frees it. */
interface Freed {
  delete(): void;
}

interface Shape extends Freed {
  Orientation_1(): { readonly value: number };
  Oriented(orientation: unknown): Shape;
  IsSame(other: Shape): boolean;
}

interface Handle<T> extends Freed {
  IsNull(): boolean;
  get(): T;
}

interface Curve {
  IsPeriodic(): boolean;
  SetNotPeriodic(): void;
  Degree(): number;
  NbPoles(): number;
  Pole(index: number): Freed & { X(): number; Y(): number; Z?(): number };
  IsRational(): boolean;
  Weight(index: number): number;
  NbKnots(): number;
  Knot(index: number): number;
  Multiplicity(index: number): number;
}

interface Surface {
  IsUPeriodic(): boolean;
  SetUNotPeriodic(): void;
  IsVPeriodic(): boolean;
  SetVNotPeriodic(): void;
  UDegree(): number;
  VDegree(): number;
  NbUPoles(): number;
  NbVPoles(): number;
  Pole(u: number, v: number): Freed & { X(): number; Y(): number; Z(): number };
  IsURational(): boolean;
  IsVRational(): boolean;
  Weight(u: number, v: number): number;
  NbUKnots(): number;
  UKnot(index: number): number;
  UMultiplicity(index: number): number;
  NbVKnots(): number;
  VKnot(index: number): number;
  VMultiplicity(index: number): number;
}

interface Explorer extends Freed {
  More(): boolean;
  Next(): void;
  Current(): Shape;
}

/** A number that a function of C++ sets. */
interface Out {
  current: number;
}

/** What `fromOpenCascade` needs of the module of opencascade.js 2, as its `initOpenCascade` gives it. */
export interface OpenCascade {
  readonly TopAbs_ShapeEnum: Readonly<Record<'TopAbs_FACE' | 'TopAbs_WIRE' | 'TopAbs_EDGE' | 'TopAbs_SHAPE', unknown>>;
  readonly TopAbs_Orientation: Readonly<Record<'TopAbs_FORWARD' | 'TopAbs_REVERSED', { readonly value: number }>>;
  readonly Convert_ParameterisationType: { readonly Convert_TgtThetaOver2: unknown };
  readonly TopExp_Explorer_2: new (shape: Shape, find: unknown, avoid: unknown) => Explorer;
  readonly BRepTools_WireExplorer_1: new () => Explorer & { Init_2(wire: Shape, face: Shape): void };
  readonly TopTools_IndexedMapOfShape_1: new () => Freed & { Size(): number; FindKey(index: number): Shape; FindIndex(shape: Shape): number };
  readonly BRepBuilderAPI_NurbsConvert_2: new (shape: Shape, copy: boolean) => Freed & { Shape(): Shape };
  readonly TopExp: { MapShapes_1(shape: Shape, kind: unknown, map: unknown): void };
  readonly TopoDS: { Face_1(shape: Shape): Shape; Wire_1(shape: Shape): Shape; Edge_1(shape: Shape): Shape };
  readonly BRepAdaptor_Curve2d_2: new (edge: Shape, face: Shape) => Freed & { FirstParameter(): number; LastParameter(): number; Curve(): Handle<unknown> };
  readonly BRepTools: { OuterWire(face: Shape): Shape };
  readonly BRep_Tool: {
    Surface_2(face: Shape): Handle<unknown>;
    Curve_2(edge: Shape, first: Out, last: Out): Handle<unknown>;
    Range_1(edge: Shape, first: Out, last: Out): void;
    Tolerance_2(edge: Shape): number;
    Degenerated(edge: Shape): boolean;
    IsClosed_2(edge: Shape, face: Shape): boolean;
  };
  readonly GeomConvert: {
    SurfaceToBSplineSurface(surface: Handle<unknown>): Handle<Surface>;
    CurveToBSplineCurve(curve: Handle<unknown>, parameterisation: unknown): Handle<Curve>;
  };
  readonly Geom2dConvert: { CurveToBSplineCurve(curve: Handle<unknown>, parameterisation: unknown): Handle<Curve> };
}

/**
 * The model of a shape of opencascade.js, such as one read from a STEP file: its faces, made NURBS, and their edges.
 *
 * @param shape any `TopoDS_Shape`; it stays as it is
 * @param oc the module that the shape is of
 * @throws SoapfilmError `bad-model` if the shape cannot be read or made NURBS
 */
export function fromOpenCascade(shape: unknown, oc: OpenCascade): Model {
  const made: Freed[] = [];
  const own: Own = (thing) => {
    made.push(thing);
    return thing;
  };
  try {
    return guarded('bad-model', 'shape', () => modelOf(shape as Shape, oc, own));
  } finally {
    for (const thing of made) thing.delete();
  }
}

/** Hands on what is to be freed at the end. */
type Own = <T extends Freed>(thing: T) => T;

function modelOf(shape: Shape, oc: OpenCascade, own: Own): Model {
  const kinds = oc.TopAbs_ShapeEnum;
  const orientations = oc.TopAbs_Orientation;
  const nurbs = own(own(new oc.BRepBuilderAPI_NurbsConvert_2(shape, true)).Shape());
  const map = own(new oc.TopTools_IndexedMapOfShape_1());
  oc.TopExp.MapShapes_1(nurbs, kinds.TopAbs_EDGE, map);
  const edges = Array.from({ length: map.Size() }, (_, i) => edgeOf(oc, own(oc.TopoDS.Edge_1(own(map.FindKey(i + 1)))), own));
  const explored = (within: Shape, kind: unknown): Shape[] => shapesOf(own(new oc.TopExp_Explorer_2(within, kind, kinds.TopAbs_SHAPE)), own);
  const faces = explored(nurbs, kinds.TopAbs_FACE).map((found): ModelFace => {
    // Loops are those of the face as if it were not reversed.
    const face = own(oc.TopoDS.Face_1(own(found.Oriented(orientations.TopAbs_FORWARD))));
    const wires = explored(face, kinds.TopAbs_WIRE).map((wire) => own(oc.TopoDS.Wire_1(wire)));
    const around = own(oc.BRepTools.OuterWire(face));
    const surface = own(oc.GeomConvert.SurfaceToBSplineSurface(own(oc.BRep_Tool.Surface_2(face))));
    return {
      surface: surfaceOf(surface.get(), own),
      reversed: found.Orientation_1().value === orientations.TopAbs_REVERSED.value,
      outer: wires.findIndex((wire) => wire.IsSame(around)),
      loops: wires.map((wire) => loopOf(oc, wire, face, (edge) => map.FindIndex(edge) - 1, own)),
    };
  });
  return { faces, edges };
}

function shapesOf(explorer: Explorer, own: Own): Shape[] {
  const found: Shape[] = [];
  while (explorer.More()) {
    found.push(own(explorer.Current()));
    explorer.Next();
  }
  return found;
}

function edgeOf(oc: OpenCascade, edge: Shape, own: Own): ModelEdge {
  const { BRep_Tool: tool } = oc;
  const tolerance = tool.Tolerance_2(edge);
  const [first, last]: Out[] = [{ current: 0 }, { current: 0 }];
  tool.Range_1(edge, first, last);
  const range = [first.current, last.current];
  if (tool.Degenerated(edge)) return { degenerate: true, tolerance, range };
  const curve = own(tool.Curve_2(edge, first, last));
  if (curve.IsNull()) return { tolerance, range };
  const spline = own(oc.GeomConvert.CurveToBSplineCurve(curve, oc.Convert_ParameterisationType.Convert_TgtThetaOver2));
  return { tolerance, range, curve3d: curveOf(spline.get(), own) };
}

function loopOf(oc: OpenCascade, wire: Shape, face: Shape, indexOf: (edge: Shape) => number, own: Own): FaceLoop {
  const explorer = own(new oc.BRepTools_WireExplorer_1());
  explorer.Init_2(wire, face);
  const uses = shapesOf(explorer, own).map((found): EdgeUse => {
    const edge = own(oc.TopoDS.Edge_1(found));
    // `CurveOnSurface` cannot be called: its binding lacks the type of an argument.
    const adaptor = own(new oc.BRepAdaptor_Curve2d_2(edge, face));
    const spline = own(oc.Geom2dConvert.CurveToBSplineCurve(own(adaptor.Curve()), oc.Convert_ParameterisationType.Convert_TgtThetaOver2));
    return {
      edge: indexOf(edge),
      reversed: edge.Orientation_1().value === oc.TopAbs_Orientation.TopAbs_REVERSED.value,
      seam: oc.BRep_Tool.IsClosed_2(edge, face),
      pcurve: { ...curveOf(spline.get(), own), domain: [adaptor.FirstParameter(), adaptor.LastParameter()] },
    };
  });
  if (uses.length === 0) throw new SoapfilmError('bad-model', 'A wire of `shape` has no edges in order');
  return { uses };
}

/** Knots as often as they count, of `count` different ones. */
const knotsOf = (count: number, knot: (index: number) => number, multiplicity: (index: number) => number): number[] =>
  Array.from({ length: count }, (_, i) => new Array<number>(multiplicity(i + 1)).fill(knot(i + 1))).flat();

/** In the plane or in space. Poles are not multiplied by weights there. */
function curveOf(curve: Curve, own: Own): NurbsCurve {
  if (curve.IsPeriodic()) curve.SetNotPeriodic();
  const numbers = Array.from({ length: curve.NbPoles() }, (_, i) => i + 1);
  const poles = numbers.map((i) => {
    const pole = own(curve.Pole(i));
    return pole.Z ? [pole.X(), pole.Y(), pole.Z()] : [pole.X(), pole.Y()];
  });
  return {
    degree: curve.Degree(),
    knots: knotsOf(curve.NbKnots(), (i) => curve.Knot(i), (i) => curve.Multiplicity(i)),
    poles,
    weights: curve.IsRational() ? numbers.map((i) => curve.Weight(i)) : null,
  };
}

function surfaceOf(surface: Surface, own: Own): NurbsSurface {
  if (surface.IsUPeriodic()) surface.SetUNotPeriodic();
  if (surface.IsVPeriodic()) surface.SetVNotPeriodic();
  const [countU, countV] = [surface.NbUPoles(), surface.NbVPoles()];
  const places = Array.from({ length: countU * countV }, (_, i) => [Math.floor(i / countV) + 1, (i % countV) + 1] as const);
  const poles = places.map((at) => {
    const pole = own(surface.Pole(...at));
    return [pole.X(), pole.Y(), pole.Z()];
  });
  const isRational = surface.IsURational() || surface.IsVRational();
  return {
    degreeU: surface.UDegree(),
    degreeV: surface.VDegree(),
    knotsU: knotsOf(surface.NbUKnots(), (i) => surface.UKnot(i), (i) => surface.UMultiplicity(i)),
    knotsV: knotsOf(surface.NbVKnots(), (i) => surface.VKnot(i), (i) => surface.VMultiplicity(i)),
    countU,
    countV,
    poles,
    weights: isRational ? places.map((at) => surface.Weight(...at)) : null,
  };
}
