import type { ErrorCode, ErrorPlace } from './errors.js';
import type { PointLike } from './types.js';

/** Numbers of a model. `null` stands for NaN, as JSON has it. */
export type ModelNumbers = readonly (number | null)[] | Float64Array | Float32Array;

/**
 * A NURBS curve. Its domain is `knots[degree]` to `knots[poles.length]`; it may be clamped there or not.
 */
export interface NurbsCurve {
  /** 1 to 25. */
  readonly degree: number;
  /** `[poles + degree + 1]` never falling, multiplicities expanded; inside the domain at most `degree` times the same. */
  readonly knots: ModelNumbers;
  /** `[x, y, z]` each in space, `[u, v]` each in the domain of a surface; not multiplied by weights. */
  readonly poles: readonly ModelNumbers[];
  /** `[poles]` positive. Default, and null: all 1. */
  readonly weights?: ModelNumbers | null;
  /** If given, what the knots say. */
  readonly domain?: ModelNumbers;
}

/** A NURBS surface, whose domain its knots give as those of a curve do. */
export interface NurbsSurface {
  /** 1 to 25. */
  readonly degreeU: number;
  readonly degreeV: number;
  /** `[countU + degreeU + 1]`, as for a curve. */
  readonly knotsU: ModelNumbers;
  readonly knotsV: ModelNumbers;
  readonly countU: number;
  readonly countV: number;
  /** `[countU · countV]` of `[x, y, z]`; that of iu and iv has the index iu · countV + iv. Not multiplied by weights. */
  readonly poles: readonly ModelNumbers[];
  /** In the order of the poles, positive. Default, and null: all 1. */
  readonly weights?: ModelNumbers | null;
  /** `[u0, u1, v0, v1]`: if given, what the knots say. */
  readonly domain?: ModelNumbers;
  /** Whether two sides coincide in space. The library finds that out by itself. */
  readonly closedU?: boolean;
  readonly closedV?: boolean;
}

/** An edge in a loop. */
export interface EdgeUse {
  /** The edge's `id`, or its index if edges have none. */
  readonly edge: number;
  /** Whether the loop runs from the end of the edge to its beginning. Default `false`. */
  readonly reversed?: boolean;
  /** Whether the loop uses the edge twice, on the two sides of the domain where the surface closes. Default `false`. */
  readonly seam?: boolean;
  /**
   * The edge in the surface's domain, by the same parameter as the edge. Default, and null: the nearest curve of the surface
   * to the edge's `curve3d`.
   */
  readonly pcurve?: NurbsCurve | null;
}

/** A closed loop of edges, each of which begins where the one before ends. */
export interface FaceLoop {
  readonly uses: readonly EdgeUse[];
}

/** A part of a surface, between loops of edges. */
export interface ModelFace {
  readonly id?: number;
  readonly surface: NurbsSurface;
  /** Whether the face's normal is -(Su × Sv). Default `false`. */
  readonly reversed?: boolean;
  /**
   * The index of the loop around the face; all others are holes. -1: all are holes, and the domain is around them.
   * Default: the first, or -1 if there are no loops.
   */
  readonly outer?: number;
  /** Default: none, and the face is all of the surface. Directions do not matter. */
  readonly loops?: readonly FaceLoop[];
}

/** An edge that faces share. It is sampled once for all of them, so that there are no cracks. */
export interface ModelEdge {
  /** Default: the edge's index in `edges`. All edges have one, or none has. */
  readonly id?: number;
  /** Whether all of it is one point, such as the pole of a sphere; `curve3d` is then null. Default `false`. */
  readonly degenerate?: boolean;
  /** How far the curves of the edge may be apart in space, besides 1e-5 of the model's size. Default 0. */
  readonly tolerance?: number;
  /** `[t0, t1]` the part of its curves that is the edge. */
  readonly range: ModelNumbers;
  /** The faces that use it. The library finds that out by itself. */
  readonly faces?: readonly number[];
  /** The edge in space. Default, and null: the edge is where the surface of its only use has the curve of that. */
  readonly curve3d?: NurbsCurve | null;
}

/** A model at a place of another. */
export interface ModelInstance {
  /** A model, or its name in `parts`. */
  readonly part: Model | string | number;
  /**
   * An affine map of space: the 12 numbers of a matrix of 3 rows and 4 columns, row by row; or 16 numbers of a matrix of 4 rows,
   * column by column, as three's `Matrix4.elements`. Default: the part stays where it is.
   */
  readonly matrix?: ArrayLike<number>;
}

/**
 * Trimmed surfaces that share edges: an object of the schema `trimmed-nurbs/1`. Models without `faces` and `edges` have none
 * besides those of their `instances`.
 *
 * Faces and edges are numbered by their index: first those of the model, then those of each instance in order.
 */
export interface Model {
  readonly schema?: string;
  readonly name?: string;
  readonly note?: string;
  /** The diagonal of the box around all poles. Not used. */
  readonly diag?: number;
  /** Whether every edge is used twice. Not used. */
  readonly closed?: boolean;
  readonly faces?: readonly ModelFace[];
  readonly edges?: readonly ModelEdge[];
  readonly instances?: readonly ModelInstance[];
  /** Models that instances name. Those that none names are not looked at. */
  readonly parts?: Readonly<Record<string, Model>> | readonly Model[];
}

/** One face with its edges. */
export interface Face extends ModelFace {
  /** Default: none, as for a face without loops. */
  readonly edges?: readonly ModelEdge[];
}

