// The numbers and names that cross the C ABI, each written once. The preprocessor makes the core's side from
// these tables (soapfilm.h), and wasm/scripts/border.mjs makes the runtime's (wasm/ts/border.ts).
//
// A table is a macro that expands X for each of its entries, in order:
//   SF_STATUSES     X(name, value, meaning)
//   ..._CHOICES     X(name, value, its name in TypeScript)
//   ..._SETTINGS    X(type, name, meaning): a struct that goes in
//   ..._RECORD      X(type, name, meaning): a struct that comes out, all fields of one type
//   ..._ARRAYS      X(type, name, meaning): the arrays of a result; structs as their fields in order
#ifndef SOAPFILM_TABLES_H
#define SOAPFILM_TABLES_H

/* How a call ends. Only Ok and NotFound come with a result. */
#define SF_STATUSES(X)                                                                         \
  X(Ok, 0, "done")                                                                             \
  X(NotFound, 1, "no triangulation in the candidate space: an answer, not an error")           \
  X(NoLoops, 2, "zero loops")                                                                  \
  X(BadStarts, 3, "starts do not increase from 0 to n")                                        \
  X(NotFinite, 4, "a coordinate is NaN or beyond 1e150")                                       \
  X(TooFewVertices, 5, "a loop has fewer than 3 vertices")                                     \
  X(RepeatedVertex, 6, "two vertices have the same position")                                  \
  X(LoopsIntersect, 7, "two loop edges cross, touch or overlap")                               \
  X(BadNormals, 8, "a boundary normal is zero, infinite or partly NaN")                        \
  X(BadWeights, 9, "a weight is negative or not finite, or all are zero")                      \
  X(BadCandidates, 10,                                                                         \
    "a candidate has an index out of range, is repeated or degenerate, "                       \
    "or has a weight that is not finite")                                                      \
  X(TooLarge, 11, "the predicted size exceeds the memory limit")                               \
  X(OutOfMemory, 12, "the work reached the memory limit")                                      \
  X(Stopped, 13, "sf_host_progress asked to stop")                                             \
  X(BadOption, 14, "a setting is out of its range")                                            \
  X(SelfIntersecting, 15, "polygons: two edges of one ring cross or overlap")                  \
  X(HoleOutside, 16, "polygons: a hole is not inside the outer ring, or crosses it")           \
  X(HolesOverlap, 17, "polygons: two holes cross or have an edge in common")                   \
  X(NestedHole, 18, "polygons: a hole lies inside another")                                    \
  X(DegeneratePolygon, 19, "polygons: a ring has fewer than 3 distinct points, or a spike")    \
  X(BadMesh, 20, "meshes: a face has a vertex that is not there")                              \
  X(BadSurface, 21, "surfaces: a triangle keeps it from being manifold, oriented and bounded") \
  X(BadNormalCount, 22, "surfaces: not one normal for each boundary edge")

/* The place in the input that a status is about. A field that does not apply is 0xFFFFFFFF. */
#define SF_PLACE_RECORD(X)                                                          \
  X(uint32_t, loop, "loop or ring of the first culprit")                            \
  X(uint32_t, vertex, "its vertex, counted in that loop; or the candidate's index") \
  X(uint32_t, otherLoop, "loop of the second culprit, for pairs")                   \
  X(uint32_t, otherVertex, "its vertex, counted in that loop")

/* sf_span_loops */

#define SF_OBJECTIVE_CHOICES(X) \
  X(Sum, 0, "sum")              \
  X(WorstDihedral, 1, "worst-dihedral")

#define SF_SPACE_CHOICES(X)  \
  X(Auto, 0, "auto")         \
  X(All, 1, "all")           \
  X(Delaunay, 2, "delaunay") \
  X(Near, 3, "near")         \
  X(Given, 4, "given")

#define SF_SPAN_SETTINGS(X)                                                           \
  X(double, areaWeight, "per square unit; NaN: 1e-3 / squared bounding-box diagonal") \
  X(double, perimeterWeight, "per unit of triangle perimeter")                        \
  X(double, dihedralWeight, "per radian")                                             \
  X(double, objective, "a choice of SF_OBJECTIVE_CHOICES")                            \
  X(double, space, "a choice of SF_SPACE_CHOICES")                                    \
  X(double, maxBytes, "memory limit")                                                 \
  X(double, bestSoFar,                                                                \
    "1: work that ends early returns the best so far, and "                           \
    "sf_host_result gets each better surface; else 0")

