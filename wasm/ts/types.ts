import type { SoapfilmError } from './errors.js';

/** k closed loops over n vertices. Loop c owns the vertices `starts[c]` to `starts[c + 1] - 1`. */
export interface LoopSet {
  /** `[3n]` xyz, one length unit. */
  readonly positions: Float64Array;
  /** `[k + 1]`, first 0, increasing, last n. */
  readonly starts: Uint32Array;
}

/** A point as a triple. */
export type Point = readonly [x: number, y: number, z: number];

/** Coordinates, in an array of any of these kinds. How many there must be depends on the use. */
export type Coordinates = readonly number[] | Float32Array | Float64Array;

/** A point in space: three coordinates, or an object that has them, such as three's `Vector3`. */
export type PointLike = Coordinates | { readonly x: number; readonly y: number; readonly z: number };

/** A point of the plane: two coordinates, or an object with `x` and `y` and without `z`. */
export type Point2Like = Coordinates | { readonly x: number; readonly y: number; readonly z?: undefined };

/** A closed loop: an array of points, or one typed array `[3m]` of all their coordinates. */
export type LoopLike = readonly PointLike[] | Float32Array | Float64Array;

/** Loops in flat arrays, as an argument. */
export interface LoopSetLike {
  /** `[3n]` xyz, one length unit. */
  readonly positions: Float32Array | Float64Array;
  /** `[k + 1]`, first 0, never falling, last n. Default: all vertices form one loop. */
  readonly starts?: Uint32Array | readonly number[];
}

/** Loops in any form: flat arrays, or one list of points for each loop. Calls only read them. */
export type LoopsLike = LoopSetLike | readonly LoopLike[];

/**
 * Factors of the cost; those left out are 0. At least one must be positive, unless the `candidates` have
 * weights of their own that are not all 0.
 */
export interface Weights {
  /** Per square unit of triangle area. */
  readonly area?: number;
  /** Per unit of triangle perimeter. */
  readonly perimeter?: number;
  /** Per radian between the normals of adjacent triangles (0 flat, π folded). */
  readonly dihedral?: number;
}

/** The named candidate spaces; see `SpanOptions.candidates`. */
export type CandidateSpace = 'auto' | 'all' | 'delaunay' | 'near';

/** A caller's own candidate triangles. */
export interface CandidateList {
  /** `[3c]` vertex indices. No triangle may occur twice, and none may be collinear. */
  readonly triangles: Uint32Array;
  /** `[c]` the cost to add for each triangle: finite, and negative if you like. */
  readonly weights?: Float64Array;
}

/**
 * Called about every 30 ms while a span is computed, and once more at the end if a surface was found.
 *
 * If the listener throws, the work ends, and the call throws the same error. If the work is already done,
 * as it is in the last call, the result is returned all the same. The error is then reported as one that
 * nobody catches: by `reportError`, or on the console where there is no such function, as in Node.
 * @param fraction share of the work done, 0 to 1, never falling
 * @param bestCost cost of the best surface so far, `Infinity` while there is none
 * @param lowerBound proven lower bound on the optimal cost. It is 0 at first, or less if candidates have
 *   negative weights. With `'auto'` it is about the space that the best surface so far is from
 */
export type ProgressListener = (fraction: number, bestCost: number, lowerBound: number) => void;

