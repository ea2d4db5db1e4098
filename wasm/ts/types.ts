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

/** Coordinates as numbers in an array of any kind; how many there must be depends on the use. */
export type Coordinates = readonly number[] | Float32Array | Float64Array;

/** A point in space: three coordinates, or an object that has them, such as three's `Vector3`. */
export type PointLike = Coordinates | { readonly x: number; readonly y: number; readonly z: number };

/** A point of the plane, likewise. */
export type Point2Like = Coordinates | { readonly x: number; readonly y: number; readonly z?: undefined };

/** A closed loop: points, or `[3m]` all their coordinates in one typed array. */
export type LoopLike = readonly PointLike[] | Float32Array | Float64Array;

/** Loops in flat arrays as they may be given. */
export interface LoopSetLike {
  /** `[3n]` xyz, one length unit. */
  readonly positions: Float32Array | Float64Array;
  /** `[k + 1]`, first 0, not falling, last n. Default: all vertices are one loop. */
  readonly starts?: Uint32Array | readonly number[];
}

/** Loops in any form: flat arrays, or one list of points a loop. They are read, and never changed or taken. */
export type LoopsLike = LoopSetLike | readonly LoopLike[];

/** Factors of the cost. At least one is positive; those left out are 0. */
export interface Weights {
  /** Per square unit of triangle area. */
  readonly area?: number;
  /** Per unit of triangle perimeter. */
  readonly perimeter?: number;
  /** Per radian between the normals of adjacent triangles (0 flat, π folded). */
  readonly dihedral?: number;
}

/** Names of the candidate spaces that can be asked for. */
export type CandidateSpace = 'auto' | 'all' | 'delaunay' | 'near';

/** A caller's own candidate triangles. */
export interface CandidateList {
  /** `[3c]` vertex indices; no triangle twice, none collinear. */
  readonly triangles: Uint32Array;
  /** `[c]` added to the cost of each triangle. */
  readonly weights?: Float64Array;
}

/**
 * Called while a span is computed, every 30 ms or so, and once when a surface has been found. What it
 * throws ends the work, and the call throws it on. Once the work is done, as in that last call, it cannot
 * be ended any more: the result is returned all the same, and what was thrown is reported as an error that
 * nobody catches (`reportError`, or the console where there is no such function, as in Node).
 * @param fraction share of the work done, 0 to 1, never falling
 * @param bestCost cost of the best surface so far, `Infinity` while there is none
 * @param lowerBound proven lower bound on the optimal cost: 0 at first, less only where candidates have
 *   negative weights; it starts anew with each space that `'auto'` tries
 */
export type ProgressListener = (fraction: number, bestCost: number, lowerBound: number) => void;