#define SF_SPAN_ARRAYS(X)                                                                 \
  X(double, positions, "[3n'] the input's vertices, then the inserted ones")              \
  X(uint32_t, triangles, "[3m]")                                                          \
  X(uint32_t, order, "[m] indices of triangles in the order of splitting")                \
  X(uint32_t, starts, "[k+1] offsets into loopVertices")                                  \
  X(uint32_t, loopVertices, "[n'] the vertices along the result's loops")                 \
  X(SfSpanNumbers, numbers, "[1]")                                                        \
  X(SfInsertedPlace, insertedPlaces, "[i] the loop edge that each inserted vertex is on") \
  X(double, insertedParameters, "[i] how far along its edge each is, 0 to 1")

#define SF_SPAN_NUMBERS_RECORD(X)                                               \
  X(double, found, "1 if there is a surface, else 0")                           \
  X(double, space, "the choice of SF_SPACE_CHOICES that the answer comes from") \
  X(double, cost, "the objective's value")                                      \
  X(double, lowerBound, "proven lower bound on the cost in that space")         \
  X(double, optimal, "1 if the surface is proven to be the best, else 0")       \
  X(double, area, "sum over triangles")                                         \
  X(double, perimeter, "sum over triangles")                                    \
  X(double, dihedral, "sum of the angles between triangles, in radians")        \
  X(double, worstDihedral, "the largest of those angles")                       \
  X(double, own, "sum of the candidates' own weights")                          \
  X(double, candidates, "candidate triangles")                                  \
  X(double, domains, "domains solved or bounded; for a single loop, segments")  \
  X(double, minimalSets, "minimal weak edge sets stored")                       \
  X(double, peakBytes, "largest amount of memory held at once")

#define SF_INSERTED_PLACE_RECORD(X) \
  X(uint32_t, loop, "input loop")   \
  X(uint32_t, edge, "the number in that loop of the vertex where the edge begins")

/* sf_triangulate_polygons */

#define SF_METHOD_CHOICES(X) \
  X(Flooding, 0, "flooding") \
  X(Trapezoids, 1, "trapezoids")

#define SF_REPAIR_CHOICES(X) \
  X(None, 0, "none")         \
  X(EvenOdd, 1, "even-odd")  \
  X(NonZero, 2, "nonzero")

#define SF_POLYGON_SETTINGS(X)                              \
  X(double, dimension, "2 or 3")                            \
  X(double, method, "a choice of SF_METHOD_CHOICES")        \
  X(double, repair, "a choice of SF_REPAIR_CHOICES")        \
  X(double, delaunay, "1 for Delaunay triangles, else 0")   \
  X(double, strips, "1 for strips as well, else 0")         \
  X(double, verify, "1 for a certificate, else 0")          \
  X(double, trace, "1 for the actions of flooding, else 0") \
  X(double, maxBytes, "memory limit")

#define SF_POLYGON_ARRAYS(X)                                                                      \
  X(uint32_t, triangles, "[3m] counter-clockwise; in space, as the outer ring runs")              \
  X(uint32_t, triangleStarts, "[p+1] where each polygon's triangles begin, in triangles")         \
  X(uint32_t, strips, "vertices of strips")                                                       \
  X(uint32_t, stripStarts, "[s+1] where each strip begins in `strips`")                           \
  X(uint32_t, polygonStrips, "[p+1] where each polygon's strips begin, in strips")                \
  X(double, added, "[dimension * a] points that repair added, numbered after all others")         \
  X(uint32_t, addedOn, "[2a] the two edges that each added point is on, by their first vertices") \
  X(SfFloodStep, trace, "[t] actions of flooding")                                                \
  X(SfPolygonFault, faults, "[f] the invalid polygons, in order")                                 \
  X(double, faultPoints, "[dimension * f] the point of each fault, or NaN")

#define SF_FLOOD_ACTION_CHOICES(X) \
  X(Start, 0, "start")             \
  X(Raise, 1, "raise")             \
  X(Fill, 2, "fill")               \
  X(Bridge, 3, "bridge")           \
  X(Spill, 4, "spill")             \
  X(Jump, 5, "jump")

#define SF_FLOOD_STEP_RECORD(X)                                                   \
  X(uint32_t, action, "a choice of SF_FLOOD_ACTION_CHOICES")                      \
  X(uint32_t, left, "the vertex at one end of the active chain after the action") \
  X(uint32_t, right, "the vertex at its other end")                               \
  X(uint32_t, triangles, "how many triangles there are after the action")