export interface SpanOptions {
  /** Default: dihedral 1, and area 1e-3 / (bounding-box diagonal)² to decide between flat surfaces. */
  readonly weights?: Weights;
  /**
   * What is to be least. `'sum'` (default): the weighted sum. `'worst-dihedral'`: the largest angle, and
   * among surfaces that tie in it the weighted sum.
   */
  readonly objective?: 'sum' | 'worst-dihedral';
  /**
   * The triangles that the surface may use.
   * - `'all'`: all triples of vertices that are not collinear.
   * - `'delaunay'`: the facets of the Delaunay tetrahedralization. Edge protection comes first, and may
   *   insert vertices on loop edges. This suits loops of any size. On noisy loops the optimum costs up to
   *   1.5 times the optimum over all triples, or the facets hold no surface.
   * - `'near'`: the Delaunay facets of the loops without inserted vertices, and triples of near-optimal
   *   surfaces. The optimum usually costs at most 1.02 times the optimum over all triples, and takes a
   *   twentieth of the time. This holds for one loop of up to about 4000 vertices, and for two loops of
   *   up to about 120 together. For other loops, the triples are those of neighbouring vertices, and for
   *   several loops of up to 2000 vertices together those of one surface found beforehand. One loop of up
   *   to 1000 vertices without angles in its cost uses `'all'` instead, which is as quick. If the
   *   candidates are widened in several rounds, `optimal` and `lowerBound` are about the last round.
   * - `'auto'` (default): all triples if that is quick. Otherwise the Delaunay facets, and near triples if
   *   the facets hold no surface, or if near triples are likely to give a better one in reasonable time.
   *   For small loops (one of up to 1000 vertices, or several of up to 80 together) that is so if the
   *   facets' surface has more than 0.001 rad an edge on average; for larger loops, if it has more than
   *   0.05 rad. With `'worst-dihedral'` its largest angle counts instead; if the cost has no angles, near
   *   triples are tried in any case. They are never tried to better a surface over one loop of more than
   *   2000 vertices. If none of these spaces holds a surface, all triples are tried, if they fit into
   *   memory. The answer is the cheapest surface of all spaces tried; `candidates` names its space. For
   *   more than two loops, and for two of more than about 120 vertices together, a better surface from
   *   near triples may come without a proof, with `optimal: false`. So it is if the facets hold no surface
   *   within some 20 seconds of work.
   */
  readonly candidates?: CandidateSpace | CandidateList;
  /**
   * `[3n]` normals of the faces around the surface. Each vertex has three numbers, for the face across
   * the edge from this vertex to the next of its loop: the normal of that face, or NaN if there is none.
   * The angle between the face and the boundary triangle, wound along the loop, is added to the cost.
   * The direction of a loop matters only here: the face is on the loop's right, as in a mesh.
   */
  readonly boundaryNormals?: Float64Array;
  /**
   * Memory that the solver may use. Default 3 GiB. If one loop over all triples fits only in single
   * precision, it is solved in single precision: to a relative error of about 1e-6, `optimal: false`.
   */
  readonly maxMemoryBytes?: number;
  /** Seconds after which the call ends with `time-limit`. Default: none. */
  readonly maxSeconds?: number;
  /**
   * Whether work that ends early returns the best surface found so far. A limit, or the `signal` of a
   * worker's call, may end it. The surface then has `optimal: false`, and the optimum lies between
   * `lowerBound` and `cost`. The call throws only if no surface was found yet. With this option the
   * solver first looks for surfaces, which takes some hundredths of a second. Default `false`.
   */
  readonly bestSoFar?: boolean;
  /**
   * With `bestSoFar`: called with every surface that is better than the one before. If it throws, the
   * same happens as for a `ProgressListener`.
   */
  readonly onBest?: (span: Span) => void;
  /**
   * `[3m]` triangles of an earlier answer to the same loops, edited or not. For several loops, the search
   * for surfaces begins with them. Triangles that no longer fit do no harm, and the optimum does not
   * depend on them.
   */
  readonly startFrom?: Uint32Array;
  readonly onProgress?: ProgressListener;
}

/**
 * Measures of a surface: the sums of its triangles' areas and perimeters, and the sum and the largest of
 * the angles between triangles, in radians.
 */
export interface SpanTerms {
  readonly area: number;
  readonly perimeter: number;
  readonly dihedral: number;
  readonly worstDihedral: number;
}

export interface SpanStats {
  /** Candidate triangles. */
  readonly candidates: number;
  /** Domains solved or bounded (Zou, Ju, Carr 2013, section 3.2.1); for a single loop, segments. */
  readonly domains: number;
  /** Minimal weak edge sets stored (section 3.2.3); one for each segment of a single loop. */
  readonly minimalSets: number;
  readonly seconds: number;
  /** Largest amount of memory that the solver held at once. */
  readonly peakBytes: number;
}

