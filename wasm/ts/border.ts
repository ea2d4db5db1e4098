// Made by wasm/scripts/border.mjs from wasm/include/soapfilm_tables.h, which says more: do not edit.

/** Hands over the array of that number of a result. */
export interface ArrayReader {
  (array: number, type: Float64ArrayConstructor): Float64Array;
  (array: number, type: Float32ArrayConstructor): Float32Array;
  (array: number, type: Uint32ArrayConstructor): Uint32Array;
}

/** What a call of the core ends with. */
export const Status = {
  /** done */
  Ok: 0,
  /** no triangulation in the candidate space: an answer, not an error */
  NotFound: 1,
  /** zero loops */
  NoLoops: 2,
  /** starts do not increase from 0 to n */
  BadStarts: 3,
  /** a coordinate is NaN or beyond 1e150 */
  NotFinite: 4,
  /** a loop has fewer than 3 vertices */
  TooFewVertices: 5,
  /** two vertices have the same position */
  RepeatedVertex: 6,
  /** two loop edges cross, touch or overlap */
  LoopsIntersect: 7,
  /** a boundary normal is zero, infinite or partly NaN */
  BadNormals: 8,
  /** a weight is negative or not finite, or all are zero */
  BadWeights: 9,
  /** a candidate has an index out of range, is repeated or degenerate, or has a weight that is not finite */
  BadCandidates: 10,
  /** the predicted size exceeds the memory limit */
  TooLarge: 11,
  /** the work reached the memory limit */
  OutOfMemory: 12,
  /** sf_host_progress asked to stop */
  Stopped: 13,
  /** a setting is out of its range */
  BadOption: 14,
  /** polygons: two edges of one ring cross or overlap */
  SelfIntersecting: 15,
  /** polygons: a hole is not inside the outer ring, or crosses it */
  HoleOutside: 16,
  /** polygons: two holes cross or have an edge in common */
  HolesOverlap: 17,
  /** polygons: a hole lies inside another */
  NestedHole: 18,
  /** polygons: a ring has fewer than 3 distinct points, or a spike */
  DegeneratePolygon: 19,
  /** meshes: a face has a vertex that is not there */
  BadMesh: 20,
  /** surfaces: a triangle keeps it from being manifold, oriented and bounded */
  BadSurface: 21,
  /** surfaces: not one normal for each boundary edge */
  BadNormalCount: 22,
} as const;

export interface Place {
  /** loop or ring of the first culprit */
  readonly loop: number;
  /** its vertex, counted in that loop; or the candidate's index */
  readonly vertex: number;
  /** loop of the second culprit, for pairs */
  readonly otherLoop: number;
  /** its vertex, counted in that loop */
  readonly otherVertex: number;
}

/** How many numbers of an array make one. */
export const kPlaceLength = 4;

/** The one that begins at index `at`. */
export const readPlace = (from: ArrayLike<number>, at = 0): Place => ({
  loop: from[at],
  vertex: from[at + 1],
  otherLoop: from[at + 2],
  otherVertex: from[at + 3],
});

export const kObjectiveChoices = ['sum', 'worst-dihedral'] as const;

export const kSpaceChoices = ['auto', 'all', 'delaunay', 'near', 'given'] as const;

export interface SpanSettings {
  /** per square unit; NaN: 1e-3 / squared bounding-box diagonal */
  readonly areaWeight: number;
  /** per unit of triangle perimeter */
  readonly perimeterWeight: number;
  /** per radian */
  readonly dihedralWeight: number;
  /** a choice of SF_OBJECTIVE_CHOICES */
  readonly objective: number;
  /** a choice of SF_SPACE_CHOICES */
  readonly space: number;
  /** memory limit */
  readonly maxBytes: number;
  /** 1: work that ends early returns the best so far, and sf_host_result gets each better surface; else 0 */
  readonly bestSoFar: number;
}

export const packSpanSettings = (settings: SpanSettings): Float64Array =>
  Float64Array.of(
    settings.areaWeight,
    settings.perimeterWeight,
    settings.dihedralWeight,
    settings.objective,
    settings.space,
    settings.maxBytes,
    settings.bestSoFar,
  );