export interface SpanOptions {
  /** Default: dihedral 1 and area 1e-3 / (bounding-box diagonal)², which settles flat ties. */
  readonly weights?: Weights;
  /** `'sum'` (default), or the least largest angle, ties settled by the weighted sum. */
  readonly objective?: 'sum' | 'worst-dihedral';
  /**
   * Triangles that the surface may use.
   * - `'all'` triples of vertices that are not collinear.
   * - `'delaunay'`: facets of the Delaunay tetrahedralization, after edge protection, which may insert
   *   vertices on loop edges. For loops of any size; on noisy ones the optimum costs up to 1.5 times
   *   that over all triples, or there is none.
   * - `'near'`: the facets for the loops as they are, and triples of near-optimal surfaces. The
   *   optimum among them usually costs at most 1.02 times that over all triples, and takes a twentieth of
   *   the time. So for one loop up to 4000 vertices, or two up to 120 together; for others triples of
   *   neighbouring vertices, and those of a surface that always exists. Without angles in the cost one
   *   loop up to 1000 vertices takes `'all'`, which is as quick. `optimal` and `lowerBound` are about the
   *   last such set.
   * - `'auto'` (default): all triples where that is quick. Else the Delaunay facets, and then near triples
   *   if they may give a better surface in reasonable time: always for small loops, for large ones where
   *   the facets' surface is rough (more than 0.05 rad an edge on average), never for one loop of more
   *   than 2000 vertices. The cheapest surface of all is the answer; `candidates` says which space it is
   *   from. A better one from near triples of three loops or more may come without a proof,
   *   `optimal: false`. Where all these hold no surface, all triples.
   */
  readonly candidates?: CandidateSpace | CandidateList;
  /**
   * `[3n]`: normal of the face that lies across the edge from each vertex to the next of its loop,
   * NaN for none. Its angle to the boundary triangle, wound along the loop, is added to the cost: only
   * here does the direction of a loop matter. As in a mesh, the face is on the loop's right.
   */
  readonly boundaryNormals?: Float64Array;
  /**
   * Memory that the solver may use. Default 3 GiB. One loop over all triples that fits only in single
   * precision is solved in it, to a relative error of about 1e-6, and comes with `optimal: false`.
   */
  readonly maxMemoryBytes?: number;
  /** Seconds after which the call ends with `time-limit`. Default: none. */
  readonly maxSeconds?: number;
  /**
   * Whether a limit, or the `signal` of a worker's call, ends the work with the best surface found
   * until then: `optimal: false`, and the optimum lies between `lowerBound` and `cost`. Surfaces are then
   * looked for first, which takes some hundredths of a second. The error of the limit comes only if there
   * is none yet. Default `false`.
   */
  readonly bestSoFar?: boolean;
  /**
   * With `bestSoFar`: called with every surface that is better than the one before. What it throws is
   * dealt with as for `ProgressListener`.
   */
  readonly onBest?: (span: Span) => void;
  /**
   * `[3m]` triangles of an earlier answer to the same loops, edited or not: the search for surfaces
   * begins there. What does not fit any more does no harm, and the optimum does not depend on it.
   */
  readonly startFrom?: Uint32Array;
  readonly onProgress?: ProgressListener;
}

/** Sums over a surface; angles in radians. */
export interface SpanTerms {
  readonly area: number;
  readonly perimeter: number;
  readonly dihedral: number;
  readonly worstDihedral: number;
}

export interface SpanStats {
  /** Candidate triangles. */
  readonly candidates: number;
  /** Domains solved, or bounded (Zou, Ju, Carr 2013, section 3.2.1); segments for a single loop. */
  readonly domains: number;
  /** Minimal weak edge sets stored (section 3.2.3); one for each segment of a single loop. */
  readonly minimalSets: number;
  readonly seconds: number;
  /** Largest amount of memory that the solver held at once. */
  readonly peakBytes: number;
}

/** A vertex that edge protection put on a loop edge, so that a mesh around can be split likewise. */
export interface InsertedVertex {
  /** Input loop and edge: the edge from vertex `edge` of that loop to the next. */
  readonly loop: number;
  readonly edge: number;
  /** 0 to 1 along that edge. */
  readonly parameter: number;
}

/** The candidate space that an answer is from. */
export type SpaceUsed = 'all' | 'delaunay' | 'near' | 'given';