/** A vertex that edge protection put on a loop edge; a mesh around it can be split at the same place. */
export interface InsertedVertex {
  /** Input loop, and in it the edge from vertex number `edge` to the next. */
  readonly loop: number;
  readonly edge: number;
  /** Where on that edge the vertex is: 0 at its start, 1 at its end. */
  readonly parameter: number;
}

/** The candidate space that an answer comes from; `'given'` is the caller's own list. */
export type SpaceUsed = 'all' | 'delaunay' | 'near' | 'given';

/** A surface that spans the loops: the optimal one, unless `optimal` is `false`. */
export interface Span {
  readonly found: true;
  /** `[3n']`: the input vertices in input order, then the inserted ones. */
  readonly positions: Float64Array;
  /** `[3m]`, m = n' + 2k - 4, consistently wound. */
  readonly triangles: Uint32Array;
  /** `[k + 1]` offsets into `loopVertices`. */
  readonly starts: Uint32Array;
  /** `[n']` the vertices along the boundary loops of the result, inserted ones included. */
  readonly loopVertices: Uint32Array;
  /** One record for each vertex from n on. */
  readonly inserted: readonly InsertedVertex[];
  /** The objective's value: the weighted sum, or the largest angle. */
  readonly cost: number;
  readonly terms: SpanTerms;
  /** Proven lower bound on the cost of every surface in the candidate space. */
  readonly lowerBound: number;
  /** Whether the surface is proven to be the best in its candidate space. */
  readonly optimal: boolean;
  readonly candidates: SpaceUsed;
  /** `[m]` indices of the triangles in the order of splitting, for animation. */
  readonly order: Uint32Array;
  readonly stats: SpanStats;
}

/** The candidate space holds no manifold triangulation of these loops: an answer, not an error. */
export interface NoSpan {
  readonly found: false;
  readonly reason: string;
  readonly candidates: SpaceUsed;
  readonly stats: SpanStats;
}

/**
 * A polygon with holes: the first ring is the outer one, and each other ring is a hole. Rings may run in
 * either direction, and may repeat their first vertex at the end. They may touch but not cross.
 */
export interface PolygonSet {
  /** `[dim · n]` xy, or xyz of points near one plane of any tilt. */
  readonly positions: Float32Array | Float64Array;
  /** `[r + 1]`, first 0, increasing, last n. Default: all vertices form one ring. */
  readonly starts?: Uint32Array | readonly number[];
  /** Default 2. */
  readonly dim?: 2 | 3;
  /** `[dim · q]` isolated vertices inside the polygon, numbered from n on. */
  readonly points?: Float32Array | Float64Array;
}

/** A polygon in earcut's form. */
export interface EarcutPolygon {
  /** `[dim · n]` */
  readonly coordinates: ArrayLike<number>;
  /** The number of each hole's first vertex. Default: no holes. */
  readonly holeIndices?: ArrayLike<number> | null;
  /** Default 2. */
  readonly dim?: 2 | 3;
}

/**
 * A closed ring: an array of points, or one typed array `[2m]` of all coordinates xy. The points of one
 * polygon are all in the plane, or all in space.
 */
export type Ring = readonly (Point2Like | PointLike)[] | Float32Array | Float64Array;

/** A polygon in any form: flat arrays, or one list of points for each ring. */
export type PolygonLike = PolygonSet | EarcutPolygon | readonly Ring[];

/** Many polygons in flat arrays. */
export interface PolygonBatch {
  /** `[dim · n]` */
  readonly positions: Float32Array | Float64Array;
  /** `[r + 1]` in vertices, first 0, increasing, last n. */
  readonly ringStarts: Uint32Array | readonly number[];
  /** `[p + 1]` in rings, first 0, never falling, last r. A polygon without rings is empty. */
  readonly polygonStarts: Uint32Array | readonly number[];
  /** Default 2. */
  readonly dim?: 2 | 3;
}

/** Many polygons in either form: flat arrays, or an array of polygons, each an array of rings. */
export type PolygonsLike = PolygonBatch | readonly (readonly Ring[])[];