export interface SpanArrays {
  /** [3n'] the input's vertices, then the inserted ones */
  readonly positions: Float64Array;
  /** [3m] */
  readonly triangles: Uint32Array;
  /** [m] indices of triangles in the order of splitting */
  readonly order: Uint32Array;
  /** [k+1] offsets into loopVertices */
  readonly starts: Uint32Array;
  /** [n'] the vertices along the result's loops */
  readonly loopVertices: Uint32Array;
  /** SpanNumbers: [1] */
  readonly numbers: Float64Array;
  /** InsertedPlace: [i] the loop edge that each inserted vertex is on */
  readonly insertedPlaces: Uint32Array;
  /** [i] how far along its edge each is, 0 to 1 */
  readonly insertedParameters: Float64Array;
}

export const readSpanArrays = (array: ArrayReader): SpanArrays => ({
  positions: array(0, Float64Array),
  triangles: array(1, Uint32Array),
  order: array(2, Uint32Array),
  starts: array(3, Uint32Array),
  loopVertices: array(4, Uint32Array),
  numbers: array(5, Float64Array),
  insertedPlaces: array(6, Uint32Array),
  insertedParameters: array(7, Float64Array),
});

export interface SpanNumbers {
  /** 1 if there is a surface, else 0 */
  readonly found: number;
  /** the choice of SF_SPACE_CHOICES that the answer comes from */
  readonly space: number;
  /** the objective's value */
  readonly cost: number;
  /** proven lower bound on the cost in that space */
  readonly lowerBound: number;
  /** 1 if the surface is proven to be the best, else 0 */
  readonly optimal: number;
  /** sum over triangles */
  readonly area: number;
  /** sum over triangles */
  readonly perimeter: number;
  /** sum of the angles between triangles, in radians */
  readonly dihedral: number;
  /** the largest of those angles */
  readonly worstDihedral: number;
  /** sum of the candidates' own weights */
  readonly own: number;
  /** candidate triangles */
  readonly candidates: number;
  /** domains solved or bounded; for a single loop, segments */
  readonly domains: number;
  /** minimal weak edge sets stored */
  readonly minimalSets: number;
  /** largest amount of memory held at once */
  readonly peakBytes: number;
}

/** How many numbers of an array make one. */
export const kSpanNumbersLength = 14;

/** The one that begins at index `at`. */
export const readSpanNumbers = (from: ArrayLike<number>, at = 0): SpanNumbers => ({
  found: from[at],
  space: from[at + 1],
  cost: from[at + 2],
  lowerBound: from[at + 3],
  optimal: from[at + 4],
  area: from[at + 5],
  perimeter: from[at + 6],
  dihedral: from[at + 7],
  worstDihedral: from[at + 8],
  own: from[at + 9],
  candidates: from[at + 10],
  domains: from[at + 11],
  minimalSets: from[at + 12],
  peakBytes: from[at + 13],
});

export interface InsertedPlace {
  /** input loop */
  readonly loop: number;
  /** the number in that loop of the vertex where the edge begins */
  readonly edge: number;
}

/** How many numbers of an array make one. */
export const kInsertedPlaceLength = 2;

/** The one that begins at index `at`. */
export const readInsertedPlace = (from: ArrayLike<number>, at = 0): InsertedPlace => ({
  loop: from[at],
  edge: from[at + 1],
});

export const kMethodChoices = ['flooding', 'trapezoids'] as const;

export const kRepairChoices = ['none', 'even-odd', 'nonzero'] as const;

export interface PolygonSettings {
  /** 2 or 3 */
  readonly dimension: number;
  /** a choice of SF_METHOD_CHOICES */
  readonly method: number;
  /** a choice of SF_REPAIR_CHOICES */
  readonly repair: number;
  /** 1 for Delaunay triangles, else 0 */
  readonly delaunay: number;
  /** 1 for strips as well, else 0 */
  readonly strips: number;
  /** 1 for a certificate, else 0 */
  readonly verify: number;
  /** 1 for the actions of flooding, else 0 */
  readonly trace: number;
  /** memory limit */
  readonly maxBytes: number;
}

export const packPolygonSettings = (settings: PolygonSettings): Float64Array =>
  Float64Array.of(
    settings.dimension,
    settings.method,
    settings.repair,
    settings.delaunay,
    settings.strips,
    settings.verify,
    settings.trace,
    settings.maxBytes,
  );

