// Surfaces of geomdl (NURBS-Python).
import { fieldsOf, guarded, mustBe, show } from './check.js';
import { SoapfilmError } from './errors.js';
import { parsedJson } from './model_file.js';
import type { EdgeUse, FaceLoop, Model, ModelEdge, ModelFace, ModelNumbers, NurbsCurve, NurbsSurface } from './surface_types.js';
import { loopAround } from './whole_domain.js';

/** A curve among the trims of a surface. */
type GeomdlTrim = {
  /** 1: the surface is what is inside the curve; 0 or left out: what is outside. */
  readonly reversed?: number | boolean;
} & (
  | { readonly type: 'spline'; readonly degree: number; readonly knotvector: ModelNumbers; readonly control_points: GeomdlPoints }
  | { readonly type: 'freeform'; readonly points: readonly ModelNumbers[] }
  | { readonly type: 'container'; readonly data: readonly GeomdlTrim[] }
);

interface GeomdlPoints {
  readonly points: readonly ModelNumbers[];
  readonly weights?: ModelNumbers;
}

interface GeomdlSurface {
  readonly degree_u: number;
  readonly degree_v: number;
  readonly knotvector_u: ModelNumbers;
  readonly knotvector_v: ModelNumbers;
  readonly size_u: number;
  readonly size_v: number;
  readonly control_points: GeomdlPoints;
  readonly reversed?: number | boolean;
  readonly trims?: { readonly data: readonly GeomdlTrim[] };
}

/**
 * The model in a file of `exchange.export_json` of geomdl 5: each surface is a face, its trims are loops. As there, what is
 * inside a trim is cut away, and of a trim that is `reversed` what is outside. Surfaces share no edges.
 *
 * @param json text, or what it says
 * @throws SoapfilmError `bad-file` if it is no such file, or holds curves or volumes; `bad-model` for a surface with several
 *   outer trims, with its `face`
 */
export function fromGeomdl(json: unknown): Model {
  const { shape } = fieldsOf<{ shape: unknown }>(parsedJson(json), { shape: true }, 'file', 'bad-file');
  const { type, data } = fieldsOf<{ type: unknown; data: unknown }>(shape, { type: true, data: true }, 'file.shape', 'bad-file');
  if (type !== 'surface') throw new SoapfilmError('bad-file', `The file must hold surfaces, not ${show(type)}`);
  return guarded('bad-file', 'file.shape.data', () => {
    if (!Array.isArray(data)) throw mustBe('bad-file', 'file.shape.data', 'an array', data);
    const edges: ModelEdge[] = [];
    const faces: ModelFace[] = [];
    // By index: one that is missing is an error.
    for (let i = 0; i < data.length; i++) faces.push(faceOf(data[i] as GeomdlSurface, i, edges));
    return { faces, edges };
  });
}

function faceOf(given: GeomdlSurface, number: number, edges: ModelEdge[]): ModelFace {
  const surface: NurbsSurface = {
    degreeU: given.degree_u,
    degreeV: given.degree_v,
    knotsU: given.knotvector_u,
    knotsV: given.knotvector_v,
    countU: given.size_u,
    countV: given.size_v,
    poles: given.control_points.points,
    weights: given.control_points.weights ?? null,
  };
  const face: ModelFace = { surface, reversed: Boolean(given.reversed ?? false) };
  const trims = given.trims?.data ?? [];
  if (trims.length === 0) return face;
  const loops = trims.map((trim): FaceLoop => ({ uses: curvesOf(trim, number).map((curve) => useOf(curve, edges)) }));
  const around = trims.flatMap(({ reversed = false }, i) => (reversed ? [i] : []));
  if (around.length > 1) {
    throw new SoapfilmError('bad-model', `Surface ${number} has several outer trims, ${around.join(', ')}: a face has one`, { face: number });
  }
  if (around.length === 1) return { ...face, loops, outer: around[0] };
  const whole = loopAround(surface, edges.length);
  edges.push(...whole.edges);
  return { ...face, loops: [{ uses: whole.uses }, ...loops], outer: 0 };
}

function useOf(pcurve: NurbsCurve, edges: ModelEdge[]): EdgeUse {
  const { degree, knots, poles } = pcurve;
  edges.push({ range: [knots[degree], knots[poles.length]] });
  return { edge: edges.length - 1, pcurve };
}

/** The curves of a trim, one after the other. */
function curvesOf(trim: GeomdlTrim, face: number): NurbsCurve[] {
  switch (trim.type) {
    case 'spline':
      return [
        { degree: trim.degree, knots: trim.knotvector, poles: trim.control_points.points, weights: trim.control_points.weights ?? null },
      ];
    case 'freeform':
      return [polylineOf(trim.points)];
    case 'container':
      return trim.data.flatMap((part) => curvesOf(part, face));
    default:
      throw new SoapfilmError('bad-file', `Surface ${face} has a trim of the unknown type ${show((trim as { type?: unknown }).type)}`, { face });
  }
}

/** A closed polyline, whose first point may be repeated at its end. */
function polylineOf(points: readonly ModelNumbers[]): NurbsCurve {
  const [first, last] = [points[0], points[points.length - 1]];
  const poles = first[0] === last[0] && first[1] === last[1] ? points : [...points, first];
  const inner = poles.map((_, i) => i);
  return { degree: 1, knots: [0, ...inner, poles.length - 1], poles };
}