export interface PolygonOptions {
  /** `'flooding'` (default, Ronfard and Rossignac 1994), or `'trapezoids'` (Kumar), with better angles. */
  readonly method?: 'flooding' | 'trapezoids';
  /** `'triangles'` (default), or `'strips'`, which adds triangle strips. */
  readonly output?: 'triangles' | 'strips';
  /** `'fast'` (default), or `'delaunay'`: the constrained Delaunay triangulation. */
  readonly quality?: 'fast' | 'delaunay';
  /** Whether to certify the result, for which its complement is triangulated too. Default `false`. */
  readonly verify?: boolean;
  /**
   * What an invalid polygon gives. `'none'` (default): an error. `'even-odd'`: the points around which its
   * rings wind an odd number of times. `'nonzero'`: the points around which they wind any number of times
   * but 0.
   */
  readonly repair?: 'none' | 'even-odd' | 'nonzero';
  /**
   * Whether to record the actions of flooding. Only for one polygon and `method: 'flooding'`. The water
   * then always rises along y, so the triangles may differ from those without a trace. Default `false`.
   */
  readonly trace?: boolean;
  /**
   * Whether the typed arrays of the result may be views of the core's memory, which saves a copy. They are
   * valid until the next call of `triangulatePolygon`, `triangulatePolygons` or `triangulateGeoJSON`, even
   * if that call throws. After it they hold arbitrary numbers, or have length 0 if the core's memory has
   * grown; with `load({ checks: true })` they always have length 0. Do not write to them or transfer them.
   * Default `false`. Workers always return arrays that are the caller's own.
   */
  readonly borrow?: boolean;
  /** Memory that the core may use. Default 3 GiB. */
  readonly maxMemoryBytes?: number;
  /** Seconds after which the call ends with `time-limit`. Default: none. */
  readonly maxSeconds?: number;
}

/** Options for many polygons. */
export interface PolygonsOptions extends PolygonOptions {
  /**
   * Whether an invalid polygon gets no triangles, and an entry in `errors`. Default `false`: the call
   * throws.
   */
  readonly skipInvalid?: boolean;
}

/** An action of flooding (Ronfard and Rossignac 1994, sections 3 and 4). */
export interface FloodStep {
  readonly action: 'start' | 'raise' | 'fill' | 'bridge' | 'spill' | 'jump';
  /** The vertices at the ends of the active chain after the action. */
  readonly left: number;
  readonly right: number;
  /** How many triangles there are after the action. */
  readonly triangles: number;
}

export interface PolygonTriangulation {
  /**
   * `[3m]` vertices, numbered as in the input. Triangles are counter-clockwise; in space they run as the
   * outer ring does. m = n + 2 holes - 2 if rings do not touch, and 2 more for each isolated vertex.
   */
  readonly triangles: Uint32Array;
  /** With `output: 'strips'`: strip i is `strips[stripStarts[i]]` up to `strips[stripStarts[i + 1] - 1]`. */
  readonly strips: Uint32Array;
  readonly stripStarts: Uint32Array;
  /** `[dim · a]` points that repair added, numbered after all others. */
  readonly added: Float64Array;
  /** `[2a]` the two edges that each added point is on, by their first vertices. */
  readonly addedOn: Uint32Array;
  /** With `trace`: the actions of flooding; else empty. */
  readonly trace: readonly FloodStep[];
}

/** The triangles of many polygons. Vertices have their numbers in the whole input. */
export interface PolygonsTriangulation extends PolygonTriangulation {
  /** `[p + 1]` where each polygon's triangles begin, counted in triangles. */
  readonly triangleStarts: Uint32Array;
  /** `[p + 1]` where each polygon's strips begin. */
  readonly polygonStrips: Uint32Array;
  /** With `skipInvalid`: an error for each invalid polygon, whose number is the error's `polygon`. */
  readonly errors: readonly SoapfilmError[];
}

