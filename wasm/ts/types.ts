/** k closed loops over n vertices. Loop c owns the vertices `starts[c]` to `starts[c + 1] - 1`. */
export interface LoopSet {
  /** `[3n]` xyz, one length unit. */
  readonly positions: Float64Array;
  /** `[k + 1]`, first 0, increasing, last n. */
  readonly starts: Uint32Array;
}

/** A point as a triple. */
export type Point = readonly [x: number, y: number, z: number];

/** Loops in either form: flat arrays, or one array of points a loop. */
export type LoopsLike = LoopSet | readonly (readonly Point[])[];

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
 * Called while a span is computed, every 30 ms or so, and once when a surface has been found.
 * @param fraction share of the work done, 0 to 1, never falling
 * @param bestCost cost of the best surface so far, `Infinity` while there is none
 * @param lowerBound proven lower bound on the optimal cost, 0 at first
 */
export type ProgressListener = (fraction: number, bestCost: number, lowerBound: number) => void;

export interface SpanOptions {
  /** Default: dihedral 1 and area 1e-3 / (bounding-box diagonal)², which settles flat ties. */
  readonly weights?: Weights;
  /** `'sum'` (default), or the least largest angle, ties settled by the weighted sum. */
  readonly objective?: 'sum' | 'worst-dihedral';
  /**
   * Triangles that the surface may use. `'auto'` (default): all triples while their predicted cost
   * is small, else the Delaunay facets, then wider spaces where that holds no triangulation.
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
   * until then: `optimal: false`, and `cost` and `lowerBound` tell how far from the optimum it can be
   * at most. Surfaces are then looked for first, which takes some hundredths of a second; the error of
   * the limit comes only if there is none yet. Default `false`.
   */
  readonly bestSoFar?: boolean;
  /** With `bestSoFar`: called with every surface that is better than the one before. */
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

export interface LoadOptions {
  /** Where to take `core.wasm` from. Default: beside the library's own module. */
  readonly wasm?: URL | string | Response | BufferSource | WebAssembly.Module;
}