export interface PolygonArrays {
  /** [3m] counter-clockwise; in space, as the outer ring runs */
  readonly triangles: Uint32Array;
  /** [p+1] where each polygon's triangles begin, in triangles */
  readonly triangleStarts: Uint32Array;
  /** vertices of strips */
  readonly strips: Uint32Array;
  /** [s+1] where each strip begins in `strips` */
  readonly stripStarts: Uint32Array;
  /** [p+1] where each polygon's strips begin, in strips */
  readonly polygonStrips: Uint32Array;
  /** [dimension * a] points that repair added, numbered after all others */
  readonly added: Float64Array;
  /** [2a] the two edges that each added point is on, by their first vertices */
  readonly addedOn: Uint32Array;
  /** FloodStep: [t] actions of flooding */
  readonly trace: Uint32Array;
  /** PolygonFault: [f] the invalid polygons, in order */
  readonly faults: Uint32Array;
  /** [dimension * f] the point of each fault, or NaN */
  readonly faultPoints: Float64Array;
}

export const readPolygonArrays = (array: ArrayReader): PolygonArrays => ({
  triangles: array(0, Uint32Array),
  triangleStarts: array(1, Uint32Array),
  strips: array(2, Uint32Array),
  stripStarts: array(3, Uint32Array),
  polygonStrips: array(4, Uint32Array),
  added: array(5, Float64Array),
  addedOn: array(6, Uint32Array),
  trace: array(7, Uint32Array),
  faults: array(8, Uint32Array),
  faultPoints: array(9, Float64Array),
});

export const kFloodActionChoices = ['start', 'raise', 'fill', 'bridge', 'spill', 'jump'] as const;

export interface FloodStep {
  /** a choice of SF_FLOOD_ACTION_CHOICES */
  readonly action: number;
  /** the vertex at one end of the active chain after the action */
  readonly left: number;
  /** the vertex at its other end */
  readonly right: number;
  /** how many triangles there are after the action */
  readonly triangles: number;
}

/** How many numbers of an array make one. */
export const kFloodStepLength = 4;

/** The one that begins at index `at`. */
export const readFloodStep = (from: ArrayLike<number>, at = 0): FloodStep => ({
  action: from[at],
  left: from[at + 1],
  right: from[at + 2],
  triangles: from[at + 3],
});

export interface PolygonFault {
  /** the polygon's number */
  readonly polygon: number;
  /** one of SF_STATUSES */
  readonly status: number;
  /** this and the rest as in SfPlace, with rings counted in the polygon */
  readonly loop: number;
  readonly vertex: number;
  readonly otherLoop: number;
  readonly otherVertex: number;
}

/** How many numbers of an array make one. */
export const kPolygonFaultLength = 6;

/** The one that begins at index `at`. */
export const readPolygonFault = (from: ArrayLike<number>, at = 0): PolygonFault => ({
  polygon: from[at],
  status: from[at + 1],
  loop: from[at + 2],
  vertex: from[at + 3],
  otherLoop: from[at + 4],
  otherVertex: from[at + 5],
});

export interface OpenedArrays {
  /** [1] the session's number */
  readonly session: Uint32Array;
  /** [3m] */
  readonly triangles: Uint32Array;
}

export const readOpenedArrays = (array: ArrayReader): OpenedArrays => ({
  session: array(0, Uint32Array),
  triangles: array(1, Uint32Array),
});

export const kEditActionChoices = ['insert', 'insert-isolated', 'delete', 'move'] as const;

export interface EditArrays {
  /** SfEditFacts; then [c] numbers of new triangles, increasing; then [3c] their corners */
  readonly edit: Uint32Array;
}

export const readEditArrays = (array: ArrayReader): EditArrays => ({
  edit: array(0, Uint32Array),
});

export interface EditFacts {
  /** the edited vertex's number */
  readonly vertex: number;
  /** how many triangles there are now */
  readonly triangleCount: number;
  /** the status of the edit itself, one of SF_STATUSES */
  readonly status: number;
  /** this and the rest as in SfPlace, but with vertices of the session */
  readonly loop: number;
  /** the first vertex at fault */
  readonly atVertex: number;
  readonly otherLoop: number;
  readonly otherVertex: number;
}

/** How many numbers of an array make one. */
export const kEditFactsLength = 7;

/** The one that begins at index `at`. */
export const readEditFacts = (from: ArrayLike<number>, at = 0): EditFacts => ({
  vertex: from[at],
  triangleCount: from[at + 1],
  status: from[at + 2],
  loop: from[at + 3],
  atVertex: from[at + 4],
  otherLoop: from[at + 5],
  otherVertex: from[at + 6],
});