/** What an edit of a PolygonSession changed. Its two arrays may share one buffer, which nothing else uses. */
export interface PolygonEdit {
  /** The vertex inserted, moved or deleted. */
  readonly vertex: number;
  /** How many triangles there are now. */
  readonly triangleCount: number;
  /** `[c]` numbers of the triangles that are new, increasing; all others are as before. */
  readonly changed: Uint32Array;
  /** `[3c]` vertices of the new triangles. */
  readonly triangles: Uint32Array;
}

/** What a PolygonSession holds. */
export interface PolygonState {
  /** `[2n]` coordinates of each vertex; those of deleted vertices mean nothing. */
  readonly positions: Float64Array;
  /**
   * `[n]` for each vertex the next one of its ring, where rings have the polygon to their left. For
   * isolated vertices `0xffffffff`; for deleted ones the vertex itself.
   */
  readonly next: Uint32Array;
  /** Strips, in the same form as those of `triangulatePolygon`. */
  readonly strips: Uint32Array;
  readonly stripStarts: Uint32Array;
  /** Whether the triangles of the polygon and of its complement passed a check from scratch. */
  readonly certified: boolean;
}

/** A GeoJSON object, with the fields that are used here. Objects of `@types/geojson` and parsed text fit. */
export interface GeoJSONLike {
  readonly type: string;
  readonly coordinates?: unknown;
  readonly geometry?: unknown;
  readonly geometries?: unknown;
  readonly features?: unknown;
  readonly properties?: unknown;
}

export interface GeoJSONTriangulation extends PolygonsTriangulation {
  /** `[2n]` the vertices of all polygons, in the order of the input and without altitudes. */
  readonly positions: Float64Array;
  /** `[f + 1]` where each feature's polygons begin, in polygons. A geometry alone is one feature. */
  readonly featureStarts: Uint32Array;
}

/** A triangle mesh. */
export interface MeshLike {
  /** `[3n]` xyz. */
  readonly positions: Float64Array | Float32Array;
  /** `[3m]` three vertices a face. `triangles` is taken for it too. */
  readonly faces: Uint32Array;
  /** Of the vertices, by name: colours, texture coordinates. Patches carry them on. */
  readonly attributes?: Readonly<Record<string, MeshAttribute>>;
}

/** `size` numbers for each vertex. */
export interface MeshAttribute {
  /** `[size n]`. */
  readonly data: Float32Array;
  readonly size: number;
}

/** `MeshLike`, or the same with `triangles` for `faces`. */
export type MeshInput = MeshLike | (Omit<MeshLike, 'faces'> & { readonly triangles: Uint32Array });

export type DefectKind =
  | 'non-manifold-edge'
  | 'non-manifold-vertex'
  | 'flipped'
  | 'duplicate-face'
  | 'degenerate-face'
  | 'not-orientable'
  | 'unused-vertex';

/** What is wrong with a mesh, all places of one kind. The mesh is used as it is; nothing of it is changed. */
export interface MeshDefect {
  readonly kind: DefectKind;
  /** Faces concerned. */
  readonly faces: Uint32Array;
  /** `[2e]` edges concerned, as pairs of vertices. */
  readonly edges: Uint32Array;
  /** Vertices concerned. */
  readonly vertices: Uint32Array;
}

/** A closed loop of edges with a face on one side alone. */
export interface HoleLoop {
  /** The vertices in the order in which faces that fill the hole have them: the mesh's face is on the right. */
  readonly vertices: Uint32Array;
  /** In units of the mesh, as is `diameter`. */
  readonly length: number;
  /** The largest distance between two of its vertices; of more than 1000, a little too small. */
  readonly diameter: number;
  /** Share of its length, 0 to 1, that faces nothing: near 1 for rims that are meant to be open. */
  readonly openness: number;
  /** The number of the connected part of the mesh that it is of. */
  readonly component: number;
  /**
   * Whether more than half of it runs along edges of loops, this one included, that are at the same places and have
   * vertices of their own: `weld` would join them. Such a loop is no hole, and mostly part of an open rim.
   */
  readonly isSeam: boolean;
}

