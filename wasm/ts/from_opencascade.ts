// Shapes of opencascade.js.
import { guarded } from './check.js';
import { SoapfilmError } from './errors.js';
import type { EdgeUse, FaceLoop, Model, ModelEdge, ModelFace, NurbsCurve, NurbsSurface } from './surface_types.js';

interface Shape {
  Orientation_1(): { readonly value: number };
  Oriented(orientation: unknown): Shape;
  IsSame(other: Shape): boolean;
}

interface Handle<T> {
  IsNull(): boolean;
  get(): T;
}

interface Reals {
  Lower(): number;
  Upper(): number;
  Value(index: number): number;
}

interface Curve {
  IsPeriodic(): boolean;
  SetNotPeriodic(): void;
  Degree(): number;
  NbPoles(): number;
  Pole(index: number): { X(): number; Y(): number; Z?(): number };
  IsRational(): boolean;
  Weight(index: number): number;
  KnotSequence_2(): Reals;
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
  Pole(u: number, v: number): { X(): number; Y(): number; Z(): number };
  IsURational(): boolean;
  IsVRational(): boolean;
  Weight(u: number, v: number): number;
  UKnotSequence_2(): Reals;
  VKnotSequence_2(): Reals;
}

interface Explorer {
  More(): boolean;
  Next(): void;
  Current(): Shape;
}

/** A number that a function of C++ sets. */
interface Out {
  current: number | boolean;
}