export interface StateArrays {
  /** [2n] by vertex; those of unused numbers mean nothing */
  readonly positions: Float64Array;
  /** [n] the next vertex of the ring; 0xFFFFFFFF for an isolated vertex, its own number if that is unused */
  readonly next: Uint32Array;
  /** vertices of strips */
  readonly strips: Uint32Array;
  /** [s+1] where each strip begins in `strips` */
  readonly stripStarts: Uint32Array;
  /** [1] 1 if the whole polygon passes the certificate, tested from scratch; else 0 */
  readonly certified: Uint32Array;
}

export const readStateArrays = (array: ArrayReader): StateArrays => ({
  positions: array(0, Float64Array),
  next: array(1, Uint32Array),
  strips: array(2, Uint32Array),
  stripStarts: array(3, Uint32Array),
  certified: array(4, Uint32Array),
});

export interface HolesArrays {
  /** [k+1] where the vertices of each loop begin */
  readonly loopStarts: Uint32Array;
  /** the vertices of all loops, as faces that fill the hole run */
  readonly loopVertices: Uint32Array;
  /** LoopFacts: [k] */
  readonly loopFacts: Float64Array;
  /** [g+1] where the loops of each group begin */
  readonly groupStarts: Uint32Array;
  /** [k] the loops of all groups, the outer rim first */
  readonly groupLoops: Uint32Array;
  /** GroupFacts: [g] */
  readonly groupFacts: Float64Array;
  /** [1] the session's number, if the mesh is kept */
  readonly session: Uint32Array;
  /** DefectCounts: [d] what is wrong with the mesh, a kind at most once */
  readonly defects: Uint32Array;
  /** for each defect its faces, its edges as pairs, its vertices */
  readonly defectPlaces: Uint32Array;
}

export const readHolesArrays = (array: ArrayReader): HolesArrays => ({
  loopStarts: array(0, Uint32Array),
  loopVertices: array(1, Uint32Array),
  loopFacts: array(2, Float64Array),
  groupStarts: array(3, Uint32Array),
  groupLoops: array(4, Uint32Array),
  groupFacts: array(5, Float64Array),
  session: array(6, Uint32Array),
  defects: array(7, Uint32Array),
  defectPlaces: array(8, Uint32Array),
});

export interface LoopFacts {
  /** of the loop */
  readonly length: number;
  /** the largest distance in it */
  readonly diameter: number;
  /** share of its length, facing nothing */
  readonly openness: number;
  /** number of the component of the faces along it */
  readonly component: number;
  /** 1 if most of it runs along edges of loops at the same places, with other vertices */
  readonly isSeam: number;
}

/** How many numbers of an array make one. */
export const kLoopFactsLength = 5;

/** The one that begins at index `at`. */
export const readLoopFacts = (from: ArrayLike<number>, at = 0): LoopFacts => ({
  length: from[at],
  diameter: from[at + 1],
  openness: from[at + 2],
  component: from[at + 3],
  isSeam: from[at + 4],
});

export const kGroupKindChoices = ['alone', 'island', 'band'] as const;

export interface GroupFacts {
  /** a choice of SF_GROUP_KIND_CHOICES */
  readonly kind: number;
  /** the least vote that it hangs by */
  readonly score: number;
  /** 1 if it is meant to be open, else 0 */
  readonly isOpenRim: number;
}

/** How many numbers of an array make one. */
export const kGroupFactsLength = 3;

/** The one that begins at index `at`. */
export const readGroupFacts = (from: ArrayLike<number>, at = 0): GroupFacts => ({
  kind: from[at],
  score: from[at + 1],
  isOpenRim: from[at + 2],
});

export const kDefectKindChoices = ['non-manifold-edge', 'non-manifold-vertex', 'flipped', 'duplicate-face', 'degenerate-face', 'not-orientable', 'unused-vertex'] as const;

export interface DefectCounts {
  /** a choice of SF_DEFECT_KIND_CHOICES */
  readonly kind: number;
  /** how many numbers of `defectPlaces` are faces */
  readonly faces: number;
  /** how many are of edges, two for each */
  readonly edges: number;
  /** how many are vertices */
  readonly vertices: number;
}