#define SF_POLYGON_FAULT_RECORD(X)                                                        \
  X(uint32_t, polygon, "the polygon's number")                                            \
  X(uint32_t, status, "one of SF_STATUSES")                                               \
  X(uint32_t, loop, "this and the rest as in SfPlace, with rings counted in the polygon") \
  X(uint32_t, vertex, "")                                                                 \
  X(uint32_t, otherLoop, "")                                                              \
  X(uint32_t, otherVertex, "")

/* sf_session_*: sessions on polygons */

#define SF_OPENED_ARRAYS(X)                        \
  X(uint32_t, session, "[1] the session's number") \
  X(uint32_t, triangles, "[3m]")

#define SF_EDIT_ACTION_CHOICES(X)         \
  X(InsertVertex, 0, "insert")            \
  X(InsertIsolated, 1, "insert-isolated") \
  X(Delete, 2, "delete")                  \
  X(Move, 3, "move")

/* All in one array: handing over several would take longer than the edit. */
#define SF_EDIT_ARRAYS(X) \
  X(uint32_t, edit,       \
    "SfEditFacts; then [c] numbers of new triangles, increasing; then [3c] their corners")

#define SF_EDIT_FACTS_RECORD(X)                                                          \
  X(uint32_t, vertex, "the edited vertex's number")                                      \
  X(uint32_t, triangleCount, "how many triangles there are now")                         \
  X(uint32_t, status, "the status of the edit itself, one of SF_STATUSES")               \
  X(uint32_t, loop, "this and the rest as in SfPlace, but with vertices of the session") \
  X(uint32_t, atVertex, "the first vertex at fault")                                     \
  X(uint32_t, otherLoop, "")                                                             \
  X(uint32_t, otherVertex, "")

#define SF_STATE_ARRAYS(X)                                                     \
  X(double, positions, "[2n] by vertex; those of unused numbers mean nothing") \
  X(uint32_t, next,                                                            \
    "[n] the next vertex of the ring; 0xFFFFFFFF for an isolated vertex, "     \
    "its own number if that is unused")                                        \
  X(uint32_t, strips, "vertices of strips")                                    \
  X(uint32_t, stripStarts, "[s+1] where each strip begins in `strips`")        \
  X(uint32_t, certified,                                                       \
    "[1] 1 if the whole polygon passes the certificate, tested from scratch; else 0")

/* sf_find_holes */

#define SF_HOLES_ARRAYS(X)                                                                \
  X(uint32_t, loopStarts, "[k+1] where the vertices of each loop begin")                  \
  X(uint32_t, loopVertices, "the vertices of all loops, as faces that fill the hole run") \
  X(SfLoopFacts, loopFacts, "[k]")                                                        \
  X(uint32_t, groupStarts, "[g+1] where the loops of each group begin")                   \
  X(uint32_t, groupLoops, "[k] the loops of all groups, the outer rim first")             \
  X(SfGroupFacts, groupFacts, "[g]")                                                      \
  X(uint32_t, session, "[1] the session's number, if the mesh is kept")                   \
  X(SfDefectCounts, defects, "[d] what is wrong with the mesh, a kind at most once")      \
  X(uint32_t, defectPlaces, "for each defect its faces, its edges as pairs, its vertices")

#define SF_LOOP_FACTS_RECORD(X)                                         \
  X(double, length, "of the loop")                                      \
  X(double, diameter, "the largest distance in it")                     \
  X(double, openness, "share of its length, facing nothing")            \
  X(double, component, "number of the component of the faces along it") \
  X(double, isSeam,                                                     \
    "1 if most of it runs along edges of loops at the same places, with other vertices")

#define SF_GROUP_KIND_CHOICES(X) \
  X(Alone, 0, "alone")           \
  X(Island, 1, "island")         \
  X(Band, 2, "band")

#define SF_GROUP_FACTS_RECORD(X)                       \
  X(double, kind, "a choice of SF_GROUP_KIND_CHOICES") \
  X(double, score, "the least vote that it hangs by")  \
  X(double, isOpenRim, "1 if it is meant to be open, else 0")

#define SF_DEFECT_KIND_CHOICES(X)                \
  X(NonManifoldEdge, 0, "non-manifold-edge")     \
  X(NonManifoldVertex, 1, "non-manifold-vertex") \
  X(Flipped, 2, "flipped")                       \
  X(DuplicateFace, 3, "duplicate-face")          \
  X(DegenerateFace, 4, "degenerate-face")        \
  X(NotOrientable, 5, "not-orientable")          \
  X(UnusedVertex, 6, "unused-vertex")