/** Loops that bound one hole. */
export interface HoleGroup {
  /** Numbers of loops, the outer rim first. */
  readonly loops: readonly number[];
  /** The least vote that the group hangs by, 0 to 1; 1 for a loop alone. */
  readonly score: number;
  /** What its loops are: one alone; an outer rim with islands; the two ends of a missing band; as the caller said. */
  readonly why: 'alone' | 'island' | 'band' | 'given';
  /** Whether it is meant to be open: such a rim is filled only if that is asked for. */
  readonly isOpenRim: boolean;
}

export interface HoleReport {
  readonly loops: readonly HoleLoop[];
  /** Every loop is in one of them. */
  readonly groups: readonly HoleGroup[];
  readonly defects: readonly MeshDefect[];
  /** With `weld`: `[n]` the number of each vertex in the welded mesh, whose numbers the rest has. */
  readonly vertexMap?: Uint32Array;
}

export interface HoleOptions {
  /** Makes vertices one that are within this distance first; 0: at the same place. For meshes whose faces share none, as in STL files. */
  readonly weld?: number;
  /** Most memory to use. Default 3 GiB. */
  readonly maxMemoryBytes?: number;
  /** Ends the work with `time-limit` after so many seconds. */
  readonly maxSeconds?: number;
  /** Called now and then with the share of the work that is done. An error in it ends the work. */
  readonly onProgress?: (fraction: number) => void;
}

/** How one hole is filled. */
export interface HoleFillOptions {
  /** What the surface costs before it is refined, as in `SpanOptions`. Default: the angles, and a little area. */
  readonly weights?: Weights;
  /** Which triangles the surface may have before it is refined. Default `'auto'`: all triples for small rims, else Delaunay. */
  readonly candidates?: 'auto' | 'all' | 'delaunay' | 'near';
  /**
   * How smoothly the patch goes on what is around it: 0 not faired, 1 direction, 2 curvature too. Default `'auto'`: 2,
   * but 1 where the surroundings are rough, and 0 in flat places.
   */
  readonly fairness?: 0 | 1 | 2 | 'auto';
  /** How much denser than its surroundings the patch is (Liepa's factor). Default √2; 0: it is not refined, and has a new vertex only where an edge would be there twice without. */
  readonly density?: number;
  /** Most new vertices in one hole, those on creases included. Default: no limit. */
  readonly maxNewVertices?: number;
  /** Whether creases that end at the rim go on through the hole, or from which angle in degrees on. Default `true`: 40. */
  readonly creases?: boolean | number;
}

export interface FillOptions extends HoleFillOptions, Omit<HoleOptions, 'onProgress'> {
  /** Numbers of groups in the `HoleReport`, or `'all'` (default): all but open rims. Those named here are filled, open or not. */
  readonly holes?: readonly number[] | 'all';
  /** Groups of loops in place of those found: these are filled, open rims or not. Other loops stay open. */
  readonly groups?: readonly (readonly number[])[];
  /** Options of single holes, by the numbers of their groups. */
  readonly perHole?: Readonly<Record<number, HoleFillOptions>>;
  /** Fills open rims as well. */
  readonly fillOpenRims?: boolean;
  /** Skips holes with more vertices on their rims. */
  readonly maxVertices?: number;
  /** Skips holes with a longer outer rim. */
  readonly maxLength?: number;
  /** `'mesh'` (default): the whole mesh; `'patches'`: only what is new, for large meshes. */
  readonly output?: 'mesh' | 'patches';
  /** Called now and then with the share of the work that is done, the hole at work and how many there are. An error in it ends the work. */
  readonly onProgress?: (fraction: number, hole: number, of: number) => void;
  /**
   * Most time for one hole. A hole that takes longer gets the best surface found until then, not refined, or fails
   * if there is none; its reason is `'time-limit'`. Default: no limit.
   */
  readonly maxSecondsPerHole?: number;
}

/** What a session is asked to fill: as in `fillHoles`, but for `weld`, which is said when it is opened. */
export type SessionFillOptions = Omit<FillOptions, 'weld'>;