/** How many numbers of an array make one. */
export const kDefectCountsLength = 4;

/** The one that begins at index `at`. */
export const readDefectCounts = (from: ArrayLike<number>, at = 0): DefectCounts => ({
  kind: from[at],
  faces: from[at + 1],
  edges: from[at + 2],
  vertices: from[at + 3],
});

export interface WeldArrays {
  /** [3w] of the first vertex of each place, in the input's order */
  readonly positions: Float64Array;
  /** [3m] the input's faces */
  readonly faces: Uint32Array;
  /** [n] the new number of each vertex */
  readonly vertexMap: Uint32Array;
}

export const readWeldArrays = (array: ArrayReader): WeldArrays => ({
  positions: array(0, Float64Array),
  faces: array(1, Uint32Array),
  vertexMap: array(2, Uint32Array),
});

export interface CrossingsArrays {
  /** [2p] faces that intersect, the smaller first; at most some 10 000 pairs */
  readonly pairs: Uint32Array;
}

export const readCrossingsArrays = (array: ArrayReader): CrossingsArrays => ({
  pairs: array(0, Uint32Array),
});

export interface CarryArrays {
  /** [size * f] of the f vertices that are not fixed */
  readonly values: Float64Array;
}

export const readCarryArrays = (array: ArrayReader): CarryArrays => ({
  values: array(0, Float64Array),
});

export const kFairingChoices = ['none', 'bending', 'curvature', 'auto'] as const;

export interface PatchSettings {
  /** per square unit; NaN: as in SF_SPAN_SETTINGS */
  readonly areaWeight: number;
  /** per unit of triangle perimeter */
  readonly perimeterWeight: number;
  /** per radian */
  readonly dihedralWeight: number;
  /** a choice of SF_SPACE_CHOICES, but not Given */
  readonly space: number;
  /** a choice of SF_FAIRING_CHOICES */
  readonly fairing: number;
  /** how much denser than its surroundings the patch is; 0: as spanned */
  readonly density: number;
  /** most vertices that refining adds */
  readonly maxNewVertices: number;
  /** edges between faces that differ by more, in radians, go on through the hole; 0: none do */
  readonly crease: number;
  /** 1 if coordinates of new vertices are rounded to single precision, else 0 */
  readonly inFloats: number;
  /** after which the hole is given up, or left as it is; or infinity */
  readonly maxSeconds: number;
}

export const packPatchSettings = (settings: PatchSettings): Float64Array =>
  Float64Array.of(
    settings.areaWeight,
    settings.perimeterWeight,
    settings.dihedralWeight,
    settings.space,
    settings.fairing,
    settings.density,
    settings.maxNewVertices,
    settings.crease,
    settings.inFloats,
    settings.maxSeconds,
  );

export const kFillStatusChoices = ['filled', 'self-intersecting', 'failed'] as const;

export const kFillReasonChoices = ['none', 'no-surface', 'rims-intersect', 'repeated-vertex', 'duplicate-face', 'too-large', 'inserted-vertices', 'stitched', 'opposed-rims', 'time-limit'] as const;

export interface FillArrays {
  /** [3a] the vertices of all patches, numbered from n on */
  readonly positions: Float64Array;
  /** [3b] the faces of all patches */
  readonly faces: Uint32Array;
  /** FilledFacts: [g] by groups */
  readonly holes: Float64Array;
  /** [2p] by groups: faces of the filled mesh that intersect, but for those of two patches */
  readonly pairs: Uint32Array;
  /** RimSplit: vertices to be put on rims, for holes that failed with InsertedVertices */
  readonly splits: Uint32Array;
  /** for each split: at (1 - parameter) tail + parameter head */
  readonly splitParameters: Float64Array;
}

export const readFillArrays = (array: ArrayReader): FillArrays => ({
  positions: array(0, Float64Array),
  faces: array(1, Uint32Array),
  holes: array(2, Float64Array),
  pairs: array(3, Uint32Array),
  splits: array(4, Uint32Array),
  splitParameters: array(5, Float64Array),
});

export interface RimSplit {
  /** the face along the rim */
  readonly face: number;
  /** the ends of the edge */
  readonly tail: number;
  readonly head: number;
}

/** How many numbers of an array make one. */
export const kRimSplitLength = 3;