#define SF_DEFECT_COUNTS_RECORD(X)                                   \
  X(uint32_t, kind, "a choice of SF_DEFECT_KIND_CHOICES")            \
  X(uint32_t, faces, "how many numbers of `defectPlaces` are faces") \
  X(uint32_t, edges, "how many are of edges, two for each")          \
  X(uint32_t, vertices, "how many are vertices")

/* sf_weld_mesh */

#define SF_WELD_ARRAYS(X)                                                              \
  X(double, positions, "[3w] of the first vertex of each place, in the input's order") \
  X(uint32_t, faces, "[3m] the input's faces")                                         \
  X(uint32_t, vertexMap, "[n] the new number of each vertex")

/* sf_find_crossings */

#define SF_CROSSINGS_ARRAYS(X) \
  X(uint32_t, pairs, "[2p] faces that intersect, the smaller first; at most some 10 000 pairs")

/* sf_carry_on */

#define SF_CARRY_ARRAYS(X) X(double, values, "[size * f] of the f vertices that are not fixed")

/* sf_fill_holes */

#define SF_FAIRING_CHOICES(X)  \
  X(None, 0, "none")           \
  X(Bending, 1, "bending")     \
  X(Curvature, 2, "curvature") \
  X(Auto, 3, "auto")

#define SF_PATCH_SETTINGS(X)                                                                      \
  X(double, areaWeight, "per square unit; NaN: as in SF_SPAN_SETTINGS")                           \
  X(double, perimeterWeight, "per unit of triangle perimeter")                                    \
  X(double, dihedralWeight, "per radian")                                                         \
  X(double, space, "a choice of SF_SPACE_CHOICES, but not Given")                                 \
  X(double, fairing, "a choice of SF_FAIRING_CHOICES")                                            \
  X(double, density, "how much denser than its surroundings the patch is; 0: as spanned")         \
  X(double, maxNewVertices, "most vertices that refining adds")                                   \
  X(double, crease,                                                                               \
    "edges between faces that differ by more, in radians, go on through the hole; 0: none do")    \
  X(double, inFloats, "1 if coordinates of new vertices are rounded to single precision, else 0") \
  X(double, maxSeconds, "after which the hole is given up, or left as it is; or infinity")

#define SF_FILL_STATUS_CHOICES(X)             \
  X(Filled, 0, "filled")                      \
  X(SelfIntersecting, 1, "self-intersecting") \
  X(Failed, 2, "failed")

#define SF_FILL_REASON_CHOICES(X)             \
  X(None, 0, "none")                          \
  X(NoSurface, 1, "no-surface")               \
  X(RimsIntersect, 2, "rims-intersect")       \
  X(RepeatedVertex, 3, "repeated-vertex")     \
  X(DuplicateFace, 4, "duplicate-face")       \
  X(TooLarge, 5, "too-large")                 \
  X(InsertedVertices, 6, "inserted-vertices") \
  X(Stitched, 7, "stitched")                  \
  X(OpposedRims, 8, "opposed-rims")           \
  X(TimeLimit, 9, "time-limit")

#define SF_FILL_ARRAYS(X)                                                                          \
  X(double, positions, "[3a] the vertices of all patches, numbered from n on")                     \
  X(uint32_t, faces, "[3b] the faces of all patches")                                              \
  X(SfFilledFacts, holes, "[g] by groups")                                                         \
  X(uint32_t, pairs,                                                                               \
    "[2p] by groups: faces of the filled mesh that intersect, but for those of two patches")       \
  X(SfRimSplit, splits, "vertices to be put on rims, for holes that failed with InsertedVertices") \
  X(double, splitParameters, "for each split: at (1 - parameter) tail + parameter head")

#define SF_RIM_SPLIT_RECORD(X)                \
  X(uint32_t, face, "the face along the rim") \
  X(uint32_t, tail, "the ends of the edge")   \
  X(uint32_t, head, "")

