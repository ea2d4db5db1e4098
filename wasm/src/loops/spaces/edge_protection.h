// Edge protection: vertices put on loop edges until all edges are Delaunay.
// Source: Zou, Ju, Carr 2013, sec. 4.2; Shewchuk 2002, "Constrained Delaunay tetrahedralizations
// and provably good boundary recovery", sec. 3, for the two kinds of splits.
// Differs: only edges that are missing are split, whether or not their diametral spheres are empty.
// Corners are cut only where one edge at the corner is missing because of the other. Edges that are
// missing because of ties among co-spherical points are first looked for by breaking the ties in
// other ways.
#pragma once
#include <cstdint>
#include <vector>

#include "base/status.h"
#include "base/work.h"
#include "loops/problem/loop_set.h"

namespace sf {

/// A vertex that edge protection put on a loop edge.
struct InsertedVertex {
  uint32_t loop;     // input loop
  uint32_t edge;     // edge from vertex `edge` of that loop to the next, counted in the input loop
  double parameter;  // 0 to 1 along that edge
};

struct ProtectedLoops {
  LoopSet loops;  // n' vertices, numbered loop by loop, the inserted ones in their places
  std::vector<uint32_t> origin;          // [n'] input vertex, or n + i for inserted[i]
  std::vector<InsertedVertex> inserted;  // [n' - n] by loop, edge and parameter, all increasing
  std::vector<uint32_t> facets;          // [3f] of the tetrahedralization of `loops`; see below
};

/// Puts vertices on loop edges until every edge of the enriched loops is an edge of their Delaunay
/// tetrahedralization, and hence of at least one facet. Puts none if that holds from the start.
/// The facets are increasing triples of vertices of `result.loops`, in lexicographic order.
/// Coplanar loops have the triangles of their planar triangulation, collinear ones no facets.
///   loops   that pass checkLoops with `intersections`
///   result  inserted vertices lie at a + t (b - a), rounded; no two vertices are equal
/// Status Ok, OutOfMemory, Stopped, or NotFound if more than 50 n + 1000 vertices were needed or
/// the loops come closer to each other than rounding can resolve.
Status protectEdges(const LoopSet& loops, Work& work, ProtectedLoops& result);

}  // namespace sf
