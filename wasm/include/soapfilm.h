// The C ABI of soapfilm's core: what the TypeScript runtime calls, and what native tests call.
// Plain pointers and counts; nothing throws, every call checks its input. sf_span_loops is exported
// by loops.wasm, functions for polygons by polygons.wasm, memory and result arrays by both.
#ifndef SOAPFILM_H
#define SOAPFILM_H
#include <stddef.h>
#include <stdint.h>

#if defined(__wasm__)
#define SF_API(name) __attribute__((export_name(#name), used, visibility("default")))
#else
#define SF_API(name) __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// 0 ok, 1 no triangulation, else an error: the values of sf::Status in src/base/status.h.
typedef int32_t SfStatus;

/// Arrays handed back by one call; owned by the caller until sf_result_free.
typedef struct SfResult SfResult;

/// Imported from the host as `env.sf_host_progress`; native programs define it themselves.
/// Called about every millisecond; returns nonzero to go on, 0 to stop the call under way.
int32_t sf_host_progress(double fraction, double bestCost, double lowerBound);

/// Imported as `env.sf_host_result`: arrays of a result that the call under way has so far, which are
/// the host's until it returns.
void sf_host_result(const SfResult* result);

/// Memory inside the instance, for arrays passed in. Null when it cannot be had.
SF_API(sf_alloc) void* sf_alloc(size_t bytes);
SF_API(sf_free) void sf_free(void* pointer);

/// Number of result arrays; the address and length (in elements) of one. The functions below say
/// which array is which.
SF_API(sf_result_data) const void* sf_result_data(const SfResult* result, uint32_t array);
SF_API(sf_result_length) size_t sf_result_length(const SfResult* result, uint32_t array);
SF_API(sf_result_free) void sf_result_free(SfResult* result);

/// Spans closed loops with the optimal manifold triangulation (Zou, Ju, Carr 2013).
///   positions        [3 * starts[loopCount]] xyz
///   starts           [loopCount + 1], from 0, increasing
///   boundaryNormals  [3 * n] or null: unit or not, NaN triple for no face
///   triangles        [3 * triangleCount] candidates for space 4, else null
///   triangleWeights  [triangleCount] or null
///   start            [3 * startCount] triangles of an earlier answer to begin from, or null
///   settings         [7] weights of area (NaN: 1e-3 / squared bounding-box diagonal), perimeter,
///                    dihedral; objective (0 sum, 1 worst-dihedral);
///                    space (0 auto, 1 all, 2 Delaunay, 3 near, 4 given); memory limit in bytes;
///                    1 for the best surface so far, each of which sf_host_result is told of, where
///                    the work ends early; else 0
///   where            [4] out: loop, vertex, other loop, other vertex at fault, or 0xFFFFFFFF
///   result           out: arrays
///       0 double   [3n'] positions        5 double   [14] found, space, cost, lower bound, optimal,
///       1 uint32_t [3m]  triangles               area, perimeter, dihedral, worst dihedral, own,
///       2 uint32_t [m]   order                   candidates, domains, minimal sets, peak bytes
///       3 uint32_t [k+1] starts           6 uint32_t [2i] loop and edge of each inserted vertex
///       4 uint32_t [n']  loop vertices    7 double   [i]  its parameter along that edge
///     null unless the status is 0 or 1
SF_API(sf_span_loops)
SfStatus sf_span_loops(const double* positions, const uint32_t* starts, uint32_t loopCount,
                       const double* boundaryNormals, const uint32_t* triangles,
                       uint32_t triangleCount, const double* triangleWeights, const uint32_t* start,
                       uint32_t startCount, const double* settings, uint32_t* where,
                       SfResult** result);