#define SF_FILLED_FACTS_RECORD(X)                                                 \
  X(double, status, "a choice of SF_FILL_STATUS_CHOICES")                         \
  X(double, reason, "a choice of SF_FILL_REASON_CHOICES")                         \
  X(double, cost, "of the surface before it was refined")                         \
  X(double, lowerBound, "proven, on that cost")                                   \
  X(double, optimal, "1 if that surface is proven to be the best, else 0")        \
  X(double, rimAngleBefore, "radians: mean angle along the rim, before refining") \
  X(double, rimAngleAfter, "the same after fairing")                              \
  X(double, fairnessUsed, "the order of the fairing, 0 if there was none")        \
  X(double, movedLess, "share of the fairing that was taken back")                \
  X(double, firstFace, "its first face in the filled mesh")                       \
  X(double, endFace, "the one after its last")                                    \
  X(double, pairs, "how many pairs of faces intersect")                           \
  X(double, splits, "how many vertices are to be put on its rims")

/* sf_smooth_surface */

#define SF_SURFACE_KIND_CHOICES(X) \
  X(SoapFilm, 0, "soap-film")      \
  X(ThinPlate, 1, "thin-plate")    \
  X(Curvature, 2, "curvature")

#define SF_SMOOTH_SETTINGS(X)                                                         \
  X(double, kind, "a choice of SF_SURFACE_KIND_CHOICES")                              \
  X(double, density, "how much denser than its boundary the surface is; 0: as it is") \
  X(double, maxNewVertices, "most vertices that refining adds")                       \
  X(double, maxBytes, "memory limit")

#define SF_SMOOTH_ARRAYS(X)                                                       \
  X(double, positions, "[3n] the vertices that stayed as given, then all others") \
  X(uint32_t, triangles, "[3m] wound as given")                                   \
  X(uint32_t, boundary, "[b] the numbers that the first b vertices had")          \
  X(uint32_t, fixed, "[f] the numbers that the next f vertices had")              \
  X(uint32_t, collapsed, "vertices where no film exists")                         \
  X(SfSmoothNumbers, numbers, "[1]")

#define SF_SMOOTH_NUMBERS_RECORD(X) \
  X(double, area, "of the surface") \
  X(double, isMinimal, "1 if a further step of a film would move nothing, else 0")

/* sf_open_surfaces */

#define SF_SURFACE_FAULT_CHOICES(X)                \
  X(BadKnots, 0, "bad-knots")                      \
  X(BadWeights, 1, "bad-weights")                  \
  X(NotFinite, 2, "not-finite")                    \
  X(BadEdge, 3, "bad-edge")                        \
  X(BadDomain, 4, "bad-domain")                    \
  X(TrimOutside, 5, "trim-outside")                \
  X(TrimOpen, 6, "trim-open")                      \
  X(EdgeApart, 7, "edge-apart")                    \
  X(TrimSelfIntersects, 8, "trim-self-intersects") \
  X(TrimsCross, 9, "trims-cross")                  \
  X(HoleOutside, 10, "hole-outside")               \
  X(Degenerate, 11, "degenerate")

#define SF_FACE_FAULT_RECORD(X)                                             \
  X(uint32_t, fault, "a choice of SF_SURFACE_FAULT_CHOICES")                \
  X(uint32_t, face, "the face")                                             \
  X(uint32_t, loop, "its loop, or 0xFFFFFFFF")                              \
  X(uint32_t, use, "the use in this loop, or 0xFFFFFFFF")                   \
  X(uint32_t, otherLoop, "the other loop of two that cross, or 0xFFFFFFFF") \
  X(uint32_t, edge, "the edge, or 0xFFFFFFFF")

#define SF_SURFACES_ARRAYS(X)                                         \
  X(uint32_t, session, "[1] the number of the session")               \
  X(SfFaceFault, faults, "[f] the faces that are left out, in order") \
  X(double, box, "[6] least and greatest corner around all faces left in")

/* sf_tessellate_surfaces, sf_update_surfaces */

#define SF_SAMPLING_SETTINGS(X)                                                               \
  X(double, tolerance, "most distance of mesh and surface, positive")                         \
  X(double, angle, "most turn of the normal along an edge in radians, up to pi; more: none")  \
  X(double, aspect, "how long cells may be for their width, from 1 on; infinity: any length") \
  X(double, maxTriangles, "most triangles; infinity: any number")                             \
  X(double, maxSeconds, "time after which what there is is handed out; infinity: any time")   \
  X(double, hasCamera, "1 if what follows counts, else 0")                                    \
  X(double, eyeX, "")                                                                         \
  X(double, eyeY, "")                                                                         \
  X(double, eyeZ, "")                                                                         \
  X(double, m0, "view and projection, column by column")                                      \
  X(double, m1, "")                                                                           \
  X(double, m2, "")                                                                           \
  X(double, m3, "")                                                                           \
  X(double, m4, "")                                                                           \
  X(double, m5, "")                                                                           \
  X(double, m6, "")                                                                           \
  X(double, m7, "")                                                                           \
  X(double, m8, "")                                                                           \
  X(double, m9, "")                                                                           \
  X(double, m10, "")                                                                          \
  X(double, m11, "")                                                                          \
  X(double, m12, "")                                                                          \
  X(double, m13, "")                                                                          \
  X(double, m14, "")                                                                          \
  X(double, m15, "")                                                                          \
  X(double, width, "of the picture in pixels")                                                \
  X(double, height, "")                                                                       \
  X(double, pixels, "most distance of mesh and surface on the picture, positive")

