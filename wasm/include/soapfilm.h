// The C ABI of soapfilm's core, for the TypeScript runtime and for native tests. It takes plain pointers and
// counts. Nothing throws, and every call checks its input. loops.wasm exports sf_span_loops; polygons.wasm
// exports the functions for polygons, meshes.wasm those for meshes, surfaces.wasm those for trimmed surfaces; all
// export those for memory and result arrays.
//
// Threads: no function may be called from two threads at once. Each instance of a module, or each native
//   process, runs one call at a time. Instances share nothing.
// Re-entry: while sf_host_progress or sf_host_result runs, only sf_result_data and sf_result_length may be
//   called, and only for the result that sf_host_result was given.
// Alignment: arrays and structs that are passed in start at a multiple of their elements' size. Memory from
//   sf_alloc starts at a multiple of 8. Everything that comes out is aligned in the same way. An array
//   without elements may have any address, but null means "none" where a comment says so.
// Ownership: what is passed in stays the caller's; it is only read, and not kept after the call. A result and
//   its arrays are the caller's until sf_result_free, and stay at their addresses. Views of a WebAssembly
//   memory are void after each call, since the memory may have grown.
// Traps: if a call traps, its instance is in an unknown state, and all that it held is lost.
#ifndef SOAPFILM_H
#define SOAPFILM_H
#include <stddef.h>
#include <stdint.h>

#include "soapfilm_tables.h"

#if defined(__wasm__)
#define SF_API(name) __attribute__((export_name(#name), used, visibility("default")))
#else
#define SF_API(name) __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// One of SF_STATUSES.
typedef int32_t SfStatus;

// The structs of the tables, field by field.
#define SF_FIELD(type, name, meaning) type name;
typedef struct SfPlace {
  SF_PLACE_RECORD(SF_FIELD)
} SfPlace;
typedef struct SfSpanSettings {
  SF_SPAN_SETTINGS(SF_FIELD)
} SfSpanSettings;
typedef struct SfSpanNumbers {
  SF_SPAN_NUMBERS_RECORD(SF_FIELD)
} SfSpanNumbers;
typedef struct SfInsertedPlace {
  SF_INSERTED_PLACE_RECORD(SF_FIELD)
} SfInsertedPlace;
typedef struct SfPolygonSettings {
  SF_POLYGON_SETTINGS(SF_FIELD)
} SfPolygonSettings;
typedef struct SfFloodStep {
  SF_FLOOD_STEP_RECORD(SF_FIELD)
} SfFloodStep;
typedef struct SfPolygonFault {
  SF_POLYGON_FAULT_RECORD(SF_FIELD)
} SfPolygonFault;
typedef struct SfEditFacts {
  SF_EDIT_FACTS_RECORD(SF_FIELD)
} SfEditFacts;
typedef struct SfLoopFacts {
  SF_LOOP_FACTS_RECORD(SF_FIELD)
} SfLoopFacts;
typedef struct SfGroupFacts {
  SF_GROUP_FACTS_RECORD(SF_FIELD)
} SfGroupFacts;
typedef struct SfDefectCounts {
  SF_DEFECT_COUNTS_RECORD(SF_FIELD)
} SfDefectCounts;
typedef struct SfPatchSettings {
  SF_PATCH_SETTINGS(SF_FIELD)
} SfPatchSettings;
typedef struct SfFilledFacts {
  SF_FILLED_FACTS_RECORD(SF_FIELD)
} SfFilledFacts;
typedef struct SfRimSplit {
  SF_RIM_SPLIT_RECORD(SF_FIELD)
} SfRimSplit;
typedef struct SfSmoothSettings {
  SF_SMOOTH_SETTINGS(SF_FIELD)
} SfSmoothSettings;
typedef struct SfSmoothNumbers {
  SF_SMOOTH_NUMBERS_RECORD(SF_FIELD)
} SfSmoothNumbers;
typedef struct SfFaceFault {
  SF_FACE_FAULT_RECORD(SF_FIELD)
} SfFaceFault;
typedef struct SfSamplingSettings {
  SF_SAMPLING_SETTINGS(SF_FIELD)
} SfSamplingSettings;
typedef struct SfSurfaceReport {
  SF_SURFACE_REPORT_RECORD(SF_FIELD)
} SfSurfaceReport;
typedef struct SfTessellationNumbers {
  SF_TESSELLATION_NUMBERS_RECORD(SF_FIELD)
} SfTessellationNumbers;
#undef SF_FIELD