/// Triangulates polygons with holes in the plane (Ronfard, Rossignac 1994; Kumar).
///   positions      [dimension * n] vertices; in space, polygon by polygon near a plane
///   ringStarts     [ringCount + 1] in vertices, from 0, increasing
///   polygonStarts  [polygonCount + 1] in rings, from 0, increasing; the first ring of each polygon is
///                  its outer one
///   points         [dimension * pointCount] isolated vertices inside the only polygon, numbered from
///                  n on; or null
///   settings       [8] dimension (2, 3); method (0 flooding, 1 trapezoids); repair (0 none, 1
///                  even-odd, 2 nonzero); Delaunay triangles, strips, certificate, trace (0, 1 each);
///                  memory limit in bytes
///   where          [4] out: as of sf_span_loops, for faults of the call as a whole
///   result         out: arrays; counter-clockwise means, in space, as the outer ring runs
///       0 uint32_t [3m]  triangles, counter-clockwise     5 double   [dimension * a] points that
///       1 uint32_t [p+1] in triangles, where each               repair added, numbered after all others
///                        polygon's begin                  6 uint32_t [2a] the edges each is on, by
///       2 uint32_t       vertices of strips                     their first vertices
///       3 uint32_t [s+1] in those, where each strip       7 uint32_t [4t] actions of flooding: action,
///                        begins                                 ends of the active chain, triangles
///       4 uint32_t [p+1] in strips, where each            8 uint32_t [6f] invalid polygons: polygon,
///                        polygon's begin                        status, two rings with vertices as in
///                                                               `where`, counted in the polygon
///                                                         9 double   [dimension * f] where each fault
///                                                               is, or NaN
///     null unless the status is 0. An invalid polygon has no triangles.
SF_API(sf_triangulate_polygons)
SfStatus sf_triangulate_polygons(const double* positions, const uint32_t* ringStarts,
                                 uint32_t ringCount, const uint32_t* polygonStarts,
                                 uint32_t polygonCount, const double* points, uint32_t pointCount,
                                 const double* settings, uint32_t* where, SfResult** result);

/// Begins a session on one polygon of the plane, whose rings may not touch, and whose vertices are then
/// inserted, deleted and moved: only the triangles around are made anew (Kumar, sec. 5).
///   points    [2 * pointCount] isolated vertices inside, numbered from n on
///   maxBytes  memory limit for the session and each of its calls
///   where     [4] out: as of sf_triangulate_polygons
///   result    out: 0 uint32_t [1] the session's number; 1 uint32_t [3m] triangles; null if refused
SF_API(sf_session_open)
SfStatus sf_session_open(const double* positions, const uint32_t* ringStarts, uint32_t ringCount,
                         const double* points, uint32_t pointCount, double maxBytes,
                         uint32_t* where, SfResult** result);

/// An edit of a session; one that is refused leaves the polygon as it was, though perhaps with other
/// triangles.
///   action  0 inserts a vertex after `vertex` of a ring, 1 an isolated one, 2 deletes `vertex`, 3
///           moves it
///   x, y    the place, for all but deletions
///   where   [4] out: nothing
///   result  out: 0 uint32_t [7 + 4c] the vertex's number, how many triangles there are now, and the status
///           of the edit itself with ring and number of the edited vertex and of the culprit; then
///           which c triangles are new, and [3c] their corners
SF_API(sf_session_edit)
SfStatus sf_session_edit(uint32_t session, uint32_t action, uint32_t vertex, double x, double y,
                         uint32_t* where, SfResult** result);

/// What a session holds.
///   result  out: 0 double [2n] positions by number; 1 uint32_t [n] the next vertex of each one's ring,
///           or 0xFFFFFFFF for isolated ones, or the vertex itself for numbers out of use;
///           2 uint32_t strips and 3 uint32_t [s+1] where each begins; 4 uint32_t [1] whether all of it
///           has passed the certificate, from scratch
SF_API(sf_session_read)
SfStatus sf_session_read(uint32_t session, uint32_t* where, SfResult** result);

/// Ends a session, if there is one of that number, which may then be given again. Returns 0.
SF_API(sf_session_close) SfStatus sf_session_close(uint32_t session);

#ifdef __cplusplus
}
#endif
#endif