/** The optimal surface. */
export interface Span {
  readonly found: true;
  /** `[3n']`: the input vertices in input order, then the inserted ones. */
  readonly positions: Float64Array;
  /** `[3m]`, m = n' + 2k - 4, consistently wound. */
  readonly triangles: Uint32Array;
  /** `[k + 1]` offsets into `loopVertices`. */
  readonly starts: Uint32Array;
  /** `[n']` the boundary loops of the result, inserted vertices included. */
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
  /** `[m]` triangles in the order of splitting, for animation. */
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
 * A polygon with holes: the first ring is the outer one, each of the others a hole. Rings may run
 * either way, may repeat their first vertex at the end, and may touch but not cross.
 */
export interface PolygonSet {
  /** `[dim · n]` xy, or xyz of points in a plane of any tilt. */
  readonly positions: Float32Array | Float64Array;
  /** `[r + 1]`, first 0, increasing, last n. Default: all vertices are one ring. */
  readonly starts?: Uint32Array | readonly number[];
  /** Default 2. */
  readonly dim?: 2 | 3;
  /** `[dim · q]` isolated vertices inside the polygon, numbered from n on. */
  readonly points?: Float32Array | Float64Array;
}

/** A polygon as earcut takes it. */
export interface EarcutPolygon {
  /** `[dim · n]` */
  readonly coordinates: ArrayLike<number>;
  /** Where each hole begins, in vertices. */
  readonly holeIndices?: ArrayLike<number> | null;
  /** Default 2. */
  readonly dim?: 2 | 3;
}

/**
 * A closed ring: points of the plane or of space, all of a polygon alike, or `[2m]` all coordinates xy in
 * one typed array.
 */
export type Ring = readonly (Point2Like | PointLike)[] | Float32Array | Float64Array;

/** A polygon in any form: flat arrays, or one list of points a ring. */
export type PolygonLike = PolygonSet | EarcutPolygon | readonly Ring[];

/** Many polygons in flat arrays. */
export interface PolygonBatch {
  /** `[dim · n]` */
  readonly positions: Float32Array | Float64Array;
  /** `[r + 1]` in vertices, first 0, increasing, last n. */
  readonly ringStarts: Uint32Array | readonly number[];
  /** `[p + 1]` in rings, first 0, increasing, last r. */
  readonly polygonStarts: Uint32Array | readonly number[];
  /** Default 2. */
  readonly dim?: 2 | 3;
}

/** Many polygons in either form: flat arrays, or an array of polygons, each an array of rings. */
export type PolygonsLike = PolygonBatch | readonly (readonly Ring[])[];

export interface PolygonOptions {
  /** `'flooding'` (default, Ronfard and Rossignac 1994) or `'trapezoids'` (Kumar): better angles. */
  readonly method?: 'flooding' | 'trapezoids';
  /** `'strips'`: triangle strips as well. Default `'triangles'`. */
  readonly output?: 'triangles' | 'strips';
  /** `'delaunay'`: the constrained Delaunay triangulation. Default `'fast'`. */
  readonly quality?: 'fast' | 'delaunay';
  /** Whether the result is to be certified, by triangles of its complement too. Default `false`. */
  readonly verify?: boolean;
  /**
   * What to make of an invalid polygon. `'none'` (default): an error; `'even-odd'`, `'nonzero'`: the
   * points about which its rings wind an odd number of times, or any number but 0.
   */
  readonly repair?: 'none' | 'even-odd' | 'nonzero';
  /**
   * Whether to record the actions of flooding, for one polygon. Water then rises along y, which it need
   * not do otherwise, so the triangles may be others than without. Default `false`.
   */
  readonly trace?: boolean;
  /**
   * Whether the typed arrays of the result may be views of the core's memory, which spares a copy: they
   * are good until the next call of `triangulatePolygon`, `triangulatePolygons` or `triangulateGeoJSON`,
   * even one that throws. What they hold afterwards is whatever the core has put there, or nothing, with
   * length 0, once its memory has grown; `load({ checks: true })` makes sure of the latter. They are not to
   * be written to or transferred. Default `false`. A worker's results are always one's own.
   */
  readonly borrow?: boolean;
  /** Memory that the core may use. Default 3 GiB. */
  readonly maxMemoryBytes?: number;
  /** Seconds after which the call ends with `time-limit`. Default: none. */
  readonly maxSeconds?: number;
}

/** Options for many polygons. */
export interface PolygonsOptions extends PolygonOptions {
  /** Whether invalid polygons get no triangles and an entry in `errors`. Default `false`: they throw. */
  readonly skipInvalid?: boolean;
}

/** An action of flooding; sections 3 and 4 of the paper. */
export interface FloodStep {
  readonly action: 'start' | 'raise' | 'fill' | 'bridge' | 'spill' | 'jump';
  /** The vertices at the ends of the active chain after it. */
  readonly left: number;
  readonly right: number;
  /** How many triangles there are after it. */
  readonly triangles: number;
}

export interface PolygonTriangulation {
  /**
   * `[3m]` vertices, numbered as in the input; counter-clockwise, in space as the outer ring runs.
   * m = n + 2 holes - 2 where rings do not touch.
   */
  readonly triangles: Uint32Array;
  /** With `output: 'strips'`: strip i is `strips[stripStarts[i]]` up to `strips[stripStarts[i + 1] - 1]`. */
  readonly strips: Uint32Array;
  readonly stripStarts: Uint32Array;
  /** `[dim · a]` points that repair added, numbered after all others. */
  readonly added: Float64Array;
  /** `[2a]` the two edges that each is on, by their first vertices. */
  readonly addedOn: Uint32Array;
  /** With `trace`. */
  readonly trace: readonly FloodStep[];
}

/** The triangles of many polygons; vertices are numbered through all of them. */
export interface PolygonsTriangulation extends PolygonTriangulation {
  /** `[p + 1]` where each polygon's triangles begin, counted in triangles. */
  readonly triangleStarts: Uint32Array;
  /** `[p + 1]` where each polygon's strips begin. */
  readonly polygonStrips: Uint32Array;
  /** With `skipInvalid`: what is wrong with each invalid polygon, by its `polygon`. */
  readonly errors: readonly SoapfilmError[];
}

/** What an edit of a PolygonSession changed. Its arrays may be views of one buffer, which is theirs alone. */
export interface PolygonEdit {
  /** The vertex inserted, moved or deleted. */
  readonly vertex: number;
  /** How many triangles there are now. */
  readonly triangleCount: number;
  /** `[c]` which of them are new, by increasing number; all others are as before. */
  readonly changed: Uint32Array;
  /** `[3c]` their vertices. */
  readonly triangles: Uint32Array;
}

/** What a PolygonSession holds. */
export interface PolygonState {
  /** `[2n]` by vertex; those of deleted vertices mean nothing. */
  readonly positions: Float64Array;
  /**
   * `[n]` the next vertex of each one's ring, with the polygon to the left; `0xffffffff` for isolated
   * vertices, and the vertex itself for deleted ones.
   */
  readonly next: Uint32Array;
  /** Strips, as those of `triangulatePolygon`. */
  readonly strips: Uint32Array;
  readonly stripStarts: Uint32Array;
  /** Whether triangles of the polygon and of its complement have been tested to be right, all anew. */
  readonly certified: boolean;
}

/** A GeoJSON object, as far as it matters here: those of `@types/geojson` are, and so are parsed ones. */
export interface GeoJSONLike {
  readonly type: string;
  readonly coordinates?: unknown;
  readonly geometry?: unknown;
  readonly geometries?: unknown;
  readonly features?: unknown;
  readonly properties?: unknown;
}

export interface GeoJSONTriangulation extends PolygonsTriangulation {
  /** `[2n]` the vertices of all polygons in their order in the input; altitudes are left out. */
  readonly positions: Float64Array;
  /** `[f + 1]` where each feature's polygons begin; a geometry alone is one feature. */
  readonly featureStarts: Uint32Array;
}

/**
 * What can be loaded by itself: `'loops'`, for `spanLoops`, is `loops.wasm`; `'polygons'`, for
 * `triangulatePolygon`, `triangulatePolygons`, `triangulateGeoJSON` and `PolygonSession`, is
 * `polygons.wasm`.
 */
export type Part = 'loops' | 'polygons';

/** A WebAssembly module, or where it is. */
export type WasmSource = URL | string | Response | BufferSource | WebAssembly.Module;

export interface LoadOptions {
  /** Which parts to fetch. Default: all, at the same time. */
  readonly parts?: readonly Part[];
  /**
   * Where to take the parts from; one source alone is for the first of `parts`. Default: beside the
   * library's own module.
   */
  readonly wasm?: WasmSource | Readonly<Partial<Record<Part, WasmSource>>>;
  /**
   * Whether to lend, with `borrow`, copies which the next call detaches, so that arrays that are used for
   * too long are empty at once, and not just in rare cases wrong. For tests; results are then no quicker to
   * get than one's own. Default: as it is, at first `false`. Workers lend nothing.
   */
  readonly checks?: boolean;
}