/** The one that begins at index `at`. */
export const readRimSplit = (from: ArrayLike<number>, at = 0): RimSplit => ({
  face: from[at],
  tail: from[at + 1],
  head: from[at + 2],
});

export interface FilledFacts {
  /** a choice of SF_FILL_STATUS_CHOICES */
  readonly status: number;
  /** a choice of SF_FILL_REASON_CHOICES */
  readonly reason: number;
  /** of the surface before it was refined */
  readonly cost: number;
  /** proven, on that cost */
  readonly lowerBound: number;
  /** 1 if that surface is proven to be the best, else 0 */
  readonly optimal: number;
  /** radians: mean angle along the rim, before refining */
  readonly rimAngleBefore: number;
  /** the same after fairing */
  readonly rimAngleAfter: number;
  /** the order of the fairing, 0 if there was none */
  readonly fairnessUsed: number;
  /** share of the fairing that was taken back */
  readonly movedLess: number;
  /** its first face in the filled mesh */
  readonly firstFace: number;
  /** the one after its last */
  readonly endFace: number;
  /** how many pairs of faces intersect */
  readonly pairs: number;
  /** how many vertices are to be put on its rims */
  readonly splits: number;
}

/** How many numbers of an array make one. */
export const kFilledFactsLength = 13;

/** The one that begins at index `at`. */
export const readFilledFacts = (from: ArrayLike<number>, at = 0): FilledFacts => ({
  status: from[at],
  reason: from[at + 1],
  cost: from[at + 2],
  lowerBound: from[at + 3],
  optimal: from[at + 4],
  rimAngleBefore: from[at + 5],
  rimAngleAfter: from[at + 6],
  fairnessUsed: from[at + 7],
  movedLess: from[at + 8],
  firstFace: from[at + 9],
  endFace: from[at + 10],
  pairs: from[at + 11],
  splits: from[at + 12],
});

export const kSurfaceKindChoices = ['soap-film', 'thin-plate', 'curvature'] as const;

export interface SmoothSettings {
  /** a choice of SF_SURFACE_KIND_CHOICES */
  readonly kind: number;
  /** how much denser than its boundary the surface is; 0: as it is */
  readonly density: number;
  /** most vertices that refining adds */
  readonly maxNewVertices: number;
  /** memory limit */
  readonly maxBytes: number;
}

export const packSmoothSettings = (settings: SmoothSettings): Float64Array =>
  Float64Array.of(
    settings.kind,
    settings.density,
    settings.maxNewVertices,
    settings.maxBytes,
  );

export interface SmoothArrays {
  /** [3n] the vertices that stayed as given, then all others */
  readonly positions: Float64Array;
  /** [3m] wound as given */
  readonly triangles: Uint32Array;
  /** [b] the numbers that the first b vertices had */
  readonly boundary: Uint32Array;
  /** [f] the numbers that the next f vertices had */
  readonly fixed: Uint32Array;
  /** vertices where no film exists */
  readonly collapsed: Uint32Array;
  /** SmoothNumbers: [1] */
  readonly numbers: Float64Array;
}

export const readSmoothArrays = (array: ArrayReader): SmoothArrays => ({
  positions: array(0, Float64Array),
  triangles: array(1, Uint32Array),
  boundary: array(2, Uint32Array),
  fixed: array(3, Uint32Array),
  collapsed: array(4, Uint32Array),
  numbers: array(5, Float64Array),
});

export interface SmoothNumbers {
  /** of the surface */
  readonly area: number;
  /** 1 if a further step of a film would move nothing, else 0 */
  readonly isMinimal: number;
}

/** How many numbers of an array make one. */
export const kSmoothNumbersLength = 2;

/** The one that begins at index `at`. */
export const readSmoothNumbers = (from: ArrayLike<number>, at = 0): SmoothNumbers => ({
  area: from[at],
  isMinimal: from[at + 1],
});

export const kSurfaceFaultChoices = ['bad-knots', 'bad-weights', 'not-finite', 'bad-edge', 'bad-domain', 'trim-outside', 'trim-open', 'edge-apart', 'trim-self-intersects', 'trims-cross', 'hole-outside', 'degenerate'] as const;