/**
 * Why a hole is not filled, or how it is.
 *
 * It failed:
 * - `'no-surface'`: the candidates hold no surface that its rims bound.
 * - `'rims-intersect'`: its rims cross or touch each other or themselves.
 * - `'repeated-vertex'`: two vertices of its rims are in one place; or rims share a vertex, and no surface goes on there.
 * - `'duplicate-face'`: the patch would have a face or an edge that the mesh has already.
 * - `'too-large'`: it needs more than `maxMemoryBytes`.
 * - `'inserted-vertices'`: only a surface with further vertices on its rims was found, and none that those could be
 *   put on.
 * - `'opposed-rims'`: a rim runs the other way round than the rest, so a part of the mesh is inside out.
 * - `'time-limit'`: no surface was found within `maxSecondsPerHole`.
 *
 * It is filled:
 * - `'stitched'`: in part at least by triangles without area, between vertices of the rim that are in one place.
 * - `'time-limit'`: by the best surface found within `maxSecondsPerHole`, which then is as coarse as its rims, and may
 *   be `'self-intersecting'`.
 *
 * It was skipped, by an option of `fillHoles`:
 * - `'too-many-vertices'`: more than `maxVertices` are on its rims.
 * - `'too-long'`: its outer rim is longer than `maxLength`.
 * - `'not-asked-for'`: `holes` does not name it.
 */
export type HoleReason =
  | 'no-surface'
  | 'rims-intersect'
  | 'repeated-vertex'
  | 'duplicate-face'
  | 'too-large'
  | 'inserted-vertices'
  | 'opposed-rims'
  | 'stitched'
  | 'time-limit'
  | 'too-many-vertices'
  | 'too-long'
  | 'not-asked-for';

/** What became of a hole. */
export interface FilledHole {
  /** Number of the group. */
  readonly group: number;
  readonly status: 'filled' | 'self-intersecting' | 'open-rim' | 'skipped' | 'failed';
  readonly reason?: HoleReason;
  /** Its faces in the filled mesh: from the first to before the second. */
  readonly faces: readonly [from: number, to: number];
  /** Of the surface before it was refined: the sum that `weights` says. If creases part the hole, over its parts. */
  readonly cost: number;
  /** Proven lower bound on the cost of every such surface among the candidates. */
  readonly lowerBound: number;
  /** Whether that surface is proven to be the best among the candidates. */
  readonly optimal: boolean;
  /** Mean angle between the patch and the faces along the rim, in radians: before refining and after fairing. */
  readonly rimAngle: { readonly before: number; readonly after: number };
  /**
   * `[2p]` pairs of faces of the filled mesh that intersect: of the patch with itself, with the mesh, and with patches of
   * other holes. Of a pair with another hole's patch, this hole's face is first. Not all are listed where there are
   * more than some 10 000.
   */
  readonly intersections: Uint32Array;
  /** 2: curvature goes on, 1: direction does, 0: not faired. */
  readonly fairnessUsed: 0 | 1 | 2;
  /** Share of the fairing that was taken back since the patch would have intersected something, 0 to 1. */
  readonly movedLess: number;
  /**
   * Attributes that are 0 on the patch: texture coordinates, called `uv` or the like, where charts meet at its rims.
   * Known only of meshes that are welded here.
   */
  readonly attributesLeft?: readonly string[];
}

/**
 * A face along a rim that had to be split, since no surface could be had without further vertices on the rim. That is
 * rare. The shape stays as it is.
 */
export interface SplitFace {
  readonly face: number;
  /** `[3]` the face is its first piece now: the vertices of that. */
  readonly corners: Uint32Array;
  /** The other pieces, as faces of the filled mesh. */
  readonly first: number;
  readonly count: number;
}