// The arrays of each result, by name: SfSpan_triangles and the like.
#define SF_ARRAY(type, name, meaning) SfSpan_##name,
enum SfSpanArray { SF_SPAN_ARRAYS(SF_ARRAY) SfSpanArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfPolygon_##name,
enum SfPolygonArray { SF_POLYGON_ARRAYS(SF_ARRAY) SfPolygonArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfOpened_##name,
enum SfOpenedArray { SF_OPENED_ARRAYS(SF_ARRAY) SfOpenedArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfEdit_##name,
enum SfEditArray { SF_EDIT_ARRAYS(SF_ARRAY) SfEditArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfState_##name,
enum SfStateArray { SF_STATE_ARRAYS(SF_ARRAY) SfStateArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfHoles_##name,
enum SfHolesArray { SF_HOLES_ARRAYS(SF_ARRAY) SfHolesArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfCrossings_##name,
enum SfCrossingsArray { SF_CROSSINGS_ARRAYS(SF_ARRAY) SfCrossingsArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfWeld_##name,
enum SfWeldArray { SF_WELD_ARRAYS(SF_ARRAY) SfWeldArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfCarry_##name,
enum SfCarryArray { SF_CARRY_ARRAYS(SF_ARRAY) SfCarryArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfFill_##name,
enum SfFillArray { SF_FILL_ARRAYS(SF_ARRAY) SfFillArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfSmooth_##name,
enum SfSmoothArray { SF_SMOOTH_ARRAYS(SF_ARRAY) SfSmoothArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfSurfaces_##name,
enum SfSurfacesArray { SF_SURFACES_ARRAYS(SF_ARRAY) SfSurfacesArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfTessellation_##name,
enum SfTessellationArray { SF_TESSELLATION_ARRAYS(SF_ARRAY) SfTessellationArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfChange_##name,
enum SfChangeArray { SF_CHANGE_ARRAYS(SF_ARRAY) SfChangeArrayCount };
#undef SF_ARRAY
#define SF_ARRAY(type, name, meaning) SfMove_##name,
enum SfMoveArray { SF_MOVE_ARRAYS(SF_ARRAY) SfMoveArrayCount };
#undef SF_ARRAY

/// Arrays handed back by one call; owned by the caller until sf_result_free.
typedef struct SfResult SfResult;

/// Imported from the host as `env.sf_host_progress`; native programs define it themselves. Called about every
/// millisecond of work. Returns nonzero to go on, 0 to stop the call under way.
int32_t sf_host_progress(double fraction, double bestCost, double lowerBound);

/// Imported from the host as `env.sf_host_seconds`: seconds since some moment, the same during a call. Asked for only
/// where a part of a call has a time limit of its own.
double sf_host_seconds(void);

/// Imported from the host as `env.sf_host_result`. Called with each better result of the call under way. The
/// result and its arrays are the core's, and valid until this returns.
void sf_host_result(const SfResult* result);

/// Memory inside the instance, for arrays to pass in. Null if there is not enough.
SF_API(sf_alloc) void* sf_alloc(size_t bytes);
SF_API(sf_free) void sf_free(void* pointer);

/// The address of a result's array, and its length in numbers: null and 0 if the array is empty or does not
/// exist. `array` is a value of the enum for the table that each function below names.
SF_API(sf_result_data) const void* sf_result_data(const SfResult* result, uint32_t array);
SF_API(sf_result_length) size_t sf_result_length(const SfResult* result, uint32_t array);
/// Frees a result and its arrays; null is allowed.
SF_API(sf_result_free) void sf_result_free(SfResult* result);

/// Spans closed loops with the optimal manifold triangulation (Zou, Ju, Carr 2013).
///   positions        [3 * starts[loopCount]] xyz
///   starts           [loopCount + 1], from 0, increasing
///   boundaryNormals  [3 * n] or null: unit or not, NaN triple for no face
///   triangles        [3 * triangleCount] candidates, for the space Given; else null
///   triangleWeights  [triangleCount] or null
///   start            [3 * startCount] triangles of an earlier answer to begin from, or null
///   where            out: the place at fault
///   result           out: SF_SPAN_ARRAYS; null unless the status is Ok or NotFound
SF_API(sf_span_loops)
SfStatus sf_span_loops(const double* positions, const uint32_t* starts, uint32_t loopCount,
                       const double* boundaryNormals, const uint32_t* triangles,
                       uint32_t triangleCount, const double* triangleWeights, const uint32_t* start,
                       uint32_t startCount, const SfSpanSettings* settings, SfPlace* where,
                       SfResult** result);

/// Triangulates polygons with holes in the plane (Ronfard, Rossignac 1994; Kumar).
///   positions      [dimension * n] vertices; in space, those of each polygon lie near a plane
///   ringStarts     [ringCount + 1] in vertices, from 0, increasing
///   polygonStarts  [polygonCount + 1] in rings, from 0, never falling; the first ring of each polygon is
///                  its outer one, and a polygon without rings is empty
///   points         [dimension * pointCount] isolated vertices inside the only polygon, numbered from
///                  n on; or null
///   where          out: the place at fault, if the call as a whole is
///   result         out: SF_POLYGON_ARRAYS; null unless the status is Ok. An invalid polygon has a fault
///                  and no triangles.
SF_API(sf_triangulate_polygons)
SfStatus sf_triangulate_polygons(const double* positions, const uint32_t* ringStarts,
                                 uint32_t ringCount, const uint32_t* polygonStarts,
                                 uint32_t polygonCount, const double* points, uint32_t pointCount,
                                 const SfPolygonSettings* settings, SfPlace* where,
                                 SfResult** result);

/// Begins a session on one polygon of the plane, whose rings may not touch. Its vertices can then be
/// inserted, deleted and moved; an edit makes only the triangles around it anew (Kumar, sec. 5).
///   positions, ringStarts, points   as for sf_triangulate_polygons, in the plane
///   maxBytes  memory limit for the session and each of its calls
///   where     out: the place at fault
///   result    out: SF_OPENED_ARRAYS; null if refused
SF_API(sf_session_open)
SfStatus sf_session_open(const double* positions, const uint32_t* ringStarts, uint32_t ringCount,
                         const double* points, uint32_t pointCount, double maxBytes, SfPlace* where,
                         SfResult** result);

/// Edits the polygon of a session. A refused edit leaves the polygon as it was, but may leave other
/// triangles.
///   action  one of SF_EDIT_ACTION_CHOICES: insert a vertex into a ring after `vertex`, insert an isolated
///           one, delete `vertex`, or move it
///   x, y    the place of the vertex, for all but deletions
///   where   out: no place
///   result  out: SF_EDIT_ARRAYS. A refused edit has them too: their `status` says why. Null if there is no
///           such session or action
SF_API(sf_session_edit)
SfStatus sf_session_edit(uint32_t session, uint32_t action, uint32_t vertex, double x, double y,
                         SfPlace* where, SfResult** result);

/// What a session holds.
///   where   out: no place
///   result  out: SF_STATE_ARRAYS; null unless the status is Ok
SF_API(sf_session_read)
SfStatus sf_session_read(uint32_t session, SfPlace* where, SfResult** result);

/// Ends the session of that number, if there is one. A later session may get the number. Returns Ok.
SF_API(sf_session_close) SfStatus sf_session_close(uint32_t session);

/// Finds the holes of a triangle mesh, and groups their rims (Zou, Ju, Carr 2013, sec. 5, 6).
///   positions  [3 * vertexCount] xyz
///   faces      [3 * faceCount]
///   keeps      whether a copy of the mesh stays in a session, for sf_fill_holes
///   groups     whether rims are grouped and handed out. Filling needs neither: `session` is then all there is
///   maxBytes   memory limit
///   where      out: the vertex at fault; for BadMesh, the face as `vertex`
///   result     out: SF_HOLES_ARRAYS; null unless the status is Ok
SF_API(sf_find_holes)
SfStatus sf_find_holes(const double* positions, uint32_t vertexCount, const uint32_t* faces,
                       uint32_t faceCount, uint32_t keeps, uint32_t groups, double maxBytes,
                       SfPlace* where, SfResult** result);

/// Welds each vertex to the first one within `radius` that was not welded itself; 0: at the same place.
///   radius   finite, not negative; the rest as for sf_find_holes
///   result   out: SF_WELD_ARRAYS; null unless the status is Ok
SF_API(sf_weld_mesh)
SfStatus sf_weld_mesh(const double* positions, uint32_t vertexCount, const uint32_t* faces,
                      uint32_t faceCount, double radius, double maxBytes, SfPlace* where,
                      SfResult** result);

/// Finds the faces of a mesh that have more in common than vertices and edges that they share.
///   as for sf_find_holes
///   result   out: SF_CROSSINGS_ARRAYS; null unless the status is Ok
SF_API(sf_find_crossings)
SfStatus sf_find_crossings(const double* positions, uint32_t vertexCount, const uint32_t* faces,
                           uint32_t faceCount, double maxBytes, SfPlace* where, SfResult** result);

/// Fills holes of a mesh that is kept.
///   session       of sf_find_holes
///   groupStarts   [groupCount + 1] from 0, increasing: where the loops of each hole begin
///   groupLoops    numbers of loops, as sf_find_holes has them, each at most once; else BadOption
///   settings      [groupCount] one for each hole
///   maxBytes      memory limit, what is kept included
///   where         out: no place
///   result        out: SF_FILL_ARRAYS; null unless the status is Ok
SF_API(sf_fill_holes)
SfStatus sf_fill_holes(uint32_t session, const uint32_t* groupStarts, uint32_t groupCount,
                       const uint32_t* groupLoops, const SfPatchSettings* settings, double maxBytes,
                       SfPlace* where, SfResult** result);

/// Ends the session of that number, if there is one. A later session may get the number. Returns Ok.
SF_API(sf_close_mesh) SfStatus sf_close_mesh(uint32_t session);

/// Carries values of vertices on over faces: each that is not fixed gets the mean of its neighbours' values, in which
/// a neighbour counts once for each face that both are in. Parts of them that have no fixed neighbour get 0.
///   as for sf_find_holes, and
///   fixedCount   the first vertices, which are fixed; at most all
///   values       [size * fixedCount] theirs, finite; else NotFinite
///   size         how many values a vertex has, from 1 to 2^30 - 1
///   result       out: SF_CARRY_ARRAYS; null unless the status is Ok
SF_API(sf_carry_on)
SfStatus sf_carry_on(const double* positions, uint32_t vertexCount, const uint32_t* faces,
                     uint32_t faceCount, uint32_t fixedCount, const double* values, uint32_t size,
                     double maxBytes, SfPlace* where, SfResult** result);

/// Smooths a surface between its boundary: a soap film, or a plate.
///   positions, vertexCount, triangles, triangleCount   manifold, oriented, with a boundary
///   fixed    [fixedCount] vertices inside that stay where they are, or null; else BadOption
///   boundaryNormals  [3 * normalCount] or null, not for soap films: for the edges of the boundary, by loops in order
///            of their least vertex, each loop from that on towards the lesser of its two neighbours there: the
///            normal, unit or not, of the surface wound along the loop in that direction; NaN triple: not known
///   where    out: the vertex at fault; for BadMesh and BadSurface, the triangle as `vertex`, and if an edge of it is
///            at fault its ends as `otherLoop` and `otherVertex`; for BadNormals, the edge's place in the list as
///            `vertex`, and its ends in the same way; for BadNormalCount, the right count as `vertex`
///   result   out: SF_SMOOTH_ARRAYS; null unless the status is Ok
SF_API(sf_smooth_surface)
SfStatus sf_smooth_surface(const double* positions, uint32_t vertexCount, const uint32_t* triangles,
                           uint32_t triangleCount, const uint32_t* fixed, uint32_t fixedCount,
                           const double* boundaryNormals, uint32_t normalCount,
                           const SfSmoothSettings* settings, SfPlace* where, SfResult** result);

/// Opens a session on trimmed surfaces with shared edges (Kumar). Faces with faults are left out of all that follows.
///   shape     [shapeLength] counts, in the order that src/surface/model.h tells
///   numbers   [numberLength] all else
///   maxBytes  memory limit
///   where     out: no place
///   result    out: SF_SURFACES_ARRAYS; null unless the status is Ok. BadOption if the arrays do not fit their counts
SF_API(sf_open_surfaces)
SfStatus sf_open_surfaces(const uint32_t* shape, uint32_t shapeLength, const double* numbers,
                          uint32_t numberLength, double maxBytes, SfPlace* where,
                          SfResult** result);

/// Tessellates the surfaces of a session from scratch.
///   maxBytes  memory limit, what is kept included
///   where     out: no place
///   result    out: SF_TESSELLATION_ARRAYS; null unless the status is Ok
SF_API(sf_tessellate_surfaces)
SfStatus sf_tessellate_surfaces(uint32_t session, const SfSamplingSettings* settings,
                                double maxBytes, SfPlace* where, SfResult** result);

/// Makes the mesh of a session one of another sampling, or of poles that have moved, from what there is.
///   as for sf_tessellate_surfaces, but
///   result    out: SF_CHANGE_ARRAYS, on top of the mesh that the last call has left; of all of it after
///             sf_tessellate_surfaces, or if there is none yet
SF_API(sf_update_surfaces)
SfStatus sf_update_surfaces(uint32_t session, const SfSamplingSettings* settings, double maxBytes,
                            SfPlace* where, SfResult** result);

/// Moves a pole of a face's surface; the next update or tessellation follows.
///   pole      its index; BadOption if there is no such face or pole, or a number is not finite
///   weight    its new weight, positive, or 0: as it was
///   result    out: SF_MOVE_ARRAYS; with a fault all is as before
SF_API(sf_move_pole)
SfStatus sf_move_pole(uint32_t session, uint32_t face, uint32_t pole, double x, double y, double z,
                      double weight, double maxBytes, SfPlace* where, SfResult** result);

/// The same for a pole of the trimming curve of a use, in the domain of the face.
SF_API(sf_move_trim)
SfStatus sf_move_trim(uint32_t session, uint32_t face, uint32_t loop, uint32_t use, uint32_t pole,
                      double u, double v, double maxBytes, SfPlace* where, SfResult** result);

/// Ends the session of that number, if there is one. A later session may get the number. Returns Ok.
SF_API(sf_close_surfaces) SfStatus sf_close_surfaces(uint32_t session);

#ifdef __cplusplus
}
#endif
#endif