export interface FaceFault {
  /** a choice of SF_SURFACE_FAULT_CHOICES */
  readonly fault: number;
  /** the face */
  readonly face: number;
  /** its loop, or 0xFFFFFFFF */
  readonly loop: number;
  /** the use in this loop, or 0xFFFFFFFF */
  readonly use: number;
  /** the other loop of two that cross, or 0xFFFFFFFF */
  readonly otherLoop: number;
  /** the edge, or 0xFFFFFFFF */
  readonly edge: number;
}

/** How many numbers of an array make one. */
export const kFaceFaultLength = 6;

/** The one that begins at index `at`. */
export const readFaceFault = (from: ArrayLike<number>, at = 0): FaceFault => ({
  fault: from[at],
  face: from[at + 1],
  loop: from[at + 2],
  use: from[at + 3],
  otherLoop: from[at + 4],
  edge: from[at + 5],
});

export interface SurfacesArrays {
  /** [1] the number of the session */
  readonly session: Uint32Array;
  /** FaceFault: [f] the faces that are left out, in order */
  readonly faults: Uint32Array;
  /** [6] least and greatest corner around all faces left in */
  readonly box: Float64Array;
}

export const readSurfacesArrays = (array: ArrayReader): SurfacesArrays => ({
  session: array(0, Uint32Array),
  faults: array(1, Uint32Array),
  box: array(2, Float64Array),
});

export interface SamplingSettings {
  /** most distance of mesh and surface, positive */
  readonly tolerance: number;
  /** most turn of the normal along an edge in radians, up to pi; more: none */
  readonly angle: number;
  /** how long cells may be for their width, from 1 on; infinity: any length */
  readonly aspect: number;
  /** most triangles; infinity: any number */
  readonly maxTriangles: number;
  /** time after which what there is is handed out; infinity: any time */
  readonly maxSeconds: number;
  /** 1 if what follows counts, else 0 */
  readonly hasCamera: number;
  readonly eyeX: number;
  readonly eyeY: number;
  readonly eyeZ: number;
  /** view and projection, column by column */
  readonly m0: number;
  readonly m1: number;
  readonly m2: number;
  readonly m3: number;
  readonly m4: number;
  readonly m5: number;
  readonly m6: number;
  readonly m7: number;
  readonly m8: number;
  readonly m9: number;
  readonly m10: number;
  readonly m11: number;
  readonly m12: number;
  readonly m13: number;
  readonly m14: number;
  readonly m15: number;
  /** of the picture in pixels */
  readonly width: number;
  readonly height: number;
  /** most distance of mesh and surface on the picture, positive */
  readonly pixels: number;
}

export const packSamplingSettings = (settings: SamplingSettings): Float64Array =>
  Float64Array.of(
    settings.tolerance,
    settings.angle,
    settings.aspect,
    settings.maxTriangles,
    settings.maxSeconds,
    settings.hasCamera,
    settings.eyeX,
    settings.eyeY,
    settings.eyeZ,
    settings.m0,
    settings.m1,
    settings.m2,
    settings.m3,
    settings.m4,
    settings.m5,
    settings.m6,
    settings.m7,
    settings.m8,
    settings.m9,
    settings.m10,
    settings.m11,
    settings.m12,
    settings.m13,
    settings.m14,
    settings.m15,
    settings.width,
    settings.height,
    settings.pixels,
  );

export const kSurfaceReportChoices = ['left-out', 'crossing-samples', 'tolerance-raised', 'above-tolerance', 'time-over'] as const;

export interface SurfaceReport {
  /** a choice of SF_SURFACE_REPORT_CHOICES */
  readonly report: number;
  /** the face, or -1 */
  readonly face: number;
  /** of a face left out: a choice of SF_SURFACE_FAULT_CHOICES, else -1 */
  readonly fault: number;
  /** how many intervals were halved; the tolerance kept to; the deviation; or 0 */
  readonly value: number;
}

/** How many numbers of an array make one. */
export const kSurfaceReportLength = 4;

/** The one that begins at index `at`. */
export const readSurfaceReport = (from: ArrayLike<number>, at = 0): SurfaceReport => ({
  report: from[at],
  face: from[at + 1],
  fault: from[at + 2],
  value: from[at + 3],
});

export interface TessellationNumbers {
  /** what positions are relative to */
  readonly originX: number;
  readonly originY: number;
  readonly originZ: number;
  /** largest distance of mesh and surface measured */
  readonly deviation: number;
  /** the tolerance kept to */
  readonly tolerance: number;
}

/** How many numbers of an array make one. */
export const kTessellationNumbersLength = 5;