export interface TrimmedOptions {
  /**
   * Whether faces with faults are left out, and named in `reports`. Default `false`: the first fault is an error, which has the
   * `face` and, where they apply, `loop`, `use`, `otherLoop` and `edge`.
   */
  readonly skipInvalid?: boolean;
  /** Memory that the core may use for the model and each call. Default 3 GiB. */
  readonly maxMemoryBytes?: number;
}

/** The picture that a mesh is for. */
export interface SamplingCamera {
  readonly eye: PointLike;
  /** The product of the matrices of projection and view, 16 numbers column by column: clip space is -w to w in all three. */
  readonly viewProjection: ArrayLike<number>;
  /** Of the picture, in pixels. */
  readonly width: number;
  readonly height: number;
  /** Most distance of mesh and surface on the picture. Default 1. */
  readonly pixels?: number;
}

/** How fine a mesh is to be. */
export interface Sampling {
  /** Most distance of mesh and surface. With `relative`, the lesser of the two counts. Default: what `relative` says. */
  readonly tolerance?: number;
  /** The same as a share of the diagonal of the box around all poles. Default 1e-3, but with `tolerance` or `camera`: none. */
  readonly relative?: number;
  /** Most turn of the normal along an edge, in radians; Infinity: any. Default 0.35, with `camera`: any. */
  readonly angle?: number;
  /**
   * A picture that the mesh is for: where it shows the model, `pixels` count besides `tolerance`. What it does not show is as
   * coarse as can be.
   */
  readonly camera?: SamplingCamera;
  /** How long cells of the grid may be for their width; Infinity: any length, which gives fewest triangles. Default 3. */
  readonly aspect?: number;
  /** Most triangles: the tolerance is raised as far as needed, and `reports` say so. Default: any number. */
  readonly maxTriangles?: number;
  /** Seconds after which what there is is handed out; `reports` say so. Default: none. */
  readonly maxSeconds?: number;
  /** Memory that the core may use, the model included. Default: that of the model's options. */
  readonly maxMemoryBytes?: number;
  /** Called about every 30 ms with the share of the work done, and once at the end. What it throws ends the work. */
  readonly onProgress?: (fraction: number) => void;
}

/** What is to be told of a mesh. */
export type TessellationReport =
  /** A face has a fault and no triangles. `message` and the place say what is wrong. */
  | ({ readonly report: 'left-out'; readonly face: number; readonly code: ErrorCode; readonly message: string } & ErrorPlace)
  /** Samples of trimming curves crossed, though the curves do not: `count` intervals were halved, of a face or of all. */
  | { readonly report: 'crossing-samples'; readonly face?: number; readonly count: number }
  /** `maxTriangles` would have been exceeded: the `tolerance` kept to. */
  | { readonly report: 'tolerance-raised'; readonly tolerance: number }
  /** The face is farther off its surface than asked for, by this `deviation`. */
  | { readonly report: 'above-tolerance'; readonly face: number; readonly deviation: number }
  /** `maxSeconds` were over: the face is coarser than asked for; without `face`, all of the mesh may be. */
  | { readonly report: 'time-over'; readonly face?: number };

/**
 * The mesh of a model. Every face has vertices of its own, so that normals at creases are right; those of faces that share an
 * edge have the same positions along it, bit by bit.
 */
export interface Tessellation {
  /** `[3n]` relative to `origin`: single precision is good for places near it. */
  readonly positions: Float32Array;
  readonly origin: readonly [x: number, y: number, z: number];
  /** `[3n]` unit vectors, those of the surfaces. */
  readonly normals: Float32Array;
  /** `[2n]` parameters of the surfaces. */
  readonly uvs: Float32Array;
  /** `[3m]`, counter-clockwise seen from where normals point. */
  readonly triangles: Uint32Array;
  /** `[faces + 1]` where the triangles of each face begin, counted in triangles. */
  readonly faceStarts: Uint32Array;
  /** The vertices of triangle strips, one strip after the other. Every second triangle of a strip runs the other way. */
  readonly strips: Uint32Array;
  /** `[strips + 1]` */
  readonly stripStarts: Uint32Array;
  /** Vertices along each edge from its beginning to its end, of one of its faces, one edge after the other. Poles have none. */
  readonly edges: Uint32Array;
  /** `[edges + 1]`; edges that no face uses have no vertices. Faces without loops get edges, which follow those given. */
  readonly edgeStarts: Uint32Array;
  /** `[n]` for each vertex the first one at the same place: its own number, or that of a vertex of another face or of a seam. */
  readonly same: Uint32Array;
  /** Largest measured distance of mesh and surface. */
  readonly deviation: number;
  /** The tolerance kept to. */
  readonly tolerance: number;
  readonly reports: readonly TessellationReport[];
}

/** What an update has changed. */
export interface Change {
  /**
   * The whole mesh. Its positions, normals, uvs, triangles and strips are the same arrays from update to update, written where the
   * ranges say. Where they have to grow, they are new and longer, and the same but for the ranges. Now and then all is laid out
   * again, as at the first update: then the ranges are all of them.
   *
   * Faces have room to grow. What is left of it is filled with triangles of a single vertex, and strips of such, which are not
   * drawn; and with vertices that no triangle has. The vertices of a face that outgrows its room move behind all others.
   */
  readonly mesh: Tessellation;
  /** Pairs `[from, to)` of vertices, of elements of `triangles` and of elements of `strips` that were written. */
  readonly vertexRanges: Uint32Array;
  readonly indexRanges: Uint32Array;
  readonly stripRanges: Uint32Array;
  /** The faces that have other triangles now, or vertices at other places. */
  readonly faces: Uint32Array;
}