export interface FillResult {
  /** The mesh with its holes filled: old vertices and faces first, exactly as given but for `splitFaces`. With `output: 'patches'` only the new ones; faces still name vertices of the whole. */
  readonly mesh: MeshLike;
  readonly oldVertices: number;
  readonly oldFaces: number;
  /** Old faces that are not as given: they had to be split. */
  readonly splitFaces: readonly SplitFace[];
  /** With `weld`: `[n]` the number of each vertex in the welded mesh, which then is the old part. */
  readonly vertexMap?: Uint32Array;
  /** Whether no hole was left, open rims neither; patches may cross something. */
  readonly closed: boolean;
  /** By groups. */
  readonly holes: readonly FilledHole[];
  readonly defects: readonly MeshDefect[];
}

export interface SmoothOptions extends Omit<HoleOptions, 'weld'> {
  /**
   * `'soap-film'` (default): the surface of least area on its boundary, as near as its vertices allow; `'thin-plate'`:
   * it bends least; `'curvature'`: its curvature varies least.
   */
  readonly kind?: 'soap-film' | 'thin-plate' | 'curvature';
  /** How much denser than its boundary the surface is (Liepa's factor). Default √2; 0: it keeps its vertices. */
  readonly density?: number;
  /** Most new vertices. */
  readonly maxNewVertices?: number;
  /** Numbers of vertices inside that stay where they are, as those of the boundary do. */
  readonly fixed?: Uint32Array | readonly number[];
  /**
   * `[3b]` normals of what the surface goes on smoothly at its boundary; without them, it leaves its boundary as it will.
   * Not for soap films, which always do. Each edge of the boundary has three numbers: by loops in order of their least
   * vertex, each loop from that on towards the lesser of its two neighbours in it. So `boundaryNormals` of `spanLoops`
   * fit its result, unless vertices were inserted. As there, a normal is that of a surface that is wound along its loop
   * in this direction, or NaN where none is known; the surface's own triangles may run the other way. Of a vertex both
   * edges must be known, or it counts as if none were.
   */
  readonly boundaryNormals?: Float64Array;
}

export interface SmoothSurface {
  /** `[3n]`: the vertices of the boundary and those of `fixed`, exactly as given, then all others. */
  readonly positions: Float64Array;
  /** `[3m]`, wound as given. */
  readonly triangles: Uint32Array;
  /** `[b]` the numbers that the first b vertices had in the input. */
  readonly boundary: Uint32Array;
  /** `[f]` the same for the next f vertices, which the option `fixed` names and which are not on the boundary. */
  readonly fixed: Uint32Array;
  /** Vertices where the film has shrunk to a thread: there is none, as between rings that are too far apart. */
  readonly collapsed: Uint32Array;
  /** In square units of the input. */
  readonly area: number;
  /** For soap films: whether a further step would move nothing. */
  readonly isMinimal: boolean;
}

/**
 * A part of the core that can be loaded by itself. `'loops'` is `loops.wasm`, for `spanLoops`. `'polygons'`
 * is `polygons.wasm`, for `triangulatePolygon`, `triangulatePolygons`, `triangulateGeoJSON` and
 * `PolygonSession`. `'meshes'` is `meshes.wasm`, for `findHoles`, `fillHoles`, `MeshSession` and
 * `smoothSurface`. `'surfaces'` is `surfaces.wasm`, for `TrimmedModel` and `TrimmedSurface` of `soapfilm/surfaces`.
 */
export type Part = 'loops' | 'polygons' | 'meshes' | 'surfaces';

/** A WebAssembly module: compiled, as bytes, as a response that holds them, or as the place of its file. */
export type WasmSource = URL | string | Response | BufferSource | WebAssembly.Module;

export interface LoadOptions {
  /** Which parts to fetch. Default: all, at the same time. */
  readonly parts?: readonly Part[];
  /**
   * Where to load the parts from: a source for each part by name, or one source, which is for the first
   * of `parts`. Default: the files beside the library's own module.
   */
  readonly wasm?: WasmSource | Readonly<Partial<Record<Part, WasmSource>>>;
  /**
   * Whether `borrow` lends copies, which the next call detaches. An array that is used for too long is then
   * empty at once; otherwise it would be wrong, but only in rare cases. This is for tests: `borrow` then
   * saves no time. If left out, the setting does not change; at first it is `false`. Workers lend nothing.
   */
  readonly checks?: boolean;
}