/** The one that begins at index `at`. */
export const readTessellationNumbers = (from: ArrayLike<number>, at = 0): TessellationNumbers => ({
  originX: from[at],
  originY: from[at + 1],
  originZ: from[at + 2],
  deviation: from[at + 3],
  tolerance: from[at + 4],
});

export interface TessellationArrays {
  /** [3n] relative to the origin */
  readonly positions: Float32Array;
  /** [3n] unit */
  readonly normals: Float32Array;
  /** [2n] parameters of the surface */
  readonly uvs: Float32Array;
  /** [3m] counter-clockwise seen from where normals point */
  readonly triangles: Uint32Array;
  /** [f+1] in triangles */
  readonly faceStarts: Uint32Array;
  /** vertices of strips, in the order of OpenGL */
  readonly strips: Uint32Array;
  /** [s+1] */
  readonly stripStarts: Uint32Array;
  /** vertices along each edge, of one of its faces */
  readonly edges: Uint32Array;
  /** [e+1] */
  readonly edgeStarts: Uint32Array;
  /** [n] the first vertex at the same place */
  readonly same: Uint32Array;
  /** SurfaceReport: [r] what is to be told */
  readonly reports: Float64Array;
  /** TessellationNumbers: [1] */
  readonly numbers: Float64Array;
}

export const readTessellationArrays = (array: ArrayReader): TessellationArrays => ({
  positions: array(0, Float32Array),
  normals: array(1, Float32Array),
  uvs: array(2, Float32Array),
  triangles: array(3, Uint32Array),
  faceStarts: array(4, Uint32Array),
  strips: array(5, Uint32Array),
  stripStarts: array(6, Uint32Array),
  edges: array(7, Uint32Array),
  edgeStarts: array(8, Uint32Array),
  same: array(9, Uint32Array),
  reports: array(10, Float64Array),
  numbers: array(11, Float64Array),
});

export interface ChangeArrays {
  /** [2a] from, to: vertices that are written */
  readonly vertexRanges: Uint32Array;
  /** of these vertices */
  readonly positions: Float32Array;
  /** of these vertices */
  readonly normals: Float32Array;
  /** of these vertices */
  readonly uvs: Float32Array;
  /** [2b] from, to: elements of the triangles' array that are written */
  readonly indexRanges: Uint32Array;
  /** these elements */
  readonly triangles: Uint32Array;
  /** [2c] from, to: elements of the strips' array that are written */
  readonly stripRanges: Uint32Array;
  /** these elements */
  readonly strips: Uint32Array;
  /** the faces that have changed */
  readonly faces: Uint32Array;
  /** [3] numbers of vertices, of elements of triangles and of strips */
  readonly sizes: Uint32Array;
  /** [f+1] in triangles */
  readonly faceStarts: Uint32Array;
  /** [s+1] */
  readonly stripStarts: Uint32Array;
  /** vertices along each edge, of one of its faces */
  readonly edges: Uint32Array;
  /** [e+1] */
  readonly edgeStarts: Uint32Array;
  /** [n] the first vertex at the same place */
  readonly same: Uint32Array;
  /** SurfaceReport: [r] what is to be told */
  readonly reports: Float64Array;
  /** TessellationNumbers: [1] */
  readonly numbers: Float64Array;
}

export const readChangeArrays = (array: ArrayReader): ChangeArrays => ({
  vertexRanges: array(0, Uint32Array),
  positions: array(1, Float32Array),
  normals: array(2, Float32Array),
  uvs: array(3, Float32Array),
  indexRanges: array(4, Uint32Array),
  triangles: array(5, Uint32Array),
  stripRanges: array(6, Uint32Array),
  strips: array(7, Uint32Array),
  faces: array(8, Uint32Array),
  sizes: array(9, Uint32Array),
  faceStarts: array(10, Uint32Array),
  stripStarts: array(11, Uint32Array),
  edges: array(12, Uint32Array),
  edgeStarts: array(13, Uint32Array),
  same: array(14, Uint32Array),
  reports: array(15, Float64Array),
  numbers: array(16, Float64Array),
});

export interface MoveArrays {
  /** FaceFault: [0 or 1] why it is refused */
  readonly faults: Uint32Array;
}

export const readMoveArrays = (array: ArrayReader): MoveArrays => ({
  faults: array(0, Uint32Array),
});