/** What `fromOpenCascade` needs of the module of opencascade.js 2, as its `initOpenCascade` gives it. */
export interface OpenCascade {
  readonly TopAbs_ShapeEnum: Readonly<Record<'TopAbs_FACE' | 'TopAbs_WIRE' | 'TopAbs_EDGE' | 'TopAbs_SHAPE', unknown>>;
  readonly TopAbs_Orientation: Readonly<Record<'TopAbs_FORWARD' | 'TopAbs_REVERSED', { readonly value: number }>>;
  readonly Convert_ParameterisationType: { readonly Convert_TgtThetaOver2: unknown };
  readonly TopExp_Explorer_2: new (shape: Shape, find: unknown, avoid: unknown) => Explorer;
  readonly BRepTools_WireExplorer_1: new () => Explorer & { Init_2(wire: Shape, face: Shape): void };
  readonly TopTools_IndexedMapOfShape_1: new () => { Size(): number; FindKey(index: number): Shape; FindIndex(shape: Shape): number };
  readonly BRepBuilderAPI_NurbsConvert_2: new (shape: Shape, copy: boolean) => { Shape(): Shape };
  readonly TopExp: { MapShapes_1(shape: Shape, kind: unknown, map: unknown): void };
  readonly TopoDS: { Face_1(shape: Shape): Shape; Wire_1(shape: Shape): Shape; Edge_1(shape: Shape): Shape };
  readonly BRepTools: { OuterWire(face: Shape): Shape };
  readonly BRep_Tool: {
    Surface_2(face: Shape): Handle<unknown>;
    Curve_2(edge: Shape, first: Out, last: Out): Handle<unknown>;
    CurveOnSurface_1(edge: Shape, face: Shape, first: Out, last: Out, isStored: Out): Handle<unknown>;
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
  return guarded('bad-model', 'shape', () => {
    const kinds = oc.TopAbs_ShapeEnum;
    const nurbs = new oc.BRepBuilderAPI_NurbsConvert_2(shape as Shape, true).Shape();
    const map = new oc.TopTools_IndexedMapOfShape_1();
    oc.TopExp.MapShapes_1(nurbs, kinds.TopAbs_EDGE, map);
    const edges = Array.from({ length: map.Size() }, (_, i) => edgeOf(oc, oc.TopoDS.Edge_1(map.FindKey(i + 1))));
    const faces = explored(new oc.TopExp_Explorer_2(nurbs, kinds.TopAbs_FACE, kinds.TopAbs_SHAPE)).map((found): ModelFace => {
      const orientation = oc.TopAbs_Orientation;
      const reversed = found.Orientation_1().value === orientation.TopAbs_REVERSED.value;
      // Loops are those of the face as if it were not reversed.
      const face = oc.TopoDS.Face_1(found.Oriented(orientation.TopAbs_FORWARD));
      const wires = explored(new oc.TopExp_Explorer_2(face, kinds.TopAbs_WIRE, kinds.TopAbs_SHAPE)).map((wire) => oc.TopoDS.Wire_1(wire));
      const around = oc.BRepTools.OuterWire(face);
      const indexOf = (edge: Shape): number => map.FindIndex(edge) - 1;
      return {
        surface: surfaceOf(oc.GeomConvert.SurfaceToBSplineSurface(oc.BRep_Tool.Surface_2(face)).get()),
        reversed,
        outer: wires.findIndex((wire) => wire.IsSame(around)),
        loops: wires.map((wire) => loopOf(oc, wire, face, indexOf)),
      };
    });
    return { faces, edges };
  });
}

function explored(explorer: Explorer): Shape[] {
  const found: Shape[] = [];
  for (; explorer.More(); explorer.Next()) found.push(explorer.Current());
  return found;
}

/** Calls a function of C++ that sets a range. */
function rangeOf(call: (first: Out, last: Out) => void): [number, number] {
  const [first, last]: Out[] = [{ current: 0 }, { current: 0 }];
  call(first, last);
  return [Number(first.current), Number(last.current)];
}

function edgeOf(oc: OpenCascade, edge: Shape): ModelEdge {
  const { BRep_Tool: tool } = oc;
  const tolerance = tool.Tolerance_2(edge);
  const range = rangeOf((first, last) => {
    tool.Range_1(edge, first, last);
  });
  if (tool.Degenerated(edge)) return { degenerate: true, tolerance, range };
  const curve = tool.Curve_2(edge, { current: 0 }, { current: 0 });
  if (curve.IsNull()) return { tolerance, range };
  const spline = oc.GeomConvert.CurveToBSplineCurve(curve, oc.Convert_ParameterisationType.Convert_TgtThetaOver2);
  return { tolerance, range, curve3d: curveOf(spline.get()) };
}

function loopOf(oc: OpenCascade, wire: Shape, face: Shape, indexOf: (edge: Shape) => number): FaceLoop {
  const explorer = new oc.BRepTools_WireExplorer_1();
  explorer.Init_2(wire, face);
  const uses = explored(explorer).map((found): EdgeUse => {
    const edge = oc.TopoDS.Edge_1(found);
    const reversed = edge.Orientation_1().value === oc.TopAbs_Orientation.TopAbs_REVERSED.value;
    let curve: Handle<unknown> | undefined;
    const domain = rangeOf((first, last) => {
      curve = oc.BRep_Tool.CurveOnSurface_1(edge, face, first, last, { current: false });
    });
    if (!curve || curve.IsNull()) return { edge: indexOf(edge), reversed };
    const spline = oc.Geom2dConvert.CurveToBSplineCurve(curve, oc.Convert_ParameterisationType.Convert_TgtThetaOver2);
    return { edge: indexOf(edge), reversed, seam: oc.BRep_Tool.IsClosed_2(edge, face), pcurve: { ...curveOf(spline.get()), domain } };
  });
  if (uses.length === 0) throw new SoapfilmError('bad-model', 'A wire of `shape` has no edges in order');
  return { uses };
}

const numbersOf = (reals: Reals): number[] => {
  const lower = reals.Lower();
  return Array.from({ length: reals.Upper() - lower + 1 }, (_, i) => reals.Value(lower + i));
};

/** In the plane or in space. Poles are not multiplied by weights there. */
function curveOf(curve: Curve): NurbsCurve {
  if (curve.IsPeriodic()) curve.SetNotPeriodic();
  const numbers = Array.from({ length: curve.NbPoles() }, (_, i) => i + 1);
  const poles = numbers.map((i) => {
    const pole = curve.Pole(i);
    return pole.Z ? [pole.X(), pole.Y(), pole.Z()] : [pole.X(), pole.Y()];
  });
  return {
    degree: curve.Degree(),
    knots: numbersOf(curve.KnotSequence_2()),
    poles,
    weights: curve.IsRational() ? numbers.map((i) => curve.Weight(i)) : null,
  };
}

function surfaceOf(surface: Surface): NurbsSurface {
  if (surface.IsUPeriodic()) surface.SetUNotPeriodic();
  if (surface.IsVPeriodic()) surface.SetVNotPeriodic();
  const [countU, countV] = [surface.NbUPoles(), surface.NbVPoles()];
  const places = Array.from({ length: countU * countV }, (_, i) => [Math.floor(i / countV) + 1, (i % countV) + 1] as const);
  const poles = places.map((at) => {
    const pole = surface.Pole(...at);
    return [pole.X(), pole.Y(), pole.Z()];
  });
  const isRational = surface.IsURational() || surface.IsVRational();
  return {
    degreeU: surface.UDegree(),
    degreeV: surface.VDegree(),
    knotsU: numbersOf(surface.UKnotSequence_2()),
    knotsV: numbersOf(surface.VKnotSequence_2()),
    countU,
    countV,
    poles,
    weights: isRational ? places.map((at) => surface.Weight(...at)) : null,
  };
}
