// Breps of rhino3dm.js.
import { amountOf, guarded, optionsOf } from './check.js';
import { SoapfilmError } from './errors.js';
import type { EdgeUse, FaceLoop, Model, ModelEdge, ModelFace, NurbsCurve, NurbsSurface } from './surface_types.js';

interface RhinoList<T> {
  readonly count: number;
  get(index: number): T;
}

interface Freed {
  delete?(): void;
}

type Pole = readonly number[];

interface RhinoNurbsCurve extends Freed {
  readonly order: number;
  readonly isRational: boolean;
  points(): RhinoList<Pole>;
  knots(): RhinoList<number>;
}

interface RhinoNurbsSurface extends Freed {
  readonly orderU: number;
  readonly orderV: number;
  readonly isRational: boolean;
  knotsU(): RhinoList<number>;
  knotsV(): RhinoList<number>;
  points(): { readonly countU: number; readonly countV: number; get(u: number, v: number): Pole };
  domain(direction: number): readonly number[];
  pointAt(u: number, v: number): Pole;
  isSingular(side: number): boolean;
}

interface RhinoTrim {
  readonly edgeIndex: number;
  readonly isReversed: boolean;
}

/** What `fromRhino` needs of a `Brep` of rhino3dm.js 8. */
export interface RhinoBrep {
  faces(): RhinoList<{
    readonly orientationIsReversed: boolean;
    underlyingSurface(): { toNurbsSurface(): RhinoNurbsSurface };
    readonly loops: RhinoList<{ readonly loopType: unknown; readonly trims: RhinoList<RhinoTrim> }>;
  }>;
  edges(): RhinoList<RhinoEdge>;
}

interface RhinoEdge {
  readonly domain: readonly number[];
  pointAt(t: number): Pole;
  toNurbsCurve(): RhinoNurbsCurve;
}

/** What `fromRhino` needs of the module, as `await rhino3dm()` gives it. */
export interface Rhino {
  readonly BrepLoopType: Readonly<Record<'Outer' | 'Inner', unknown>>;
}

export interface FromRhinoOptions {
  /** How far edges may be off their surfaces, such as the absolute tolerance of the file's settings. Default 0. */
  readonly tolerance?: number;
}

/**
 * The model of a Brep of rhino3dm.js. That tells edges in space, but not their curves on surfaces: those are found when the
 * model is opened. An `Extrusion` is made a Brep by its `toBrep` first.
 *
 * @param rhino the module that the Brep is of
 * @throws SoapfilmError `bad-model` if the Brep cannot be read, or is of a rhino3dm that tells no loops; `bad-option`
 */
export function fromRhino(brep: RhinoBrep, rhino: Rhino, options: FromRhinoOptions = {}): Model {
  const { tolerance = 0 } = optionsOf<FromRhinoOptions>(options, { tolerance: true });
  const slack = amountOf('tolerance', tolerance, Number.MAX_VALUE);
  return guarded('bad-model', 'brep', () => {
    const rhinoEdges = listOf(brep.edges());
    const edges = rhinoEdges.map((edge): ModelEdge => {
      const curve3d = freeing(edge.toNurbsCurve(), curveOf);
      return { curve3d, range: domainOf(curve3d), tolerance: slack };
    });
    const faces = listOf(brep.faces()).map((face) =>
      freeing(face.underlyingSurface().toNurbsSurface(), (nurbs): ModelFace => {
        if ((face.loops as unknown) === undefined) throw new SoapfilmError('bad-model', 'This version of rhino3dm does not tell the loops of faces');
        const kinds = [rhino.BrepLoopType.Outer, rhino.BrepLoopType.Inner];
        const given = listOf(face.loops).filter(({ loopType }) => kinds.includes(loopType));
        const loops = given.map(({ trims }) => loopOf(listOf(trims), new SingularSides(nurbs, rhinoEdges), edges));
        const outer = given.findIndex(({ loopType }) => loopType === kinds[0]);
        return { surface: surfaceOf(nurbs), reversed: face.orientationIsReversed, loops, outer };
      }),
    );
    return { faces, edges };
  });
}

const listOf = <T>(list: RhinoList<T>): T[] => Array.from({ length: list.count }, (_, i) => list.get(i));

/** Trims without an edge run along a singular side of the domain; here they get an edge. */
function loopOf(trims: readonly RhinoTrim[], sides: SingularSides, edges: ModelEdge[]): FaceLoop {
  const isSeam = ({ edgeIndex }: RhinoTrim): boolean => trims.filter((other) => other.edgeIndex === edgeIndex).length > 1;
  const uses = trims.map((trim, i): EdgeUse => {
    const { edgeIndex, isReversed } = trim;
    if (edgeIndex >= 0) return { edge: edgeIndex, reversed: isReversed, seam: isSeam(trim) };
    const count = trims.length;
    const end = (neighbour: RhinoTrim, isLast: boolean) => ({ edge: neighbour.edgeIndex, isSeam: isSeam(neighbour), isAtEnd: isLast !== neighbour.isReversed });
    const pcurve = sides.between(end(trims[(i + count - 1) % count], true), end(trims[(i + 1) % count], false));
    edges.push({ degenerate: true, range: [0, 1] });
    return { edge: edges.length - 1, pcurve };
  });
  return { uses };
}

/** An end of an edge that lies on a singular side. */
interface SideEnd {
  readonly edge: number;
  readonly isSeam: boolean;
  readonly isAtEnd: boolean;
}