#define SF_SURFACE_REPORT_CHOICES(X)        \
  X(LeftOut, 0, "left-out")                 \
  X(CrossingSamples, 1, "crossing-samples") \
  X(ToleranceRaised, 2, "tolerance-raised") \
  X(AboveTolerance, 3, "above-tolerance")   \
  X(TimeOver, 4, "time-over")

#define SF_SURFACE_REPORT_RECORD(X)                                                     \
  X(double, report, "a choice of SF_SURFACE_REPORT_CHOICES")                            \
  X(double, face, "the face, or -1")                                                    \
  X(double, fault, "of a face left out: a choice of SF_SURFACE_FAULT_CHOICES, else -1") \
  X(double, value, "how many intervals were halved; the tolerance kept to; the deviation; or 0")

#define SF_TESSELLATION_NUMBERS_RECORD(X)                               \
  X(double, originX, "what positions are relative to")                  \
  X(double, originY, "")                                                \
  X(double, originZ, "")                                                \
  X(double, deviation, "largest distance of mesh and surface measured") \
  X(double, tolerance, "the tolerance kept to")

#define SF_TESSELLATION_ARRAYS(X)                                                \
  X(float, positions, "[3n] relative to the origin")                             \
  X(float, normals, "[3n] unit")                                                 \
  X(float, uvs, "[2n] parameters of the surface")                                \
  X(uint32_t, triangles, "[3m] counter-clockwise seen from where normals point") \
  X(uint32_t, faceStarts, "[f+1] in triangles")                                  \
  X(uint32_t, strips, "vertices of strips, in the order of OpenGL")              \
  X(uint32_t, stripStarts, "[s+1]")                                              \
  X(uint32_t, edges, "vertices along each edge, of one of its faces")            \
  X(uint32_t, edgeStarts, "[e+1]")                                               \
  X(uint32_t, same, "[n] the first vertex at the same place")                    \
  X(SfSurfaceReport, reports, "[r] what is to be told")                          \
  X(SfTessellationNumbers, numbers, "[1]")

/* What an update has changed. Blocks of faces have room to grow: what is left of them is filled with triangles and strips of one
   vertex, and vertices that no triangle has. */
#define SF_CHANGE_ARRAYS(X)                                                                    \
  X(uint32_t, vertexRanges, "[2a] from, to: vertices that are written")                        \
  X(float, positions, "of these vertices")                                                     \
  X(float, normals, "of these vertices")                                                       \
  X(float, uvs, "of these vertices")                                                           \
  X(uint32_t, indexRanges, "[2b] from, to: elements of the triangles' array that are written") \
  X(uint32_t, triangles, "these elements")                                                     \
  X(uint32_t, stripRanges, "[2c] from, to: elements of the strips' array that are written")    \
  X(uint32_t, strips, "these elements")                                                        \
  X(uint32_t, faces, "the faces that have changed")                                            \
  X(uint32_t, sizes, "[3] numbers of vertices, of elements of triangles and of strips")        \
  X(uint32_t, faceStarts, "[f+1] in triangles")                                                \
  X(uint32_t, stripStarts, "[s+1]")                                                            \
  X(uint32_t, edges, "vertices along each edge, of one of its faces")                          \
  X(uint32_t, edgeStarts, "[e+1]")                                                             \
  X(uint32_t, same, "[n] the first vertex at the same place")                                  \
  X(SfSurfaceReport, reports, "[r] what is to be told")                                        \
  X(SfTessellationNumbers, numbers, "[1]")

/* sf_move_pole, sf_move_trim */

#define SF_MOVE_ARRAYS(X) X(SfFaceFault, faults, "[0 or 1] why it is refused")

#endif