/** How near to its end an edge is looked at, and how often steps are halved on the way to the nearest point. */
const [kBeside, kHalvings] = [1e-3, 40];

/** The sides of a surface that are one point in space: south, east, north and west, as Rhino numbers them. */
class SingularSides {
  constructor(
    private readonly surface: RhinoNurbsSurface,
    private readonly edges: readonly RhinoEdge[],
  ) {}

  /** The line along a side from where one edge meets it to where another leaves it. */
  between(from: SideEnd, to: SideEnd): NurbsCurve {
    const side = this.sideAt(this.near(from, 0));
    const poles = [from, to].map((end, i) => {
      // Counter-clockwise around the domain; a seam meets the side where it begins and leaves it where it ends.
      const [a, b] = this.endsOf(side);
      const along = side % 2;
      const corner = i === 0 ? a : b;
      const found = end.isSeam ? corner[along] : this.nearest(this.near(end, kBeside), side)[along];
      return along === 0 ? [found, a[1]] : [a[0], found];
    });
    return { degree: 1, knots: [0, 0, 1, 1], poles };
  }

  /** Where an edge is, that share of its range before its end. */
  private near({ edge, isAtEnd }: SideEnd, share: number): Pole {
    const { domain } = this.edges[edge];
    const x = isAtEnd ? 1 - share : share;
    return this.edges[edge].pointAt(domain[0] + x * (domain[1] - domain[0]));
  }

  private sideAt(point: Pole): number {
    const far = (side: number): number => distance(this.surface.pointAt(...this.endsOf(side)[0]), point);
    const singular = [0, 1, 2, 3].filter((side) => this.surface.isSingular(side));
    if (singular.length === 0) throw new SoapfilmError('bad-model', 'A trim has no edge, and its surface no singular side');
    return singular.reduce((best, side) => (far(side) < far(best) ? side : best));
  }

  private endsOf(side: number): readonly (readonly [u: number, v: number])[] {
    const [u, v] = [this.surface.domain(0), this.surface.domain(1)];
    const corners = [[u[0], v[0]], [u[1], v[0]], [u[1], v[1]], [u[0], v[1]]] as const;
    return [corners[side], corners[(side + 1) % 4]];
  }

  /** About where the surface is nearest to a point beside a singular side: by steps of half the length again and again. */
  private nearest(point: Pole, side: number): readonly number[] {
    const [a, b] = this.endsOf(side);
    const inwards = this.endsOf((side + 1) % 4);
    const [along, across] = [minus(b, a), minus(inwards[1], inwards[0])];
    const place = (s: number, t: number): [number, number] => [a[0] + s * along[0] + t * across[0], a[1] + s * along[1] + t * across[1]];
    const far = (s: number, t: number): number => distance(this.surface.pointAt(...place(s, t)), point);
    let [best, bestFar] = [[0, 0], Infinity];
    const look = (s: number, t: number): boolean => {
      const there = s < 0 || s > 1 || t < 0 || t > 1 ? Infinity : far(s, t);
      if (there >= bestFar) return false;
      [best, bestFar] = [[s, t], there];
      return true;
    };
    for (let i = 0; i <= 64; i++) for (let k = 1; k <= 16; k++) look(i / 64, 4 ** -k * 4);
    for (let [step, n] = [1 / 64, 0]; n < kHalvings; ) {
      const [s, t] = best;
      const moved = [look(s + step, t), look(s - step, t), look(s, t * (1 + step)), look(s, t / (1 + step))].includes(true);
      if (moved) continue;
      step /= 2;
      n++;
    }
    return place(best[0], best[1]);
  }
}

const minus = (a: readonly [number, number], b: readonly [number, number]): readonly [number, number] => [a[0] - b[0], a[1] - b[1]];
const distance = (a: Pole, b: Pole): number => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** Uses what is the caller's own to free. */
function freeing<T extends Freed, R>(thing: T, use: (thing: T) => R): R {
  try {
    return use(thing);
  } finally {
    thing.delete?.();
  }
}

/** Rhino leaves out the first and the last knot, which a curve does not depend on. */
function knotsOf(list: RhinoList<number>): number[] {
  const knots = listOf(list);
  return [knots[0], ...knots, knots[knots.length - 1]];
}

/** Poles, which Rhino has multiplied by weights. */
function polesOf(points: readonly Pole[], isRational: boolean): { poles: number[][]; weights: number[] | null } {
  const poles = points.map(([x, y, z, w]) => (isRational ? [x / w, y / w, z / w] : [x, y, z]));
  return { poles, weights: isRational ? points.map(([, , , w]) => w) : null };
}

const curveOf = (curve: RhinoNurbsCurve): NurbsCurve => ({
  degree: curve.order - 1,
  knots: knotsOf(curve.knots()),
  ...polesOf(listOf(curve.points()), curve.isRational),
});

const domainOf = ({ degree, knots, poles }: NurbsCurve): [number, number] => [knots[degree] as number, knots[poles.length] as number];

function surfaceOf(nurbs: RhinoNurbsSurface): NurbsSurface {
  const points = nurbs.points();
  const { countU, countV } = points;
  const list = Array.from({ length: countU * countV }, (_, i) => points.get(Math.floor(i / countV), i % countV));
  return {
    degreeU: nurbs.orderU - 1,
    degreeV: nurbs.orderV - 1,
    knotsU: knotsOf(nurbs.knotsU()),
    knotsV: knotsOf(nurbs.knotsV()),
    countU,
    countV,
    ...polesOf(list, nurbs.isRational),
  };
}
